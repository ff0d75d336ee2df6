"""From sources to a verified FMU."""

from __future__ import annotations

import json
import logging
import os
import subprocess
import sys
import tempfile
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path
from typing import Any

from . import BuildError, archive, terminals
from .sources import Sources, check_compiled, collect, find_package
from .staging import lay_out

log = logging.getLogger(__name__)

_CHILD = "import json, sys; job = json.load(sys.stdin); sys.path[:0] = job['path']; from cardan_build.{module} import "
_CHILD += "{function}; {function}(job)"


def assemble(output: Path, *, portable: bool = False, kernel_dirs: tuple[Path, ...] = ()) -> Path:
    """Build and verify an FMU and put it at `output`; see `cardan_build.build`."""
    output = output.absolute()
    if output.suffix != ".fmu":
        raise BuildError(f"{output} is no name for an FMU: it must end with .fmu")
    if output.is_dir():
        raise BuildError(f"{output} is a directory; name a file")
    sources = collect(portable=portable, kernel_dirs=kernel_dirs)
    check_compiled(sources)
    # Written beside its place and renamed at the end: an FMU in use is never overwritten.
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".cardan-build-", dir=output.parent) as directory:
            made = _make(sources, Path(directory))
            archive.put(made, output)
    except OSError as error:
        raise BuildError(f"{output} cannot be written: {error}") from error
    return output


def _make(sources: Sources, work: Path) -> Path:
    """A verified FMU inside `work`."""
    root = work / "stage"
    root.mkdir()
    stage = lay_out(sources, root)
    job = {"work": str(work), "stage": str(stage.root), "slave": stage.slave, "kernel": stage.kernel,
           "pythonfmu": stage.pythonfmu, "digest": sources.digest, "binaries": list(sources.binaries)}
    _child("packaging", "package", job, ["cardan_build", "pythonfmu"], work)
    members = archive.contents(work / "raw.fmu")
    members = {name: content for name, content in members.items() if not name.startswith("resources/pythonfmu/")}
    members["modelDescription.xml"] = (work / "modelDescription.xml").read_bytes()
    members["model.png"] = (Path(__file__).parent / "model.png").read_bytes()
    ports = sorted((work / terminals.FOLDER).iterdir())
    members |= {f"{terminals.FOLDER}/{path.name}": path.read_bytes() for path in ports}
    made = work / "CardanDriveline.fmu"
    archive.write(made, members)
    _verify(made, sources, work)
    return made


def _verify(made: Path, sources: Sources, work: Path) -> None:
    unpack = work / "unpacked"
    unpack.mkdir()
    text = _child("verification", "verify", {"fmu": str(made), "unpack": str(unpack)}, ["cardan_build", "fmpy"], work)
    report = json.loads(text.splitlines()[-1])
    if report["problems"]:
        raise BuildError("the FMU was built, but does not work:\n" + "\n".join(report["problems"]))
    if report["kernel"] != "compiled" and _loadable(sources):
        raise BuildError("the FMU was built, but its compiled kernel does not load; compile it again "
                         "(pip install -e .) or leave it out (--portable)")
    log.info("verified in a clean process: %s kernel, source %s", report["kernel"], sources.tag)


def _loadable(sources: Sources) -> bool:
    """True where a compiled kernel inside is of the kind that this Python takes."""
    return any(name == f"_compiled{suffix}" for name in sources.binaries for suffix in EXTENSION_SUFFIXES)


def _child(module: str, function: str, job: dict[str, Any], packages: list[str], work: Path) -> str:
    """Call ``cardan_build.<module>.<function>(job)`` in a process of its own; gives what it prints.

    ``-I`` keeps the current directory, PYTHONPATH and the user's packages out.
    """
    path = [str(find_package(name).parent) for name in packages]
    code = _CHILD.format(module=module, function=function)
    done = subprocess.run([sys.executable, "-I", "-B", "-c", code], input=json.dumps({**job, "path": path}), cwd=work,
                          capture_output=True, text=True, check=False, env={**os.environ, "TMPDIR": str(work)})
    if done.returncode:
        raise BuildError(f"cardan_build.{module} failed with exit code {done.returncode}:\n{done.stderr.strip()}")
    for line in done.stderr.splitlines():
        log.warning(line)
    return done.stdout
