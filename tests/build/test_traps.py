"""The toolchain's traps (docs/FMI.md), each shown to be avoided, through bare FMPy in fresh processes."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cardan_build
import pytest
from cardan_build.sources import find_package

Run = Callable[..., dict[str, Any]]
OK, DISCARD = 0, 2


@pytest.fixture
def decoys(tmp_path: Path) -> Path:
    """A host's own modules that happen to have the names of the FMU's, and would not work in it."""
    root = tmp_path / "decoys"
    for name in ("cardan_kernel", "pythonfmu"):
        (root / name).mkdir(parents=True)
        (root / name / "__init__.py").write_text("Driveline = KERNEL = __version__ = Fmi2Slave = None\n")
    for name in ("_compiled", "driveline", "variables"):
        (root / "cardan_kernel" / f"{name}.py").write_text("Driveline = VARIABLES = INDEX = UNITS = None\n")
    (root / "cardan_slave.py").write_text("CardanDriveline = None\n")
    return root


@pytest.mark.parametrize("order", ["host first", "fmu first"])
def test_trap_1_fmu_and_host_run_their_own_modules(order: str, fmu: Path, decoys: Path, run: Run) -> None:
    alone = run("run", fmu=fmu)
    beside = run("beside_host_modules", fmu=fmu, order=order, path=[str(decoys)])
    assert beside["steps"] == alone["steps"]
    assert beside["messages"] == alone["messages"]
    found = beside["after"] + beside.get("before", [])
    assert all(Path(each).is_relative_to(decoys) for each in found), found


@pytest.mark.parametrize("order", ["host first", "fmu first"])
def test_trap_1_compiled_kernels_of_host_and_fmu_stay_apart(order: str, fmu: Path, run: Run) -> None:
    home = find_package("cardan_kernel")
    if not list(home.glob("_compiled*")):
        pytest.skip("no compiled kernel is installed")
    paths = [str(find_package(name).parent) for name in ("cardan_kernel", "pythonfmu")]
    beside = run("beside_host_modules", fmu=fmu, order=order, path=paths)
    assert [Path(each).parent for each in beside["after"][:2]] == [home, home]


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_trap_1_two_versions_in_one_process_run_their_own_code(
    order: tuple[int, int], fmu: Path, other_fmu: Path, run: Run
) -> None:
    fmus = [str((fmu, other_fmu)[place]) for place in order]
    together = run("two_versions", fmus=fmus)
    alone = [run("two_versions", fmus=[each]) for each in fmus]
    assert together["steps"] == [each["steps"][0] for each in alone]
    assert together["steps"][0] != together["steps"][1]
    versions = [messages[0][2].split(":")[0] for messages in together["messages"]]
    assert versions[order.index(1)].startswith("cardan_kernel 99.")
    assert not versions[order.index(0)].startswith("cardan_kernel 99.")


def test_trap_2_builds_in_one_process_are_independent_and_leave_nothing_behind(
    fmu: Path, other_fmu: Path, other_sources: Path, tmp_path: Path
) -> None:
    code = (
        "import sys, cardan_build\n"
        "before = set(sys.modules)\n"
        f"first = cardan_build.build(__import__('pathlib').Path({str(tmp_path / 'first.fmu')!r}))\n"
        f"sys.path.insert(0, {str(other_sources)!r})\n"
        f"second = cardan_build.build(__import__('pathlib').Path({str(tmp_path / 'second.fmu')!r}))\n"
        "names = {name.split('.')[0] for name in set(sys.modules) - before}\n"
        "print([name for name in names if name.startswith(('cardan_kernel', 'cardan_slave', 'pythonfmu'))])\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
    assert (tmp_path / "first.fmu").read_bytes() == fmu.read_bytes()
    assert (tmp_path / "second.fmu").read_bytes() == other_fmu.read_bytes()


def test_trap_3_200_refused_steps_recover_without_a_crash(fmu: Path, run: Run) -> None:
    answer = run("failing_steps", fmu=fmu)
    assert answer["exit"] == 0
    assert answer["statuses"] == [DISCARD]
    assert answer["messages"] >= 200
    assert answer["rest"] == answer["again"]
    assert all(step[0] == OK for step in answer["rest"])


def test_trap_4_a_run_that_ends_early_tells_why(fmu: Path, run: Run) -> None:
    # simulate_fmu takes the refusal for a wish to stop and returns without an error: only the time and the log tell.
    answer = run("fails_midway", fmu=fmu)
    assert answer["last"] < 0.1 - 0.5e-3
    assert any("input.torque = nan" in text for text in answer["messages"])


def test_trap_5_the_state_is_complete(fmu: Path, run: Run) -> None:
    answer = run("state_round_trip", fmu=fmu)
    assert answer["first"] == answer["second"]
    later = run("continue_from", fmu=fmu, state=answer["state"])
    assert later["steps"] == answer["first"]


def test_trap_6_the_description_is_ours_and_valid(fmu: Path) -> None:
    from fmpy.validation import validate_fmu

    assert validate_fmu(str(fmu)) == []


def test_trap_7_same_source_same_bytes_compressed(fmu: Path, tmp_path: Path) -> None:
    again = cardan_build.build(tmp_path / "elsewhere" / "Other name.fmu")
    assert again.read_bytes() == fmu.read_bytes()
    with zipfile.ZipFile(again) as archive:
        entries = archive.infolist()
    assert {entry.compress_type for entry in entries} == {zipfile.ZIP_DEFLATED}
    assert sum(entry.compress_size for entry in entries) < 0.5 * sum(entry.file_size for entry in entries)


def test_trap_8_platforms_are_told_and_a_path_with_spaces_works(fmu: Path, run: Run) -> None:
    with zipfile.ZipFile(fmu) as archive:
        binaries = {name.split("/")[1] for name in archive.namelist() if name.startswith("binaries/")}
        text = archive.read("documentation/externalDependencies.txt").decode()
    assert binaries == {"linux64", "win64"}
    assert all(word in text for word in ("Linux", "glibc 2.32", "Windows", "Python 3.9", "LD_PRELOAD"))
    assert run("run", fmu=fmu)["steps"][-1][0] == OK  # `run` unpacks to a directory with a space in its name


def test_trap_9_texts_arrive_with_logging_on_and_say_what_is_wrong(fmu: Path, run: Run) -> None:
    answer = run("silent", fmu=fmu)
    assert answer["False"] == [DISCARD, []]
    status, messages = answer["True"]
    assert status == DISCARD
    level, category, text = messages[-1]
    assert (level, category) in ((DISCARD, "logStatusDiscard"), (3, "logStatusError"))
    assert all(part in text for part in ("joint2.angle", "2 rad", "below", "90 deg"))
    assert not any("%" in text for _, _, text in messages)


def test_trap_10_wrong_calls_are_refused_and_told(fmu: Path, run: Run) -> None:
    answer = run("call_order", fmu=fmu)
    assert answer["exit"] == 0
    assert answer["statuses"] == {
        "before initialization": DISCARD, "negative": DISCARD, "zero": DISCARD, "not finite": DISCARD, "good": OK,
        "late fixed parameter": DISCARD, "after it": OK, "late tunable parameter": OK, "after terminate": DISCARD,
        "string": [""], "unknown": [False],
    }
    assert answer["kept"] == 0.2
    texts = [text for _, _, text in answer["messages"]]
    assert any("before" in text and "initializ" in text for text in texts)
    assert any("input.inertia is a fixed parameter" in text for text in texts)


def test_trap_10_instances_leave_nothing_on_the_path_and_little_in_memory(fmu: Path, run: Run) -> None:
    answer = run("many_instances", fmu=fmu, count=150)
    assert answer["path"] == 0
    assert answer["left"] == []
    # pythonfmu's exporter itself leaves 7 to 22 kB per instance; a kernel that stayed alive would show on top
    assert answer["per_instance"] < 40e3


def test_trap_11_results_are_out_before_the_process_can_abort(fmu: Path, run: Run) -> None:
    # An abort at exit is rare and not ours to mend; what counts is that the answer was written before.
    answers = [run("run", fmu=fmu) for _ in range(3)]
    assert all(each["steps"] == answers[0]["steps"] for each in answers)
