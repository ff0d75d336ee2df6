"""The generated parts of the README are the ones that the commands print."""

from pathlib import Path

import pytest
from cardan.readme import BLOCKS, filled
from cardan.scenario.reference import scene_reference

README = Path(__file__).parents[2] / "README.md"


def test_generated_parts_are_up_to_date() -> None:
    text = README.read_text(encoding="utf-8")
    assert filled(text) == text, "run python -m cardan.readme"


def test_the_reference_of_scene_files_is_up_to_date() -> None:
    page = (README.parent / "docs" / "scenes.md").read_text(encoding="utf-8")
    assert page == scene_reference(), "run python -m cardan.readme"


def test_a_missing_place_is_told() -> None:
    name = next(iter(BLOCKS))
    with pytest.raises(ValueError, match=f"add <!-- begin {name} -->"):
        filled("no places here")


def test_an_unknown_part_is_told() -> None:
    with pytest.raises(ValueError, match="no generated part 'nonsense'"):
        filled("<!-- begin nonsense -->\n<!-- end nonsense -->")
