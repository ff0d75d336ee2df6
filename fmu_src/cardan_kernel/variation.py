"""A motion together with its variational equations: the fundamental matrix beside the states.

x' = f(x) and X' = A(x(t)) X are integrated as one system by DOP853 (coefficients in `tableau`, controller as
in `integrator`), the error controlled on both; A is exact. Over one period of a periodic motion X is the
monodromy matrix, whose eigenvalues are the Floquet multipliers (docs/PHYSICS.md sections 6 and 7).
"""

from math import atan2, fabs, isfinite, pow, sqrt

from .integrator import (
    DONE,
    INFINITE,
    LARGEST_CUT,
    LARGEST_GROWTH,
    NOT_FINITE,
    PRESENT,
    PREVIOUS,
    SAFETY,
    STEP_TOO_SMALL,
    TOO_MANY_STEPS,
)

MOST_COLUMNS = 7
WIDTH = 32  # four states and four numbers for each column
FINEST_STEP = 1e-13  # of the time to go


class Variation:
    """States of a `Bundle` and their derivatives by initial states and constant inputs.

    Columns 0 to 3 start as unit vectors of ``JACOBIAN_STATES``, 4 to 6 start at zero and are forced by a
    constant unit of ``JACOBIAN_INPUTS``.

    Attributes
    ----------
    tolerance : float
        Relative local error of states and columns.
    rotation : float
        Angle (rad) that column 1 has turned through in the plane of twist and twist rate since `start`; half a turn
        for each zero of the twist.
    steps : float
        Counter since `start`.
    most_steps : float
        `run` gives up beyond so many.
    """

    def __init__(self, bundle):
        self.bundle = bundle
        self.integrator = self.bundle.stepper.integrator
        self.y = [0.0] * 32
        self.z = [0.0] * 32
        self.scale = [0.0] * 32
        self.f = [0.0] * 384
        self.places = [0] * 50
        self.width = 4
        self.watched = -1
        self.fast = 1.0
        self.s = 0.0
        self.h = 0.0
        self.previous_error = 1e-4
        self.tolerance = 1e-13
        self.rotation = 0.0
        self.steps = 0.0
        self.most_steps = 1000000.0
        for j in range(50):
            self.places[j] = self.integrator.columns[j] // 5 * WIDTH

    def start(self, p, twist, w1, wy, columns):
        """Start from states (rad, rad, rad/s, rad/s) with the given columns (at most 7).

        In a rigid driveline `twist` and `wy` do not matter; where the input speed is prescribed it stays `w1`.
        """
        b = self.bundle
        m = b.motion
        y = self.y
        b.prepare()
        y[0] = p
        y[1] = 0.0 if m.rigid else twist
        y[2] = w1
        y[3] = 0.0 if m.rigid else wy
        count = len(columns)
        b.count = count
        self.width = 4 + 4 * count
        self.watched = -1
        for j in range(count):
            kind = columns[j]
            b.kinds[j] = kind
            for i in range(4):
                y[4 + 4 * j + i] = 1.0 if i == kind else 0.0
            if kind == 1:
                self.watched = 4 + 4 * j
        m.steer(p, w1, 0.0, 0.0)
        fast = m.frequency()
        if fast < 2.0 * fabs(w1):
            fast = 2.0 * fabs(w1)
        if fast < 1.0:
            fast = 1.0
        self.fast = fast
        self.s = 0.0
        self.h = pow(self.tolerance, 0.125) / fast
        self.previous_error = 1e-4
        self.rotation = 0.0
        self.steps = 0.0

    def stages(self, h):
        """Evaluate the stages 1 .. 11 of a step of length `h` (s)."""
        y = self.y
        z = self.z
        f = self.f
        it = self.integrator
        for i in range(1, 12):
            first = it.starts[i]
            last = it.starts[i + 1]
            for m in range(self.width):
                d = 0.0
                for j in range(first, last):
                    d += it.values[j] * f[self.places[j] + m]
                z[m] = y[m] + h * d
            self.bundle.slopes(self.s + it.nodes[i] * h, z, f, WIDTH * i)

    def measure(self):
        """Sizes that the errors of a step are compared with, from the present states and columns."""
        y = self.y
        scale = self.scale
        fast = self.fast
        speed = fabs(y[2])
        if speed < fabs(y[3]):
            speed = fabs(y[3])
        if speed < 1.0:
            speed = 1.0
        scale[0] = 1.0
        scale[1] = fabs(y[1])
        if scale[1] < speed / fast:
            scale[1] = speed / fast
        scale[2] = speed
        scale[3] = speed
        # A forced column starts at zero; in the time 1 / fast a unit torque moves it by about this much.
        least = 1e-3 / (fast * fast * (self.bundle.motion.m1 + self.bundle.motion.m2))
        for o in range(4, self.width, 4):
            size = fabs(y[o]) + fabs(y[o + 1]) + (fabs(y[o + 2]) + fabs(y[o + 3])) / fast
            if size < least:
                size = least
            scale[o] = size
            scale[o + 1] = size
            scale[o + 2] = size * fast
            scale[o + 3] = size * fast

    def combine(self, h):
        """Form the increments into `z` and return the scaled error of the step (inf if not finite)."""
        z = self.z
        f = self.f
        it = self.integrator
        sum5 = 0.0
        sum3 = 0.0
        total = 0.0
        for m in range(self.width):
            d = 0.0
            error5 = 0.0
            error3 = 0.0
            for j in range(12):
                if j > 0 and j < 5:
                    continue
                slope = f[WIDTH * j + m]
                d += it.b[j] * slope
                error5 += it.e5[j] * slope
                error3 += it.e3[j] * slope
            z[m] = h * d
            total += z[m]
            error5 = error5 / self.scale[m]
            error3 = error3 / self.scale[m]
            sum5 += error5 * error5
            sum3 += error3 * error3
        spread = sum5 + 0.01 * sum3
        if spread == 0.0:
            return 0.0
        error = h * sum5 / (self.tolerance * sqrt(self.width * spread))
        if not isfinite(error + total):
            return INFINITE
        return error

    def attempt(self, h):
        """Scaled error of one step of length `h`; inf where the equations leave the numbers."""
        try:
            self.stages(h)
            return self.combine(h)
        except (ValueError, OverflowError, ZeroDivisionError):
            return INFINITE

    def accept(self, h):
        """Add the increments in `z`; follow the watched column."""
        y = self.y
        f = self.f
        o = self.watched
        a0 = 0.0
        b0 = 0.0
        if o >= 0:
            a0 = y[o + 1] * self.fast
            b0 = f[o + 1]
        for m in range(self.width):
            y[m] += self.z[m]
        self.bundle.slopes(self.s + h, y, f, 0)
        if o >= 0:
            a1 = y[o + 1] * self.fast
            b1 = f[o + 1]
            self.rotation -= atan2(a0 * b1 - b0 * a1, a0 * a1 + b0 * b1)
        self.steps += 1.0

    def run(self, end):
        """Integrate to the time `end` (s) since `start`.

        Returns
        -------
        int
            ``DONE`` (0), ``STEP_TOO_SMALL``, ``NOT_FINITE`` or ``TOO_MANY_STEPS`` as `Integrator.run`.
        """
        span = end - self.s
        rejected = False
        if not isfinite(span + self.y[0] + self.y[1] + self.y[2] + self.y[3]):
            return NOT_FINITE
        self.bundle.slopes(self.s, self.y, self.f, 0)
        while self.s < end:
            left = end - self.s
            h = self.h
            reach = self.bundle.motion.reach()
            fitted = False
            if h > reach:
                h = reach
                fitted = True
            if h >= left:
                h = left
                fitted = True
            elif 2.0 * h > left:
                h = 0.5 * left
                fitted = True
            self.measure()
            error = self.attempt(h)
            if error <= 1.0:
                if error < 1e-10:
                    factor = LARGEST_GROWTH
                else:
                    factor = SAFETY * pow(error, -PRESENT) * pow(self.previous_error, PREVIOUS)
                    if factor > LARGEST_GROWTH:
                        factor = LARGEST_GROWTH
                    elif factor * LARGEST_CUT < 1.0:
                        factor = 1.0 / LARGEST_CUT
                self.previous_error = error if error > 1e-4 else 1e-4
                if rejected and factor > 1.0:
                    factor = 1.0
                if not fitted or factor < LARGEST_GROWTH or h * factor > self.h:
                    self.h = h * factor
                rejected = False
                self.accept(h)
                self.s = end if h == left else self.s + h
            else:
                rejected = True
                factor = 1.0 / LARGEST_CUT
                if isfinite(error):
                    factor = SAFETY * pow(error, -PRESENT)
                    if factor * LARGEST_CUT < 1.0:
                        factor = 1.0 / LARGEST_CUT
                self.h = h * factor
                if self.h < FINEST_STEP * span or self.s + self.h == self.s:
                    return STEP_TOO_SMALL if isfinite(error) else NOT_FINITE
                self.bundle.slopes(self.s, self.y, self.f, 0)
            if self.steps > self.most_steps:
                return TOO_MANY_STEPS
        return DONE

    def values(self):
        """The four states, then each column's four numbers."""
        return [self.y[i] for i in range(self.width)]

    def rates(self):
        """Time derivatives of `values`."""
        self.bundle.slopes(self.s, self.y, self.f, 0)
        return [self.f[i] for i in range(self.width)]
