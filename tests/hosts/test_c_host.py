"""A C program that knows no Python (host.c) runs the FMU once libpython is in its process."""

from __future__ import annotations

import shlex
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest
from hosts.conftest import Job
from hosts.pythons import interpreter

VERSIONS = [f"3.{minor}" for minor in range(9, 16)]
STRICT = ["-std=c99", "-D_GNU_SOURCE", "-O2", "-Wall", "-Wextra", "-Werror"]
_EMPTY = '''
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Empty(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        for name in "abcdefg":
            setattr(self, name, 0.0)
            self.register_variable(Real(name, causality=getattr(Fmi2Causality, "input" if name < "c" else "output")))

    def do_step(self, current_time, step_size):
        return True
'''


@pytest.fixture(scope="module")
def compiler() -> str:
    found = shutil.which("gcc") or shutil.which("cc")
    if found is None:
        pytest.skip("no C compiler is installed here")
    return found


@pytest.fixture(scope="module")
def host(compiler: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The program, not linked to any Python."""
    program = tmp_path_factory.mktemp("host") / "host"
    source = Path(__file__).with_name("host.c")
    subprocess.run([compiler, *STRICT, "-o", str(program), str(source), "-ldl", "-lpthread"], check=True)
    return program


def libpython(python: str) -> Path:
    """Shared library of a Python; skips by name where it has none."""
    code = "import sysconfig as s; print(s.get_config_var('LIBDIR')); print(s.get_config_var('INSTSONAME'))"
    folder, name = subprocess.run([python, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    path = Path(folder) / name
    if ".so" not in name or not path.is_file():
        pytest.skip(f"{python} has no shared library of Python")
    return path


def text_of(job: Job) -> str:
    lines = [f"START {len(job['starts'])}"]
    lines += [f"{kind} {reference} {value!r}" for kind, reference, value in job["starts"]]
    lines.append(f"INPUTS {' '.join(map(str, job['inputs']))}")
    lines.append(f"OUTPUTS {len(job['outputs'])} {' '.join(map(str, job['outputs']))}")
    return "\n".join(lines) + "\n"


def run(program: Path, job: Job, mode: str, count: int,
        library: Path | None = None) -> subprocess.CompletedProcess[str]:
    environment = {"LD_PRELOAD": str(library)} if library else {}
    return subprocess.run([str(program), job["library"], job["resources"], job["guid"], mode, str(count)], text=True,
                          input=text_of(job), capture_output=True, check=False, timeout=120, env=environment)


def rows(done: subprocess.CompletedProcess[str]) -> list[list[float]]:
    assert done.returncode == 0, done.stderr
    return [[float.fromhex(each) for each in line.split()] for line in done.stdout.splitlines()]


def numbers(expected: list[list[str]]) -> list[list[float]]:
    return [[float.fromhex(each) for each in row] for row in expected]


@pytest.mark.parametrize("version", VERSIONS)
def test_c_program_with_libpython_loaded(version: str, host: Path, job: Job, expected: list[list[str]]) -> None:
    python = interpreter(version)
    if python is None:
        pytest.skip(f"no Python {version} is installed here")
    done = run(host, job, "run", 200, libpython(python))
    assert rows(done) == numbers(expected)
    assert "message 0: cardan_kernel" in done.stderr


def test_c_program_linked_to_libpython(compiler: str, job: Job, expected: list[list[str]], tmp_path: Path) -> None:
    library = libpython(sys.executable)
    config = Path(sysconfig.get_config_var("BINDIR")) / f"python{sysconfig.get_python_version()}-config"
    flags = ["-L", str(library.parent), f"-lpython{sysconfig.get_python_version()}"]
    if config.is_file():  # what people are told to use
        said = subprocess.run([str(config), "--embed", "--ldflags"], capture_output=True, text=True, check=True)
        flags = shlex.split(said.stdout)
    program = tmp_path / "linked"
    subprocess.run([compiler, *STRICT, "-o", str(program), str(Path(__file__).with_name("host.c")),
                    "-Wl,--no-as-needed", *flags, f"-Wl,-rpath,{library.parent}", "-ldl", "-lpthread"], check=True)
    assert rows(run(program, job, "run", 200)) == numbers(expected)


def test_twenty_instances_in_threads_of_a_c_program(host: Path, job: Job, expected: list[list[str]]) -> None:
    done = run(host, job, "threads", 20, libpython(sys.executable))
    assert rows(done) == [numbers(expected)[-1]] * 20


def test_a_thousand_cycles_of_loading_in_a_c_program(host: Path, job: Job) -> None:
    done = run(host, job, "cycles", 1000, libpython(sys.executable))
    assert done.returncode == 0, done.stderr
    memory = [int(line) for line in done.stdout.split()]
    assert (memory[-1] - memory[0]) / 900 < 22.0  # kB; docs/FMI.md, trap 10


def test_a_program_without_libpython_is_told_so(host: Path, job: Job) -> None:
    done = run(host, job, "run", 1)
    assert done.returncode == 3
    assert "Py" in done.stderr  # the loader names the symbol that is missing


def test_a_step_costs_a_fraction_of_an_empty_pythonfmu_fmu(host: Path, job: Job, tmp_path: Path) -> None:
    """Set 2, step of 1 ms at tolerance 1e-6, get 5: both in this program, in turns, the fastest of many batches."""
    (tmp_path / "empty.py").write_text(_EMPTY)
    code = "from pythonfmu import FmuBuilder; FmuBuilder.build_FMU('empty.py', dest='.')"
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=True, capture_output=True)
    shutil.unpack_archive(tmp_path / "Empty.fmu", tmp_path / "empty", "zip")
    empty = {"library": str(tmp_path / "empty/binaries/linux64/Empty.so"), "guid": "any", "starts": [],
             "resources": (tmp_path / "empty/resources").as_uri(), "inputs": [0, 1], "outputs": [2, 3, 4, 5, 6]}
    library = libpython(sys.executable)
    ours, theirs = [], []
    for _ in range(3):
        ours.append(float(run(host, job, "time", 100, library).stdout))
        theirs.append(float(run(host, empty, "time", 20, library).stdout))
    print(f"a step of 1 ms from C: {min(ours):.2f} us; empty pythonfmu FMU: {min(theirs):.2f} us")
    assert min(ours) < 0.4 * min(theirs)
