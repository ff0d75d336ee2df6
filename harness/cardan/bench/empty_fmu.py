"""An FMU that does nothing: what the export itself costs per step."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

OUTPUTS = ("y1", "y2", "y3", "y4", "y5")

_SLAVE = '''
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Empty(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        for name in ("u1", "u2", "y1", "y2", "y3", "y4", "y5"):
            setattr(self, name, 0.0)
            causality = Fmi2Causality.input if name[0] == "u" else Fmi2Causality.output
            self.register_variable(Real(name, causality=causality))

    def do_step(self, current_time, step_size):
        return True
'''
_OWN_ACCESS = '''
    def get_real(self, vrs):
        return [0.0] * len(vrs)

    def set_real(self, vrs, values):
        pass
'''


def build_empty(folder: Path, own_access: bool = False) -> Path:
    """Build it.

    Parameters
    ----------
    folder : Path
        Made where it is missing.
    own_access : bool
        Whether it has getters and setters of its own in the place of pythonfmu's, which look up every variable.

    Returns
    -------
    Path
        The FMU.
    """
    folder.mkdir(parents=True, exist_ok=True)
    name = "empty_own" if own_access else "empty"
    (folder / f"{name}.py").write_text(_SLAVE + (_OWN_ACCESS if own_access else ""), encoding="utf-8")
    # pythonfmu imports the slave into the process that builds it, so that is another one (docs/FMI.md, trap 2).
    code = f"from pythonfmu import FmuBuilder; FmuBuilder.build_FMU('{name}.py', dest='.')"
    subprocess.run([sys.executable, "-c", code], cwd=folder, check=True, capture_output=True)
    return folder / "Empty.fmu"
