"""Variational equations of the kernel: both kernels to the last bit, against differences, laws and symmetry."""

import math
import struct

import cardan_kernel
import pytest
from cardan_kernel import Driveline
from cardan_kernel.bundle import Bundle
from cardan_kernel.variation import Variation

VALUES = {"joint1.angle": 0.4, "joint2.angle": 0.3, "shaft.yoke_phase": 0.2, "shaft.damping": 3.0,
          "output.damping": 0.1, "joint1.cross.inertia_a": 1e-3, "joint1.cross.inertia_b": 2e-3,
          "joint2.trunnion.damping_a": 0.05, "shaft.stiffness": 5e3}
STATE = (0.3, 0.01, 60.0, 61.0)


def bundle(kind=Bundle, **changes):
    line = Driveline()
    for name, value in {**VALUES, **changes}.items():
        line.set(name, value)
    return kind(line.get_state())


def kinds():
    """Pairs of classes: interpreted, and compiled where it was built."""
    found = [(Bundle, Variation)]
    if cardan_kernel.Compiled is not None:
        from cardan_kernel._compiled import Bundle as CompiledBundle
        from cardan_kernel._compiled import Variation as CompiledVariation

        found.append((CompiledBundle, CompiledVariation))
    return found


def moved(kind, law, span, columns=(0, 1, 2, 3, 4, 5), start=STATE, **changes):
    made = bundle(kind[0], **changes)
    for output in (False, True):
        made.load(output, *law[output][:3])
        if len(law[output]) > 3:
            made.load_series(output, *law[output][3:])
    variation = kind[1](made)
    variation.start(*start, columns)
    assert variation.run(span) == 0
    return variation


PLAIN = ((20.0, -0.1, 0.0), (5.0, 0.2, 1e-3))
SERIES = ((20.0, 0.0, 0.0, 2.0, [1.0, 3.0, -2.0, 0.5, 0.1], [0.01, 0.02, -0.01, 0.0, 0.0]), (0.0, 0.1, 0.0))


@pytest.mark.parametrize("law", [PLAIN, SERIES])
@pytest.mark.parametrize("changes", [{}, {"model.fidelity": 1}, {"model.drive": 1}])
def test_compiled_equals_interpreted_to_the_last_bit(law, changes):
    if len(kinds()) == 1:
        pytest.skip("the compiled kernel was not built: no C compiler at installation")
    one, other = (moved(kind, law, 0.05, **changes) for kind in kinds())
    assert struct.pack("28d", *one.values()) == struct.pack("28d", *other.values())
    assert struct.pack("28d", *one.rates()) == struct.pack("28d", *other.rates())
    assert (one.rotation, one.steps) == (other.rotation, other.steps)


@pytest.mark.parametrize("law", [PLAIN, SERIES])
def test_fields_of_both_kernels_and_of_the_driveline(law):
    point = [*STATE, 12.0, -0.1, 0.7, 9.0, 0.2]
    found = []
    for kind, _ in kinds():
        from array import array

        points, values = array("d", point), array("d", bytes(8 * 152))
        bundle(kind).fields(memoryview(points), memoryview(values), 1)
        found.append(values.tobytes())
    assert len(set(found)) == 1


@pytest.mark.parametrize("law", [PLAIN, SERIES])
@pytest.mark.parametrize("changes", [{}, {"model.fidelity": 1}])
def test_columns_are_the_derivatives_of_the_motion(law, changes):
    # central differences of fourth order of the motion itself, about 1e-9 of the largest
    kind = kinds()[-1]
    span = 0.02
    exact = moved(kind, law, span, **changes).values()
    rigid = "model.fidelity" in changes
    for j, size in enumerate((1e-3, 1e-3, 0.1, 0.1)):
        if rigid and j in (1, 3):
            continue
        ends = []
        for step in (1, -1, 2, -2):
            start = list(STATE)
            start[j] += step * size
            ends.append(moved(kind, law, span, (), start, **changes).values()[:4])
        column = exact[4 + 4 * j:8 + 4 * j]
        scale = max(abs(v) for v in column)
        for i in range(4):
            slope = (8.0 * (ends[0][i] - ends[1][i]) - (ends[2][i] - ends[3][i])) / (12.0 * size)
            assert column[i] == pytest.approx(slope, abs=2e-8 * scale), (i, j)


def test_forced_columns_are_the_derivatives_by_constant_torques():
    kind = kinds()[-1]
    exact = moved(kind, PLAIN, 0.02).values()
    for side, place in ((False, 20), (True, 24)):
        ends = []
        for step in (1, -1):
            law = [list(PLAIN[0]), list(PLAIN[1])]
            law[side][0] += 0.5 * step
            ends.append(moved(kind, law, 0.02, ()).values()[:4])
        for i in range(4):
            slope = ends[0][i] - ends[1][i]
            assert exact[place + i] == pytest.approx(slope, rel=1e-6, abs=1e-12)


def test_a_series_stands_for_a_law():
    # T = 2 + 3 cos 2p + (0.1 - 0.05 sin 2p) w, once as a series and once split between both parts
    kind = kinds()[-1]
    whole = ((0.0, 0.0, 0.0, 2.0, [2.0, 3.0, 0.0], [0.1, 0.0, -0.05]), (0.0, 0.0, 0.0))
    split = ((1.5, 0.07, 0.0, 2.0, [0.5, 3.0, 0.0], [0.03, 0.0, -0.05]), (0.0, 0.0, 0.0))
    one, other = (moved(kind, law, 0.1).values() for law in (whole, split))
    assert one == pytest.approx(other, rel=1e-11, abs=1e-11)


def test_volume_of_the_fundamental_matrix_obeys_liouville():
    # without damping and laws det X = (m1 m2 at the start) / (m1 m2 at the end); over a period it is 1
    kind = kinds()[-1]
    nothing = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    still = {name: 0.0 for name in ("shaft.damping", "output.damping", "joint2.trunnion.damping_a")}
    same = {"joint2.angle": 0.4, "shaft.yoke_phase": 0.0, "joint1.cross.inertia_a": 0.0, "joint1.cross.inertia_b": 0.0,
            "shaft.inertia_a": 0.0, "shaft.inertia_b": 0.0, "model.drive": 1}
    w = 50.0
    y = moved(kind, nothing, math.pi / w, (1, 3), (0.0, 0.0, w, w / math.cos(0.4)), **still, **same).values()
    assert y[1] == pytest.approx(0.0, abs=1e-13)  # homokinetic: the uniform motion is exact
    assert y[5] * y[11] - y[7] * y[9] == pytest.approx(1.0, abs=1e-12)


def test_an_impossible_run_is_told():
    for kind in kinds():
        variation = kind[1](bundle(kind[0]))
        variation.start(0.0, 0.0, math.inf, 0.0, (1,))
        assert variation.run(1.0) == 2
        variation.start(*STATE, (1,))
        variation.most_steps = 10.0
        assert variation.run(100.0) == 3
