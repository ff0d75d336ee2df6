"""Markdown of the measured tables: those of the README, and the report of one run."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from cardan.bench.records import Record, Tables, told
from cardan.bench.sections import Measured
from cardan.bench.targets import targets

Cells = Iterable[str]


def markdown(heads: Cells, rows: Iterable[Cells]) -> str:
    """Return a Markdown table."""
    lines = ["| " + " | ".join(heads) + " |"]
    lines.append("|" + "---|" * (lines[0].count("|") - 1))
    lines += ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def number(value: float | None, digits: int = 2) -> str:
    """Return a figure with few digits, without an exponent where that is readable."""
    if value is None or not math.isfinite(value):
        return "-"
    if value == 0.0:
        return "0"
    if 0.01 <= abs(value) < 1e5:
        text = f"{value:#.{digits}g}"
        return f"{float(text):.0f}" if "e" in text else text.removesuffix(".")
    mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
    return f"{mantissa}e{int(exponent)}"


def power(tolerance: float) -> str:
    """Return a tolerance as a power of ten."""
    return f"1e{round(math.log10(tolerance))}"


def machine(measured: Measured) -> str:
    """Return the line that says where the figures were measured."""
    by = measured.made_by
    return (f"{by['processor']}, {by['cores']} cores, {by['system']}, Python {by['python']}, {by['kernel']} kernel, "
            f"scipy {by['scipy']}, python-control {by['control']}; {by['time'][:10]}. Times are processor times, "
            f"medians of interleaved repeats.")


def targets_table(tables: Tables) -> str:
    """What is promised and what was measured."""
    verdict = {True: "met", False: "not met", None: "-"}
    return markdown(("target", "wanted", "measured", ""),
                    ((target.what, target.wanted, target.measured, verdict[target.met]) for target in targets(tables)))


def integrator_table(tables: Tables) -> str:
    """Error and right-hand sides per tolerance, one row per case."""
    records = tables["integrator"]
    tolerances = sorted({record["tolerance"] for record in records}, reverse=True)
    shown = [tolerance for tolerance in tolerances if tolerance in (1e-3, 1e-6, 1e-9, 1e-12)] or tolerances
    rows = []
    for case, title in dict.fromkeys((record["case"], record["title"]) for record in records):
        found = {record["tolerance"]: record for record in records if record["case"] == case}
        rows.append((f"{case}: {title}", *(f"{_told(found[t])} ({number(found[t]['rhs_per_ms'], 3)}, "
                                           f"{number(found[t]['ms_per_s'])})" for t in shown)))
    return markdown(("case", *(f"tolerance {power(t)}" for t in shown)), rows)


def _told(record: Record) -> str:
    """Return an error, or that it lies below what the reference can tell."""
    return number(record["error"]) if told(record) else f"< {number(2.0 * max(record['floor'], record['error']))}"


def orders_table(tables: Tables) -> str:
    """Order of each scheme as stated and as fitted, and the longest step at which it is stable on the steep load."""
    records = tables["orders"]
    cases = list(dict.fromkeys(record["case"] for record in records))
    rows = []
    for scheme, found in _by_scheme(tables):
        rows.append((f"`{scheme}`", str(found[cases[0]]["order"]),
                     *(number(found[case]["fitted"], 3) for case in cases), _longest(tables, scheme)))
    return markdown(("scheme", "order", *(f"fitted, {case}" for case in cases), "longest stable step, steep"), rows)


def effort_table(tables: Tables) -> str:
    """Communication step and processor time for an error of 1e-6."""
    cases = list(dict.fromkeys(record["case"] for record in tables["orders"]))
    rows = ((f"`{scheme}`", *(_effort(found[case]) for case in cases)) for scheme, found in _by_scheme(tables))
    return markdown(("for 1e-6", *(f"{case}: step, time" for case in cases)), rows)


def _by_scheme(tables: Tables) -> list[tuple[str, dict[str, Record]]]:
    found: dict[str, dict[str, Record]] = {}
    for record in tables["orders"]:
        found.setdefault(record["scheme"], {})[record["case"]] = record
    return list(found.items())


def _effort(record: Record) -> str:
    if record["step_ms"] is None:
        return "-"
    about = "" if record["measured"] else "about "
    return f"{about}{number(record['step_ms'])} ms, {number(record['ms_per_s'])} ms per s"


def _longest(tables: Tables, scheme: str) -> str:
    """Return the longest measured step of the steep case whose run stays within a tenth of the reference."""
    rows = [record for record in tables["coupling"] if record["case"] == "steep" and record["scheme"] == scheme]
    good = [record["step_ms"] for record in rows if record["error"] is not None and record["error"] < 0.1]
    return f"{number(max(good))} ms" if good else "-"


def controlled_table(tables: Tables) -> str:
    """Adaptive steps: error and time per tolerance."""
    records = [record for record in tables["controlled"] if record["scheme"] == "auto"]
    cases = list(dict.fromkeys(record["case"] for record in records))
    rows = []
    for tolerance in sorted({record["tolerance"] for record in records}, reverse=True):
        found = {record["case"]: record for record in records if record["tolerance"] == tolerance}
        rows.append((power(tolerance), *(f"{number(found[case]['error'])}, {number(found[case]['ms_per_s'])} ms/s"
                                             for case in cases)))
    return markdown(("tolerance of `auto`", *(f"speed error, time, {case}" for case in cases)), rows)


def auto_table(tables: Tables) -> str:
    """Error of ``auto`` over its tolerance on the shipped scenes."""
    records = tables["auto"]
    tolerances = sorted({record["tolerance"] for record in records}, reverse=True)
    rows = []
    for scene in dict.fromkeys(record["scene"] for record in records):
        found = {record["tolerance"]: record for record in records if record["scene"] == scene}
        rows.append((f"`{scene}`", *(number(found[t]["over_tolerance"]) for t in tolerances)))
    return markdown(("scene", *(f"error / tolerance at {power(t)}" for t in tolerances)), rows)


def peers_table(tables: Tables, name: str = "peers") -> str:
    """Who needs how long for the same error."""
    records = tables[name]
    keys = [key for key in records[0] if key.startswith("times_")]
    heads = {"times_kernel": "times the kernel", "times_fmu_10ms": "times the FMU at 10 ms",
             "times_fmu_1ms": "times the FMU at 1 ms", "times_coupled": "times the FMU"}
    rows = ((record["method"], *(number(record[key], 3) for key in keys),
             f"{number(record['ms_per_s'], 3)} ({number(record['low'], 3)} .. {number(record['high'], 3)})",
             number(record["error"]), number(record["evaluations"], 3)) for record in records)
    return markdown(("method", *(heads[key] for key in keys), "ms per simulated s", "speed error",
                     "right-hand sides"), rows)


def stepping_table(tables: Tables) -> str:
    """One communication step of 1 ms."""
    return markdown(("set 2, step 1 ms, get 5", "times the empty FMU", "us (quartiles)"),
                    ((record["what"], number(record["ratio"], 3), record["remark"] or
                      f"{number(record['us'], 3)} ({number(record['low'], 3)} .. {number(record['high'], 3)})")
                     for record in tables["stepping"]))


def fidelity_table(tables: Tables) -> str:
    """Cost of the models."""
    return markdown(("model", "times the compliant one, kernel", "FMU", "kernel, us per ms step", "FMU, us"),
                    ((record["model"], number(record["kernel_ratio"], 3), number(record["ratio"], 3),
                      number(record["kernel_us"], 3), number(record["fmu_us"], 3)) for record in tables["fidelity"]))


def exchange_table(tables: Tables) -> str:
    """Cost of the number of outputs."""
    return markdown(("outputs read per step", "times two of them", "us per step"),
                    ((str(record["outputs"]), number(record["ratio"], 3), number(record["us"], 3))
                     for record in tables["exchange"]))


def scaling_table(tables: Tables) -> str:
    """How cost and memory grow."""
    first, last = tables["memory"][0], tables["memory"][-1]
    rows = [(f"{record['simulated_s']:g} s simulated at 1 ms", f"{number(record['ms_per_s'], 3)} ms per s")
            for record in tables["simulated_time"]]
    rows += [(f"{record['processes']} process{'es' if record['processes'] > 1 else ''} at once",
              f"{number(record['simulated_s_per_s'], 3)} simulated s per s, {number(record['speed_up'], 3)} times one, "
              f"{number(record['processor_us_per_step'], 3)} us of processor per step")
             for record in tables["parallel"]]
    rows.append((f"memory after {first['steps']:g} and after {last['steps']:g} steps",
                 f"{first['resident_MB']:.1f} and {last['resident_MB']:.1f} MB"))
    return markdown(("what", "measured"), rows)


def hard_table(tables: Tables) -> str:
    """One row per hard case: its property nearest to the bound."""
    rows = []
    records = tables["hard"]
    for case, title in dict.fromkeys((record["number"], record["case"]) for record in records):
        found = [record for record in records if record["number"] == case]
        near = max(found, key=_nearness)
        unit = "" if near["unit"] == "1" else f" {near['unit']}"
        rows.append((str(case), title, f"{sum(record['held'] for record in found)} of {len(found)}", near["property"],
                     f"{number(near['measured'])}{unit}", f"{number(near['bound'])}{unit}"))
    return markdown(("", "case", "held", "property nearest to its bound", "measured", "bound"), rows)


def _nearness(record: Record) -> float:
    """Return how near a figure is to its bound: a broken one first, a bound of 0 that is kept last."""
    if not record["held"]:
        return float("inf")
    if record["bound"] <= 0.0 or record["measured"] < 0.0:
        return -1.0
    return float(record["measured"] / record["bound"])


REPORT = (  # table it needs, heading, what makes it
    ("integrator", "Integrator: error (right-hand sides per ms, processor ms per simulated s)", integrator_table),
    ("orders", "Coupling: fitted orders", orders_table),
    ("orders", "Coupling: communication step and processor time for an error of 1e-6", effort_table),
    ("controlled", "Coupling: adaptive steps", controlled_table),
    ("auto", "`auto` on the shipped scenes", auto_table),
    ("peers", "Peers: the ordinary driveline to 1e-6", peers_table),
    ("coupled_peers", "Peers: the ripple scene to 1e-6", lambda tables: peers_table(tables, "coupled_peers")),
    ("stepping", "One communication step", stepping_table),
    ("fidelity", "Fidelity", fidelity_table),
    ("exchange", "Exchange", exchange_table),
    ("memory", "Scaling", scaling_table),
    ("hard", "Hard cases", hard_table),
)


# Parts of the README, by the name of their place.
PARTS: dict[str, Callable[[Measured], str]] = {
    "machine": machine,
    "targets": lambda measured: targets_table(measured.tables),
    "accuracy": lambda measured: integrator_table(measured.tables),
    "orders": lambda measured: orders_table(measured.tables),
    "effort": lambda measured: effort_table(measured.tables),
    "auto": lambda measured: auto_table(measured.tables),
    "peers": lambda measured: peers_table(measured.tables),
    "coupled": lambda measured: peers_table(measured.tables, "coupled_peers"),
    "stepping": lambda measured: stepping_table(measured.tables),
    "fidelity": lambda measured: fidelity_table(measured.tables),
    "hard": lambda measured: hard_table(measured.tables),
}


def report(measured: Measured) -> str:
    """Return the whole report of a run as Markdown."""
    tables = measured.tables
    parts = ["# Speed against error", machine(measured)]
    if targets(tables):
        parts += ["## Targets", targets_table(tables)]
    for needed, heading, make in REPORT:
        if needed in tables:
            parts += [f"## {heading}", make(tables)]
    return "\n\n".join(parts) + "\n"
