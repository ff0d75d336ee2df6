"""Engine or load from an FMU of another author, with a mapping of names."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from cardan.errors import CardanError
from cardan.models.base import Bus, Discrete, Model, Shaft, State, Torque
from cardan.models.parameters import ParameterError, file, quantity, table, words
from cardan.units import UnitError, parse_unit

if TYPE_CHECKING:
    from cardan.description import Description, Variable
    from cardan.models.foreign_run import ForeignRun

# our quantity -> its SI unit; the inputs first, the outputs after
INPUTS = {"speed": "rad/s", "angle": "rad", "acceleration": "rad/s2", "throttle": "1", "brake": "1"}
OUTPUTS = {"torque": "N.m", "rate": "N.m/s", "by_speed": "N.m.s/rad"}


@dataclass(frozen=True, eq=False)
class Names:
    """What the quantities are called in the FMU; an empty name is not exchanged."""

    torque: str = words("output: torque on the shaft")
    speed: str = words("input: shaft speed", "")
    angle: str = words("input: shaft angle", "")
    acceleration: str = words("input: shaft acceleration", "")
    throttle: str = words("input: throttle, 0 to 1", "")
    brake: str = words("input: brake, 0 to 1", "")
    rate: str = words("output: time derivative of the torque at constant speed", "")
    by_speed: str = words("output: derivative of the torque by the speed", "")


@dataclass(frozen=True, eq=False)
class ForeignFmu(Model):
    """T = factor * output of an FMU that is stepped along, its inputs held over each step.

    Values are converted between SI and the units that the FMU declares (none declared: SI). The FMU has its state
    inside: it is stepped when its torque is asked for at a later time, and brought back to a saved state when that is
    asked for at an earlier one, if it can do that. Held inputs make it first order, whatever the coupling.

    An object runs one simulation at a time: the next `start` ends the one before.

    Attributes
    ----------
    stepped : bool
        True: the state is not in `states`, and a coupling of higher order than `order` is wasted on it.
    order : int
        Order in the communication step that it can have.
    rolls_back : bool
        Whether the FMU can go back to an earlier time: what couplings that repeat a step need.
    """

    kind: ClassVar[str] = "fmu"
    stepped: ClassVar[bool] = True
    order: ClassVar[int] = 1
    fmu: Path = file("FMI 2.0 co-simulation FMU")
    names: Names = table(Names, "what the quantities are called in the FMU")
    parameters: str = words("start values, as in 'gain = 3; limit = 20'", "")
    factor: float = quantity("1", "factor on its torque, such as -1 for the other sign", 1.0)
    record: str = words("further outputs to record, as in 'fuel, heat'", "")
    throttle: float = quantity("1", "throttle where no driver sets it", 1.0, minimum=0.0, maximum=1.0)
    rolls_back: bool = field(init=False, repr=False)
    inputs: tuple[tuple[str, str, float], ...] = field(init=False, repr=False)  # ours, its, SI per its unit
    outputs: tuple[tuple[str, str, float], ...] = field(init=False, repr=False)
    settings: dict[str, float | int | bool | str] = field(init=False, repr=False)
    recorded: tuple[tuple[str, str], ...] = field(init=False, repr=False)
    _run: ForeignRun | None = field(init=False, repr=False)

    def prepare(self) -> None:
        from cardan.description import read_description

        if self.names is None:
            raise ParameterError("names", None, "missing", "a table that names at least the FMU's torque")
        try:
            about = read_description(self.fmu)
        except CardanError as error:
            raise ParameterError("fmu", str(self.fmu), str(error)) from None
        stem = self.fmu.stem
        wanted = [name.strip() for name in self.record.split(",") if name.strip()]
        recorded = tuple((f"{stem}.{name}", _variable(about, "record", name, ("output", "local")).name)
                         for name in wanted)
        self.put(
            rolls_back=about.can_get_set_state, _run=None, recorded=recorded,
            inputs=self._mapped(about, INPUTS, ("input", "parameter")),
            outputs=self._mapped(about, OUTPUTS, ("output", "local")),
            settings=_settings(about, self.parameters),
            signals={ours: about[its].unit or "1" for ours, its in recorded},
        )

    def _mapped(self, about: Description, units: dict[str, str],
                causalities: tuple[str, ...]) -> tuple[tuple[str, str, float], ...]:
        found = []
        for ours, unit in units.items():
            its = getattr(self.names, ours)
            if its:
                variable = _variable(about, f"names.{ours}", its, causalities)
                if variable.type != "Real":
                    raise ParameterError(f"names.{ours}", its, f"is of type {variable.type}", "a Real variable")
                found.append((ours, its, _factor(f"names.{ours}", variable, unit)))
        return tuple(found)

    def takes_throttle(self) -> bool:
        return any(ours == "throttle" for ours, _, _ in self.inputs)

    def start(self, t: float, shaft: Shaft, bus: Bus) -> list[float]:
        from cardan.models.foreign_run import ForeignRun

        if self._run is not None:
            self._run.close()
        self.put(_run=ForeignRun(self.fmu, self.settings, t, self._inputs(shaft, bus), keeps=self.rolls_back))
        return []

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        values = self._at(t, shaft, bus).read(tuple(its for _, its, _ in self.outputs))
        found = {ours: self.factor * unit * value for (ours, _, unit), value in zip(self.outputs, values)}
        return Torque(found["torque"], found.get("rate", 0.0), found.get("by_speed", 0.0))

    def observe(self, t: float, x: State, shaft: Shaft, bus: Bus, discrete: Discrete) -> dict[str, float]:
        if not self.recorded:
            return {}
        values = self._at(t, shaft, bus).read(tuple(its for _, its in self.recorded))
        return {ours: value for (ours, _), value in zip(self.recorded, values)}

    def _at(self, t: float, shaft: Shaft, bus: Bus) -> ForeignRun:
        """Return the running FMU, brought to time t, with the inputs of that time."""
        if self._run is None:
            raise RuntimeError("a foreign FMU has to be started before its torque is asked for")
        self._run.go(t)
        self._run.send(self._inputs(shaft, bus))
        return self._run

    def _inputs(self, shaft: Shaft, bus: Bus) -> dict[str, float]:
        seen = {"angle": shaft.angle, "speed": shaft.speed, "acceleration": shaft.acceleration,
                "throttle": bus.throttle, "brake": bus.brake}
        return {its: seen[ours] / unit for ours, its, unit in self.inputs}


def foreign_in(*models: Model | None) -> list[ForeignFmu]:
    """Return the foreign FMUs among models and inside them (of a gearbox, or beside a governor)."""
    found: list[ForeignFmu] = []
    for model in models:
        if isinstance(model, ForeignFmu):
            found.append(model)
        elif model is not None:
            found += foreign_in(*(getattr(model, name, None) for name in ("source", "first", "second")))
    return found


def _variable(about: Description, key: str, name: str, causalities: tuple[str, ...]) -> Variable:
    if name not in about.variables:
        from difflib import get_close_matches

        near = get_close_matches(name, about.variables, 1, 0.0)
        raise ParameterError(key, name, f"no such variable in {about.path.name}; nearest: {near[0]}" if near else
                             f"no such variable in {about.path.name}, which has none")
    variable = about.variables[name]
    if variable.causality not in causalities:
        raise ParameterError(key, name, f"has causality {variable.causality} in {about.path.name}",
                             " or ".join(causalities))
    return variable


def _factor(key: str, variable: Variable, unit: str) -> float:
    """SI per the variable's own unit; the plane angle, which many tools leave out, is not compared."""
    if not variable.unit:
        return 1.0
    try:
        own, ours = parse_unit(variable.unit), parse_unit(unit)
    except UnitError as error:
        raise ParameterError(key, variable.name, f"has a unit that cannot be read: {error}", unit) from None
    if own.exponents[:3] != ours.exponents[:3]:
        raise ParameterError(key, variable.name, f"is in {variable.unit}", f"a unit that converts to {unit}")
    return own.factor


def _settings(about: Description, text: str) -> dict[str, float | int | bool | str]:
    found: dict[str, float | int | bool | str] = {}
    for part in (each.strip() for each in text.split(";")):
        if not part:
            continue
        name, equals, value = (each.strip() for each in part.partition("="))
        if not equals:
            raise ParameterError("parameters", part, "is not of the form NAME = VALUE")
        variable = _variable(about, "parameters", name, ("parameter", "input"))
        found[name] = _value(variable, value)
    return found


def _value(variable: Variable, text: str) -> Any:
    if variable.type == "String":
        return text
    if variable.type == "Boolean" and text.lower() in ("true", "false"):
        return text.lower() == "true"
    try:
        number = float(text) if variable.type == "Real" else int(text)
    except ValueError:
        number = math.nan
    if variable.type == "Boolean" or not math.isfinite(number):
        raise ParameterError("parameters", f"{variable.name} = {text}", f"is no value of type {variable.type}")
    return number
