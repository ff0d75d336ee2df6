"""Results: figures, files of three formats, tables, pictures."""

from __future__ import annotations

import dataclasses
import json
import math
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from cardan import Result
from cardan.errors import InputError
from cardan.plots import panels_of
from cardan.result import RunInfo
from cardan.storage import writable_problems

mpl.use("Agg")


@pytest.fixture
def result() -> Result:
    """Two points per second; values that no short decimal gives."""
    time = np.array([0.0, 0.1, 0.30000000000000004])
    columns = {"input.speed": np.array([0.0, 1.0 / 3.0, 1e-300]), "ratio": np.array([1.0, math.pi, -math.e])}
    info = RunInfo(title='a "title", with commas', scene={"scene": {"stop_time": "0.3 s"}, "load": {}},
                   completed=False, message="stopped", reached_time=0.3, coupling="held", steps=2, kernel="compiled",
                   energy_residual=1e-9, communication_step=0.1, start_time=0.0, stop_time=1.0, wall_time=0.1,
                   processor_time=0.1, loading_time=0.2, real_time_factor=3.0, energy_supplied=1.0, energy_taken=0.5,
                   fmu={"file": "x.fmu", "sha256": "00"}, versions={"python": "3"})
    return Result(time, columns, {"input.speed": "rad/s", "ratio": "1"}, info, {"input.speed": ("rpm", 30.0 / math.pi)})


