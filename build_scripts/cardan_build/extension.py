"""The compiled kernel as a setuptools extension; optional in every respect."""

from __future__ import annotations

import sys
import sysconfig
from pathlib import Path
from typing import Any

from setuptools import Extension
from setuptools.command.build_ext import build_ext

from .amalgamate import amalgamate, digest_inside

NAME = "cardan_kernel._compiled"
LIMITED_API = "0x030B0000"  # one binary for Python 3.11 and later

# Equal to the interpreted kernel to the last bit: no fused multiply-add, and pow as libm has it.
UNIX_FLAGS = ["-O3", "-ffp-contract=off", "-fno-builtin-pow", "-fno-math-errno", "-g0"]
MSVC_FLAGS = ["/O2", "/fp:precise"]

DIRECTIVES = {
    "language_level": 3,
    "boundscheck": False,
    "wraparound": False,
    "cdivision": True,
    "annotation_typing": False,  # the .pxd alone gives types; annotations are for people and mypy
    "auto_pickle": False,
}


class BuildKernel(build_ext):  # type: ignore[misc]
    """Compile with the flags of the compiler at hand, and leave no binary of another source behind."""

    digest = ""

    def build_extension(self, ext: Extension) -> None:
        """Compile one extension."""
        if ext.name == NAME:
            ext.extra_compile_args = MSVC_FLAGS if self.compiler.compiler_type == "msvc" else UNIX_FLAGS
            # Should compiling fail, an older binary must not be installed in its place.
            places = [Path(self.get_ext_fullpath(NAME)).parent, Path("fmu_src/cardan_kernel")]
            for path in (each for place in places for each in place.glob("_compiled*")):
                if path.suffix in (".so", ".pyd") and digest_inside(path.read_bytes()) != self.digest:
                    path.unlink()
        super().build_extension(ext)


def arguments(root: Path) -> dict[str, Any]:
    """Keyword arguments for ``setuptools.setup`` that add the compiled kernel.

    Parameters
    ----------
    root : Path
        Top of the repository.

    Returns
    -------
    dict
        Empty where Cython is not installed: the interpreted kernel does everything, more slowly.
    """
    try:
        from Cython.Build import cythonize
    except ImportError:
        print("Cython is not installed: the kernel is installed without its compiled form", file=sys.stderr)
        return {}
    kernel = root / "fmu_src" / "cardan_kernel"
    limited = not sysconfig.get_config_var("Py_GIL_DISABLED")  # free-threaded Python has no stable ABI yet
    work = Path("build") / "cython" / "cardan_kernel"
    work.mkdir(parents=True, exist_ok=True)
    joined = amalgamate(kernel)
    _write(work / "__init__.py", "")
    _write(work / "_compiled.py", joined.module)
    _write(work / "_compiled.pxd", joined.types)
    extension = Extension(
        NAME,
        [str(work / "_compiled.py")],
        define_macros=[("Py_LIMITED_API", LIMITED_API)] if limited else [],
        py_limited_api=limited,
    )
    BuildKernel.digest = joined.digest
    extensions = cythonize([extension], compiler_directives=DIRECTIVES, quiet=True)
    for each in extensions:
        each.optional = True  # without a C compiler the installation goes on; cythonize would drop it
    settings: dict[str, Any] = {"ext_modules": extensions, "cmdclass": {"build_ext": BuildKernel}}
    if limited:
        settings["options"] = {"bdist_wheel": {"py_limited_api": "cp311"}}
    return settings


def _write(path: Path, text: str) -> None:
    """Write only what changed, so that an unchanged kernel is not compiled again."""
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")

