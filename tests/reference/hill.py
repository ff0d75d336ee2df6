"""Hill determinant of the homokinetic double joint: ``python -m tests.reference.hill``.

Writes ``hill_edges.csv`` (transition curves) and ``hill_growth.csv`` (Floquet exponents); one to two minutes.

docs/PHYSICS.md section 6: two joints of equal angle, W layout, a massless compliant shaft between them, constant input
speed, no load. With p the input angle the perturbation of the output obeys

    y'' + nu^-2 r(p)^2 y = 0,   r = 1 + 2 sum_{n>=1} q^n cos 2np,   q = tan^2(beta/2),

so r^2 = sum_m A_m exp(2imp) with A_m = q^|m| (|m| + (1 + q^2)/(1 - q^2)), by multiplying the series. The ansatz
y = exp(mu p) sum_n c_n exp(i k_n p), with k_n = 2n (even regions) or 2n + 1 (odd regions), gives the system

    (mu + i k_n)^2 c_n + nu^-2 sum_m A_{(k_n - k_m)/2} c_m = 0.

Regions are numbered by nu near 1/region. On their edges mu = 0, and y is a cosine or a sine series.
"""

from __future__ import annotations

from math import radians

import mpmath

from tests.reference.arithmetic import Number
from tests.reference.table import save

ANGLES = (5.0, 15.0, 30.0, 45.0)
REGIONS = (1, 2, 3)
DIGITS = 34
ORDERS = 28
"""Harmonics kept. Coefficients fall like q^n, values converge like q^2n: 0.172^28 = 4e-22 at 45 deg."""

GROWTH_SPEEDS = {5.0: (1.0, 1.001, 0.997), 15.0: (1.0, 0.99, 0.49995, 1.02), 30.0: (1.0, 0.95, 1.04, 0.499),
                 45.0: (1.0, 0.9, 1.1, 0.495, 0.332)}
"""nu at which the growth exponent is tabulated, by joint angle in deg; some lie outside the regions."""


def coefficient(m: int, q: Number) -> Number:
    """Return A_m, the Fourier coefficient of r^2 at exp(2imp)."""
    return q ** abs(m) * (abs(m) + (1 + q * q) / (1 - q * q))


def _ratio_parameter(angle: float) -> Number:
    return mpmath.tan(mpmath.mpf(angle) / 2) ** 2


