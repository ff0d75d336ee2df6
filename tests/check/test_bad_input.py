"""Files that no command can work with: exit code 2, a clear error, nothing unpacked outside, nothing left."""

from __future__ import annotations

import io
import stat
import tempfile
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from cardan.cli.app import app
from typer.testing import CliRunner

from .conftest import write

FMI_1 = '<fmiModelDescription fmiVersion="1.0" modelName="M" modelIdentifier="M" guid="1" ' \
        'numberOfContinuousStates="0" numberOfEventIndicators="0">' \
        "<ModelVariables/><Implementation><CoSimulation_StandAlone><Capabilities/>" \
        "</CoSimulation_StandAlone></Implementation></fmiModelDescription>"
FMI_3 = '<fmiModelDescription fmiVersion="3.0" modelName="M" instantiationToken="1">' \
        '<CoSimulation modelIdentifier="M"/>' \
        '<ModelVariables><Float64 name="time" valueReference="0" causality="independent" variability="continuous"/>' \
        "</ModelVariables><ModelStructure/></fmiModelDescription>"
EXCHANGE = '<fmiModelDescription fmiVersion="2.0" modelName="M" guid="1"><ModelExchange modelIdentifier="M"/>' \
           '<ModelVariables><ScalarVariable name="x" valueReference="0"><Real/></ScalarVariable></ModelVariables>' \
           "<ModelStructure/></fmiModelDescription>"
GIB = 1 << 30
Change = Callable[[zipfile.ZipFile], None]


def archive(members: Mapping[str, bytes | str], change: Change = lambda made: None) -> bytes:
    """Return an archive; `change` may falsify its directory before that is written."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as made:
        for name, content in members.items():
            made.writestr(name, content)
        change(made)
    return stream.getvalue()


def claim(name: str, size: int) -> Change:
    """Let a member claim a size that it does not have."""

    def change(made: zipfile.ZipFile) -> None:
        made.getinfo(name).file_size = size

    return change


def link(made: zipfile.ZipFile) -> None:
    """Make the last member a symbolic link."""
    made.filelist[-1].external_attr = (stat.S_IFLNK | 0o777) << 16


def files(good: dict[str, bytes]) -> dict[str, tuple[bytes, str]]:
    """Contents of bad files, and what has to be said about them."""
    no_library = {name: content for name, content in good.items() if not name.startswith("binaries/linux64")}
    whole = archive(good)
    return {
        "text": (b"not an FMU", "no zip archive"),
        "truncated": (whole[: len(whole) // 2], "no zip archive"),
        "empty": (b"", "no zip archive"),
        "no description": (archive({"readme.txt": "hello"}), "has no modelDescription.xml"),
        "no XML": (archive({**good, "modelDescription.xml": "hello"}), "modelDescription.xml"),
        "half XML": (archive({**good, "modelDescription.xml": good["modelDescription.xml"][:900]}),
                     "modelDescription.xml"),
        "FMI 1": (archive({**good, "modelDescription.xml": FMI_1}), "FMI 1.0"),
        "FMI 3": (archive({**good, "modelDescription.xml": FMI_3}), "FMI 3.0"),
        "model exchange": (archive({**good, "modelDescription.xml": EXCHANGE}), "model exchange only"),
        "another platform": (archive(no_library), "has no binary for this platform"),
        "way up": (archive({**good, "resources/../../outside.txt": "x"}), "outside the target directory"),
        "absolute path": (archive({**good, "/tmp/outside.txt": "x"}), "outside the target directory"),
        "drive": (archive({**good, "C:/outside.txt": "x"}), "outside the target directory"),
        "link": (archive({**good, "resources/link": "/etc/passwd"}, link), "is a link"),
        "10 GB resource": (archive({**good, "resources/huge": "x"}, claim("resources/huge", 10 * GIB)),
                           "10240 MiB, the limit is 1024 MiB"),
        "10 GB description": (archive(good, claim("modelDescription.xml", 10 * GIB)), "MiB, the limit is"),
        "damaged library": (damaged(whole), "cannot be unpacked"),
    }


def damaged(whole: bytes) -> bytes:
    """Return the archive with a byte in the middle of the library changed."""
    with zipfile.ZipFile(io.BytesIO(whole)) as made:
        member = made.getinfo("binaries/linux64/Lag.so")
    place = member.header_offset + member.compress_size // 2
    return whole[:place] + bytes([whole[place] ^ 0xFF]) + whole[place + 1 :]


@pytest.fixture(scope="session")
def bad(built: dict[str, bytes]) -> dict[str, tuple[bytes, str]]:
    return files(built)


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


COMMANDS = {"check": ["check", "{}"], "info": ["info", "{}"], "simulate": ["simulate", "fligiel", "--fmu", "{}"]}
# What `info` has no need to look at: it unpacks nothing and loads nothing.
READS_ONLY = {"another platform", "way up", "absolute path", "drive", "link", "10 GB resource", "damaged library"}
KINDS = list(files({"modelDescription.xml": b"", "binaries/linux64/Lag.so": b"0123"}))


@pytest.mark.parametrize(("kind", "command"), [(kind, command) for kind in KINDS for command in COMMANDS
                                               if not (command == "info" and kind in READS_ONLY)])
def test_bad_files_are_refused_by_every_command(kind: str, command: str, bad: dict[str, tuple[bytes, str]],
                                                    tmp_path: Path, temporary: Path) -> None:
    content, said = bad[kind]
    path = tmp_path / "bad.fmu"
    path.write_bytes(content)
    before = sorted(each for each in tmp_path.rglob("*"))
    result = CliRunner().invoke(app, [part.format(path) for part in COMMANDS[command]])
    assert result.exit_code == 2, (result.output, result.exception)
    assert said in result.stderr
    assert str(path) in result.stderr
    assert result.stdout == ""
    assert "Traceback" not in result.stderr
    assert sorted(each for each in tmp_path.rglob("*")) == before
    assert not Path("/tmp/outside.txt").exists()


@pytest.mark.parametrize("command", COMMANDS)
def test_missing_files_and_directories(command: str, tmp_path: Path) -> None:
    for path, said in ((tmp_path / "none.fmu", "does not exist"), (tmp_path, "cannot be read")):
        result = CliRunner().invoke(app, [part.format(path) for part in COMMANDS[command]])
        assert result.exit_code == 2
        assert said in result.stderr
        assert str(path) in result.stderr


def test_a_damaged_document_fails_the_check_of_the_archive_only(built: dict[str, bytes], tmp_path: Path) -> None:
    path = write(tmp_path / "Lag.fmu", {**built, "documentation/index.html": b"<html>" + bytes(range(200))})
    whole = path.read_bytes()
    with zipfile.ZipFile(path) as made:
        place = made.getinfo("documentation/index.html").header_offset + 100
    path.write_bytes(whole[:place] + bytes([whole[place] ^ 0xFF]) + whole[place + 1 :])
    result = CliRunner().invoke(app, ["check", str(path), "--only", "archive", "--only", "ranges"])
    assert result.exit_code == 1
    assert "documentation/index.html is damaged" in " ".join(result.stdout.split())
