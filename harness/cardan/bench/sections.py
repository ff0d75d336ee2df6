"""The sections of the report, in order, and the run over them."""

from __future__ import annotations

import dataclasses
import datetime
import importlib
import json
import math
import os
import platform
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NamedTuple

from cardan.bench.records import Options, Tables
from cardan.errors import InputError
from cardan.provenance import package_version, versions

Progress = Callable[[float, str], None]  # fraction of the whole that is done, section


class Section(NamedTuple):
    """A part of the report: what it measures, and roughly how many seconds it takes."""

    title: str
    seconds: float
    quick_seconds: float


SECTIONS: dict[str, Section] = {
    "integrator": Section("work and precision of the integrator", 15.0, 3.0),
    "coupling": Section("coupling schemes: error against step and time", 70.0, 15.0),
    "auto": Section("auto on the shipped scenes", 60.0, 20.0),
    "peers": Section("peers on the same system at the same error", 70.0, 50.0),
    "stepping": Section("one communication step, in all that takes it", 20.0, 12.0),
    "fidelity": Section("cost of fidelity and of exchange", 5.0, 3.0),
    "scaling": Section("simulated time, parallel instances, memory", 60.0, 15.0),
    "hard": Section("hard cases", 20.0, 20.0),
}


@dataclasses.dataclass(frozen=True)
class Measured:
    """Everything that was measured in one run.

    Attributes
    ----------
    made_by : dict
        Program, versions, machine, time and load.
    tables : dict of str to list of dict
        The tables by name.
    """

    made_by: dict[str, Any]
    tables: Tables

    def to_dict(self) -> dict[str, Any]:
        """Return it for JSON: six digits, more would be noise in a diff, and None for what is no number."""
        return {"made_by": self.made_by, "tables": _rounded(self.tables)}

    def save(self, path: Path) -> None:
        """Write it as JSON."""
        path.write_text(json.dumps(self.to_dict(), indent=1, allow_nan=False) + "\n", encoding="utf-8")

    @classmethod
    def load(cls, path: Path) -> Measured:
        """Read what `save` wrote."""
        found = json.loads(path.read_text(encoding="utf-8"))
        return cls(found["made_by"], found["tables"])


def chosen(only: Iterable[str]) -> list[str]:
    """Return the sections of a choice in the order of the report; all for an empty one.

    Raises
    ------
    InputError
        With each name that is none and the choices.
    """
    wanted = list(only)
    problems = [f"--only {name}: no such section; choose from {', '.join(SECTIONS)}"
                for name in wanted if name not in SECTIONS]
    if problems:
        raise InputError(problems)
    return [name for name in SECTIONS if name in wanted or not wanted]


def run(options: Options, only: Iterable[str] = (), progress: Progress | None = None) -> Measured:
    """Measure.

    Parameters
    ----------
    options : Options
        How much.
    only : iterable of str
        Sections; all if empty.
    progress : callable, optional
        Called with the fraction done and what is being measured.

    Raises
    ------
    InputError
        If a section does not exist.
    CardanError
        If the FMU cannot be built or run.
    """
    names = chosen(only)
    lengths = [SECTIONS[name].quick_seconds if options.quick else SECTIONS[name].seconds for name in names]
    made_by = _made_by(options)
    tables: Tables = {}
    done = 0.0
    for name, length in zip(names, lengths):
        def tell(fraction: float, name: str = name, done: float = done, length: float = length) -> None:
            if progress is not None:
                progress((done + fraction * length) / sum(lengths), SECTIONS[name].title)

        tell(0.0)
        tables.update(importlib.import_module(f"cardan.bench.{name}").measure(options, tell))
        done += length
    return Measured(made_by, tables)


def _made_by(options: Options) -> dict[str, Any]:
    import cardan_kernel

    load = [round(value, 2) for value in os.getloadavg()] if hasattr(os, "getloadavg") else None
    return {**versions(), "kernel": cardan_kernel.KERNEL, "scipy": package_version("scipy"),
            "control": package_version("control"), "processor": _processor(), "cores": os.cpu_count(),
            "load_at_start": load, "quick": options.quick,
            "time": datetime.datetime.now(datetime.UTC).strftime("%Y-%m-%dT%H:%MZ")}


def _processor() -> str:
    """Return the name of the processor, as far as the system tells."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return float(f"{value:.6g}") if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _rounded(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [_rounded(entry) for entry in value]
    return value
