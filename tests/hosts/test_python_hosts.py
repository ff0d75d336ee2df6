"""One FMU file under every Python of this machine, in threads, in processes, from awkward places."""

from __future__ import annotations

import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import cardan_kernel
import pytest
from cardan import Instance, archive
from cardan.errors import FmuError
from hosts.conftest import INPUTS, OUTPUTS, STARTS, Job, Play, unpack
from hosts.pythons import interpreter

VERSIONS = [f"3.{minor}" for minor in range(9, 16)]


@pytest.mark.parametrize("version", VERSIONS)
def test_same_file_same_results_without_numpy(version: str, job: Job, play: Play, expected: list[list[str]]) -> None:
    python = interpreter(version)
    if python is None:
        pytest.skip(f"no Python {version} is installed here")
    answer = play(job, "run", 200, python)
    assert answer["rows"] == expected
    assert not answer["numpy"]
    fits = cardan_kernel.Compiled is not None and int(version.split(".")[1]) >= 11
    assert (": compiled kernel" in answer["messages"][0][1]) == fits


def test_results_are_those_of_the_harness(fmu: Path, expected: list[list[str]]) -> None:
    assert _in_harness(fmu) == expected[-1]


def _in_harness(fmu: Path) -> list[str]:
    with Instance(fmu) as instance:
        for name, value in STARTS.items():
            instance.set(name, value)
        instance.setup(0.0)
        instance.initialize()
        for i in range(200):
            for name, value in zip(INPUTS, (200.0 - 10.0 * (i % 7), 50.0 + 5.0 * (i % 3))):
                instance.set(name, value)
            instance.step(i * 1e-3, 1e-3)
        return [float(instance.get(name)).hex() for name in OUTPUTS]


def test_where_no_byte_code_can_be_written(fmu: Path, tmp_path: Path, play: Play, expected: list[list[str]]) -> None:
    job = unpack(fmu, tmp_path)
    for folder in [tmp_path, *(path for path in tmp_path.rglob("*") if path.is_dir())]:
        (folder / "__pycache__").write_text("")  # a file in its place holds off even a privileged user
        folder.chmod(0o555)
    before = sorted(tmp_path.rglob("*"))
    try:
        assert play(job, "run", 200)["rows"] == expected
        assert sorted(tmp_path.rglob("*")) == before
    finally:
        for folder in [tmp_path, *(path for path in before if path.is_dir())]:
            folder.chmod(0o755)


def test_twenty_instances_in_threads(job: Job, play: Play, expected: list[list[str]]) -> None:
    assert play(job, "threads", 20)["rows"] == [expected[-1]] * 20


def test_twenty_instances_in_threads_of_the_harness(fmu: Path, expected: list[list[str]]) -> None:
    with ThreadPoolExecutor(20) as pool:
        assert list(pool.map(_in_harness, [fmu] * 20)) == [expected[-1]] * 20


def test_twenty_instances_in_processes(job: Job, expected: list[list[str]]) -> None:
    command = [sys.executable, "-I", "-S", "-B", str(Path(__file__).with_name("ctypes_host.py"))]
    started = [subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) for _ in range(20)]
    for each in started:  # all are there before the first has its job
        assert each.stdin is not None
        each.stdin.write(json.dumps({**job, "mode": "run", "count": 200}))
        each.stdin.close()
    for each in started:
        assert each.stdout is not None
        with each.stdout as stream:
            assert json.loads(stream.read())["rows"] == expected
        assert each.wait() == 0


def test_a_thousand_instances_leave_no_more_than_the_exporter_does(job: Job, play: Play) -> None:
    answer = play(job, "cycles", 1000)
    memory = answer["memory"]
    # docs/FMI.md, trap 10: pythonfmu's exporter itself leaves 7 to 22 kB per instance
    assert (memory[-1] - memory[0]) / 900 < 22.0
    assert answer["path"] == []


def test_a_path_that_the_exporter_cannot_read_is_not_used(fmu: Path, tmp_path: Path,
                                                          monkeypatch: pytest.MonkeyPatch) -> None:
    awkward = tmp_path / "50% #1+2; sch\u00f6n"
    awkward.mkdir()
    copy = awkward / fmu.name
    copy.write_bytes(fmu.read_bytes())
    monkeypatch.setattr(archive.tempfile, "tempdir", str(awkward))
    with Instance(copy) as instance:  # unpacked to another directory
        assert instance.get("input.inertia") == 0.2
    monkeypatch.setattr(archive, "_bases", lambda: iter([awkward]))
    with pytest.raises(FmuError, match="TMPDIR"):
        Instance(copy)
