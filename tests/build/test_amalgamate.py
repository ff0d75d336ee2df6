"""The amalgamation: same text, no repetition, differences found."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from cardan_build.amalgamate import HOT_MODULES, MARKER, amalgamate, digest_inside
from cardan_build.sources import compiled, find_package

FIRST = '''"""First."""

from math import (
    inf,
    isfinite,
    sin,
)

from .variables import TABLE

N = 2


class First:
    def sine(self, x):
        return sin(x) if isfinite(x) else inf
'''
FIRST_TYPES = """cimport cython

cdef extern from "math.h":
    double sin(double x) noexcept
    bint isfinite(double x) noexcept

cdef enum:
    N = 2

@cython.final
cdef class First:
    @cython.locals(y=double)
    cdef double sine(self, double x) noexcept
"""
SECOND = "from .first import N, First\n\nUSED = First().sine(N)\n"
SECOND_TYPES = """cimport cython
from .first cimport First
cdef extern from "math.h":
    double cos(double x) noexcept
    double sin(double x) noexcept
cdef double USED
"""


@pytest.fixture
def kernel(tmp_path: Path) -> Path:
    for name, text in (("first.py", FIRST), ("first.pxd", FIRST_TYPES), ("second.py", SECOND),
                       ("second.pxd", SECOND_TYPES)):
        (tmp_path / name).write_text(text)
    return tmp_path


def test_text_is_kept_and_what_c_brings_is_dropped(kernel: Path) -> None:
    made = amalgamate(kernel, ("first", "second"))
    lines = made.module.splitlines()
    assert lines[0] == "from __future__ import annotations"
    assert "from math import inf" in lines
    assert "from .variables import TABLE" in lines
    assert "        return sin(x) if isfinite(x) else inf" in lines
    assert "USED = First().sine(N)" in lines
    assert not any("first import" in line or line.startswith("N =") for line in lines)
    assert made.types.count("double sin(double x) noexcept") == 1
    assert made.types.count("double cos(double x) noexcept") == 1
    assert "cimport First" not in made.types
    assert "@cython.final\ncdef class First:\n    @cython.locals(y=double)\n" in made.types


def test_marker_can_be_read_without_loading(kernel: Path) -> None:
    made = amalgamate(kernel, ("first", "second"))
    assert digest_inside(b"\x7fELF..." + (MARKER + made.digest).encode() + b"\0...") == made.digest
    assert digest_inside(b"\x7fELF...") == ""
    (kernel / "second.py").write_text(SECOND + "# another\n")
    assert amalgamate(kernel, ("first", "second")).digest != made.digest


def test_a_constant_that_differs_from_its_pxd_is_found(kernel: Path) -> None:
    (kernel / "first.py").write_text(FIRST.replace("N = 2", "N = 3"))
    with pytest.raises(ValueError, match=r"first\.py:11 gives N another value than its \.pxd, which says 2"):
        amalgamate(kernel, ("first", "second"))


def test_a_name_in_two_modules_is_found(kernel: Path) -> None:
    (kernel / "second.py").write_text(SECOND + "\n\nclass First:\n    pass\n")
    with pytest.raises(ValueError, match=r"second\.py:6 defines First, which first\.py defines too"):
        amalgamate(kernel, ("first", "second"))


def test_a_missing_module_is_named(kernel: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"third\.py is missing; HOT_MODULES"):
        amalgamate(kernel, ("first", "third"))


def test_the_kernel_amalgamates_and_the_installed_binary_is_of_its_source() -> None:
    home = find_package("cardan_kernel")
    made = amalgamate(home)
    defined = {node.name for node in ast.parse(made.module).body if isinstance(node, ast.ClassDef)}
    assert "Driveline" in defined
    assert all((home / f"{name}.py").is_file() for name in HOT_MODULES)
    assert {digest_inside(binary) for binary in compiled(home).values()} <= {made.digest}
