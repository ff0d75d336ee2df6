"""scipy and python-control on the system as one set of equations."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np

from cardan.bench.monolithic import SIZES, Array, Monolith
from cardan.bench.peers import POINTS, Peer, Solution

Run = Callable[[float], tuple[Array, float | None]]  # relative tolerance -> states, shape (4, n), right-hand sides


def _peer(name: str, system: Monolith, run: Run) -> Peer:
    def solve(setting: float) -> Solution:
        begin = time.process_time()
        states, evaluations = run(setting)
        return Solution(POINTS, system.speeds(states), time.process_time() - begin, evaluations)

    return Peer(name, solve)


def scipy_peers(system: Monolith) -> list[Peer]:
    """Return `solve_ivp` with its three methods that suit, and scipy's two older, compiled loops.

    Absolute tolerances are the relative one times the size of each state, as whoever knows the system chooses them.
    """
    from scipy.integrate import ode, odeint, solve_ivp

    rates, start, end = system.right_hand_side(), system.start(), float(POINTS[-1])

    def by(method: str) -> Run:
        def run(rtol: float) -> tuple[Array, float | None]:
            solution = solve_ivp(rates, (0.0, end), start, method=method, t_eval=POINTS, rtol=rtol, atol=rtol * SIZES)
            return solution.y, float(solution.nfev)

        return run

    def odeint_run(rtol: float) -> tuple[Array, float | None]:
        states, said = odeint(rates, start, POINTS, rtol=rtol, atol=rtol * SIZES, tfirst=True, mxstep=100000,
                              full_output=True)
        return np.asarray(states).T, float(said["nfe"][-1])

    def ode_run(rtol: float) -> tuple[Array, float | None]:
        # This one takes no array; the twist is what needs the smallest.
        solver: Any = ode(rates).set_integrator("dop853", rtol=rtol, atol=rtol * float(SIZES.min()), nsteps=100000)
        solver.set_initial_value(start, 0.0)
        return np.array([start, *(solver.integrate(t) for t in POINTS[1:])]).T, None

    methods = [_peer(f"scipy solve_ivp {method}", system, by(method)) for method in ("LSODA", "DOP853", "Radau")]
    return [*methods, _peer("scipy odeint (LSODA)", system, odeint_run), _peer("scipy ode (dop853)", system, ode_run)]


def control_peer(system: Monolith) -> Peer:
    """Return python-control's `input_output_response`, with the method of `solve_ivp` that is fastest here."""
    import control

    rates, start = system.right_hand_side(), system.start()
    plant = control.nlsys(lambda t, x, u, params: rates(t, x), None, states=4, inputs=1, outputs=4)

    def run(rtol: float) -> tuple[Array, float | None]:
        response = control.input_output_response(
            plant, POINTS, 0.0, start, solve_ivp_kwargs={"method": "DOP853", "rtol": rtol, "atol": rtol * SIZES})
        return np.asarray(response.states), None

    return _peer("python-control input_output_response", system, run)
