"""Results against reference files in the form of the FMI cross-check rules."""

from __future__ import annotations

import math
import subprocess
import sys
from pathlib import Path

import pytest
from cardan.check import Options, check_fmu, export_reference
from cardan.check.cross_check_files import Signals, read_options, read_signals
from cardan.check.report import Outcome
from cardan.errors import FmiError, InputError

from .conftest import Make

OPT = "StartTime, 0.0   // in seconds\nStopTime, 1.0\nStepSize, 0.01\nRelTol, 0.0001\nSolverType, FixedStep\n"


@pytest.fixture(scope="module")
def exported(good: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("reference") / "made"
    files = export_reference(good, directory)
    assert [path.name for path in files] == ["Lag_in.csv", "Lag_ref.csv", "Lag_ref.opt"]
    return directory


def compare(fmu: Path, directory: Path) -> Outcome:
    return check_fmu(fmu, only=["reference"], options=Options(reference=str(directory)))["reference"]


def copied(source: Path, target: Path, name: str = "", old: str = "", new: str = "") -> Path:
    """Copy reference files, one of them with a text replaced."""
    for path in source.iterdir():
        text = path.read_text()
        if path.name == name:
            assert text.count(old) == 1
            text = text.replace(old, new)
        (target / path.name).write_text(text)
    return target


def test_exported_files_keep_to_the_rules(exported: Path) -> None:
    from fmpy.util import read_csv, read_ref_opt_file

    options = read_ref_opt_file(exported / "Lag_ref.opt")
    assert (options["StartTime"], options["StopTime"], options["StepSize"]) == (0.0, 2.0, 0.01)
    results, inputs = read_csv(exported / "Lag_ref.csv"), read_csv(exported / "Lag_in.csv")
    assert results.dtype.names == ("time", "y")
    assert inputs.dtype.names == ("time", "u")
    assert results["time"][0] == 0.0 and results["time"][-1] == 2.0
    assert len(results) == 201
    assert all(path.stat().st_size < 1e6 for path in exported.iterdir())


def test_the_same_fmu_gives_the_same_results(good: Path, exported: Path) -> None:
    outcome = compare(good, exported)
    assert outcome.status == "passed", outcome
    assert outcome.figures["largest deviation"][0] == 0.0


def test_fmpy_gives_them_too(good: Path, exported: Path) -> None:
    """In a process of its own: one that ran a Python FMU may abort at its end (docs/FMI.md, trap 11)."""
    code = (
        "from fmpy import simulate_fmu\n"
        "from fmpy.util import read_csv\n"
        f"result = simulate_fmu({str(good)!r}, stop_time=2.0, step_size=0.01, output_interval=0.01, output=['y'],\n"
        f"                      relative_tolerance=1e-9, input=read_csv({str(exported / 'Lag_in.csv')!r}))\n"
        f"print(abs(result['y'] - read_csv({str(exported / 'Lag_ref.csv')!r})['y']).max(), flush=True)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert float(done.stdout) < 1e-12, done.stderr


def test_files_beside_the_fmu_are_found(good: Path, exported: Path, tmp_path: Path) -> None:
    (tmp_path / "Other.fmu").write_bytes(good.read_bytes())
    for path in exported.iterdir():  # named after the model identifier
        (tmp_path / path.name).write_bytes(path.read_bytes())
    outcome = check_fmu(tmp_path / "Other.fmu", only=["reference"])["reference"]
    assert outcome.status == "passed"
    assert str(tmp_path / "Lag_ref.csv") in outcome.remarks[0]


def test_another_fmu_is_found_out(lag: Make, exported: Path) -> None:
    outcome = compare(lag({"goal = gain * u": "goal = 1.000001 * gain * u"}), exported)
    assert outcome.status == "failed"
    assert outcome.problems[0].startswith("y = ") and "of 201 samples are off" in outcome.problems[0]
    assert 1e-7 < outcome.figures["largest deviation"][0] < 1e-5


def test_one_wrong_sample_is_found_out(good: Path, exported: Path, tmp_path: Path) -> None:
    line = (exported / "Lag_ref.csv").read_text().splitlines()[100]
    time, value = line.split(",")
    directory = copied(exported, tmp_path, "Lag_ref.csv", f"\n{line}\n", f"\n{time},{float(value) + 1.0!r}\n")
    outcome = compare(good, directory)
    assert outcome.status == "failed"
    assert "1 of 201 samples" in outcome.problems[0]


def test_a_reference_of_another_tool(good: Path, tmp_path: Path) -> None:
    """The exact solution for u = 0: y = exp(-t/T), rounded, at other times than the communication points."""
    rows = [f"{t:.4f},{math.exp(-t / 0.05):.6f}" for t in (i / 128 for i in range(129))]
    (tmp_path / "Lag_ref.csv").write_text("\n".join(['"time","y"', *rows]) + "\n")
    (tmp_path / "Lag_ref.opt").write_text(OPT)
    assert compare(good, tmp_path).status == "passed"
    wrong = [row.replace(",0.", ",0.1") for row in rows]
    (tmp_path / "Lag_ref.csv").write_text("\n".join(['"time","y"', *wrong]) + "\n")
    assert compare(good, tmp_path).status == "failed"


def test_a_variable_that_the_fmu_does_not_have(good: Path, exported: Path, tmp_path: Path) -> None:
    outcome = compare(good, copied(exported, tmp_path, "Lag_ref.csv", '"y"', '"z"'))
    assert outcome.status == "failed"
    assert "variables that the FMU does not have: z" in outcome.problems[0]


@pytest.mark.parametrize(("name", "old", "new", "said"), [
    ("Lag_ref.csv", "\n0.02,", "\nzero,", "Lag_ref.csv, line 4: 'zero' is no number"),
    ("Lag_ref.csv", "\n0.02,", "\n0.02,1,", "line 4: 3 numbers for 2 names"),
    ("Lag_in.csv", "\n0.02,", "\n0.001,", "line 4: the time goes back"),
    ("Lag_ref.opt", "RelTol", "Tol", "lacks RelTol"),
    ("Lag_ref.opt", "StopTime, 2.0", "StopTime, -1", "StopTime has to be after StartTime"),
])
def test_files_that_cannot_be_read(name: str, old: str, new: str, said: str, good: Path, exported: Path,
                                   tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        compare(good, copied(exported, tmp_path, name, old, new))
    assert said in str(caught.value)


def test_options_have_to_be_there(good: Path, exported: Path, tmp_path: Path) -> None:
    (copied(exported, tmp_path) / "Lag_ref.opt").unlink()
    with pytest.raises(InputError, match=r"Lag_ref\.opt is missing"):
        compare(good, tmp_path)


def test_an_export_that_fails_writes_nothing(lag: Make, tmp_path: Path) -> None:
    fmu = lag({"        u, gain, lag, _, y": "        import os\n        os._exit(3)\n        u, gain, lag, _, y"})
    with pytest.raises(FmiError, match="fmi2DoStep"):
        export_reference(fmu, tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_signals_jump_and_are_interpolated(tmp_path: Path) -> None:
    path = tmp_path / "x_in.csv"
    path.write_text('"time","a"\n0,1\n1,3\n1,7\n2,9\n')
    signals = read_signals(path)
    assert [signals.at("a", t, linear=True) for t in (-1.0, 0.0, 0.5, 1.0, 1.5, 2.0, 3.0)] == [1, 1, 2, 7, 8, 9, 9]
    assert [signals.at("a", t, linear=False) for t in (0.5, 0.999, 1.0, 1.5)] == [1, 1, 7, 7]
    assert Signals([0.0], {"a": [2.0]}).at("a", 5.0, linear=True) == 2.0


def test_options_pass_over_comments_and_texts(tmp_path: Path) -> None:
    (tmp_path / "x.opt").write_text(OPT)
    assert read_options(tmp_path / "x.opt") == {"StartTime": 0.0, "StopTime": 1.0, "StepSize": 0.01, "RelTol": 1e-4}
