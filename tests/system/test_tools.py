"""System packages in other tools, against ``cardan simulate`` with ``coupling = "held"``.

At a communication point ``held`` takes the shafts' motion and works out the torques for it. Ecos, libcosim and FMPy
read a part's outputs right after its step, before it has the new motion, and send them on: a torque that follows the
speed at once arrives one step late. That is the whole difference, so it is of first order in the step, and it is absent
where a torque depends on time and states alone. FMPy also sends zeros in the first step.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from system.conftest import Packaged
from system.in_order import play
from system.scenes import ALL, OUTPUTS

TOOLS = ("ecos", "libcosim", "fmpy")
NAMES = [f"driveline.{name}" for name in OUTPUTS]
Run = Callable[[str, Path, float, int, list[str]], NDArray[np.float64]]


def differences(rows: NDArray[np.float64], packaged: tuple) -> NDArray[np.float64]:
    """Largest difference of each output, relative to its largest value, after every step."""
    _, _, result = packaged
    expected = np.column_stack([result[name] for name in OUTPUTS])[1:]
    assert rows.shape == expected.shape
    return np.abs(rows - expected).max(axis=0) / np.abs(expected).max(axis=0)


@pytest.mark.parametrize("tool", TOOLS)
def test_same_result_where_values_are_exchanged_in_the_same_order(tool: str, packaged: Packaged, run_in: Run) -> None:
    made = packaged("without_feedthrough")
    assert np.ptp(made[2]["input.speed"]) > 5.0  # something happens
    assert differences(run_in(tool, made[0], 1e-3, 400, NAMES), made).max() < 1e-9


@pytest.mark.parametrize("tool", ["ecos", "libcosim"])
def test_a_prescribed_speed_and_a_jump_are_exchanged_in_the_same_order(tool: str, packaged: Packaged,
                                                                       run_in: Run) -> None:
    made = packaged("prescribed")
    assert differences(run_in(tool, made[0], 1e-3, 400, NAMES), made).max() < 1e-9


@pytest.mark.parametrize("name", ["feedthrough", "driven"])
@pytest.mark.parametrize("tool", TOOLS)
def test_elsewhere_the_difference_shrinks_at_first_order(tool: str, name: str, packaged: Packaged,
                                                         run_in: Run) -> None:
    coarse, fine = packaged(name, 5e-4), packaged(name, 2.5e-4)
    first = differences(run_in(tool, coarse[0], 5e-4, 800, NAMES), coarse)
    second = differences(run_in(tool, fine[0], 2.5e-4, 1600, NAMES), fine)
    assert first.max() < 0.1
    orders = np.log2(first / second)
    assert np.abs(orders - 1.0).max() < 0.2, orders  # what is left of the second order


def test_what_fmpy_starts_with_fades_at_first_order(packaged: Packaged, run_in: Run) -> None:
    # zero instead of the prescribed speed in the first step: a wrong first point, and a jolt as long as the step
    found = []
    for step, count in ((5e-4, 800), (2.5e-4, 1600)):
        ssp, _, result = packaged("prescribed", step)
        rows = run_in("fmpy", ssp, step, count, NAMES)
        assert rows[0, OUTPUTS.index("input.speed")] == 0.0
        expected = np.column_stack([result[name] for name in OUTPUTS])[1:]
        found.append(np.abs(rows - expected)[1:].max(axis=0)[[0, 2, 3]])  # the input speed itself is right again
    orders = np.log2(found[0] / found[1])
    assert np.abs(orders - 1.0).max() < 0.2, orders


@pytest.mark.parametrize("name", [name for name in ALL if name != "driven"])
def test_a_tool_that_resolves_feedthrough_gives_the_same_result(name: str, packaged: Packaged, tmp_path: Path) -> None:
    made = packaged(name)
    rows = np.array(play(made[0], tmp_path, 1e-3, 400, tuple(NAMES)))
    expected = np.column_stack([made[2][each] for each in OUTPUTS])
    assert np.abs(rows - expected).max() / np.abs(expected).max() < 1e-12
    assert differences(rows[1:], made).max() < 1e-9


def test_pedals_that_move_straight_within_a_step_cost_second_order(packaged: Packaged, tmp_path: Path) -> None:
    # cardan integrates driver and engine together; between two parts the pedals go with value and rate
    found = []
    for step, count in ((4e-3, 100), (2e-3, 200)):
        made = packaged("driven", step)
        folder = tmp_path / str(count)
        folder.mkdir()
        rows = np.array(play(made[0], folder, step, count, tuple(NAMES)))
        found.append(differences(rows[1:], made)[:3])
    assert found[0].max() < 1e-4
    assert np.all(found[0] / found[1] > 3.0), found


def test_gears_shift_in_the_scene_that_is_to_show_it(packaged: Packaged, tmp_path: Path) -> None:
    made = packaged("gearbox")
    gears = np.array(play(made[0], tmp_path, 1e-3, 400, ("engine.gearbox.gear",)))[:, 0]
    assert set(gears) >= {1.0, 2.0}
