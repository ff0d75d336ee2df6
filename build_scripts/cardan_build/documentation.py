"""The FMU's ``documentation`` folder: page for people, licences, what the importing process must bring."""

from __future__ import annotations

import importlib.metadata
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any

from . import BuildError

EXTERNAL = """CardanDriveline is a Python FMU (exporter: PythonFMU). It carries its Python code and needs from the
importing process, on Linux (x86-64, glibc 2.32 or later) or Windows (x86-64):

- Python 3.9 or later, nothing else: no numpy, no further package.
- The compiled kernel inside is used by Python 3.11 and later on its platform; elsewhere the same source runs
  interpreted, with the same results, more slowly. The first log message tells which one runs.
- An importer that is no Python program must bring libpython into its process before it loads the FMU: link it, or set
  LD_PRELOAD to libpython3.x.so on Linux, or have python3.dll on the path on Windows.
- The folder that the FMU is unpacked to may hold letters, digits, spaces, and . _ - in its path; the exporter cannot
  read others back from the resource URI.
"""

PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>CardanDriveline {version}</title>
<style>
body {{ font: 15px/1.45 sans-serif; max-width: 68em; margin: 2em auto; padding: 0 1em; color: #222 }}
table {{ border-collapse: collapse; width: 100%; font-size: 13px }}
td, th {{ border-bottom: 1px solid #ddd; padding: 3px 8px; text-align: left; vertical-align: top }}
td:nth-child(n+3):nth-child(-n+5) {{ white-space: nowrap }}
code {{ font-size: 13px }}
</style></head><body>
<h1>CardanDriveline {version}</h1>
<p>{text}. FMI 2.0 co-simulation; all values in SI units.</p>
<h2>Use</h2>
<p>Set parameters before initialization; tunable ones and all inputs at any communication point. Outputs hold their
values at the end of the step. Torque inputs given alone are held over a step. With <code>.der1</code> (time derivative)
and <code>.by_speed</code> (derivative by the shaft's speed) the torque is followed inside the step; with
<code>hold.degree</code> 3 or 5 it is interpolated through the last communication points, whose history
<code>hold.restart</code> drops where a torque jumped.</p>
<p>A step with a value out of range is refused (<code>fmi2Discard</code>); the message names the variable, its value and
the allowed range, the state stays as it was, and after a correction the run goes on. The state can be saved, restored
and serialized, and a repeated step is equal to the last bit.</p>
{tables}
<h2>Signs</h2>
<p>Angles, speeds and torques of a shaft are right-handed about its axis, which points from the input to the output.
A joint's angle is zero where its input trunnion lies in the plane of the bent shafts. <code>input.torque</code> drives,
<code>output.torque</code> resists positive speed.</p>
</body></html>
"""

HEADINGS = {"parameter": "Parameters", "input": "Inputs", "output": "Outputs"}


def write(folder: Path, variables: Sequence[Any], *, version: str, text: str) -> None:
    """Write the documentation.

    Parameters
    ----------
    folder : Path
        The ``documentation`` directory; made here.
    variables : sequence of Variable
        ``cardan_kernel.variables.VARIABLES``.
    version, text : str
        Version and one-line description of the model.
    """
    licences = folder / "licenses"
    licences.mkdir(parents=True)
    tables = "\n".join(_table(heading, [each for each in variables if each.causality == causality])
                       for causality, heading in HEADINGS.items())
    pages = {
        folder / "index.html": PAGE.format(version=escape(version), text=escape(text), tables=tables),
        folder / "externalDependencies.txt": EXTERNAL,
        licences / "license.txt": own_licence(),
        licences / "pythonfmu.txt": licence_of("pythonfmu"),
    }
    for path, content in pages.items():
        path.write_text(content, encoding="utf-8", newline="\n")


def own_licence() -> str:
    """Licence of this project: the repository's file, or the copy that was installed."""
    path = Path(__file__).resolve().parents[2] / "LICENSE"
    return path.read_text(encoding="utf-8") if path.is_file() else licence_of("cardan-driveline")


def licence_of(distribution: str) -> str:
    """Licence text of an installed distribution; BuildError where it brings none."""
    try:
        files = importlib.metadata.files(distribution) or []
    except importlib.metadata.PackageNotFoundError:
        raise BuildError(f"the distribution {distribution} is not installed; its licence belongs in the FMU") from None
    for each in files:
        if each.name == "LICENSE" and ".dist-info" in str(each):
            return each.read_text(encoding="utf-8")
    raise BuildError(f"the distribution {distribution} has no LICENSE file; it belongs in the FMU")


def _table(heading: str, variables: Sequence[Any]) -> str:
    rows = "\n".join(_row(variable) for variable in variables)
    return (f"<h2>{heading}</h2>\n<table><tr><th>Name</th><th>Meaning</th><th>Unit</th><th>Start</th>"
            f"<th>Allowed</th></tr>\n{rows}\n</table>")


def _row(variable: Any) -> str:
    start = "" if variable.start is None else f"{variable.start:.10g}" if variable.type == "Real" else variable.start
    bounds = (("&ge;", variable.minimum), ("&le;", variable.maximum))
    allowed = " ".join(f"{sign} {bound:.7g}" for sign, bound in bounds if bound is not None)
    tunable = " (tunable)" if variable.variability == "tunable" else ""
    cells = (f"<code>{escape(variable.name)}</code>", escape(variable.description) + tunable,
             escape(variable.unit if variable.unit != "1" else ""), escape(str(start).lower()), allowed)
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"
