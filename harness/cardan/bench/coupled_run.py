"""One run of a coupled system, as `cardan.simulate` does it, with an end for what diverges."""

from __future__ import annotations

import time
from typing import NamedTuple

import numpy as np

from cardan.bench.monolithic import Array, speed_error
from cardan.bench.systems import Coupled
from cardan.coupling import Master, scheme_of
from cardan.errors import CardanError
from cardan.instance import Instance
from cardan.models.surroundings import Surroundings
from cardan.recorder import Recorder

DIVERGED = 10.0  # times the largest speed of the reference
GRID = 20000  # points per second of the references; every communication step of a study is a multiple


class Outcome(NamedTuple):
    """Figures of one run.

    Attributes
    ----------
    error : float
        Largest speed error at the communication points (`speed_error`); inf where the run diverged.
    processor : float
        Processor time of the stepping loop, s.
    steps : int
        Steps of the FMU.
    speeds : array, shape (2, n)
        Input and output speed at the communication points that were reached, rad/s.
    """

    error: float
    processor: float
    steps: int
    speeds: Array


class Study:
    """A coupled system with its reference and one instance of the FMU for all runs.

    Parameters
    ----------
    instance : Instance
        The FMU; it is reset for each run.
    case : Coupled
        The system.
    """

    def __init__(self, instance: Instance, case: Coupled) -> None:
        self.instance, self.case = instance, case
        self.reference: Array = case.monolith().reference(
            np.linspace(0.0, case.stop_time, round(GRID * case.stop_time) + 1))
        self._limit = DIVERGED * float(np.abs(self.reference).max())

    def run(self, coupling: str, rate: int, tolerance: float) -> Outcome:
        """Run once.

        Parameters
        ----------
        coupling : str
            Name of the scheme.
        rate : int
            Communication steps per simulated second.
        tolerance : float
            Of the scene.
        """
        step, stop = 1.0 / rate, self.case.stop_time
        scenario = self.case.scenario(coupling, step, tolerance)
        scheme = scheme_of(scenario)
        self.instance.reset()
        models = Surroundings(scenario, tolerance=scheme.model_tolerance(tolerance))
        master = Master(self.instance, models, scheme, step, scenario.driveline, scenario.outputs)
        count = round(stop * rate)
        master.begin(0.0, stop, scheme.fmu_tolerance(tolerance))
        recorder = Recorder(master, scenario.outputs, count + 1)
        advance, record, limit = scheme.advance, recorder.record, self._limit
        begin = time.process_time()
        record()
        t = 0.0
        try:
            for i in range(1, count + 1):
                end = i * step if i < count else stop
                advance(master, t, end)
                record()
                t = end
                if not abs(master.shaft_in[1]) + abs(master.shaft_out[1]) < limit:
                    break
        except (CardanError, ArithmeticError):  # what diverges is refused by the FMU, or overflows in the models
            pass
        processor = time.process_time() - begin
        columns = recorder.columns()
        speeds = np.array([columns["input.speed"], columns["output.speed"]])
        error = speed_error(speeds, self.reference[:, :: GRID // rate])  # inf where it ended early
        return Outcome(error, processor, master.steps, speeds)
