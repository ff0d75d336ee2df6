"""``cardan bench`` in a process of its own."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

COMMAND = [sys.executable, "-c", "from cardan.cli import main; main()", "bench"]


def run(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([*COMMAND, *arguments], cwd=folder, text=True, capture_output=True, check=False, timeout=300)


def test_a_section_alone_as_json_and_files(tmp_path: Path) -> None:
    done = run(tmp_path, "--only", "fidelity", "--quick", "--json", "-o", "out")
    assert done.returncode == 0, done.stderr
    answer = json.loads(done.stdout)
    assert set(answer) == {"made_by", "tables", "files", "targets"}
    assert set(answer["tables"]) == {"fidelity", "exchange"}
    for record in answer["tables"]["fidelity"]:
        assert record["fmu_us"] > record["kernel_us"] > 0.0
    assert [record["outputs"] for record in answer["tables"]["exchange"]][:3] == [0, 1, 2]
    assert answer["made_by"]["quick"] is True
    assert {path.name for path in (tmp_path / "out").iterdir()} == {Path(name).name for name in answer["files"]}
    assert "times the compliant one" in (tmp_path / "out" / "report.md").read_text()


def test_what_is_asked_wrongly_costs_no_measurement(tmp_path: Path) -> None:
    done = run(tmp_path, "--only", "speed,peers", "--json")
    assert done.returncode == 2
    assert "--only speed: no such section" in done.stderr
    assert json.loads(done.stdout)["errors"]
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "file").write_text("kept")
    done = run(tmp_path, "--only", "hard", "-o", "file")
    assert done.returncode == 2
    assert "file cannot be made a directory" in done.stderr
    assert (tmp_path / "file").read_text() == "kept"
