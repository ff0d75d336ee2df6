"""`cardan.Instance`: values by name, steps, states and failures of any FMI 2.0 co-simulation FMU."""

from __future__ import annotations

import math
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from cardan import Instance
from cardan.description import Value
from cardan.errors import FmiError, FmuError, InputError, StepRefused

READ = ("input.angle", "input.speed", "output.angle", "output.speed", "shaft.torque")


def started(path: Path) -> Instance:
    """A driveline at 100 rad/s under 50 N.m, ready for steps."""
    instance = Instance(path)
    instance.set("initial.speed", 100.0)
    instance.setup(0.0, 1.0, 1e-9)
    instance.initialize()
    instance.set("input.torque", 50.0)
    return instance


def test_all_types_are_set_and_read_back_by_name(foreign_fmu: Path) -> None:
    values: dict[str, Value] = {"gain": 3.5, "count": -7, "ready": True, "label": "shaft \xf6"}
    with Instance(foreign_fmu) as instance:
        for name, value in values.items():
            instance.set(name, value)
        read = {name: instance.get(name) for name in values}
    assert read == values
    assert [type(value) for value in read.values()] == [float, int, bool, str]


def test_plans_exchange_what_names_do(fmu: Path) -> None:
    with started(fmu) as instance:
        inputs, outputs = instance.plan(["input.torque", "output.torque"]), instance.plan(READ)
        inputs.values[0], inputs.values[1] = 80.0, 30.0
        inputs.write()
        assert instance.get("output.torque") == 30.0
        instance.step(0.0, 1e-2)
        assert list(outputs.read()) == [instance.get(name) for name in READ]
        assert outputs.units == ("rad", "rad/s", "rad", "rad/s", "N.m")
        assert list(instance.plan([]).read()) == []


def test_units_come_from_the_description(fmu: Path) -> None:
    with Instance(fmu) as instance:
        about = instance.description
    assert about["input.speed"].unit == "rad/s"
    assert about["input.speed"].display_unit == "rpm"
    assert about["input.speed"].display_factor == pytest.approx(60.0 / (2.0 * math.pi), rel=1e-15)
    assert about.can_get_set_state
    assert about.can_serialize_state


@pytest.mark.parametrize(("name", "value", "said"), [
    ("input.torqe", 1.0, "input.torque"),  # the nearest name
    ("input.torque", "much", "input.torque = 'much'"),
    ("input.torque", True, "input.torque = True"),
    ("model.fidelity", 1.5, "model.fidelity = 1.5"),
    ("hold.restart", 2, "hold.restart = 2"),
])
def test_wrong_names_and_types_are_named(fmu: Path, name: str, value: object, said: str) -> None:
    with Instance(fmu) as instance, pytest.raises(InputError, match=said):
        instance.set(name, value)  # type: ignore[arg-type]


def test_a_plan_takes_real_variables_only(fmu: Path) -> None:
    with Instance(fmu) as instance, pytest.raises(InputError, match=r"solver\.steps is of type Integer"):
        instance.plan(["solver.steps"])


def test_a_refused_step_says_why_and_the_run_goes_on(fmu: Path) -> None:
    with started(fmu) as instance:
        instance.step(0.0, 1e-3)
        before = instance.serialize()
        instance.set("input.torque", math.nan)
        with pytest.raises(StepRefused, match=r"input\.torque = nan") as caught:
            instance.step(1e-3, 1e-3)
        assert (caught.value.time, caught.value.size, caught.value.status) == (1e-3, 1e-3, 2)
        instance.set("input.torque", 50.0)
        assert instance.serialize() == before
        instance.step(1e-3, 1e-3)
        with pytest.raises(StepRefused, match="step of -1") as caught:
            instance.step(2e-3, -1.0)
        assert "nan" not in caught.value.text  # the present reason, not an old one


def test_bad_start_values_are_told_at_initialization(fmu: Path) -> None:
    with Instance(fmu) as instance:
        instance.set("input.inertia", -1.0)
        instance.setup()
        with pytest.raises(FmiError, match=r"input\.inertia = -1"):
            instance.initialize()


def test_states_restore_bit_for_bit(fmu: Path) -> None:
    with started(fmu) as instance, started(fmu) as other:
        plan = instance.plan(READ)
        instance.step(0.0, 1e-3)
        state, data = instance.get_state(), instance.serialize()
        instance.step(1e-3, 2e-3)
        first = list(plan.read())
        instance.set_state(state)
        instance.step(1e-3, 2e-3)
        again = list(plan.read())
        instance.free_state(state)
        instance.free_state(state)  # a second time does nothing
        other.deserialize(data)
        other.step(1e-3, 2e-3)
        assert first == again == list(other.plan(READ).read())


