"""Motion of a shaft end during a communication step, for the models' own states."""

from __future__ import annotations

from collections.abc import Callable

from cardan.models.base import Shaft

Motion = Callable[[float], Shaft]


def held(start: Shaft) -> Motion:
    """Return the motion that keeps the speed of the step's start.

    Parameters
    ----------
    start : Shaft
        Motion at the start of the step.

    Returns
    -------
    callable
        Time since the start, s -> Shaft.
    """
    angle, speed, acceleration = start

    def motion(s: float) -> Shaft:
        return Shaft(angle + speed * s, speed, acceleration)

    return motion


def interpolated(start: Shaft, end: Shaft, h: float) -> Motion:
    """Return the cubic Hermite interpolant between two communication points.

    The angle follows the cubic through angles and speeds, the speed the cubic through speeds and accelerations
    (error of fourth order in h), the acceleration is the slope of the latter.

    Parameters
    ----------
    start, end : Shaft
        Motion at both ends of the step.
    h : float
        Length of the step, s.

    Returns
    -------
    callable
        Time since the start, s in [0, h] -> Shaft.
    """
    a0, w0, b0 = start
    a1, w1, b1 = end
    # value(s) = v0 + h u (d0 + u (q + u c)) with u = s/h, mean slope m: q = 3 m - 2 d0 - d1, c = d0 + d1 - 2 m
    m = (a1 - a0) / h
    angle_q, angle_c = 3.0 * m - 2.0 * w0 - w1, w0 + w1 - 2.0 * m
    m = (w1 - w0) / h
    speed_q, speed_c = 3.0 * m - 2.0 * b0 - b1, b0 + b1 - 2.0 * m

    def motion(s: float) -> Shaft:
        u = s / h
        return Shaft(
            a0 + s * (w0 + u * (angle_q + u * angle_c)),
            w0 + s * (b0 + u * (speed_q + u * speed_c)),
            b0 + u * (2.0 * speed_q + 3.0 * u * speed_c),
        )

    return motion


def chord(start: Shaft, end: Shaft, h: float) -> Motion:
    """Return the motion whose angle is the cubic through angles and speeds at both ends.

    It needs no accelerations. Speed and acceleration are the cubic's derivatives: the error of the speed has no mean
    over the step, so states that follow it are of fourth order at its end.

    Parameters
    ----------
    start, end : Shaft
        Motion at both ends of the step.
    h : float
        Length of the step, s.

    Returns
    -------
    callable
        Time since the start, s in [0, h] -> Shaft.
    """
    a0, w0, _ = start
    a1, w1, _ = end
    m = (a1 - a0) / h
    q, c = 3.0 * m - 2.0 * w0 - w1, w0 + w1 - 2.0 * m

    def motion(s: float) -> Shaft:
        u = s / h
        return Shaft(a0 + s * (w0 + u * (q + u * c)), w0 + u * (2.0 * q + 3.0 * u * c), (2.0 * q + 6.0 * u * c) / h)

    return motion


def smooth(start: Shaft, end: Shaft, h: float) -> Motion:
    """Return the motion whose angle is the quintic through angles, speeds and accelerations at both ends.

    Speed and acceleration are its derivatives: the error of the speed is of fifth order and has no mean over the
    step.

    Parameters
    ----------
    start, end : Shaft
        Motion at both ends of the step.
    h : float
        Length of the step, s.

    Returns
    -------
    callable
        Time since the start, s in [0, h] -> Shaft.
    """
    a0, w0, b0 = start
    a1, w1, b1 = end
    # in u = s/h: a0 + h w0 u + h^2 b0/2 u^2 + c3 u^3 + c4 u^4 + c5 u^5
    c1, c2 = h * w0, 0.5 * h * h * b0
    rest, slope, bend = (a1 - a0) - c1 - c2, h * w1 - c1 - 2.0 * c2, h * h * b1 - 2.0 * c2
    c3 = 10.0 * rest - 4.0 * slope + 0.5 * bend
    c4 = -15.0 * rest + 7.0 * slope - bend
    c5 = 6.0 * rest - 3.0 * slope + 0.5 * bend

    def motion(s: float) -> Shaft:
        u = s / h
        return Shaft(
            a0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * c5)))),
            (c1 + u * (2.0 * c2 + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)))) / h,
            (2.0 * c2 + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))) / (h * h),
        )

    return motion
