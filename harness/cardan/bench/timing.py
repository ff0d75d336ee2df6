"""Processor times that can be compared: interleaved repeats, medians with their spread."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple


class Figure(NamedTuple):
    """A median with the quartiles below and above it."""

    median: float
    low: float
    high: float

    def __mul__(self, factor: float) -> Figure:  # type: ignore[override]
        """Return it in another unit."""
        return Figure(self.median * factor, self.low * factor, self.high * factor)


Job = Callable[[], float]
Samples = dict[str, list[float]]


def figure(samples: Sequence[float]) -> Figure:
    """Return median and quartiles of samples; with less than four of them the extremes stand for the quartiles."""
    ordered = sorted(samples)
    if len(ordered) < 4:
        return Figure(statistics.median(ordered), ordered[0], ordered[-1])
    low, middle, high = statistics.quantiles(ordered, n=4, method="inclusive")
    return Figure(middle, low, high)


def clocked(work: Callable[[], object]) -> Job:
    """Return a job that does the work and returns the processor time it took, s."""

    def job() -> float:
        begin = time.process_time()
        work()
        return time.process_time() - begin

    return job


def repeated(job: Job, least: float = 0.02) -> Job:
    """Return a job that does a short job until `least` seconds are spent, and returns the mean.

    A single run of half a millisecond would measure the caches that the job before it has left cold.
    """

    def several() -> float:
        spent, number = 0.0, 0
        while spent < least:
            spent += job()
            number += 1
        return spent / number

    return several


def interleaved(jobs: Mapping[str, Job], repeats: int, tell: Callable[[float], None] | None = None) -> Samples:
    """Run jobs in turns, so that whatever else the machine does meets all of them alike.

    Parameters
    ----------
    jobs : mapping of str to callable
        Each returns the time that it measured, s.
    repeats : int
        Rounds, after one that is not counted.
    tell : callable, optional
        Called after each round with the fraction done, 0 to 1.

    Returns
    -------
    dict of str to list of float
        The times of each job, one per round.
    """
    samples: Samples = {name: [] for name in jobs}
    for number in range(repeats + 1):
        for name, job in jobs.items():
            taken = job()
            if number > 0:
                samples[name].append(taken)
        if tell is not None:
            tell((number + 1) / (repeats + 1))
    return samples


def ratio(samples: Sequence[float], base: Sequence[float]) -> Figure:
    """Return the ratio to another job's samples, formed within each round."""
    return figure([a / b for a, b in zip(samples, base)])
