"""The FMU in importers that are not ours: each runs the same scene in a process of its own.

`compare` runs them and says how far each is from FMPy; `markdown` prints the table. One module per importer, with
a function ``run(job)`` and the names of the distribution that brings it. Native libraries of two importers do not
go together in one process, and a crash is to end one row of the table, not the command.
"""

from __future__ import annotations

from cardan.importers.runner import Outcome, compare, unavailable
from cardan.importers.table import markdown

__all__ = ["Outcome", "compare", "markdown", "unavailable"]
