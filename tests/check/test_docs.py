"""docs/ci.md says what the command does."""

from __future__ import annotations

import re
from pathlib import Path

import typer.main
from cardan.check.catalog import CHECKS
from cardan.cli.app import app

TEXT = (Path(__file__).parents[2] / "docs" / "ci.md").read_text(encoding="utf-8")


def test_every_check_is_described_in_its_own_words() -> None:
    rows = re.findall(r"^\| `([a-z-]+)` \| (.*) \|$", TEXT, re.MULTILINE)
    assert rows == [(check.id, check.proves) for check in CHECKS]


def test_options_in_examples_exist() -> None:
    command = typer.main.get_command(app).get_command(None, "check")  # type: ignore[attr-defined]
    known = {option for parameter in command.params for option in parameter.opts}
    lines = [line for line in TEXT.splitlines() if "cardan check" in line]
    named = {option for line in lines for option in re.findall(r"--[a-z-]+", line)}
    assert named and named <= known, named - known


def test_checks_are_told_apart_and_need_what_comes_before_them() -> None:
    ids = [check.id for check in CHECKS]
    assert len(set(ids)) == len(ids)
    for place, check in enumerate(CHECKS):
        assert set(check.needs) <= set(ids[:place])
