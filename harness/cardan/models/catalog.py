"""The models that a scene file can name by type."""

from __future__ import annotations

from cardan.models.base import Model
from cardan.models.constant import ConstantTorque
from cardan.models.csv_torque import CsvTorque
from cardan.models.driver import Driver
from cardan.models.dyno import Dyno
from cardan.models.foreign import ForeignFmu
from cardan.models.four_stroke import FourStroke
from cardan.models.governor import IdleGovernor
from cardan.models.prescribed_speed import PrescribedSpeed
from cardan.models.road import RoadLoad
from cardan.models.speed_laws import LinearLoad, PowerLoad, QuadraticLoad
from cardan.models.step import StepTorque
from cardan.models.stribeck import StribeckLoad
from cardan.models.torque_map import TorqueMap

_ENGINES: tuple[type[Model], ...] = (ConstantTorque, TorqueMap, FourStroke, IdleGovernor, PrescribedSpeed, CsvTorque,
                                     StepTorque, ForeignFmu)
_LOADS: tuple[type[Model], ...] = (ConstantTorque, LinearLoad, QuadraticLoad, PowerLoad, RoadLoad, Dyno, StribeckLoad,
                                   StepTorque, CsvTorque, ForeignFmu)

ENGINES: dict[str, type[Model]] = {model.kind: model for model in _ENGINES}
LOADS: dict[str, type[Model]] = {model.kind: model for model in _LOADS}
DRIVERS: dict[str, type[Model]] = {Driver.kind: Driver}
