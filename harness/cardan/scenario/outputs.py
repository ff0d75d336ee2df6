"""The key ``outputs`` of ``[scene]``: what is exchanged and recorded."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from cardan.scenario.problems import Collector

DEFAULT = ("input.speed", "input.torque", "output.speed", "output.torque", "shaft.torque", "ratio", "power.input",
           "power.output", "energy.residual")


def recordable() -> tuple[str, ...]:
    """Return the variables of the FMU that can be recorded: outputs and inputs."""
    from cardan_kernel.variables import VARIABLES

    return tuple(v.name for v in VARIABLES if v.causality in ("output", "input"))


def read_outputs(raw: Any, signals: Iterable[str], collector: Collector) -> tuple[str, ...]:
    """Return the names to record: FMU outputs and inputs, and the signals of engine, load and driver.

    Parameters
    ----------
    raw : object
        The value of the key: a list of names, a text of names with commas, or None for the default (`DEFAULT` and
        all signals).
    signals : iterable of str
        Names that the models of this scene offer.
    collector : Collector
        Takes the problems.
    """
    signals = tuple(signals)
    if raw is None:
        return (*DEFAULT, *signals)
    names = [part.strip() for part in raw.split(",")] if isinstance(raw, str) else raw
    if not isinstance(names, (list, tuple)) or not all(isinstance(name, str) for name in names) or not names:
        collector.add("scene.outputs", raw, "must be a list of names, not empty")
        return ()
    known = (*recordable(), *signals)
    for place, name in enumerate(names):
        if name not in known:
            collector.unknown("scene.outputs", name, "output", name, known)
        elif name in names[:place]:
            collector.add("scene.outputs", name, "listed twice")
    return tuple(names)
