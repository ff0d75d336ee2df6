"""The tables ``[engine]``, ``[load]`` and ``[driver]``: from a type name to a model."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from cardan.models.base import Model
from cardan.models.catalog import DRIVERS, ENGINES, LOADS
from cardan.models.combined import Combined
from cardan.models.constant import ConstantTorque
from cardan.models.driver import Driver
from cardan.models.gearbox import Gearbox
from cardan.models.governor import IdleGovernor
from cardan.models.road import RoadLoad
from cardan.scenario.convert import Reader
from cardan.scenario.problems import Collector, nearest


def read_engine(table: Mapping[str, Any] | None, collector: Collector, reader: Reader) -> Model | None:
    """Return the engine, with its governor and its gearbox if the table has them; None if there were problems."""
    if table is None:
        collector.add("engine", None, "the table [engine] is missing", f"type = one of {', '.join(ENGINES)}")
        return None
    kind = _kind(table, "engine", ENGINES, collector)
    if kind is None:
        return None
    parts = tuple(name for name in ("governor", "gearbox") if name in table)
    extra = () if kind.drive == 1 else ("governor", "gearbox")
    engine: Model | None = reader.build(kind, table, "engine", ("type", *extra))
    governor = gearbox = None
    if "governor" in parts and extra:
        governor = _part(IdleGovernor, table["governor"], "engine.governor", collector, reader)
        engine = Combined(engine, governor) if engine is not None and governor is not None else None
    if "gearbox" in parts and extra:
        # a stand-in lets the gearbox's own problems be found along with those of the engine
        source = engine if engine is not None else ConstantTorque(torque_=0.0)
        gearbox = _part(Gearbox, table["gearbox"], "engine.gearbox", collector, reader, source=source)
        engine = gearbox if engine is not None else None
    return engine


def read_load(table: Mapping[str, Any] | None, collector: Collector, reader: Reader) -> Model | None:
    """Return the load (none given: zero torque); None if there were problems."""
    if table is None:
        return ConstantTorque(torque_=0.0)
    kind = _kind(table, "load", LOADS, collector)
    model: Model | None = reader.build(kind, table, "load", ("type",)) if kind is not None else None
    return model


def read_driver(table: Mapping[str, Any] | None, engine: Model | None, load: Model | None,
                collector: Collector, reader: Reader) -> Driver | None:
    """Return the driver of the table, if there is one; a driver needs a road and an engine with a throttle."""
    if table is None:
        return None
    kind = _kind({"type": Driver.kind, **table}, "driver", DRIVERS, collector)
    if kind is None:
        return None
    if load is not None and not isinstance(load, RoadLoad):
        collector.add("driver", None, f"a driver needs [load] type = 'road', not {load.kind!r}")
        return None
    # noted without an early end: the driver's own problems are reported along with this one
    if engine is not None and not engine.takes_throttle():
        collector.add("driver", None, f"a driver needs an engine with a throttle (a map, also in four_stroke, or an "
                      f"FMU with a throttle input), not {engine.kind!r}")
    travel = load.travel if isinstance(load, RoadLoad) else 1.0
    made: Driver | None = reader.build(kind, table, "driver", ("type",), travel=travel)
    return made


def _kind(table: Any, path: str, kinds: Mapping[str, type[Model]], collector: Collector) -> type[Model] | None:
    choices = ", ".join(kinds)
    if not isinstance(table, Mapping):
        collector.add(path, table, f"must be a table [{path}]")
    elif "type" not in table and "fmu" in table and "fmu" in kinds:
        return kinds["fmu"]
    elif "type" not in table:
        collector.add(f"{path}.type", None, "missing", choices)
    elif not isinstance(table["type"], str) or table["type"] not in kinds:
        kind = table["type"]
        collector.add(f"{path}.type", kind, f"unknown type of {path}", choices,
                      nearest(kind, kinds) if isinstance(kind, str) else "")
    else:
        return kinds[table["type"]]
    return None


def _part(kind: type[Model], table: Any, path: str, collector: Collector, reader: Reader, **given: Any) -> Any:
    if not isinstance(table, Mapping):
        collector.add(path, table, f"must be a table [{path}]")
        return None
    return reader.build(kind, table, path, **given)
