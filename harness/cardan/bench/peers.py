"""Who else solves the same system to the same error in the same run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np

from cardan.bench.monolithic import Array, Monolith, speed_error
from cardan.bench.records import Options, Record, Tables, Tell
from cardan.bench.systems import RIPPLE, ordinary
from cardan.bench.timing import Samples, figure, interleaved, ratio, repeated

GOAL = 1e-6
POINTS = np.linspace(0.0, 1.0, 101)  # s, where the speeds are delivered; 1 ms points cost the peers more
TOLERANCES = tuple(float(f"{10.0 ** (-0.5 * number):.3g}") for number in range(6, 25))  # 1e-3 .. 1e-12


class Solution(NamedTuple):
    """What a solver delivers.

    Attributes
    ----------
    points : array, shape (n,)
        Times of the speeds, s.
    speeds : array, shape (2, n)
        Input and output speed, rad/s.
    seconds : float
        Processor time that it took.
    evaluations : float or None
        Right-hand sides; None where nobody counts them.
    """

    points: Array
    speeds: Array
    seconds: float
    evaluations: float | None


@dataclass(frozen=True)
class Peer:
    """A way to solve the system.

    Attributes
    ----------
    name : str
        What it is called in the table.
    solve : callable
        Setting -> `Solution`.
    settings : tuple of float
        From loose to tight: tolerances, or communication steps per second.
    """

    name: str
    solve: Callable[[float], Solution]
    settings: tuple[float, ...] = TOLERANCES


class Tuned(NamedTuple):
    """A peer with the loosest setting at which it reaches the goal."""

    peer: Peer
    setting: float
    error: float
    evaluations: float | None


def tune(peer: Peer, reference: Callable[[Array], Array]) -> Tuned:
    """Find the loosest setting that reaches the goal.

    Raises
    ------
    ValueError
        If none does.
    """
    for setting in peer.settings:
        solution = peer.solve(setting)
        error = speed_error(solution.speeds, reference(solution.points))
        if error <= GOAL:
            return Tuned(peer, setting, error, solution.evaluations)
    raise ValueError(f"{peer.name} does not reach an error of {GOAL:g}")


def measure(options: Options, tell: Tell) -> Tables:
    """Return the tables ``peers`` (the ordinary driveline) and ``coupled_peers`` (engine and load outside the FMU)."""
    from cardan_build import default_fmu

    from cardan.bench.coupled_run import Study
    from cardan.bench.peers_own import coupled_peer, fmu_peers, kernel_peers
    from cardan.bench.peers_python import control_peer, scipy_peers
    from cardan.instance import Instance

    with Instance(default_fmu()) as instance:
        system = ordinary()
        first = [*kernel_peers(), *fmu_peers(instance), *scipy_peers(system), control_peer(system)]
        alone = _compared(first, system, options, lambda done: tell(0.5 * done))
        study = Study(instance, RIPPLE)
        system = RIPPLE.monolith()
        second = [coupled_peer(study), *scipy_peers(system), control_peer(system)]
        coupled = _compared(second, system, options, lambda done: tell(0.5 + 0.5 * done))
    return {"peers": alone, "coupled_peers": coupled}


def _compared(peers: list[Peer], system: Monolith, options: Options, tell: Tell) -> list[Record]:
    tuned = []
    known: dict[int, Array] = {}

    def reference(points: Array) -> Array:
        if len(points) not in known:
            known[len(points)] = system.reference(points)
        return known[len(points)]

    for number, peer in enumerate(peers):
        tuned.append(tune(peer, reference))
        tell(0.5 * (number + 1) / len(peers))
    jobs = {one.peer.name: repeated(partial(_seconds, one)) for one in tuned}
    samples = interleaved(jobs, 3 if options.quick else 5, lambda done: tell(0.5 + 0.5 * done))
    span = float(POINTS[-1])
    records: list[Record] = []
    for one in tuned:
        name = one.peer.name
        time = figure(samples[name]) * (1e3 / span)
        records.append({"method": name, "error": one.error, "setting": one.setting, "evaluations": one.evaluations,
                        "ms_per_s": time.median, "low": time.low, "high": time.high,
                        **{f"times_{key}": _against(samples, name, base) for key, base in _bases(peers).items()}})
    return records


def _seconds(one: Tuned) -> float:
    return one.peer.solve(one.setting).seconds


def _bases(peers: list[Peer]) -> dict[str, str]:
    """Return short names of the ways of this project: what the peers are compared with."""
    from cardan.bench.peers_own import BASES

    known = [peer.name for peer in peers]
    return {key: name for key, name in BASES.items() if name in known}


def _against(samples: Samples, name: str, base: str) -> float:
    return ratio(samples[name], samples[base]).median
