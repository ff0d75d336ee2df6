"""The FMU under examination as a check sees it: unpacked, described, with the numbers to use."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from cardan.check.trail import Trail

Errand = Callable[[str, dict[str, Any]], dict[str, Any]]


@dataclass(frozen=True)
class Options:
    """How thoroughly to look.

    Attributes
    ----------
    run_steps : int
        Communication steps of the long run at most.
    steps : int
        Communication steps of runs that are compared.
    points : int
        Points at which dependencies are looked for.
    instances : int
        Instances made one after the other in the memory check.
    time_limit : float
        Seconds for one check.
    exciting : bool
        Whether inputs are moved; turned off for FMUs that refuse that.
    reference : str
        Directory of the reference files; empty for the one of the FMU.
    """

    run_steps: int = 1000
    steps: int = 30
    points: int = 24
    instances: int = 1000
    time_limit: float = 60.0
    exciting: bool = True
    reference: str = ""

    def to_dict(self) -> dict[str, Any]:
        """Return the options as JSON takes them."""
        return asdict(self)


@dataclass(frozen=True)
class Experiment:
    """Start, stop (s), communication step (s) and tolerance (None where not given) of the default experiment."""

    start: float
    stop: float
    step: float
    tolerance: float | None

    def times(self, count: int, step: float | None = None) -> list[float]:
        """Return communication points: ``start + i * step`` for i from 0 to `count`."""
        h = self.step if step is None else step
        return [self.start + i * h for i in range(count + 1)]

    @property
    def count(self) -> int:
        """Steps from start to stop."""
        return max(1, round((self.stop - self.start) / self.step))


@dataclass
class Subject:
    """The FMU under examination.

    Attributes
    ----------
    path : pathlib.Path
        The FMU file.
    directory : pathlib.Path
        Where it is unpacked.
    scratch : pathlib.Path
        An empty directory for the check's own files.
    model : fmpy.model_description.ModelDescription
        The model description, not validated.
    options : Options
        How thoroughly to look.
    trail : Trail
        Where the calls are noted.
    errand : callable
        ``errand(check_id, data)`` calls `Check.errand` in a second process and returns its answer.
    """

    path: Path
    directory: Path
    scratch: Path
    model: Any
    options: Options
    trail: Trail
    errand: Errand = field(repr=False)

    @property
    def capability(self) -> Any:
        """The element CoSimulation of the model description."""
        return self.model.coSimulation

    @cached_property
    def native(self) -> bool:
        """False for FMUs of the common Python export, which run in the interpreter of the importing process."""
        return not (self.directory / "resources" / "slavemodule.txt").is_file()

    @cached_property
    def variables(self) -> list[Any]:
        """All variables but the independent one."""
        return [each for each in self.model.modelVariables if each.causality != "independent"]

    def having(self, *causalities: str, kinds: tuple[str, ...] = ()) -> list[Any]:
        """Return the variables of these causalities, and of these types where given."""
        return [each for each in self.variables
                if each.causality in causalities and (not kinds or each.type in kinds)]

    @cached_property
    def outputs(self) -> list[Any]:
        """What is compared between runs: outputs, or all that can be computed where there are none."""
        return self.having("output") or self.having("local", "calculatedParameter")

    @cached_property
    def experiment(self) -> Experiment:
        """The default experiment."""
        return experiment_of(self.model)


def experiment_of(model: Any) -> Experiment:
    """Return the default experiment of a model description; what it does not say is 1 s in 500 steps."""
    default = model.defaultExperiment
    start = _number(default and default.startTime, 0.0)
    stop = _number(default and default.stopTime, start + 1.0)
    if not stop > start:
        stop = start + 1.0
    step = _number(default and default.stepSize, (stop - start) / 500.0)
    if not 0.0 < step <= stop - start:
        step = (stop - start) / 500.0
    tolerance = _number(default and default.tolerance, 0.0)
    return Experiment(start, stop, step, tolerance if tolerance > 0.0 else None)


def _number(text: Any, otherwise: float) -> float:
    try:
        return float(text)
    except (TypeError, ValueError):
        return otherwise
