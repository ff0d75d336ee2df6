"""What the project promises, beside what was measured."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from cardan.bench.records import Record, Tables

ORDER_WITHIN = 0.2
AUTO_WITHIN = 10.0


class Target(NamedTuple):
    """A promise.

    Attributes
    ----------
    what : str
        What is promised.
    wanted, measured : str
        Figure that is promised and figure that was measured, as text.
    met : bool or None
        None where it was not measured.
    """

    what: str
    wanted: str
    measured: str
    met: bool | None


def targets(tables: Tables) -> list[Target]:
    """Return the promises that the tables at hand say something about."""
    return [*_peers(tables), *_stepping(tables), *_coupled(tables), *_orders(tables), *_auto(tables)]


def _find(tables: Tables, table: str, column: str, value: str) -> Record | None:
    return next((record for record in tables.get(table, []) if record[column] == value), None)


def _at_least(what: str, wanted: float, measured: float) -> Target:
    return Target(what, f"at least {wanted:g} times", f"{measured:.3g} times", measured >= wanted)


def _peers(tables: Tables) -> Iterator[Target]:
    solvers = [record for record in tables.get("peers", []) if record["method"].startswith("scipy solve_ivp")]
    for key, what, wanted in (("fmu_1ms", "FMU stepped at 1 ms", 10.0), ("fmu_10ms", "FMU stepped at 10 ms", 40.0),
                              ("kernel", "kernel alone", 100.0)):
        ratios = [record[f"times_{key}"] for record in solvers if f"times_{key}" in record]
        if ratios:
            yield _at_least(f"{what}, faster than the best `solve_ivp` at 1e-6", wanted, min(ratios))


def _stepping(tables: Tables) -> Iterator[Target]:
    from cardan.bench.stepping import OURS, SHARE, STATES

    ours, share = _find(tables, "stepping", "what", OURS), _find(tables, "stepping", "what", SHARE)
    if ours is not None and share is not None:
        yield Target("FMU stepped at 1 ms over an empty pythonfmu FMU (set 2, step, get 5)", "at most 1.25 times",
                     f"{ours['ratio']:.3g} times, {100.0 * share['us'] / ours['us']:.0f} % of it in the kernel",
                     ours["ratio"] <= 1.25)
    states = _find(tables, "stepping", "what", STATES)
    if states is not None:
        yield Target("state saved, restored and freed", "at most 4 us", f"{states['us']:.3g} us", states["us"] <= 4.0)
    in_c = _find(tables, "stepping", "what", f"{OURS}, in a C host")
    if in_c is not None:
        known = in_c["us"] is not None
        yield Target("one 1 ms step from a C host", "at most 4.5 us",
                     f"{in_c['us']:.3g} us" if known else f"not measured: {in_c['remark']}",
                     in_c["us"] <= 4.5 if known else None)


def _coupled(tables: Tables) -> Iterator[Target]:
    from cardan.bench.peers_own import BASES

    record = _find(tables, "coupled_peers", "method", BASES["coupled"])
    if record is not None:
        yield Target("ripple scene, engine and load outside the FMU, to 1e-6", "at most 20 ms per simulated s",
                     f"{record['ms_per_s']:.3g} ms", record["ms_per_s"] <= 20.0)


def _orders(tables: Tables) -> Iterator[Target]:
    for record in tables.get("orders", []):
        if record["case"] == "smooth":
            fitted = record["fitted"]
            yield Target(f"order of `{record['scheme']}`, smooth case", f"{record['order']} within {ORDER_WITHIN}",
                         "not fitted" if fitted is None else f"{fitted:.2f}",
                         None if fitted is None else abs(fitted - record["order"]) <= ORDER_WITHIN)


def _auto(tables: Tables) -> Iterator[Target]:
    ratios = [record["over_tolerance"] for record in tables.get("auto", [])]
    if ratios:
        yield Target("error of `auto` over its tolerance, worst of all shipped scenes, tolerances and quantities",
                     f"at most {AUTO_WITHIN:g} times", f"{max(ratios):.2g} times", max(ratios) <= AUTO_WITHIN)
