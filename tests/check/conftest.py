"""FMUs to check: a good one, and the same with single faults."""

from __future__ import annotations

import itertools
import subprocess
import sys
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from cardan.check import Options, Report, check_fmu

from .faults import Changes

HERE = Path(__file__).parent
QUICK = Options(run_steps=200, steps=12, points=6, instances=60, time_limit=20.0)

Make = Callable[..., Path]
Examine = Callable[..., Report]


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """What pythonfmu makes of lag.py, by member."""
    folder = tmp_path_factory.mktemp("lag")
    code = f"from pythonfmu import FmuBuilder; FmuBuilder.build_FMU({str(HERE / 'lag.py')!r}, dest='.')"
    subprocess.run([sys.executable, "-c", code], cwd=folder, check=True, capture_output=True)
    with zipfile.ZipFile(folder / "Lag.fmu") as archive:
        made = {name: archive.read(name) for name in archive.namelist()}
    return {**made, "modelDescription.xml": (HERE / "lag.xml").read_bytes()}


@pytest.fixture(scope="session")
def lag(built: dict[str, bytes], tmp_path_factory: pytest.TempPathFactory) -> Make:
    """Make the good FMU, or one with texts replaced in its source or its model description."""
    count = itertools.count()

    def make(code: Changes | None = None, xml: Changes | None = None) -> Path:
        members = dict(built)
        for name, changes in (("resources/lag.py", code), ("modelDescription.xml", xml)):
            members[name] = changed(members[name], changes or {})
        path = tmp_path_factory.mktemp(f"lag_{next(count)}") / "Lag.fmu"
        return write(path, members)

    return make


@pytest.fixture(scope="session")
def good(lag: Make) -> Path:
    """The FMU without a fault."""
    return lag()


@pytest.fixture(scope="session")
def driveline() -> Path:
    """The driveline FMU of this installation."""
    from cardan_build import default_fmu

    return default_fmu()


@pytest.fixture
def examine() -> Examine:
    """Carry out the named checks, all without a name, with few repetitions."""

    def run(fmu: Path, *only: str, **options: object) -> Report:
        strict = bool(options.pop("strict", False))
        return check_fmu(fmu, only=only, options=Options(**{**QUICK.to_dict(), **options}), strict=strict)

    return run


def changed(content: bytes, changes: Changes) -> bytes:
    """Return a text with single places replaced."""
    text = content.decode()
    for old, new in changes.items():
        assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in the text"
        text = text.replace(old, new)
    return text.encode()


def write(path: Path, members: Mapping[str, bytes]) -> Path:
    """Write an archive."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return path
