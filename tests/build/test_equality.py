"""The FMU is the kernel: same numbers to the last bit, compiled or not, in a process that knows no repository."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cardan_kernel
import pytest
from cardan_build.sources import find_package

Run = Callable[..., dict[str, Any]]


def kernels() -> list[str]:
    return ["Interpreted"] + ["Compiled"] * (cardan_kernel.Compiled is not None)


@pytest.mark.parametrize("which", kernels())
def test_fmu_equals_the_kernel_to_the_last_bit(which: str, fmu: Path, run: Run) -> None:
    path = [str(find_package("cardan_kernel").parent)]
    kernel = run("run_kernel", isolated=False, which=which, path=path)
    through_fmi = run("run", fmu=fmu)
    assert through_fmi["first"] == kernel["first"]
    assert through_fmi["steps"] == kernel["steps"]
    assert all(step[0] == 0 for step in kernel["steps"])


def test_portable_fmu_has_no_binary_kernel_and_gives_the_same_numbers(fmu: Path, portable_fmu: Path, run: Run) -> None:
    with zipfile.ZipFile(portable_fmu) as archive:
        inside = [name for name in archive.namelist() if name.startswith("resources/")]
    assert all(name.endswith((".py", "slavemodule.txt")) for name in inside), inside
    interpreted, default = run("run", fmu=portable_fmu), run("run", fmu=fmu)
    assert interpreted["steps"] == default["steps"]
    assert ": interpreted kernel" in interpreted["messages"][0][2]


def test_the_first_message_tells_which_kernel_runs(fmu: Path, run: Run) -> None:
    status, category, text = run("run", fmu=fmu)["messages"][0]
    assert (status, category) == (0, "logAll")
    assert text.startswith(f"cardan_kernel {cardan_kernel.__version__}: {cardan_kernel.KERNEL} kernel")
