"""The kernel for the analysis of periodic motions, compiled where a compiled kernel fits, else interpreted."""

from .bundle import POINT_IN, POINT_OUT
from .law import MOST_HARMONICS

try:
    from ._compiled import Bundle, Variation
except ImportError:
    from .bundle import Bundle
    from .variation import Variation

__all__ = ["MOST_HARMONICS", "POINT_IN", "POINT_OUT", "Bundle", "Variation"]
