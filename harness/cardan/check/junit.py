"""JUnit XML, which CI systems show as a test report."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree.ElementTree import Element, ElementTree, SubElement, indent

from cardan.check.report import FAILED, SKIPPED, Outcome, Report
from cardan.errors import InputError

_NO_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def write_junit(report: Report, path: Path) -> None:
    """Write a report as JUnit XML: one test case per check.

    Parameters
    ----------
    report : Report
        What to write.
    path : pathlib.Path
        The file.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    numbers = {"tests": str(len(report.outcomes)), "failures": str(report.count(FAILED)), "errors": "0",
               "skipped": str(report.count(SKIPPED)), "time": f"{report.seconds:.3f}"}
    root = Element("testsuites", {"name": "cardan check", **numbers})
    about = {"name": f"cardan check {Path(report.fmu).name}", "timestamp": report.started.replace("+00:00", "")}
    suite = SubElement(root, "testsuite", {**about, "hostname": "localhost", **numbers})
    properties = SubElement(suite, "properties")
    for name, value in {"fmu": report.fmu, "sha256": report.sha256, **report.versions}.items():
        SubElement(properties, "property", name=name, value=_clean(value))
    for outcome in report.outcomes:
        _case(suite, outcome, report.model_name)
    indent(root)
    try:
        ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)
    except OSError as error:
        raise InputError(f"{path} cannot be written: {error.strerror}") from None


def _case(suite: Element, outcome: Outcome, model: str) -> None:
    case = SubElement(suite, "testcase", classname=f"cardan.check.{_clean(model)}",
                      name=f"{outcome.id}: {outcome.title}", time=f"{outcome.seconds:.3f}")
    if outcome.status == FAILED:
        first = outcome.problems[0]
        failure = SubElement(case, "failure", message=_clean(first), type=outcome.id)
        failure.text = _clean("\n".join(outcome.problems))
    elif outcome.status == SKIPPED:
        SubElement(case, "skipped", message=_clean(outcome.reason))
    said = [f"warning: {text}" for text in outcome.warnings] + outcome.remarks
    said += [f"{name}: {value:.6g} {unit}".rstrip() for name, (value, unit) in outcome.figures.items()]
    if said:
        SubElement(case, "system-out").text = _clean("\n".join(said))


def _clean(text: str) -> str:
    """Return text without the characters that XML cannot hold; FMUs say all sorts of things."""
    return _NO_XML.sub("?", text)
