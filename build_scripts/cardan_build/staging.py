"""Lays the FMU's sources out under names made from their content (docs/FMI.md, trap 1)."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from .sources import Sources

_IMPORT = re.compile(r"^from (cardan_kernel|pythonfmu)\b", re.MULTILINE)


@dataclass(frozen=True)
class Stage:
    """A directory with the renamed modules.

    Attributes
    ----------
    root : Path
        The directory.
    slave : str
        Name of the slave module.
    kernel, pythonfmu : str
        Names of the packages.
    """

    root: Path
    slave: str
    kernel: str
    pythonfmu: str


def names(sources: Sources, root: Path) -> Stage:
    """Names that the modules take in the FMU."""
    return Stage(root, *(f"{base}_{sources.tag}" for base in ("cardan_slave", "cardan_kernel", "pythonfmu")))


def lay_out(sources: Sources, root: Path) -> Stage:
    """Write the sources under `root`, which is empty, with the slave's imports renamed."""
    stage = names(sources, root)
    for package, files in ((stage.kernel, sources.kernel), (stage.pythonfmu, sources.pythonfmu)):
        for name, content in files.items():
            path = root / package / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
    text = sources.slave["cardan_slave.py"].decode("utf-8")
    renamed = _IMPORT.sub(lambda match: f"from {match.group(1)}_{sources.tag}", text)
    (root / f"{stage.slave}.py").write_text(renamed, encoding="utf-8", newline="\n")
    return stage
