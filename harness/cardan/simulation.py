"""From a scenario to a result: the run."""

from __future__ import annotations

import math
import os
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING

import numpy as np

from cardan.coupling import FALLBACK, FOREIGN, Master, Scheme, scheme, scheme_of
from cardan.errors import CardanError
from cardan.instance import Instance
from cardan.models.foreign import foreign_in
from cardan.models.surroundings import Surroundings
from cardan.provenance import provenance
from cardan.recorder import Recorder
from cardan.result import Result, RunInfo

if TYPE_CHECKING:
    from cardan.scenario import Scenario

Progress = Callable[[float], None]
DOUBTFUL = 0.05  # of the energy exchanged: a run whose coupling makes or loses more gets a note
PULSE = 0.05  # s between looks at the progress and at the keyboard


class Interrupted(KeyboardInterrupt):
    """The user has stopped a run; `result` has what was recorded until then."""

    def __init__(self, result: Result) -> None:
        self.result = result
        super().__init__(result.info.message)


def simulate(scenario: Scenario | str | Path, *, fmu: str | os.PathLike[str] | None = None,
             progress: Progress | None = None, announce: Callable[[str], None] | None = None) -> Result:
    """Run a scenario.

    Only the listed outputs are recorded; they and the shaft motions that the models need are exchanged, at the points
    ``start + i h`` with the last one exactly on the stop time.

    Parameters
    ----------
    scenario : Scenario, str or Path
        What to run: a scene, its file, or the name of a shipped one.
    fmu : path-like, optional
        FMU to use; by default the driveline FMU of this installation, built on first use.
    progress : callable, optional
        Called about 20 times per second with the fraction done, 0 to 1.
    announce : callable, optional
        Called once, when the FMU is loaded, with a line that says which kernel runs.

    Returns
    -------
    Result
        Complete, or with ``info.completed`` False and the FMU's own words in ``info.message`` where a step was
        refused: what was recorded until then is kept.

    Raises
    ------
    CardanError
        If the run cannot start.
    Interrupted
        On Ctrl-C, with what was recorded.
    """
    from cardan.scenario import Scenario as Kind

    if not isinstance(scenario, Kind):
        scenario = Kind.read(scenario)
    method = scheme_of(scenario)
    loading = time.perf_counter()
    with Instance(_fmu_path(fmu)) as instance:
        description = instance.description
        method, note = _possible(method, scenario, description.can_get_set_state, description.path.name)
        surroundings = Surroundings(scenario, tolerance=method.model_tolerance(scenario.tolerance))
        names = [name for name in scenario.outputs if name not in surroundings.signals]
        read = [name for name in names if description[name].type == "Real"]
        master = Master(instance, surroundings, method, scenario.communication_step, scenario.driveline, read)
        start, stop, h = 0.0, scenario.stop_time, scenario.communication_step
        count = max(1, math.ceil((stop - start) / h - 1e-6))
        master.begin(start, stop, method.fmu_tolerance(scenario.tolerance))
        recorder = Recorder(master, scenario.outputs, count + 1)
        made_by = provenance(instance)
        if announce is not None:
            announce(f"{made_by['kernel']} kernel {made_by['fmu']['kernel_version']} in {description.path}")
            if note:
                announce(note)
        wall, processor = time.perf_counter(), time.process_time()
        message, interrupted = _run(master, recorder, start, stop, h, count, progress)
        processor, wall, loading = time.process_time() - processor, time.perf_counter() - wall, wall - loading
    done = recorder.count
    times = start + np.arange(done, dtype=np.float64) * h
    if done == count + 1:
        times[-1] = stop
    simulated = float(times[-1]) - start
    info = RunInfo(
        title=scenario.title, scene=scenario.to_dict(), completed=done == count + 1, message=message,
        start_time=start, stop_time=stop, reached_time=float(times[-1]), communication_step=h,
        coupling=method.name, steps=master.steps, note=note or _judged(master),
        wall_time=wall, processor_time=processor, loading_time=loading,
        real_time_factor=simulated / wall if wall > 0.0 else math.inf,
        energy_residual=master.energy.residual, energy_supplied=master.energy.supplied,
        energy_taken=master.energy.taken, **made_by,
    )
    display = {name: (description[name].display_unit, description[name].display_factor)
               for name in names if description[name].display_unit}
    result = Result(times, recorder.columns(), recorder.units, info, display)
    if interrupted:
        raise Interrupted(result)
    return result


