"""The scenes that come with the package."""

from __future__ import annotations

from pathlib import Path

FOLDER = Path(__file__).resolve().parent.parent / "scenes"


def names() -> tuple[str, ...]:
    """Return the names of the shipped scenes."""
    return tuple(sorted(path.stem for path in FOLDER.glob("*.toml")))


def find(path: str | Path) -> Path:
    """Return the file for a path, or for the name of a shipped scene where no such file exists."""
    place = Path(path)
    if not place.exists() and place.parent == Path(".") and place.suffix in ("", ".toml"):
        candidate = FOLDER / f"{place.stem}.toml"
        if candidate.is_file():
            return candidate
    return place
