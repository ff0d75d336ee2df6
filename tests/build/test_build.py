"""Building: what is refused, what is left behind, what the cache gives."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import cardan_build
import pytest
from cardan_build import BuildError, archive, cache
from cardan_build.__main__ import main


def test_contents(fmu: Path) -> None:
    with zipfile.ZipFile(fmu) as opened:
        names = opened.namelist()
        page = opened.read("documentation/index.html").decode()
        licences = [opened.read(f"documentation/licenses/{name}.txt").decode() for name in ("license", "pythonfmu")]
        picture = opened.read("model.png")
    assert names[0] == "modelDescription.xml"
    assert names[1:] == sorted(names[1:])
    assert not any("__pycache__" in name or name.startswith("resources/pythonfmu/") for name in names)
    assert page.count("<tr>") > 80
    assert "<code>joint1.trunnion.friction</code>" in page
    assert all("Permission is hereby granted" in text for text in licences)
    assert picture.startswith(b"\x89PNG")


def test_archive_is_the_same_whatever_the_order_and_time(tmp_path: Path) -> None:
    members = {"b/x.so": b"1" * 1000, "modelDescription.xml": b"<x/>", "a.txt": b"2"}
    archive.write(tmp_path / "one.fmu", members)
    archive.write(tmp_path / "two.fmu", dict(reversed(members.items())))
    assert (tmp_path / "one.fmu").read_bytes() == (tmp_path / "two.fmu").read_bytes()
    assert archive.contents(tmp_path / "one.fmu") == members
    with zipfile.ZipFile(tmp_path / "one.fmu") as opened:
        modes = {entry.filename: entry.external_attr >> 16 for entry in opened.infolist()}
    assert modes == {"modelDescription.xml": 0o100644, "a.txt": 0o100644, "b/x.so": 0o100755}


@pytest.mark.parametrize(("name", "words"), [("x.zip", "must end with .fmu"), ("directory.fmu", "is a directory")])
def test_names_that_are_none_for_an_fmu(name: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "directory.fmu").mkdir()
    with pytest.raises(BuildError, match=words):
        cardan_build.build(tmp_path / name)
    assert [path.name for path in tmp_path.iterdir()] == ["directory.fmu"]


def test_output_that_cannot_be_written_leaves_nothing_half_done(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(BuildError, match=r"CardanDriveline.fmu cannot be written"):
        cardan_build.build(tmp_path / "file" / "CardanDriveline.fmu")
    assert (tmp_path / "file").read_text() == "in the way"


def test_a_failed_build_keeps_the_earlier_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "CardanDriveline.fmu"
    target.write_bytes(b"earlier")

    def fail(*_: object) -> Path:
        raise BuildError("the FMU was built, but does not work")

    monkeypatch.setattr("cardan_build.assembly._make", fail)
    with pytest.raises(BuildError, match="does not work"):
        cardan_build.build(target)
    assert target.read_bytes() == b"earlier"
    assert list(tmp_path.iterdir()) == [target]


def test_verification_finds_an_fmu_that_does_not_work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    original = archive.write

    def without_a_module(path: Path, members: dict[str, bytes]) -> None:
        original(path, {name: each for name, each in members.items() if not name.endswith("/motion.py")})

    monkeypatch.setattr(archive, "write", without_a_module)
    with pytest.raises(BuildError, match="verif"):
        cardan_build.build(tmp_path / "CardanDriveline.fmu", portable=True)
    assert list(tmp_path.iterdir()) == []


def test_a_kernel_compiled_from_another_source_is_refused(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    with pytest.raises(BuildError, match="holds no compiled kernel"):
        cardan_build.build(tmp_path / "x.fmu", kernel_dirs=[tmp_path / "elsewhere"])
    (tmp_path / "elsewhere" / "_compiled.pyd").write_bytes(b"MZ cardan-kernel-source:" + b"0" * 64)
    with pytest.raises(BuildError, match="was made from another source") as caught:
        cardan_build.build(tmp_path / "x.fmu", kernel_dirs=[tmp_path / "elsewhere"])
    assert str(tmp_path / "elsewhere" / "_compiled.pyd") in str(caught.value)


def test_a_kernel_of_the_same_source_made_elsewhere_is_added(tmp_path: Path) -> None:
    from cardan_build.amalgamate import MARKER, amalgamate
    from cardan_build.sources import find_package

    elsewhere = tmp_path / "windows"
    elsewhere.mkdir()
    digest = amalgamate(find_package("cardan_kernel")).digest
    (elsewhere / "_compiled.pyd").write_bytes(b"MZ " + MARKER.encode() + digest.encode())
    path = cardan_build.build(tmp_path / "both.fmu", kernel_dirs=[elsewhere])
    inside = [Path(name).name for name in archive.contents(path)]
    assert "_compiled.pyd" in inside


def test_command_line_reports_errors_with_exit_code_2(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["-o", str(tmp_path / "x.zip")]) == 2
    assert "must end with .fmu" in capsys.readouterr().err
    assert main(["--portable", "-o", str(tmp_path / "x.fmu")]) == 0
    assert capsys.readouterr().out.strip() == str(tmp_path / "x.fmu")


def test_default_fmu_is_built_once_by_processes_at_the_same_time(
    tmp_path: Path, fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path))
    command = [sys.executable, "-c", "import cardan_build; print(cardan_build.default_fmu())"]
    running = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(3)]
    found = {Path(each.communicate()[0].strip()) for each in running}
    assert [each.returncode for each in running] == [0, 0, 0]
    assert len(found) == 1
    path = found.pop()
    assert path.is_relative_to(tmp_path)
    assert path.read_bytes() == fmu.read_bytes()
    assert [each.name for each in path.parent.iterdir()] == [path.name]
    monkeypatch.setattr(cache, "assemble", lambda *_: pytest.fail("built again"))
    assert cardan_build.default_fmu() == path


def test_cache_keeps_the_newest_builds(tmp_path: Path) -> None:
    import os

    for place in range(cache.KEPT + 3):
        (tmp_path / f"{place:02}").mkdir()
        os.utime(tmp_path / f"{place:02}", (place, place))
    cache._prune(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"{place:02}" for place in range(3, cache.KEPT + 3)]


def test_cache_that_cannot_be_written_names_the_variable(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path / "file" / "inside"))
    with pytest.raises(BuildError, match=cache.VARIABLE):
        cardan_build.default_fmu()
