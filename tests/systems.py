"""Exact cases: closed-form solutions that any part of the project can be tested against.

Every function computes in 40-digit mpmath from the binary values of its float arguments, so its own error is
nil next to a double's; ``float(...)`` the result to compare. Signs and symbols are those of docs/PHYSICS.md.
Trajectories without a closed form are in ``tests/reference``.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import mpmath

Real = Any
"""A float on entry, an mpmath number on return."""

exact = mpmath.MPContext()
exact.dps = 40


# -- one joint, docs/PHYSICS.md section 2 ----------------------------------------------------------------------


def joint_difference(p: Real, beta: Real) -> Real:
    """Return phi_out - phi_in in rad: bounded, so it compares without loss after any number of turns."""
    p, c = exact.mpf(p), exact.cos(beta)
    sp, cp = exact.sin(p), exact.cos(p)
    return exact.atan2((1 - c) * sp * cp, c * cp**2 + sp**2)


def joint_output(p: Real, beta: Real) -> Real:
    """Return phi_out in rad, continuous over any number of turns."""
    return exact.mpf(p) + joint_difference(p, beta)


def joint_ratio(p: Real, beta: Real) -> Real:
    """Return r = d phi_out / d phi_in."""
    return exact.cos(beta) / _denominator(p, beta)


def joint_ratio_slope(p: Real, beta: Real) -> Real:
    """Return r' = dr/dp in 1/rad."""
    s2 = exact.sin(beta) ** 2
    return -exact.cos(beta) * s2 * exact.sin(2 * exact.mpf(p)) / _denominator(p, beta) ** 2


def joint_swing(p: Real, beta: Real) -> Real:
    """Return g = d phi_out / d beta."""
    return exact.sin(beta) * exact.sin(p) * exact.cos(p) / _denominator(p, beta)


def trunnion_rates(p: Real, beta: Real, w: Real) -> tuple[Real, Real]:
    """Return the relative rates of the cross about the input and the output trunnion in rad/s (beta at rest)."""
    s = exact.sin(beta)
    return (w * joint_ratio(p, beta) * s * exact.cos(p), w * s * exact.sin(p) / exact.sqrt(_denominator(p, beta)))


def cross_inertia(p: Real, beta: Real, inertia_a: Real, inertia_b: Real, inertia_m: Real) -> Real:
    """Return Jc(p) in kg.m2: the cross's kinetic energy is 1/2 Jc w_in^2."""
    c, s = exact.cos(beta), exact.sin(beta)
    d = _denominator(p, beta)
    on_a = exact.mpf(inertia_a) * (s * c * exact.cos(p)) ** 2
    return (on_a + (exact.mpf(inertia_b) * (s * exact.sin(p)) ** 2 + exact.mpf(inertia_m) * c**2) * d) / d**2


def secondary_couples(p: Real, beta: Real, torque_in: Real, torque_out: Real) -> tuple[Real, Real]:
    """Return the bending couples in N.m on the input shaft (along e1 x a) and the output shaft (along e2 x b)."""
    tangent = exact.tan(beta)
    return torque_in * tangent * exact.sin(p), torque_out * tangent * exact.cos(joint_output(p, beta))


def _denominator(p: Real, beta: Real) -> Real:
    return 1 - (exact.sin(beta) * exact.cos(p)) ** 2


# -- two joints, sections 1 and 4 ------------------------------------------------------------------------------


class Pair(NamedTuple):
    """A rigid double joint at one input angle; rad and 1."""

    shaft: Real          # angle of the intermediate shaft, phi_out of joint 1
    output: Real         # phi_out,2 - 90 deg - (psi - theta), which is FMI.md's output.angle
    ratio: Real          # w_out / w_in


def pair(p: Real, beta1: Real, beta2: Real, psi: Real, theta: Real) -> Pair:
    """Return the kinematics of a double joint with yoke phase `psi` and plane twist `theta`, all angles in rad."""
    delta = exact.mpf(psi) - exact.mpf(theta) + exact.pi / 2
    shaft = joint_output(p, beta1)
    ratio = joint_ratio(p, beta1) * joint_ratio(shaft + delta, beta2)
    return Pair(shaft, joint_output(shaft + delta, beta2) - delta, ratio)


