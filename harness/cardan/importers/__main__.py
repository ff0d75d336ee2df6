"""``python -m cardan.importers NAME``: run the scene in one importer; a job on stdin, the answer into a file.

The answer does not go to stdout, where native libraries print what they like, and it is on disk before the process
leaves, which it does at once: an interpreter that ran a Python FMU sometimes aborts while it shuts down.
"""

from __future__ import annotations

import importlib
import json
import os
import platform
import sys
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any


def answer(name: str, job: dict[str, Any]) -> dict[str, Any]:
    """Return version and rows of an importer, or why it was skipped or has failed."""
    module = importlib.import_module(f"cardan.importers.with_{name}")
    about = {"python": platform.python_version(), "version": ""}
    try:
        about["version"] = version(module.DISTRIBUTION)
    except PackageNotFoundError:
        return {**about, "skipped": f"{module.DISTRIBUTION} is not installed (pip install {module.DISTRIBUTION})"}
    try:
        return {**about, "rows": module.run(job)}
    except OSError as error:
        for library, hint in getattr(module, "NEEDS", {}).items():
            if library in str(error):
                return {**about, "skipped": f"{module.DISTRIBUTION} needs {library}: {hint}"}
        return {**about, "failed": f"{type(error).__name__}: {error}"}
    except Exception as error:  # whatever an importer raises is its row of the table
        return {**about, "failed": f"{type(error).__name__}: {error}"}


def main() -> None:
    """Do the job and leave."""
    job = json.load(sys.stdin)
    text = json.dumps(answer(sys.argv[1], job))
    Path(job["answer"]).write_text(text, encoding="utf-8")
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main()
