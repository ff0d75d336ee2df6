"""What a hard case reports, and the list of all of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from cardan_kernel import Driveline


@dataclass(frozen=True)
class Outcome:
    """Figure of a property that must hold.

    Attributes
    ----------
    measured : float
        The figure.
    bound : float
        It must not be larger than this.
    unit : str
        Unit of both, ``"1"`` for a relative figure.
    detail : str
        What the figure is.
    """

    measured: float
    bound: float
    unit: str
    detail: str

    @property
    def held(self) -> bool:
        """Whether the property holds; NaN never does."""
        return self.measured <= self.bound


@dataclass(frozen=True)
class HardCase:
    """A numbered case: what happens in it, and the function that measures it."""

    number: int
    title: str
    measure: Callable[[], Iterator[Outcome]]


CASES: dict[int, HardCase] = {}


def hard_case(number: int, title: str) -> Callable[[Callable[[], Iterator[Outcome]]], Callable[[], Iterator[Outcome]]]:
    """Enter a function, which yields outcomes, as the hard case `number`."""

    def enter(measure: Callable[[], Iterator[Outcome]]) -> Callable[[], Iterator[Outcome]]:
        CASES[number] = HardCase(number, title, measure)
        return measure

    return enter


class Refused(RuntimeError):
    """The driveline refused a step or a value; the text is its own."""


def start(values: dict[str, float], tolerance: float = 1e-9) -> Driveline:
    """A driveline with `values` by variable name, initialized.

    Raises
    ------
    Refused
        If the values are not taken.
    """
    driveline = Driveline()
    driveline.setup_experiment(0.0, None, tolerance)
    driveline.enter_initialization_mode()
    for name, value in values.items():
        driveline.set(name, value)
    driveline.exit_initialization_mode()
    if driveline.last_error:
        raise Refused(driveline.last_error)
    return driveline


def step(driveline: Driveline, t: float, h: float) -> None:
    """One communication step.

    Raises
    ------
    Refused
        If it is refused.
    """
    if not driveline.do_step(t, h):
        raise Refused(driveline.last_error)