class Layout(NamedTuple):
    """Uniformity of a double joint over a turn."""

    kappa: Real                # largest overall ratio; the smallest is 1 / kappa
    nonuniformity: Real        # U = kappa - 1/kappa
    equivalent_angle: Real     # angle in rad of the one joint that behaves alike


def layout(beta1: Real, beta2: Real, psi: Real, theta: Real) -> Layout:
    """Return kappa, U and beta_eq of docs/PHYSICS.md section 4."""
    c1, c2 = exact.cos(beta1), exact.cos(beta2)
    delta = exact.mpf(psi) - exact.mpf(theta)
    total = ((c1**2 + c2**2) * exact.cos(delta) ** 2 + (1 + (c1 * c2) ** 2) * exact.sin(delta) ** 2) / (c1 * c2)
    # kappa + 1/kappa = total; the root of the difference total - 2 >= 0 may come out -1e-41 for a homokinetic pair.
    difference = exact.sqrt(max(total - 2, exact.mpf(0)) * (total + 2))
    kappa = (total + difference) / 2
    return Layout(kappa, difference, exact.acos(1 / kappa))


# -- rigid dynamics --------------------------------------------------------------------------------------------


def rigid_inertia(p: Real, beta: Real, j1: Real, j2: Real) -> Real:
    """Return M = J1 + J2 r^2 in kg.m2, both inertias in kg.m2: one rigid joint reduced to its input shaft."""
    return exact.mpf(j1) + exact.mpf(j2) * joint_ratio(p, beta) ** 2


def free_rotation(p: Real, p0: Real, w0: Real, beta: Real, j1: Real, j2: Real) -> Real:
    """Return the input speed w0 sqrt(M0/M) in rad/s of the torque-free rigid joint that passed `p0` at `w0`."""
    return w0 * exact.sqrt(rigid_inertia(p0, beta, j1, j2) / rigid_inertia(p, beta, j1, j2))


def free_rotation_time(p: Real, p0: Real, w0: Real, beta: Real, j1: Real, j2: Real) -> Real:
    """Return the time in s that the torque-free rigid joint takes from `p0` to `p` rad (quadrature of 1/w)."""
    whole = int(exact.floor((exact.mpf(p) - p0) / exact.pi))        # 1/w has period pi

    def slowness(q: Real) -> Real:
        return 1 / free_rotation(q, p0, w0, beta, j1, j2)

    def integral(a: Real, b: Real) -> Real:
        return exact.quad(slowness, exact.linspace(a, b, 9))

    start = exact.mpf(p0)
    rest = integral(start, exact.mpf(p) - whole * exact.pi)
    return rest + (whole * integral(start, start + exact.pi) if whole else 0)


def kinetic_energy(p: Real, w: Real, beta: Real, j1: Real, j2: Real) -> Real:
    """Return 1/2 M w^2 in J of one rigid joint turning at input speed `w` in rad/s."""
    return rigid_inertia(p, beta, j1, j2) * exact.mpf(w) ** 2 / 2


# -- the plain torsional shaft: all joint angles zero ----------------------------------------------------------


class Torsion(NamedTuple):
    """State of two inertias on a spring; rad, rad/s, N.m."""

    input_angle: Real
    input_speed: Real
    twist: Real
    twist_rate: Real
    output_angle: Real
    output_speed: Real
    shaft_torque: Real


