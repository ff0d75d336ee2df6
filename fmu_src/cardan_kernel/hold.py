"""A torque between communication points: what the FMU makes of the values its master gives.

Only the part of a torque that does not depend on the shaft speed is held: with the partial derivative
K = dT/dw given, the rest u - K w is continued as a polynomial in the time s since the last
communication point and K w(s) is added while integrating. A steep load then stays stable.
"""

# A polynomial is not stretched over more than this many times the history that it was made from.
LONGEST_STRETCH = 8.0


class Hold:
    """One torque over the present communication step: T(s) = c0 + c1 s + .. + c5 s^5 + K w(s).

    Attributes
    ----------
    slope : float
        K = dT/dw, N.m.s/rad.
    degree : int
        Degree of the polynomial actually used.
    """

    def __init__(self):
        self.slope = 0.0
        self.degree = 0
        self.c0 = 0.0
        self.c1 = 0.0
        self.c2 = 0.0
        self.c3 = 0.0
        self.c4 = 0.0
        self.c5 = 0.0

    def rest(self, s):
        """Polynomial part (N.m) at the time `s` (s) since the communication point."""
        if self.degree == 0:
            return self.c0
        if self.degree == 1:
            return self.c0 + s * self.c1
        return self.c0 + s * (self.c1 + s * (self.c2 + s * (self.c3 + s * (self.c4 + s * self.c5))))

    def line(self, value, rate, slope, speed):
        """Continue by value and rate.

        Parameters
        ----------
        value, rate : float
            Torque (N.m) at the communication point and its time derivative (N.m/s) at constant speed.
        slope, speed : float
            dT/dw (N.m.s/rad) and the shaft speed w (rad/s) at the communication point.
        """
        self.slope = slope
        self.c0 = value - slope * speed
        self.c1 = rate
        self.c2 = 0.0
        self.c3 = 0.0
        self.c4 = 0.0
        self.c5 = 0.0
        self.degree = 0 if rate == 0.0 else 1

    def hermite3(self, step, d, u1, m1):
        """Raise a `line` to the cubic through one earlier point.

        Parameters
        ----------
        step : float
            Length of the coming communication step, s.
        d : float
            Time since the earlier point, s.
        u1, m1 : float
            Rest (N.m) and its total time derivative (N.m/s) there.

        Returns
        -------
        bool
            False where the step is too long for the history; the polynomial is then left as it was.
        """
        if step > LONGEST_STRETCH * d:
            return False
        u = self.c0
        m = self.c1
        q = (u - u1) / d
        f2 = (m - q) / d
        f3 = (f2 - (q - m1) / d) / d
        self.c2 = f2 + d * f3
        self.c3 = f3
        self.degree = 3
        return True

    def hermite5(self, step, d, u1, m1, d2, u2, m2):
        """Raise a `line` to the quintic through two earlier points.

        Parameters as in `hermite3`; `d2` is the time from the second earlier point to the first.
        Newton's divided differences over the double nodes 0, -d, -(d + d2).
        """
        if step > LONGEST_STRETCH * d or step > LONGEST_STRETCH * d2:
            return False
        e = d + d2
        u = self.c0
        m = self.c1
        q01 = (u - u1) / d
        q12 = (u1 - u2) / d2
        a001 = (m - q01) / d
        a011 = (q01 - m1) / d
        a112 = (m1 - q12) / d2
        a122 = (q12 - m2) / d2
        b0011 = (a001 - a011) / d
        b0112 = (a011 - a112) / e
        b1122 = (a112 - a122) / d2
        d00112 = (b0011 - b0112) / e
        d01122 = (b0112 - b1122) / e
        f5 = (d00112 - d01122) / e
        f4 = d00112
        f3 = b0011
        self.c2 = a001 + d * f3 + d * d * (f4 + e * f5)
        self.c3 = f3 + 2.0 * d * f4 + (d * d + 2.0 * d * e) * f5
        self.c4 = f4 + (2.0 * d + e) * f5
        self.c5 = f5
        self.degree = 5
        return True
