"""DOP853 with a PI step-size controller over one communication step.

Method and error estimate: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 2nd
edition, section II.10; controller: Gustafsson's PI control as in section II.4 and the authors' program
dop853.f. Coefficients stand in `tableau`.
"""

from math import fabs, floor, isfinite, pow, sqrt

from .tableau import EMBEDDED_WEIGHTS_3, ERROR_WEIGHTS_5, NODES, STAGE_WEIGHTS, WEIGHTS

DONE = 0
STEP_TOO_SMALL = 1
NOT_FINITE = 2
TOO_MANY_STEPS = 3

# Controller: safety factor, exponents of the present and the previous error, limits of a step's change.
SAFETY = 0.9
PREVIOUS = 0.04
PRESENT = 0.117  # 1/8 - 0.2 * PREVIOUS
LARGEST_CUT = 3.0
LARGEST_GROWTH = 6.0

# The local error is kept this much below the tolerance, so that the error of a second of motion, some
# thousand steps, is of the order of the tolerance.
LOCAL = 0.02

SMALLEST_STEP = 1e-14  # of the communication step
MOST_STEPS = 20000000.0
INFINITE = float("inf")

TURN = 6.283185307179586
TURN_REST = 2.4492935982947064e-16  # 2 pi less TURN


def _dense(weights, length):
    return [weights.get(j, 0.0) for j in range(length)]


def _flat(rows):
    """Nonzero stage weights in one list, with their columns and the start of each row."""
    columns, values, starts = [], [], [0]
    for row in rows:
        columns.extend(row)
        values.extend(row.values())
        starts.append(len(columns))
    return columns, values, starts


def product_rest(a, b):
    """Rounding error of the product a * b (Dekker 1971)."""
    big = 134217729.0 * a
    a1 = big - (big - a)
    a2 = a - a1
    big = 134217729.0 * b
    b1 = big - (big - b)
    b2 = b - b1
    return ((a1 * b1 - a * b) + a1 * b2 + a2 * b1) + a2 * b2


