"""A torque as a law of shaft speed and input angle, for the analysis of periodic motions.

T(p, w) = c0 + c1 w + c2 w |w| + R(p) + K(p) w, with R and K Fourier series in the input angle p. The
polynomial part holds the usual loads exactly; the series hold the linearization of any law along a
periodic motion, whose motion and variational equations are then those of the law itself.
"""

from math import cos, fabs, sin

MOST_HARMONICS = 96


class Law:
    """A torque law; `take` evaluates it.

    Attributes
    ----------
    value : float
        T, N.m.
    slope : float
        Partial derivative by the speed, N.m.s/rad.
    by_angle : float
        Partial derivative by the input angle, N.m/rad.
    """

    def __init__(self):
        self.c0 = 0.0
        self.c1 = 0.0
        self.c2 = 0.0
        self.harmonics = 0
        self.order = 2.0
        self.rest = [0.0] * 194
        self.gain = [0.0] * 194
        self.plain = True
        self.value = 0.0
        self.slope = 0.0
        self.by_angle = 0.0

    def polynomial(self, c0, c1, c2):
        """Set the part c0 + c1 w + c2 w |w| (N.m, N.m.s/rad, N.m.s2/rad2)."""
        self.c0 = c0
        self.c1 = c1
        self.c2 = c2
        self.plain = c2 == 0.0 and self.harmonics == 0

    def series(self, order, rest, gain):
        """Set the Fourier series R and K.

        Parameters
        ----------
        order : float
            Lowest order: harmonic n goes as n * order * p.
        rest, gain : list of float
            Mean, then cosine and sine amplitude of each harmonic, N.m and N.m.s/rad; equally long, at most
            1 + 2 * ``MOST_HARMONICS`` entries. Empty lists remove the series.
        """
        self.harmonics = 0
        for i in range(len(rest)):
            self.rest[i] = rest[i]
            self.gain[i] = gain[i]
        if len(rest) > 0:
            self.harmonics = (len(rest) - 1) // 2 + 1
        self.order = order
        self.plain = self.c2 == 0.0 and self.harmonics == 0

    def take(self, p, w):
        """Evaluate at the input angle `p` (rad) and the shaft speed `w` (rad/s)."""
        self.value = self.c0 + (self.c1 + self.c2 * fabs(w)) * w
        self.slope = self.c1 + 2.0 * self.c2 * fabs(w)
        self.by_angle = 0.0
        if self.harmonics == 0:
            return
        c1 = cos(self.order * p)
        s1 = sin(self.order * p)
        c = 1.0
        s = 0.0
        value = self.rest[0]
        slope = self.gain[0]
        turning = 0.0
        rate = 0.0
        for n in range(1, self.harmonics):
            keep = c * c1 - s * s1
            s = s * c1 + c * s1
            c = keep
            value += self.rest[2 * n - 1] * c + self.rest[2 * n] * s
            slope += self.gain[2 * n - 1] * c + self.gain[2 * n] * s
            rate += n * (self.rest[2 * n] * c - self.rest[2 * n - 1] * s)
            turning += n * (self.gain[2 * n] * c - self.gain[2 * n - 1] * s)
        self.value += value + slope * w
        self.slope += slope
        self.by_angle = self.order * (rate + turning * w)