def torsional_shaft(t: Real, j_in: Real, j_out: Real, k: Real, d: Real, start: tuple[Real, Real, Real, Real],
                    torque_in: tuple[Real, Real] = (0.0, 0.0), torque_out: tuple[Real, Real] = (0.0, 0.0)) -> Torsion:
    """Return the exact state at time `t` of J_in - (k, d) - J_out.

    The centre of inertia moves under the sum of the torques; the twist obeys
    ``x'' + d/J x' + k/J x = T_in/J_in + T_out/J_out`` with ``1/J = 1/J_in + 1/J_out``, damped at any rate but the
    critical one. In FMI.md's names J_in = input.inertia + shaft.inertia_a, J_out = shaft.inertia_b + output.inertia.

    Parameters
    ----------
    t : float
        Time in s.
    j_in, j_out : float
        Inertias in kg.m2.
    k, d : float
        Stiffness in N.m/rad, damping in N.m.s/rad.
    start : tuple
        Input angle in rad, input speed in rad/s, twist in rad, twist rate in rad/s at time 0.
    torque_in, torque_out : tuple
        Value in N.m and rate in N.m/s of the engine's torque, and of the load's torque (which resists).
    """
    t, a, b = exact.mpf(t), exact.mpf(j_in), exact.mpf(j_out)
    angle, speed, twist, twist_rate = (exact.mpf(x) for x in start)
    t0, t1, l0, l1 = (exact.mpf(x) for x in (*torque_in, *torque_out))
    half = exact.mpf(d) * (1 / a + 1 / b) / 2
    square = exact.mpf(k) * (1 / a + 1 / b)
    # Particular solution x = still + drift t, then a damped oscillation from the rest of the start values.
    drift = (t1 / a + l1 / b) / square
    still = (t0 / a + l0 / b - 2 * half * drift) / square
    root = exact.sqrt(square - half**2 + 0j)                        # imaginary beyond critical damping
    x0, v0 = twist - still, twist_rate - drift
    decay, cos, sine = exact.exp(-half * t), exact.cos(root * t), exact.sin(root * t) / root
    x = still + drift * t + (decay * (x0 * cos + (v0 + half * x0) * sine)).real
    v = drift + (decay * (v0 * cos - (square * x0 + half * v0) * sine)).real
    # phi and y from the centre of inertia and the twist.
    share = b / (a + b)
    centre = angle - share * twist + (speed - share * twist_rate) * t
    centre_speed = speed - share * twist_rate + ((t0 - l0) * t + (t1 - l1) * t**2 / 2) / (a + b)
    centre += ((t0 - l0) * t**2 / 2 + (t1 - l1) * t**3 / 6) / (a + b)
    return Torsion(centre + share * x, centre_speed + share * v, x, v, centre + (share - 1) * x,
                   centre_speed + (share - 1) * v, exact.mpf(k) * x + exact.mpf(d) * v)


# -- literature, section 5 -------------------------------------------------------------------------------------


class Fligiel(NamedTuple):
    """One joint at constant input speed with an output inertia; corrected figures of Fligiel's table 3."""

    speed_low: Real          # rad/s
    speed_high: Real
    acceleration: Real       # largest output acceleration in rad/s2
    angle: Real              # rad, phi_in where it occurs; there w2' is negative, at -phi_in positive
    inertia_torque: Real     # largest J2 w2' in N.m
    impulse: Real            # J2 (w_max - w_min) in N.m.s


def fligiel(beta: Real, w: Real, j2: Real) -> Fligiel:
    """Return the corrected figures at joint angle `beta` in rad, input speed `w` in rad/s, inertia `j2` in kg.m2.

    Where d(r')/dp = 0: s^2 C^2 + (2 - s^2) C - 2 s^2 = 0 for C = cos 2p, with phi_in counted from the null plane.
    """
    c, s2 = exact.cos(beta), exact.sin(beta) ** 2
    cos2 = (-(2 - s2) + exact.sqrt((2 - s2) ** 2 + 8 * s2**2)) / (2 * s2)
    angle = exact.acos(cos2) / 2
    acceleration = abs(joint_ratio_slope(angle, beta)) * exact.mpf(w) ** 2
    low, high = w * c, w / c
    return Fligiel(low, high, acceleration, angle, j2 * acceleration, j2 * (high - low))


# -- parametric stability, section 6, to first order -----------------------------------------------------------


def principal_region(beta: Real) -> tuple[Real, Real]:
    """Return the first-order limits sqrt(cos b), 1/sqrt(cos b) of nu for the homokinetic pair's principal region."""
    root = exact.sqrt(exact.cos(beta))
    return root, 1 / root


def critical_damping(beta: Real) -> Real:
    """Return the first-order critical ground damping ratio sin^2 b / (4 cos b) of the homokinetic pair."""
    return exact.sin(beta) ** 2 / (4 * exact.cos(beta))


def free_free_half_width(beta: Real, j1: Real, j2: Real) -> Real:
    """Return the first-order half width of abs(Omega/w_n - 1) < q J2/(J1 + J2), q = tan^2(b/2)."""
    return exact.tan(exact.mpf(beta) / 2) ** 2 * j2 / (exact.mpf(j1) + j2)
