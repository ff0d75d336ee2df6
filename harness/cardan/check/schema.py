"""The model description against the XML schema of FMI 2.0, and against FMPy's rules."""

from __future__ import annotations

import re
from pathlib import Path

import fmpy

from cardan.check.base import Check, Findings
from cardan.check.subject import Subject

MOST = 20  # problems told
_DATE = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ")


class Schema(Check):
    """The schema files are those that FMPy carries, from the FMI 2.0 standard."""

    id = "schema"
    title = "modelDescription.xml against the XML schema of FMI 2.0"
    proves = "the model description has the elements, attributes and value types of the standard"

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Validate with lxml."""
        from lxml import etree

        folder = Path(fmpy.__file__).parent / "schema" / "fmi2"
        schema = etree.XMLSchema(file=str(folder / "fmi2ModelDescription.xsd"))
        tree = etree.parse(str(subject.directory / "modelDescription.xml"))
        if not schema.validate(tree):
            for error in list(schema.error_log)[:MOST]:
                found.fail(f"line {error.line}: {error.message}")
        date = subject.model.generationDateAndTime
        if date and not _DATE.fullmatch(date):
            found.warn(f'generationDateAndTime = "{date}": FMI wants the form 2026-01-31T23:59:59Z')


class Validation(Check):
    """What ``fmpy validate`` tells."""

    id = "validation"
    title = f"FMPy {fmpy.__version__}: validation"
    proves = "FMPy finds no fault with variable names, start values, causalities, units and model structure"

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Call FMPy."""
        from fmpy.validation import validate_fmu

        problems = validate_fmu(str(subject.path))
        for text in problems[:MOST]:
            found.fail(str(text))
        if len(problems) > MOST:
            found.fail(f"and {len(problems) - MOST} more")