@pytest.mark.parametrize("suffix", [".csv", ".parquet", ".nc"])
def test_what_is_saved_is_loaded(result: Result, tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"run{suffix}"
    result.save(path)
    again = Result.load(path)
    assert again.time.tobytes() == result.time.tobytes()
    assert list(again.columns) == list(result.columns)
    for name, values in result.columns.items():
        assert again[name].tobytes() == values.tobytes()
    assert again.units == result.units
    assert again.display == result.display
    assert again.info == result.info
    files = {path.name, "run.meta.json"} if suffix == ".csv" else {path.name}
    assert {entry.name for entry in tmp_path.iterdir()} == files  # and no temporary file


def test_csv_says_units_in_its_header(result: Result, tmp_path: Path) -> None:
    result.save(tmp_path / "run.csv")
    lines = (tmp_path / "run.csv").read_text().splitlines()
    assert lines[0] == "time [s],input.speed [rad/s],ratio [1]"
    assert lines[2] == "0.1,0.3333333333333333,3.141592653589793"
    about = json.loads((tmp_path / "run.meta.json").read_text())
    assert about["info"]["message"] == "stopped"


def test_csv_of_other_origin_has_columns_and_units(tmp_path: Path) -> None:
    path = tmp_path / "plain.csv"
    path.write_text("time [s],output.torque [N.m]\n0,1\n0.5,2\n")
    loaded = Result.load(path)
    assert loaded["output.torque"].tolist() == [1.0, 2.0]
    assert loaded.units == {"output.torque": "N.m"}
    assert loaded.info.reached_time == 0.5


def test_netcdf_variables_carry_units(result: Result, tmp_path: Path) -> None:
    from scipy.io import netcdf_file

    result.save(tmp_path / "run.nc")
    with netcdf_file(tmp_path / "run.nc", "r", mmap=False) as file:
        assert {name: variable.units for name, variable in file.variables.items()} == {
            "time": b"s", "input.speed": b"rad/s", "ratio": b"1"}


def test_parquet_fields_carry_units(result: Result, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    result.save(tmp_path / "run.parquet")
    schema = parquet.read_schema(tmp_path / "run.parquet")
    assert {field.name: field.metadata[b"unit"] for field in schema} == {
        "time": b"s", "input.speed": b"rad/s", "ratio": b"1"}


@pytest.mark.parametrize("name", ["run.xlsx", "run", "none/run.csv"])
def test_bad_places_are_told_before_and_after(result: Result, tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    assert len(writable_problems(path, (".csv",))) == 1
    with pytest.raises(InputError, match=path.name):
        result.save(path)
    assert list(tmp_path.iterdir()) == []


def test_a_failed_write_keeps_the_old_file(result: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "run.parquet"
    path.write_text("old")

    def full(*arguments: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pyarrow.parquet.write_table", full)
    with pytest.raises(InputError, match="No space left"):
        result.save(path)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(("name", "content", "said"), [
    ("missing.csv", None, "does not exist"),
    ("text.csv", b"hello\nworld\n", "no result file"),
    ("text.parquet", b"hello", "no result file"),
    ("text.nc", b"hello", "no result file"),
    ("text.dat", b"hello", "unknown ending"),
])
def test_files_that_are_no_results(tmp_path: Path, name: str, content: bytes | None, said: str) -> None:
    path = tmp_path / name
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(InputError, match=said):
        Result.load(path)


def test_figures_are_means_over_time(result: Result) -> None:
    figures = result.figures()["ratio"]
    area = 0.1 * (1.0 + math.pi) / 2.0 + 0.2 * (math.pi - math.e) / 2.0
    assert figures["mean"] == pytest.approx(area / 0.3, rel=1e-14)
    assert (figures["min"], figures["max"], figures["final"]) == (-math.e, math.pi, -math.e)


def test_summary_is_json(result: Result) -> None:
    result.columns["ratio"][1] = math.nan
    summary = json.loads(json.dumps(result.summary(), allow_nan=False))
    assert summary["figures"]["ratio"]["mean"] is None
    assert summary["figures"]["input.speed"]["unit"] == "rad/s"
    assert (summary["completed"], summary["message"], summary["kernel"]) == (False, "stopped", "compiled")


def test_data_frames_have_units(result: Result) -> None:
    frame = result.to_pandas()
    assert list(frame.columns) == ["input.speed", "ratio"]
    assert frame.index.to_numpy().tolist() == result.time.tolist()
    assert frame.attrs["units"] == {"time": "s", "input.speed": "rad/s", "ratio": "1"}
    assert list(result.to_pandas(units=True).columns) == ["input.speed [rad/s]", "ratio [1]"]


def test_unknown_columns_are_told_with_the_known_ones(result: Result) -> None:
    with pytest.raises(KeyError, match=r"'output.speed' was not recorded; recorded are input.speed, ratio"):
        result["output.speed"]


def test_text_is_short(result: Result) -> None:
    lines = str(result).splitlines()
    assert len(lines) == 2 + len(result.columns)
    assert "ended at 0.3 s: stopped" in lines[0]


def test_panels_show_familiar_units() -> None:
    time = np.linspace(0.0, 1.0, 5)
    units = {"energy.residual": "J", "vehicle.speed": "m/s", "driver.target_speed": "m/s", "gearbox.gear": "1",
             "input.speed": "rad/s", "engine.speed": "rad/s", "input.angle": "rad", "driver.brake": "1"}
    result = Result(time, {name: 20.0 * time for name in units}, units, display={"input.angle": ("deg", 180 / math.pi)})
    panels = panels_of(result)
    assert {unit: [line.name for line in lines] for unit, lines in panels.items()} == {
        "km/h": ["vehicle.speed", "driver.target_speed"], "pedal": ["driver.brake"], "gear": ["gearbox.gear"],
        "rpm": ["input.speed", "engine.speed"], "turns": ["input.angle"]}
    assert panels["rpm"][0].values[-1] == pytest.approx(20.0 * 30.0 / math.pi)
    assert panels["turns"][0].values[-1] == pytest.approx(10.0 / math.pi)


@pytest.mark.parametrize("suffix", [".png", ".svg", ".pdf"])
def test_pictures_have_titles_and_units(result: Result, tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"run{suffix}"
    figure = result.plot(path)
    assert path.stat().st_size > 1000
    assert figure.get_suptitle() == result.info.title
    assert [axis.get_ylabel() for axis in figure.axes] == ["Speed [rpm]", "Ratio [1]"]
    assert figure.axes[-1].get_xlabel() == "Time [s]"
    assert "ended early" in figure.axes[0].get_title("right")


def test_fast_swings_are_drawn_as_bands(tmp_path: Path) -> None:
    """20 000 points of 5 000 periods: no line can show them, a filled band does."""
    time = np.linspace(0.0, 1.0, 20001)
    fast = np.sin(2.0 * math.pi * 5000.3 * time)
    slow = np.sin(2.0 * math.pi * 3.0 * time)
    result = Result(time, {"shaft.torque": fast, "shaft.twist": slow}, {"shaft.torque": "N.m", "shaft.twist": "rad"})
    torque, twist = result.plot(tmp_path / "x.png").axes
    assert np.isnan(torque.lines[0].get_ydata()).all()
    assert not np.isnan(twist.lines[0].get_ydata()).any()
    assert torque.collections[0].get_paths()[0].get_extents().height == pytest.approx(2.0, rel=0.05)


def test_a_write_protected_file_is_refused_beforehand(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "run.csv"
    path.write_text("kept")
    monkeypatch.setattr("os.access", lambda *_: False)  # root may write to all
    assert "write-protected" in writable_problems(path, (".csv",))[0]
    assert writable_problems(tmp_path / "new.csv", (".csv",)) == []


def test_dollars_in_a_title_are_no_formula(result: Result, tmp_path: Path) -> None:
    info = dataclasses.replace(result.info, title=r"from $5 to $\nonsense{6$")
    dataclasses.replace(result, info=info).plot(tmp_path / "run.svg")
    assert r"from $5 to $\nonsense{6$" in (tmp_path / "run.svg").read_text()