class Integrator:
    """Integrates the states of a `Motion` and the net work.

    Attributes
    ----------
    y : list of 5 float
        p (reduced to one turn), twist, w1, wy, net work.
    carry : float
        Rounding left over from adding to p, rad.
    turns : float
        Whole turns counted so far.
    h : float
        Step proposed for the next integrator step, s.
    previous_error : float
        Memory of the PI controller.
    steps, evaluations, rejected : float
        Counters.
    tolerance, twist_floor : float
        Relative tolerance; twist (rad) per speed (rad/s) below which the twist error is absolute.
    """

    def __init__(self, motion):
        self.motion = motion
        self.y = [0.0] * 5
        self.z = [0.0] * 5
        self.f = [0.0] * 60
        self.nodes = [0.0] * 12
        self.values = [0.0] * 50
        self.columns = [0] * 50
        self.starts = [0] * 13
        self.b = [0.0] * 12
        self.e5 = [0.0] * 12
        self.e3 = [0.0] * 12
        self.carry = 0.0
        self.turns = 0.0
        self.h = 0.0
        self.previous_error = 1e-4
        self.steps = 0.0
        self.evaluations = 0.0
        self.rejected = 0.0
        self.tolerance = 1e-9
        self.twist_floor = 1.0
        self._load()

    def _load(self):
        columns, values, starts = _flat(STAGE_WEIGHTS)
        b = _dense(WEIGHTS, 12)
        e5 = _dense(ERROR_WEIGHTS_5, 12)
        low = _dense(EMBEDDED_WEIGHTS_3, 12)
        for j in range(50):
            self.columns[j] = 5 * columns[j]
            self.values[j] = values[j]
        for i in range(13):
            self.starts[i] = starts[i]
        for i in range(12):
            self.nodes[i] = NODES[i]
            self.b[i] = b[i]
            self.e5[i] = e5[i]
            self.e3[i] = b[i] - low[i]

    def stages(self, s, h):
        """Evaluate the stages 1 .. 11 of a step of length `h` (s) at the time `s` (s)."""
        y = self.y
        z = self.z
        f = self.f
        values = self.values
        columns = self.columns
        starts = self.starts
        for i in range(1, 12):
            d0 = 0.0
            d1 = 0.0
            d2 = 0.0
            d3 = 0.0
            for j in range(starts[i], starts[i + 1]):
                a = values[j]
                o = columns[j]
                d0 += a * f[o]
                d1 += a * f[o + 1]
                d2 += a * f[o + 2]
                d3 += a * f[o + 3]
            z[0] = y[0] + h * d0
            z[1] = y[1] + h * d1
            z[2] = y[2] + h * d2
            z[3] = y[3] + h * d3
            self.motion.derivative(s + self.nodes[i] * h, z, f, 5 * i)
        self.evaluations += 11.0

    def combine(self, h):
        """Form the increments into `z` and return the scaled error of the step (inf if not finite)."""
        y = self.y
        z = self.z
        f = self.f
        big = fabs(y[2])
        if fabs(y[3]) > big:
            big = fabs(y[3])
        if big < 1.0:
            big = 1.0
        sum5 = 0.0
        sum3 = 0.0
        for m in range(5):
            d = 0.0
            error5 = 0.0
            error3 = 0.0
            for j in range(12):
                if j > 0 and j < 5:
                    continue
                slope = f[5 * j + m]
                d += self.b[j] * slope
                error5 += self.e5[j] * slope
                error3 += self.e3[j] * slope
            z[m] = h * d
            if m == 4:
                break
            if m == 0:
                scale = 1.0 + fabs(z[0])
            elif m == 1:
                scale = fabs(y[1] + z[1])
                if scale < fabs(y[1]):
                    scale = fabs(y[1])
                if scale < self.twist_floor * big:
                    scale = self.twist_floor * big
            else:
                scale = fabs(y[m] + z[m])
                if scale < fabs(y[m]):
                    scale = fabs(y[m])
                if scale < 1.0:
                    scale = 1.0
            error5 = error5 / scale
            error3 = error3 / scale
            sum5 += error5 * error5
            sum3 += error3 * error3
        spread = sum5 + 0.01 * sum3
        if spread == 0.0:
            return 0.0
        error = h * sum5 / (LOCAL * self.tolerance * sqrt(4.0 * spread))
        if not isfinite(error + z[0] + z[1] + z[2] + z[3] + z[4]):
            return INFINITE
        return error

    def accept(self):
        """Add the increments in `z` to the states."""
        y = self.y
        z = self.z
        self.add_angle(z[0])
        y[1] += z[1]
        y[2] += z[2]
        y[3] += z[3]
        y[4] += z[4]
        self.steps += 1.0

    def add_angle(self, increment):
        """Add to p without losing the rounding; keep p within half a turn of zero."""
        self.shift(increment)
        turns = float(floor(self.y[0] / TURN + 0.5))
        if turns != 0.0:
            whole = turns * TURN
            self.carry -= product_rest(turns, TURN) + turns * TURN_REST
            self.shift(-whole)
            self.turns += turns

    def shift(self, increment):
        """Add to p; what rounding drops goes to the carry (Knuth's two-sum)."""
        before = self.y[0]
        step = increment + self.carry
        total = before + step
        kept = total - before
        self.carry = (before - (total - kept)) + (step - kept) + (self.carry - (step - increment))
        self.y[0] = total

    def run(self, span):
        """Integrate over `span` (s); on any result but ``DONE`` the states are to be thrown away.

        Returns
        -------
        int
            ``DONE``, ``STEP_TOO_SMALL``, ``NOT_FINITE`` or ``TOO_MANY_STEPS``.
        """
        s = 0.0
        left = span
        last_rejected = False
        begin = self.steps + self.rejected
        fresh = True
        reach = INFINITE
        while left > 0.0:
            if fresh:
                self.motion.derivative(s, self.y, self.f, 0)
                self.evaluations += 1.0
                fresh = False
                if not isfinite(self.f[0] + self.f[1] + self.f[2] + self.f[3]):
                    return NOT_FINITE
                reach = self.motion.reach()
            h = self.h
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
            error = self.attempt(s, h)
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
                if last_rejected and factor > 1.0:
                    factor = 1.0
                # A fitted step says nothing against the longer one that was proposed before it.
                if not fitted or factor < LARGEST_GROWTH or h * factor > self.h:
                    self.h = h * factor
                last_rejected = False
                self.accept()
                fresh = True
                if h == left:
                    left = 0.0
                else:
                    s += h
                    left = span - s
            else:
                self.rejected += 1.0
                last_rejected = True
                if isfinite(error):
                    factor = SAFETY * pow(error, -PRESENT)
                    if factor * LARGEST_CUT < 1.0:
                        factor = 1.0 / LARGEST_CUT
                else:
                    factor = 1.0 / LARGEST_CUT
                self.h = h * factor
                if self.h < SMALLEST_STEP * span or s + self.h == s:
                    return STEP_TOO_SMALL if isfinite(error) else NOT_FINITE
            if self.steps + self.rejected - begin > MOST_STEPS:
                return TOO_MANY_STEPS
        return DONE

    def attempt(self, s, h):
        """Scaled error of one step of length `h`; inf where the equations leave the numbers."""
        try:
            self.stages(s, h)
            return self.combine(h)
        except (ValueError, OverflowError, ZeroDivisionError):
            return INFINITE
