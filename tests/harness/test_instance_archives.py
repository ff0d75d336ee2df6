"""Files that are no usable FMUs: a clear error, nothing unpacked outside the temporary directory."""

from __future__ import annotations

import shutil
import tempfile
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest
from cardan import Instance
from cardan.errors import FmuError


@pytest.fixture
def rewritten(fmu: Path, tmp_path: Path) -> Callable[..., Path]:
    """Make a copy of the FMU with members changed (None leaves one out) or added."""

    def make(changes: dict[str, Callable[[bytes], bytes | None]] | None = None,
             added: dict[str, bytes] | None = None) -> Path:
        path = tmp_path / "changed.fmu"
        with zipfile.ZipFile(fmu) as source, zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as target:
            for name in source.namelist():
                data: bytes | None = source.read(name)
                for part, change in (changes or {}).items():
                    if name.startswith(part) and data is not None:
                        data = change(data)
                if data is not None:
                    target.writestr(name, data)
            for name, data in (added or {}).items():
                target.writestr(name, data)
        return path

    return make


@pytest.fixture(autouse=True)
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


def refused(path: Path, said: str, temporary: Path) -> None:
    with pytest.raises(FmuError, match=said) as caught:
        Instance(path)
    assert str(path) in str(caught.value)
    assert list(temporary.iterdir()) == []


def test_missing_file(tmp_path: Path, temporary: Path) -> None:
    refused(tmp_path / "none.fmu", "does not exist", temporary)


def test_directory(tmp_path: Path, temporary: Path) -> None:
    refused(tmp_path, "cannot be read", temporary)


def test_no_zip(tmp_path: Path, temporary: Path) -> None:
    path = tmp_path / "text.fmu"
    path.write_text("not an FMU")
    refused(path, "no zip archive", temporary)


def test_truncated(fmu: Path, tmp_path: Path, temporary: Path) -> None:
    path = tmp_path / "half.fmu"
    path.write_bytes(fmu.read_bytes()[: fmu.stat().st_size // 2])
    refused(path, "no zip archive", temporary)


def test_no_description(rewritten: Callable[..., Path], temporary: Path) -> None:
    refused(rewritten({"modelDescription.xml": lambda data: None}), "has no modelDescription.xml", temporary)


@pytest.mark.parametrize(("old", "new", "said"), [
    (b'fmiVersion="2.0"', b'fmiVersion="1.0"', "modelDescription.xml of FMI 2.0"),
    (b'fmiVersion="2.0"', b'fmiVersion="3.0"', "modelDescription.xml of FMI 2.0"),
    (b"CoSimulation", b"ModelExchange", "modelDescription.xml of FMI 2.0"),
    (b"<ModelVariables>", b"<ModelVariables", "modelDescription.xml of FMI 2.0"),
])
def test_other_descriptions(rewritten: Callable[..., Path], temporary: Path, old: bytes, new: bytes,
                            said: str) -> None:
    refused(rewritten({"modelDescription.xml": lambda data: data.replace(old, new)}), said, temporary)


def test_no_binary_for_this_platform(rewritten: Callable[..., Path], temporary: Path) -> None:
    refused(rewritten({"binaries/": lambda data: None}), "no binary for this platform", temporary)


@pytest.mark.parametrize("name", ["../outside.txt", "/outside.txt", "resources/../../outside.txt", "C:/outside.txt"])
def test_members_that_would_leave_the_directory(rewritten: Callable[..., Path], temporary: Path, name: str) -> None:
    refused(rewritten(added={name: b"x"}), "outside the target directory", temporary)
    assert not (temporary.parent / "outside.txt").exists()


def test_links(fmu: Path, tmp_path: Path, temporary: Path) -> None:
    path = tmp_path / "link.fmu"
    shutil.copy(fmu, path)
    member = zipfile.ZipInfo("resources/link")
    member.external_attr = 0o120777 << 16
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr(member, "/etc/passwd")
    refused(path, "is a link", temporary)


def test_bombs(fmu: Path, tmp_path: Path, temporary: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The declared size counts; zipfile stops reading there, so a wrong one cannot unpack to more."""
    path = tmp_path / "bomb.fmu"
    shutil.copy(fmu, path)
    monkeypatch.setattr("cardan.archive.LARGEST", 16 << 20)
    with zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("resources/bomb", bytes(17 << 20))
    refused(path, "the limit is 16 MiB", temporary)
