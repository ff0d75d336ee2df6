"""A host that knows no Python: a small C program that loads an FMU by its C functions and times its steps."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
from collections.abc import Mapping, Sequence
from pathlib import Path

from cardan.archive import remove, unpack
from cardan.description import read_description

_SOURCE = r"""
#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef unsigned int reference;
typedef struct {
    void (*logger)(void *, const char *, int, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*finished)(void *, int);
    void *environment;
} callbacks;

static void say(void *environment, const char *name, int status, const char *category, const char *text, ...)
{
    (void)environment; (void)name; (void)category;
    if (status > 1) fprintf(stderr, "%s\n", text);
}

static void need(int good, const char *what)
{
    if (!good) { fprintf(stderr, "host: %s failed\n", what); exit(3); }
}

/* argument: libpython, FMU library, GUID, resources, tolerance (0: none), rounds, steps per round */
int main(int count, char **argument)
{
    static const callbacks calls = {say, calloc, free, NULL, NULL};
    reference input[2], output[5], start[32];
    double value[32], seen[5], torques[2];
    int starts, i, round;
    need(count == 8, "usage");
    need(dlopen(argument[1], RTLD_NOW | RTLD_GLOBAL) != NULL, argument[1]);
    void *library = dlopen(argument[2], RTLD_NOW | RTLD_LOCAL);
    need(library != NULL, argument[2]);
    void *(*instantiate)(const char *, int, const char *, const char *, const callbacks *, int, int);
    int (*setup)(void *, int, double, double, int, double), (*enter)(void *), (*leave)(void *);
    int (*set)(void *, const reference *, size_t, const double *), (*get)(void *, const reference *, size_t, double *);
    int (*step)(void *, double, double, int);
    *(void **)&instantiate = dlsym(library, "fmi2Instantiate");
    *(void **)&setup = dlsym(library, "fmi2SetupExperiment");
    *(void **)&enter = dlsym(library, "fmi2EnterInitializationMode");
    *(void **)&leave = dlsym(library, "fmi2ExitInitializationMode");
    *(void **)&set = dlsym(library, "fmi2SetReal");
    *(void **)&get = dlsym(library, "fmi2GetReal");
    *(void **)&step = dlsym(library, "fmi2DoStep");
    for (i = 0; i < 2; i++) need(scanf("%u %lf", &input[i], &torques[i]) == 2, "reading inputs");
    for (i = 0; i < 5; i++) need(scanf("%u", &output[i]) == 1, "reading outputs");
    need(scanf("%d", &starts) == 1 && starts <= 32, "reading start values");
    for (i = 0; i < starts; i++) need(scanf("%u %lf", &start[i], &value[i]) == 2, "reading start values");
    void *fmu = instantiate("c_host", 1, argument[3], argument[4], &calls, 0, 0);
    need(fmu != NULL, "fmi2Instantiate");
    double tolerance = atof(argument[5]);
    need(setup(fmu, tolerance > 0.0, tolerance, 0.0, 0, 0.0) < 2, "fmi2SetupExperiment");
    need(enter(fmu) < 2, "fmi2EnterInitializationMode");
    if (starts) need(set(fmu, start, starts, value) < 2, "fmi2SetReal");
    need(leave(fmu) < 2, "fmi2ExitInitializationMode");
    int rounds = atoi(argument[6]), steps = atoi(argument[7]);
    for (round = 0; round < rounds; round++) {
        struct timespec before, after;
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &before);
        for (i = 0; i < steps; i++)
            need(set(fmu, input, 2, torques) < 2 && step(fmu, (round * steps + i) * 1e-3, 1e-3, 1) < 2
                 && get(fmu, output, 5, seen) < 2, "a step");
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &after);
        printf("%.9g\n", ((after.tv_sec - before.tv_sec) + 1e-9 * (after.tv_nsec - before.tv_nsec)) / steps);
    }
    fflush(stdout);
    _Exit(0); /* a Python FMU can abort the process when it is taken down */
}
"""
ROUNDS, STEPS = 5, 1000


class NoHost(Exception):
    """There is no such host here; the text says why."""


class CHost:
    """The compiled program.

    Parameters
    ----------
    folder : Path
        Where it is made.

    Raises
    ------
    NoHost
        Without a C compiler or a shared libpython, or on another system than Linux.
    """

    def __init__(self, folder: Path) -> None:
        if sys.platform != "linux":
            raise NoHost("the C host is written for Linux")
        compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
        if compiler is None:
            raise NoHost("no C compiler")
        self._python = _libpython()
        source, self._program = folder / "host.c", folder / "host"
        source.write_text(_SOURCE, encoding="ascii")
        done = subprocess.run([compiler, "-O2", "-std=c99", str(source), "-o", str(self._program), "-ldl"],
                              capture_output=True, text=True, check=False)
        if done.returncode:
            raise NoHost(f"the C host does not compile: {done.stderr.strip().splitlines()[-1:]}")

    def times(self, fmu: Path, inputs: Sequence[str], outputs: Sequence[str], starts: Mapping[str, float],
              tolerance: float | None) -> list[float]:
        """Return processor times per step, s, one per round, of a process of its own.

        Parameters
        ----------
        fmu : Path
            FMU with Python inside.
        inputs, outputs : sequence of str
            Two inputs, which are sent as they start, and five outputs.
        starts : mapping of str to float
            Start values.
        tolerance : float or None
            Announced to the FMU.

        Raises
        ------
        NoHost
            If the program fails, with what it said.
        """
        about = read_description(fmu)
        references = {name: variable.reference for name, variable in about.variables.items()}
        directory = unpack(fmu, "linux64")
        try:
            lines = [f"{references[name]} {value}" for name, value in zip(inputs, (200.0, 197.0), strict=True)]
            lines += [str(references[name]) for name in outputs]
            lines += [str(len(starts)), *(f"{references[name]} {value!r}" for name, value in starts.items())]
            library = directory / "binaries" / "linux64" / f"{about.identifier}.so"
            done = subprocess.run(
                [str(self._program), str(self._python), str(library), about.guid, (directory / "resources").as_uri(),
                 str(tolerance or 0.0), str(ROUNDS + 1), str(STEPS)], input="\n".join(lines), text=True,
                capture_output=True, check=False, timeout=120, env={**os.environ, "PYTHONHOME": sys.base_prefix})
        finally:
            remove(directory)
        if done.returncode:
            raise NoHost(f"the C host failed: {done.stderr.strip()}")
        return [float(line) for line in done.stdout.split()][1:]


def _libpython() -> Path:
    """Return the shared library of this interpreter."""
    folder, name = sysconfig.get_config_var("LIBDIR"), sysconfig.get_config_var("INSTSONAME")
    path = Path(folder or "", name or "")
    if not name or ".so" not in name or not path.is_file():
        raise NoHost("this Python has no shared libpython")
    return path