def _possible(method: Scheme, scenario: Scenario, can_roll_back: bool, fmu: str) -> tuple[Scheme, str]:
    """Return the scheme, or another one and why, where an FMU in the scene cannot do what it needs."""
    asked = f"coupling = {method.name!r}"
    if foreign_in(scenario.engine, scenario.load) and (method.rolls_back or method.order > 2):
        return scheme(FOREIGN), (f"{asked} gains nothing with a foreign FMU, whose inputs are held: "
                                 f"coupling = {FOREIGN!r} is used instead")
    if method.rolls_back and not can_roll_back:
        return scheme(FALLBACK), (f"{asked} needs an FMU that saves and restores its state, which {fmu} does not: "
                                  f"coupling = {FALLBACK!r} is used instead")
    return method, ""


def _judged(master: Master) -> str:
    """Return a warning where the coupling has made or lost so much energy that the run cannot be trusted."""
    energy = master.energy
    exchanged = max(abs(energy.supplied), abs(energy.taken))
    if abs(energy.residual) <= DOUBTFUL * exchanged:
        return ""
    return (f"the coupling {'lost' if energy.residual > 0.0 else 'made'} {abs(energy.residual):.3g} J, "
            f"{abs(energy.residual) / exchanged:.1%} of the energy exchanged: inaccurate or unstable; take a shorter "
            f"communication_step or coupling = 'auto'")


def _fmu_path(fmu: str | os.PathLike[str] | None) -> Path:
    if fmu is not None:
        return Path(fmu)
    from cardan_build import default_fmu

    return default_fmu()


def _run(master: Master, recorder: Recorder, start: float, stop: float, h: float, count: int,
         progress: Progress | None) -> tuple[str, bool]:
    """Do all steps; return why it ended early (empty: it did not) and whether the user wanted that."""
    recorder.record()
    t, done, chunk = start, 0, 1
    with _Keyboard() as keyboard:
        while done < count:
            clock = time.perf_counter()
            message, done, t = _steps(master, recorder, keyboard, t, done, min(done + chunk, count),
                                      lambda i: start + i * h if i < count else stop)
            if message:
                return message, False
            taken = time.perf_counter() - clock
            chunk = 2 * chunk if taken < 0.5 * PULSE else max(1, chunk // 4) if taken > 4.0 * PULSE else chunk
            if progress is not None:
                progress(done / count)
            if keyboard.pressed and done < count:
                return f"stopped by the user at t = {t:.6g} s", True
    return "", False


def _steps(master: Master, recorder: Recorder, keyboard: _Keyboard, t: float, done: int, last: int,
           point: Callable[[int], float]) -> tuple[str, int, float]:
    """Do steps up to the number `last` or the keyboard; return why it failed (empty: it did not), steps done, time."""
    advance, record = master.scheme.advance, recorder.record
    try:
        while done < last and not keyboard.pressed:
            end = point(done + 1)
            advance(master, t, end)
            record()
            t = end
            done += 1
    except CardanError as error:
        return str(error), done, t
    except (ArithmeticError, ValueError) as error:
        return f"the models outside the FMU failed after t = {t:.6g} s: {error}", done, t
    return "", done, t


class _Keyboard:
    """Notes Ctrl-C instead of raising: raised inside a Python FMU it would be a fatal error of that FMU."""

    def __init__(self) -> None:
        self.pressed = False

    def __enter__(self) -> _Keyboard:
        ours = threading.current_thread() is threading.main_thread()
        self._old = signal.getsignal(signal.SIGINT) if ours else None
        if self._old is signal.default_int_handler:
            signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(self, *exception: object) -> None:
        if self._old is signal.default_int_handler:
            signal.signal(signal.SIGINT, self._old)

    def _note(self, number: int, frame: FrameType | None) -> None:
        self.pressed = True
