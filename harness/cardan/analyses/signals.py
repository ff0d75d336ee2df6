"""Names and units of the inputs and outputs that a linearization can have."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from cardan.errors import InputError


def output_units() -> dict[str, str]:
    """Return the outputs of the kernel's Jacobians with their units, in their order."""
    from cardan_kernel import INDEX, JACOBIAN_OUTPUTS, VARIABLES

    return {name: VARIABLES[INDEX[name]].unit for name in JACOBIAN_OUTPUTS}


def input_units(driven: bool) -> dict[str, str]:
    """Return the inputs with their units; `driven` where the engine prescribes the input speed."""
    first = {"input.acceleration": "rad/s2"} if driven else {"input.torque": "N.m"}
    return {**first, "output.torque": "N.m"}


def check_input(name: str, driven: bool) -> str:
    """Return the input's name.

    Raises
    ------
    InputError
        If there is none of that name; the message says which there are.
    """
    known = input_units(driven)
    if name in known:
        return name
    if name == "input.torque":
        raise InputError("--input input.torque: the engine of this scene prescribes the input speed, so its torque "
                         f"follows and is no input; allowed: {', '.join(known)} (or give an [engine] with a torque)")
    if name == "input.acceleration":
        raise InputError("--input input.acceleration: only where the engine prescribes the speed ([engine] type = "
                         f"'speed'); allowed here: {', '.join(known)}")
    raise InputError(f"--input {name}: unknown signal{_nearest(name, known)}; allowed: {', '.join(known)}")


def check_outputs(names: Iterable[str]) -> tuple[str, ...]:
    """Return the outputs' names, each once.

    Raises
    ------
    InputError
        With every name that is not an output.
    """
    known = output_units()
    wanted = tuple(dict.fromkeys(names))
    problems = [f"--output {name}: unknown signal{_nearest(name, known)}; allowed: {', '.join(known)}"
                for name in wanted if name not in known]
    if not wanted:
        problems.append(f"--output: no signal given; allowed: {', '.join(known)}")
    if problems:
        raise InputError(problems)
    return wanted


def control_name(name: str) -> str:
    """Return a name as python-control takes it: it allows no dot, an underscore stands for it."""
    return name.split(" [")[0].replace(".", "_")


def _nearest(name: str, known: Iterable[str]) -> str:
    found = difflib.get_close_matches(name, list(known), 1, 0.4)
    return f" (nearest: {found[0]})" if found else ""
