"""The cardan driveline as its FMU offers it: life cycle, steps and complete state."""

from math import isfinite
from typing import Optional

from . import checks
from .integrator import DONE, NOT_FINITE, TOO_MANY_STEPS
from .memory import (
    INITIALIZING,
    INSTANTIATED,
    LAYOUT,
    LEFT_INITIALIZATION,
    MARK,
    MASTER_TOLERANCE,
    MODE,
    RUNNING,
    TERMINATED,
    UNCHECKED,
    VARS,
)
from .places import BEND1, BEND2, COMMAND, TORQUE_IN, TORQUE_OUT
from .values import FIRST_INPUT, FIRST_OUTPUT, Values
from .variables import HALF_PI, VARIABLES

LOWEST_BEND = -checks.ROUNDING


class Driveline(Values):
    """A cardan driveline with the life cycle of an FMI 2.0 co-simulation slave.

    No method of the life cycle raises: what is refused is told through `log` and `last_error`, and
    `do_step` returns False with the state as it was.

    Parameters
    ----------
    log : callable, optional
        Called as ``log(status, text)`` with the FMI 2.0 status 1 (warning) or 3 (error).

    Attributes
    ----------
    last_error : str
        Text of the last refusal.
    """

    # Life cycle

    def setup_experiment(self, start_time: float, stop_time: Optional[float] = None,
                         tolerance: Optional[float] = None) -> None:
        """Take the master's tolerance (1); it wins over ``model.tolerance``."""
        if self.z[MODE] != INSTANTIATED:
            self.misuse("setup_experiment is refused after enter_initialization_mode: reset the instance first")
            return
        self.z[MASTER_TOLERANCE] = 0.0
        if tolerance is not None:
            low, high = 1e-13, 0.1
            if low <= tolerance <= high:
                self.z[MASTER_TOLERANCE] = tolerance
            else:
                self.misuse(f"tolerance = {tolerance:g} is refused: it must be at least {low:g} and at most {high:g}; "
                            f"model.tolerance is used instead")

    def enter_initialization_mode(self) -> None:
        """Open the parameters for setting."""
        if self.z[MODE] != INSTANTIATED:
            self.misuse("enter_initialization_mode is refused a second time: reset the instance first")
            return
        self.z[MODE] = INITIALIZING
        self.stepper.forget_outputs()

    def exit_initialization_mode(self) -> None:
        """Judge all values and start; what is wrong is told here and refused by `do_step`."""
        if self.z[MODE] != INITIALIZING:
            self.misuse("exit_initialization_mode is refused outside of initialization mode: enter it first")
            return
        self.pending = ""
        self.z[MODE] = LEFT_INITIALIZATION
        self.begin()

    def terminate(self) -> None:
        """End the run; further steps are refused."""
        if self.z[MODE] != RUNNING and self.z[MODE] != LEFT_INITIALIZATION:
            self.misuse("terminate is refused before exit_initialization_mode and after terminate")
            return
        self.z[MODE] = TERMINATED

    def begin(self) -> bool:
        """Start if every value is good; returns whether it is."""
        z = self.z
        problems = checks.all_problems(self.number)
        if problems:
            self.refuse("; ".join(problems))
            return False
        z[UNCHECKED] = 0.0
        self.stepper.start()
        self.stale = False
        z[MODE] = RUNNING
        return True

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Go on by `step_size` (s).

        Parameters
        ----------
        current_time : float
            Communication point, s; only told in messages, the driveline counts its own steps.
        step_size : float
            Length of the communication step, s; any positive length, different each time.

        Returns
        -------
        bool
            False where the step is refused; `last_error` says why and the state is as it was.
        """
        try:
            return self.advance(current_time, step_size)
        except Exception as error:  # an exception that leaves a callback ends the host process
            return self.refuse(f"internal error in do_step at t = {current_time} s: {error!r}")

    def advance(self, current_time: float, step_size: float) -> bool:
        """`do_step` without its net."""
        z = self.z
        if self.pending:
            text = self.pending
            self.pending = ""
            return self.refuse(text)
        if z[MODE] != RUNNING and not self.may_run():
            return False
        if not (isfinite(step_size) and step_size > 0.0 and isfinite(current_time)):
            return self.refuse(f"step of {step_size} s at t = {current_time} s is refused: the step must be a finite "
                               f"number above 0")
        if z[UNCHECKED] != 0.0:
            problems = checks.all_problems(self.number)
            if problems:
                return self.refuse("; ".join(problems))
            z[UNCHECKED] = 0.0
        if not self.inputs_good(step_size):
            return self.refuse(self.input_problems(step_size))
        if self.stale:
            self.stepper.configure()
            self.stale = False
        result = self.stepper.step(step_size)
        if result != DONE:
            return self.refuse(self.failure(result, current_time, step_size))
        return True

    def may_run(self) -> bool:
        """Whether steps are due; a start that was refused is tried again with the present values."""
        mode = self.z[MODE]
        if mode == LEFT_INITIALIZATION:
            return self.begin()
        if mode == TERMINATED:
            return self.refuse("do_step after terminate is refused: reset the instance first")
        return self.refuse("do_step before exit_initialization_mode is refused: initialize the instance first")

    def failure(self, result, current_time, step_size):
        """Why the integrator gave up, in words."""
        where = f"in the step of {step_size:g} s from t = {current_time:g} s"
        if result == NOT_FINITE:
            return (f"the motion leaves the finite numbers {where}: look at input.torque, output.torque, their der1 "
                    f"and by_speed, or give a shorter communication step")
        if result == TOO_MANY_STEPS:
            return f"more than 2e7 integrator steps {where}: give a shorter communication step or a larger tolerance"
        return (f"the tolerance cannot be met {where}: the integrator step fell below 1e-14 of it; give a larger "
                f"tolerance or model.fidelity = 1 where shaft.stiffness or shaft.damping are extreme")

    # Judging

    def inputs_good(self, h):
        """Whether all inputs can be taken over the step `h` (s); fast, without words."""
        z = self.z
        total = 0.0
        for i in range(3):
            total += (z[TORQUE_IN + i] - z[TORQUE_IN + i]) + (z[TORQUE_OUT + i] - z[TORQUE_OUT + i])
            total += (z[COMMAND + i] - z[COMMAND + i]) + (z[BEND1 + i] - z[BEND1 + i]) + (z[BEND2 + i] - z[BEND2 + i])
        return total == 0.0 and self.bend_good(BEND1, h) and self.bend_good(BEND2, h)

    def bend_good(self, place, h):
        """Whether a joint angle stays below 90 deg over the step `h` (s)."""
        z = self.z
        a0 = z[place]
        a1 = z[place + 1]
        a2 = z[place + 2]
        if not LOWEST_BEND <= a0 < HALF_PI:
            return False
        if a1 == 0.0 and a2 == 0.0:
            return True
        if not LOWEST_BEND <= a0 + h * (a1 + 0.5 * h * a2) < HALF_PI:
            return False
        if a2 != 0.0 and 0.0 < -a1 / a2 < h:
            return LOWEST_BEND <= a0 - 0.5 * a1 * a1 / a2 < HALF_PI
        return True

    def input_problems(self, h):
        """What `inputs_good` found, in words."""
        z = self.z
        found = [checks.problem(VARIABLES[r], z[VARS + r]) for r in range(FIRST_INPUT, FIRST_OUTPUT)]
        found = [text for text in found if text]
        if not found:
            found = [checks.bend_problem(joint, z[at], z[at + 1], z[at + 2], h)
                     for joint, at in ((1, BEND1), (2, BEND2))]
        return "; ".join(text for text in found if text)

    # State

    def get_state(self) -> bytes:
        """The complete state as bytes; `set_state` of them repeats every later result bit for bit."""
        return self.stepper.store.tobytes()

    def set_state(self, state: bytes) -> None:
        """Restore a state from `get_state`; refused where the length is not that of this version."""
        if len(state) == 8 * len(self.stepper.store) and memoryview(state).cast("d")[MARK] != LAYOUT:
            self.misuse("state is refused: these bytes are no state of this version of the driveline")
            return
        if len(state) != 8 * len(self.stepper.store):
            self.misuse(f"state of {len(state)} bytes is refused: this version's states have "
                        f"{8 * len(self.stepper.store)} bytes")
            return
        memoryview(self.stepper.store).cast("B")[:] = state
        self.pending = ""
        self.stale = True

    # For analyses in Python

    def jacobian(self):
        """Exact Jacobians of the equations of motion at the end of the last step.

        Returns
        -------
        a, b, c, d : list of rows
            Derivatives of the rates of `JACOBIAN_STATES` (a, b) and of `JACOBIAN_OUTPUTS` (c, d) by the states
            (4 columns) and by `JACOBIAN_INPUTS` (3 columns), SI units. In a rigid driveline the twist and
            ``shaft.speed_b`` are no states of their own (their columns are zero); where the input speed is
            prescribed, ``input.acceleration`` is its rate and ``input.torque`` has no effect.
        """
        if self.stale:
            self.stepper.configure()
            self.stale = False
        columns = self.stepper.columns()
        rows = [[column[i] for column in columns] for i in range(19)]
        return ([row[:4] for row in rows[:4]], [row[4:] for row in rows[:4]],
                [row[:4] for row in rows[4:]], [row[4:] for row in rows[4:]])
