"""What the analysing commands have in common: the scene with its changes, checked together with the files to write."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from cardan.cli.failures import collected, refuse
from cardan.cli.simulate import progress_bar, read_overrides

if TYPE_CHECKING:
    from cardan.scenario import Scenario
    from cardan.simulation import Progress


def checked_scene(scene: str, changes: list[str] | None, files: Iterable[tuple[Path | None, tuple[str, ...]]],
                  fmu: Path | None = None) -> Scenario:
    """Read a scene; raise one error with all that is wrong with it and with the files.

    Parameters
    ----------
    scene : str
        File, or name of a shipped scene.
    changes : list of str, optional
        ``KEY=VALUE``.
    files : iterable of (Path or None, tuple of str)
        Files to be written, with the endings that are known.
    fmu : Path, optional
        FMU to be read.
    """
    from cardan.archive import open_archive
    from cardan.scenario import Scenario
    from cardan.storage import writable_problems

    problems: list[str] = []
    scenario = None
    with collected(problems):
        overrides = read_overrides(changes or [], None, problems)
        scenario = Scenario.load(scene)
        if overrides:
            scenario = scenario.with_overrides(overrides)
    for path, endings in files:
        if path is not None:
            problems += writable_problems(path, endings)
    if fmu is not None:
        with collected(problems):
            open_archive(fmu).close()
    refuse(problems)
    assert scenario is not None
    return scenario


def bar(title: str) -> AbstractContextManager[Progress | None]:
    """Give a progress bar on stderr; nothing where stderr is no terminal."""
    return progress_bar(title)


def warn(texts: Iterable[str]) -> None:
    """Print warnings to stderr."""
    for text in texts:
        typer.echo(f"warning: {text}", err=True)
