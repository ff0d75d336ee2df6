"""A scene, read and checked."""

from __future__ import annotations

import copy
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, overload

from cardan.models.base import Model
from cardan.models.driver import Driver
from cardan.models.road import RoadLoad
from cardan.scenario import shipped
from cardan.scenario.convert import Reader, plain
from cardan.scenario.driveline import misplaced, read_driveline
from cardan.scenario.members import read_driver, read_engine, read_load
from cardan.scenario.outputs import read_outputs
from cardan.scenario.overrides import apply_overrides
from cardan.scenario.problems import Collector, Problem, ScenarioError, nearest
from cardan.scenario.tables import TABLES, SceneTable


class _Load:
    """``Scenario.load(path)`` reads a scene; ``scenario.load`` is the load of a scene that was read."""

    @overload
    def __get__(self, scenario: None, owner: type[Scenario]) -> Callable[[str | Path], Scenario]: ...
    @overload
    def __get__(self, scenario: Scenario, owner: type[Scenario]) -> Model: ...
    def __get__(self, scenario: Scenario | None, owner: type[Scenario]) -> Any:
        return owner.read if scenario is None else scenario.load_model


@dataclass(frozen=True, eq=False)
class Scenario:
    """A scene that can be simulated; immutable.

    Attributes
    ----------
    title : str
        One line.
    stop_time, communication_step : float
        s.
    coupling : str
        One of `cardan.scenario.COUPLINGS`.
    tolerance : float
        Relative tolerance of the integrator; with ``adaptive`` and ``auto`` of the whole run.
    sweeps, sweep_tolerance : int, float
        Corrections per step of ``iterated``, and the change of the torques at which they end.
    shortest_step : float or None
        Floor of the communication step of ``adaptive`` and ``auto``, s.
    outputs : tuple of str
        FMU variables and signals of the models to record.
    driveline : mapping of str to float, int or bool
        FMU parameters and inputs that differ from their start values, SI; ``model.drive`` and a road vehicle's
        ``output.inertia`` included.
    engine, load : Model
        What acts on the input and the output shaft (on the class, ``Scenario.load(path)`` is `read`).
    driver : Driver or None
        Who presses the pedals.
    name : str
        Name of the scene file without its ending.
    source : str
        Text of the scene file, for the record.
    overrides : mapping
        What `with_overrides` changed.
    base : Path
        Folder that relative file names refer to.
    """

    title: str
    stop_time: float
    communication_step: float
    coupling: str
    tolerance: float
    sweeps: int
    sweep_tolerance: float
    shortest_step: float | None
    outputs: tuple[str, ...]
    driveline: Mapping[str, float | int | bool]
    engine: Model
    load_model: Model
    driver: Driver | None
    name: str
    source: str
    overrides: Mapping[str, Any]
    base: Path
    _tables: Mapping[str, Any] = field(repr=False)
    load = _Load()

    @staticmethod
    def shipped() -> tuple[str, ...]:
        """Return the names of the scenes that come with the package; `Scenario.load` takes them."""
        return shipped.names()

    @classmethod
    def read(cls, path: str | Path) -> Scenario:
        """Read a scene file, or a shipped scene by its name.

        Raises
        ------
        ScenarioError
            With everything that is wrong: file, key, value, reason, allowed range, nearest valid name.
        """
        place = shipped.find(path)
        if not place.is_file():
            what = "is a folder, not a scene file" if place.is_dir() else "no such scene file"
            raise ScenarioError([Problem(str(path), "", "", what, "a TOML file, or a shipped scene: "
                                         + ", ".join(shipped.names()), nearest(Path(path).stem, shipped.names()))])
        try:
            text = place.read_text(encoding="utf-8")
            tables = tomllib.loads(text)
        except (OSError, UnicodeDecodeError) as error:
            raise ScenarioError([Problem(str(path), "", "", f"cannot be read: {error}")]) from None
        except tomllib.TOMLDecodeError as error:
            hint = " (a name that continues another one must be quoted: \"joint1.angle.der1\")"
            raise ScenarioError([Problem(str(path), "", "", f"is no valid TOML: {error}"
                                         + (hint if "overwrite" in str(error).lower() else ""))]) from None
        except ValueError as error:  # a whole number of thousands of digits
            raise ScenarioError([Problem(str(path), "", "", f"cannot be read: {error}")]) from None
        return cls.from_dict(tables, base=place.parent, source=text, name=place.stem, file=str(path))

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any], base: str | Path = ".", source: str = "", name: str = "scene",
                  file: str = "", overrides: Mapping[str, Any] | None = None) -> Scenario:
        """Make a scene from nested dictionaries of the form of a scene file.

        Parameters
        ----------
        tables : mapping
            The tables ``scene``, ``driveline``, ``engine``, ``load``, ``driver``.
        base : str or Path
            Folder that relative file names refer to.
        source, name, file : str
            Text for the record, name of the scene, and what stands for the file in messages.
        overrides : mapping, optional
            For the record: what was changed against `source`.

        Raises
        ------
        ScenarioError
            With everything that is wrong.
        TypeError
            If `tables` is no mapping.
        """
        if not isinstance(tables, Mapping):
            raise TypeError(f"a scene is made from a dictionary of tables, not from {type(tables).__name__}")
        collector = Collector(file or name)
        reader = Reader(collector, Path(base))
        tables = plain(tables, "", collector)
        for table, content in tables.items():
            if table not in TABLES:
                if not misplaced(table, content, collector):
                    collector.unknown(table, None, "table", table, TABLES)
            elif not isinstance(content, Mapping):
                collector.add(table, content, f"must be a table [{table}]")
        given = {t: tables[t] for t in TABLES if isinstance(tables.get(t), Mapping)}
        scene: SceneTable | None = reader.build(SceneTable, given.get("scene", {}), "scene", ("outputs",))
        driveline = read_driveline(given.get("driveline", {}), collector, reader)
        engine = read_engine(given.get("engine"), collector, reader)
        load = read_load(given.get("load"), collector, reader)
        driver = read_driver(given.get("driver"), engine, load, collector, reader)
        if isinstance(load, RoadLoad) and "output.inertia" in driveline:
            collector.add("driveline.output.inertia", driveline["output.inertia"],
                          "given together with [load] type = 'road', which sets it from mass, wheels and axle_ratio; "
                          "leave one out")
        members = [m for m in (driver, engine, load) if m is not None]
        complete = engine is not None and load is not None and (driver is not None or "driver" not in given)
        signals = [signal for member in members for signal in member.signals]
        outputs: tuple[str, ...] = ()
        if complete:  # without all models their signals are not known
            outputs = read_outputs(given.get("scene", {}).get("outputs"), signals, collector)
        collector.finish()
        assert scene is not None and scene.tolerance is not None and engine is not None and load is not None
        if engine.drive == 1:
            driveline["model.drive"] = 1
        if isinstance(load, RoadLoad):
            driveline["output.inertia"] = load.inertia
        return cls(title=scene.title or name, stop_time=scene.stop_time, communication_step=scene.communication_step,
                   coupling=scene.coupling, tolerance=scene.tolerance, sweeps=scene.sweeps,
                   sweep_tolerance=scene.sweep_tolerance, shortest_step=scene.shortest_step, outputs=outputs,
                   driveline=MappingProxyType(driveline), engine=engine, load_model=load, driver=driver, name=name,
                   source=source, overrides=MappingProxyType(dict(overrides or {})), base=Path(base),
                   _tables=MappingProxyType(copy.deepcopy(dict(tables))))

    def with_overrides(self, changes: Mapping[str, Any]) -> Scenario:
        """Return the scene with some keys changed.

        Parameters
        ----------
        changes : mapping
            Dotted key -> value as in a scene file, such as ``{"driveline.joint1.angle": "10 deg",
            "scene.stop_time": "5 s"}``; a table (``{"load": {...}}``) is replaced, None removes a key.

        Raises
        ------
        ScenarioError
            With everything that is wrong afterwards.
        """
        tables = apply_overrides(self.to_dict(), changes)
        return self.from_dict(tables, self.base, self.source, self.name, overrides={**self.overrides, **changes})

    def to_dict(self) -> dict[str, Any]:
        """Return the tables as they stand in the file (overrides applied); `from_dict` takes them."""
        return copy.deepcopy(dict(self._tables))

    def __reduce__(self) -> tuple[Any, ...]:
        # worker processes read the tables again: the read-only views of a scene cannot be pickled
        return _again, (self.to_dict(), self.base, self.source, self.name, dict(self.overrides))

    def __str__(self) -> str:
        driver = f", driver {self.driver.kind}" if self.driver is not None else ""
        return (f"{self.name}: {self.title}\n  {self.stop_time:g} s, step {self.communication_step:g} s, "
                f"{self.coupling}, tolerance {self.tolerance:g}; engine {self.engine.kind}, "
                f"load {self.load.kind}{driver}")


def _again(tables: dict[str, Any], base: Path, source: str, name: str, overrides: dict[str, Any]) -> Scenario:
    return Scenario.from_dict(tables, base, source, name, overrides=overrides)
