"""Generated parts of the README: ``python -m cardan.readme`` writes them, a test compares them.

A generated part stands between ``<!-- begin NAME -->`` and ``<!-- end NAME -->``.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

from cardan_kernel.variables import UNITS, VARIABLES, Variable

from cardan.bench.sections import Measured
from cardan.bench.tables import PARTS

Row = Iterable[str]
REPOSITORY = Path(__file__).resolve().parents[2]  # it is run from a checkout


def table(heads: Row, rows: Iterable[Row]) -> str:
    """Return a Markdown table."""
    lines = ["| " + " | ".join(heads) + " |"]
    lines.append("|" + "---|" * (lines[0].count("|") - 1))
    lines += ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def _range(variable: Variable) -> str:
    factor = dict(UNITS[variable.unit].displays).get(variable.display, 1.0) if variable.unit else 1.0
    low, high = variable.minimum, variable.maximum
    if variable.unit == "rad" and high is not None:
        return "0 <= .. < 90 deg"
    if low is not None and high is not None:
        return f"{low * factor:g} .. {high * factor:g}"
    return "" if low is None else f">= {low:g}"


def variables_table() -> str:
    """Every variable of the FMU: name, kind, unit, start, range, meaning."""
    kinds = {("parameter", "fixed"): "P", ("parameter", "tunable"): "P t", ("input", "continuous"): "I",
             ("input", "discrete"): "I", ("output", "continuous"): "O", ("output", "discrete"): "O"}
    rows = []
    for variable in VARIABLES:
        unit = variable.unit or {"Integer": "int", "Boolean": "bool"}[variable.type]
        start = "" if variable.start is None else (f"{variable.start:g}" if variable.type == "Real"
                                                   else str(variable.start).lower())
        rows.append((f"`{variable.name}`", kinds[variable.causality, variable.variability], unit, start,
                     _range(variable), variable.description))
    return table(("name", "kind", "unit", "start", "range", "meaning"), rows)


def scenes_table() -> str:
    """The shipped scenes: name, title, length."""
    from cardan.scenario import Scenario

    rows = []
    for name in Scenario.shipped():
        scene = Scenario.read(name)
        rows.append((f"`{name}`", scene.title, f"{scene.stop_time:g} s", f"{scene.communication_step * 1e3:g} ms",
                     scene.coupling))
    return table(("scene", "what it is", "length", "communication step", "coupling"), rows)


def importers_table() -> str:
    """The table that ``cardan importers --markdown`` printed into docs/importers.md."""
    return (REPOSITORY / "docs" / "importers.md").read_text(encoding="utf-8").strip()


def measured(make: Callable[[Measured], str]) -> Callable[[], str]:
    """Return what makes a block of the measurements that ``cardan bench -o docs/bench`` has stored."""

    def block() -> str:
        return make(Measured.load(REPOSITORY / "docs" / "bench" / "results.json"))

    return block


BLOCKS: dict[str, Callable[[], str]] = {
    "variables": variables_table, "scenes": scenes_table, "importers": importers_table,
    **{f"bench-{name}": measured(make) for name, make in PARTS.items()}}


def filled(text: str) -> str:
    """Return a README text with its generated parts made anew.

    Raises
    ------
    ValueError
        If a part that is known has no place in the text, or a place is unknown.
    """
    places = re.findall(r"<!-- begin ([\w-]+) -->", text)
    for name in places:
        if name not in BLOCKS:
            raise ValueError(f"README: no generated part {name!r}; known are {', '.join(BLOCKS)}")
    for name, make in BLOCKS.items():
        begin, end = f"<!-- begin {name} -->\n", f"<!-- end {name} -->"
        if begin not in text or end not in text:
            raise ValueError(f"README: no place for the generated part {name!r}: add <!-- begin {name} --> and its end")
        before, rest = text.split(begin, 1)
        text = before + begin + make() + "\n" + end + rest.split(end, 1)[1]
    return text


def main() -> None:
    """Write the generated parts of the README in the folder named on the command line (here), and docs/scenes.md."""
    from cardan.scenario.reference import scene_reference

    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    readme = folder / "README.md"
    readme.write_text(filled(readme.read_text(encoding="utf-8")), encoding="utf-8")
    (folder / "docs" / "scenes.md").write_text(scene_reference(), encoding="utf-8")


if __name__ == "__main__":
    main()
