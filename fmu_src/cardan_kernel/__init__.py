"""Physics and integration of the cardan driveline, in plain Python or compiled from the same source.

`Driveline` is the compiled class where a compiled kernel fits this interpreter, else the interpreted
one; both give the same results to the last bit.
"""

from typing import TYPE_CHECKING

from .driveline import Driveline as Interpreted
from .tangent import JACOBIAN_INPUTS, JACOBIAN_OUTPUTS, JACOBIAN_STATES
from .variables import INDEX, UNITS, VARIABLES, Unit, Variable

try:
    from ._compiled import Driveline as Compiled
except ImportError:
    Compiled = None

__version__ = "0.1.0"

if TYPE_CHECKING:
    Driveline = Interpreted
else:
    Driveline = Interpreted if Compiled is None else Compiled
KERNEL = "interpreted" if Compiled is None else "compiled"

__all__ = [
    "INDEX", "JACOBIAN_INPUTS", "JACOBIAN_OUTPUTS", "JACOBIAN_STATES", "KERNEL", "UNITS", "VARIABLES",
    "Compiled", "Driveline", "Interpreted", "Unit", "Variable",
]
