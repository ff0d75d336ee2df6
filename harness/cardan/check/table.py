"""The report for people."""

from __future__ import annotations

import sys

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from cardan.check.report import FAILED, PASSED, SKIPPED, Outcome, Report

STYLES = {PASSED: "green", FAILED: "bold red", SKIPPED: "yellow"}


def print_report(report: Report, verbose: bool = False) -> None:
    """Print a line per check, what is wrong below it, and the count.

    Parameters
    ----------
    report : Report
        What to print.
    verbose : bool
        Whether remarks are printed too.
    """
    console = Console(highlight=False, width=None if sys.stdout.isatty() else 140)
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    table.add_column("check", no_wrap=True)
    table.add_column("result", no_wrap=True)
    table.add_column("time", justify="right", no_wrap=True)
    table.add_column("what", overflow="fold")
    for outcome in report.outcomes:
        table.add_row(outcome.id, Text(outcome.status, STYLES[outcome.status]), f"{outcome.seconds:.1f} s",
                      _about(outcome, verbose))
    console.print(f"{report.fmu}", style="bold", markup=False)
    console.print(table)
    counts = ", ".join(f"{report.count(status)} {status}" for status in (PASSED, FAILED, SKIPPED))
    console.print(f"{counts} in {report.seconds:.0f} s", style=STYLES[PASSED if report.passed else FAILED])


def _about(outcome: Outcome, verbose: bool) -> Text:
    """Return the title, and below it reason, problems, warnings and figures."""
    text = Text(outcome.title)
    if outcome.reason:
        text.append(f"\n{outcome.reason}", "dim")
    for problem in outcome.problems:
        text.append(f"\n- {problem}", "red")
    for warning in outcome.warnings:
        text.append(f"\n- warning: {warning}", "yellow")
    if outcome.figures:
        figures = ", ".join(f"{name} {value:.4g} {unit}".rstrip() for name, (value, unit) in outcome.figures.items())
        text.append(f"\n{figures}", "dim")
    if verbose:
        for remark in outcome.remarks:
            text.append(f"\n- {remark}", "dim")
    return text
