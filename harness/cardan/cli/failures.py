"""From expected errors to messages and the exit code 2."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

import typer

from cardan.errors import CardanError, InputError


@contextmanager
def expected_errors(as_json: bool = False) -> Iterator[None]:
    """Print expected errors to stderr, one line per problem, and leave with exit code 2.

    A run that fails after its start is no error here: it has a result, and an exit code of its own.

    Parameters
    ----------
    as_json : bool
        Whether stdout is to have one JSON object all the same: ``{"completed": false, "errors": [...]}``.
    """
    try:
        yield
    except Exception as error:
        if not _is_expected(error):
            raise
        lines = _problem_lines(error)
        for line in lines:
            typer.echo(f"error: {line}", err=True)
        if as_json:
            typer.echo(json.dumps({"completed": False, "errors": lines}))
        raise typer.Exit(2) from None


@contextmanager
def collected(problems: list[str]) -> Iterator[None]:
    """Add an expected error to a list of problems instead of letting it through."""
    try:
        yield
    except Exception as error:
        if not _is_expected(error):
            raise
        problems += _problem_lines(error)


def refuse(problems: list[str]) -> None:
    """Raise an `InputError` if there are problems."""
    if problems:
        raise InputError(problems)


def _is_expected(error: Exception) -> bool:
    """Return whether an error is one that a user can act on."""
    from cardan_build import BuildError

    from cardan.scenario import ScenarioError

    return isinstance(error, (CardanError, ScenarioError, BuildError))


def _problem_lines(error: Exception) -> list[str]:
    """Return the problems that an expected error carries, one text each."""
    problems: Iterable[object] = getattr(error, "problems", None) or [error]
    return [str(problem) for problem in problems]