def series_matrix(region: int, even: bool, q: Number, orders: int) -> tuple[list[int], Number]:
    """Return the harmonics k and the matrix of r^2 on the normed cosine (`even`) or sine series of a region."""
    odd = region % 2
    harmonics = [2 * n + odd for n in range(orders)] if odd or even else [2 * n + 2 for n in range(orders)]
    sign = 1 if even else -1
    matrix = mpmath.matrix(orders)
    for i, k in enumerate(harmonics):
        for j, other in enumerate(harmonics):
            value = coefficient((k - other) // 2, q) + sign * coefficient((k + other) // 2, q)
            halved = (k == 0) + (other == 0)                     # the constant has half the square sum of a cosine
            matrix[i, j] = value / mpmath.sqrt(2) ** halved
    return harmonics, matrix


def transition(angle: float, region: int, even: bool, orders: int = ORDERS) -> Number:
    """Return nu on one edge of a region: where the Hill determinant det(-K^2 + nu^-2 A) of its class vanishes.

    Parameters
    ----------
    angle : float
        Joint angle in rad.
    region : int
        1 for the principal region, 2, 3 for the higher ones.
    even : bool
        Whether the periodic solution is the cosine or the sine series.
    orders : int
        Harmonics kept.
    """
    harmonics, matrix = series_matrix(region, even, _ratio_parameter(angle), orders)
    if harmonics[0] == 0:                                       # the row k = 0 has no K: eliminate its unknown
        first = matrix[0, 0]
        size = orders - 1
        reduced = mpmath.matrix(size)
        for i in range(size):
            for j in range(size):
                reduced[i, j] = matrix[i + 1, j + 1] - matrix[i + 1, 0] * matrix[0, j + 1] / first
        harmonics, matrix = harmonics[1:], reduced
    size = len(harmonics)
    scaled = mpmath.matrix(size)
    for i in range(size):
        for j in range(size):
            scaled[i, j] = matrix[i, j] / (harmonics[i] * harmonics[j])
    # det(-K^2 + nu^-2 A) = 0 where nu^2 is an eigenvalue of A/(k l). They fall like 1/region^2, one a region and class.
    squares = sorted(mpmath.eigsy(scaled, eigvals_only=True), reverse=True)
    return mpmath.sqrt(squares[(region - 1) // 2])


def growth(angle: float, nu: Number, orders: int = ORDERS) -> Number:
    """Return the real Floquet exponent mu per rad of input angle at `nu`, zero where the motion is bounded.

    mu is the root of the determinant det((mu + i k)^2 + nu^-2 A) over both signs of k, sought between zero
    and twice the first-order width; a turn multiplies the perturbation by exp(2 pi mu), a second by exp(Omega mu).
    """
    nu = mpmath.mpf(nu)
    region = max(1, int(mpmath.nint(1 / nu)))
    edges = sorted(transition(angle, region, even, orders) for even in (True, False))
    if not edges[0] < nu < edges[1]:
        return mpmath.mpf(0)
    q = _ratio_parameter(angle)
    ks = [2 * n + region % 2 for n in range(-orders // 2, orders // 2 + (1 - region % 2))]

    def determinant(mu: Number) -> Number:
        matrix = mpmath.matrix(len(ks))
        for i, k in enumerate(ks):
            for j, other in enumerate(ks):
                matrix[i, j] = coefficient((k - other) // 2, q) / nu**2 / max(1, k * k)
            matrix[i, i] += mpmath.mpc(mu, k) ** 2 / max(1, k * k)
        return mpmath.det(matrix).real

    # Real and even on the real axis, with no other root than +-mu: one change of sign.
    width = (edges[1] - edges[0]) / nu
    return mpmath.findroot(determinant, (mpmath.mpf(0), 2 * width * region), solver="anderson",
                           tol=mpmath.mpf(10) ** (-DIGITS + 4), maxsteps=100)


def main() -> None:
    """Write the tables of transition curves and growth exponents."""
    edges, rates = [], []
    worst = [mpmath.mpf(0), mpmath.mpf(0)]
    with mpmath.workdps(DIGITS):
        for degrees in ANGLES:
            angle = radians(degrees)
            for region in REGIONS:
                fine, coarse = ([transition(angle, region, even, orders) for even in (True, False)]
                                for orders in (ORDERS, ORDERS - 6))
                worst[0] = max(worst[0], *(abs(a - b) for a, b in zip(fine, coarse, strict=True)))
                edges.append([repr(angle), str(region), *(mpmath.nstr(nu, 20) for nu in sorted(fine))])
            for speed in GROWTH_SPEEDS[degrees]:
                mu, other = (growth(angle, mpmath.mpf(speed), orders) for orders in (ORDERS, ORDERS - 6))
                worst[1] = max(worst[1], abs(mu - other))
                rates.append([repr(angle), repr(speed), mpmath.nstr(mu, 20)])
    for name, title, heads, rows, difference in (
            ("hill_edges", "transition curves",
             ["angle [rad]", "region [1]", "nu_low [1]", "nu_high [1]"], edges, worst[0]),
            ("hill_growth", "real Floquet exponents per rad of input angle (0: bounded)",
             ["angle [rad]", "nu [1]", "growth [1/rad]"], rates, worst[1])):
        save(name, [
            f"homokinetic double joint, y'' + nu^-2 r(p)^2 y = 0: {title}",
            "command: python -m tests.reference.hill",
            f"method: Hill determinant, {ORDERS} harmonics, {DIGITS} digits; {ORDERS - 6} harmonics differ by at most "
            f"{mpmath.nstr(difference, 1)}",
        ], heads, rows)


if __name__ == "__main__":
    main()