def test_reset_brings_the_start_back(fmu: Path) -> None:
    with started(fmu) as instance:
        instance.get_state()
        instance.step(0.0, 1e-2)
        instance.reset()
        instance.setup()
        instance.initialize()
        assert instance.get("input.speed") == 0.0


def test_an_fmu_without_states_says_so(foreign_fmu: Path) -> None:
    with Instance(foreign_fmu) as instance:
        assert not instance.description.can_get_set_state


def test_a_foreign_fmu_runs_and_its_words_arrive(foreign_fmu: Path) -> None:
    with Instance(foreign_fmu) as instance:
        instance.set("limit", 0.5)
        instance.setup()
        instance.initialize()
        instance.step(0.0, 0.5)
        assert instance.get("y") == 1.0
        with pytest.raises(StepRefused, match=r"y = 1\.0 is above limit = 0\.5"):
            instance.step(0.5, 0.5)


def test_a_fatal_error_does_not_take_the_process_along(foreign_fmu: Path) -> None:
    """Freeing a Python FMU after fmi2Fatal crashes the host (docs/FMI.md, trap 3): it must be left alone."""
    code = f"""
import os
from cardan import Instance
from cardan.errors import FmuError, StepRefused
with Instance({str(foreign_fmu)!r}) as instance:
    instance.set("count", 13)
    plan = instance.plan(["y"])
    instance.setup()
    instance.initialize()
    for use in (lambda: instance.step(0.0, 0.1), instance.reset, lambda: instance.step(0.0, 0.1), instance.get_state,
                lambda: plan.read()):
        try:
            use()
        except (FmuError, StepRefused) as error:
            print(type(error).__name__, error)
print("alive", flush=True)
os._exit(0)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("StepRefused fmi2DoStep returned fatal")
    assert "thirteen" in done.stdout
    assert done.stdout.count("the instance is unusable after a fatal error") == 4
    assert done.stdout.endswith("alive\n")


def test_a_closed_instance_refuses_and_leaves_nothing_behind(fmu: Path, tmp_path: Path,
                                                            monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    paths = list(sys.path)

    def fail(instance: Instance) -> None:
        with instance:
            assert len(list(tmp_path.iterdir())) == 1
            raise ZeroDivisionError

    instance = started(fmu)
    with pytest.raises(ZeroDivisionError):
        fail(instance)
    instance.close()
    assert list(tmp_path.iterdir()) == []
    assert sys.path == paths
    for use in (lambda: instance.get("input.speed"), lambda: instance.step(0.0, 1e-3), instance.get_state):
        with pytest.raises(FmuError, match="closed"):
            use()


@pytest.mark.parametrize("name", ["plus+hash#", "per cent%", "semi;colon", "\N{LATIN SMALL LETTER E WITH ACUTE}t\xe9"])
def test_odd_temporary_directories_are_avoided(fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                              name: str) -> None:
    """Trap 8 of docs/FMI.md: an FMU unpacked below such a path crashes the process at load."""
    odd = tmp_path / name
    odd.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(odd))
    here = os.getcwd()
    with started(fmu) as instance:
        instance.step(0.0, 1e-3)
        assert list(odd.iterdir()) == []
    assert os.getcwd() == here


def test_instances_of_one_process_do_not_see_each_other(fmu: Path) -> None:
    with started(fmu) as one, started(fmu) as other:
        one.step(0.0, 1e-2)
        other.set("output.torque", math.inf)
        with pytest.raises(StepRefused):
            other.step(0.0, 1e-2)
        assert other.get("input.speed") == 100.0
        assert float(one.get("input.speed")) > 100.0
        assert not [message for message in one.messages if message.status > 1]
        assert [message for message in other.messages if message.status > 1]


def test_instances_load_in_threads(fmu: Path) -> None:
    """FMPy changes the working directory while it loads (trap 13)."""
    here = os.getcwd()

    def run(torque: float) -> float:
        with started(fmu) as instance:
            instance.set("input.torque", torque)
            for i in range(20):
                instance.step(i * 1e-3, 1e-3)
            return float(instance.get("input.speed"))

    torques = [10.0 * i for i in range(8)]
    with ThreadPoolExecutor(4) as pool:
        parallel = list(pool.map(run, torques))
    assert parallel == [run(torque) for torque in torques]
    assert os.getcwd() == here


def test_a_foreign_fmu_leaves_the_hosts_modules_alone(foreign_fmu: Path) -> None:
    """Trap 1 of docs/FMI.md: an FMU's modules take the place of the host's of the same name."""
    sys.modules.pop("pythonfmu", None)
    with Instance(foreign_fmu) as instance:
        instance.setup()
        assert not Path(str(sys.modules["pythonfmu"].__file__)).is_relative_to(Path(sys.prefix))
    assert "pythonfmu" not in sys.modules
    import pythonfmu

    assert Path(pythonfmu.__file__).is_file()
