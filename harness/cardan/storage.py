"""Results on disk: CSV, Parquet and NetCDF, each complete or not there at all.

All three hold the same: the columns in SI units with the units said, and as JSON the `RunInfo` and the display
units (in a ``.meta.json`` beside a CSV file, as file metadata ``cardan`` in the other two).
"""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from cardan.errors import InputError
from cardan.result import Result, RunInfo, jsonable

FORMATS = (".csv", ".parquet", ".nc")


def save(result: Result, path: str | os.PathLike[str]) -> None:
    """Write a result; the ending of the name decides the format.

    The file is written beside its place and renamed, so that a reader never sees half of it.

    Parameters
    ----------
    result : Result
        What to write.
    path : path-like
        ``.csv`` (a header row ``time [s],input.speed [rad/s],...``), ``.parquet`` or ``.nc`` (NetCDF 3).

    Raises
    ------
    InputError
        If the ending is another one, or the file cannot be written.
    """
    path = Path(path)
    _WRITERS[_format(path)](result, path)


def load(path: str | os.PathLike[str]) -> Result:
    """Read a result written by `save`. A CSV file without its ``.meta.json`` gives columns and units only.

    Raises
    ------
    InputError
        If the file is missing, of another format or not a result.
    """
    path = Path(path)
    reader = _READERS[_format(path)]
    try:
        return reader(path)
    except FileNotFoundError:
        raise InputError(f"{path} does not exist") from None
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror or error}") from None
    except (ValueError, KeyError, TypeError, IndexError) as error:
        raise InputError(f"{path} is no result file: {error}") from None


def writable_problems(path: str | os.PathLike[str], formats: tuple[str, ...],
                      inputs: Iterable[str | os.PathLike[str]] = ()) -> list[str]:
    """Say beforehand why a file could not be written; nothing is left behind.

    Parameters
    ----------
    path : path-like
        The file to be.
    formats : tuple of str
        Endings that are known.
    inputs : iterable of path-like, optional
        Files that are read and must not be written over, by whatever name.

    Returns
    -------
    list of str
        Problems; empty if there are none.
    """
    path = Path(path)
    if path.is_dir():
        return [f"{path} is a directory; give a file name"]
    if path.suffix.lower() not in formats:
        return [f"{path}: unknown ending {path.suffix!r}; choose one of {', '.join(formats)}"]
    places = [path, _meta_path(path)] if path.suffix.lower() == ".csv" else [path]
    for place in places:
        for read in inputs:
            if _same(place, Path(read)):
                return [f"{place} would write over {read}, which is read; choose another name"]
        # A folder that can be written to allows to replace a file that is meant to be kept.
        if place.exists() and not os.access(place, os.W_OK):
            return [f"{place} cannot be written: it is write-protected; choose another name"]
        if place.is_dir():
            return [f"{place} is a directory, and is written beside {path}; choose another name"]
    try:
        handle, probe = tempfile.mkstemp(prefix=".cardan_", dir=path.parent)
    except OSError as error:
        return [f"{path} cannot be written: {error.strerror or error}; choose another place"]
    os.close(handle)
    os.unlink(probe)
    return []


def _same(one: Path, other: Path) -> bool:
    """Return whether two names lead to the same file."""
    try:
        return one.samefile(other)
    except OSError:  # one of them is not there
        return False


@contextmanager
def written_beside(path: Path) -> Iterator[Path]:
    """Give a name beside `path` to write to; it takes the place of `path` when all went well.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    try:
        handle, name = tempfile.mkstemp(prefix=".cardan_", suffix=path.suffix, dir=path.parent)
        os.close(handle)
        beside = Path(name)
        try:
            yield beside
            umask = os.umask(0)
            os.umask(umask)
            beside.chmod(0o666 & ~umask)  # mkstemp makes files that nobody else can read
            beside.replace(path)
        finally:
            beside.unlink(missing_ok=True)
    except OSError as error:
        raise InputError(f"{path} cannot be written: {error.strerror or error}") from None


def _format(path: Path) -> str:
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        raise InputError(f"{path}: unknown ending {path.suffix!r}; choose one of {', '.join(FORMATS)}")
    return suffix


def _about(result: Result) -> str:
    about = {"info": asdict(result.info), "units": result.units, "display": result.display}
    return json.dumps(jsonable(about), indent=1)


def _result(columns: dict[str, Any], units: dict[str, str], about: str) -> Result:
    known = json.loads(about) if about else {}
    arrays = {name: np.ascontiguousarray(values, dtype=float) for name, values in columns.items()}
    time = arrays.pop("time")
    display = {name: (unit, float(factor)) for name, (unit, factor) in known.get("display", {}).items()}
    info = RunInfo.from_dict(known.get("info", {"reached_time": float(time[-1])}))
    return Result(time, arrays, {name: units[name] for name in arrays}, info, display)


def _meta_path(path: Path) -> Path:
    return path.with_suffix(".meta.json")


def _write_csv(result: Result, path: Path) -> None:
    rows = np.column_stack([result.time, *result.columns.values()]).tolist()
    with written_beside(path) as beside, open(beside, "w", encoding="utf-8", newline="\n") as file:
        file.write(",".join(result.header(name) for name in ("time", *result.columns)) + "\n")
        # repr is the shortest text that reads back as the same double
        file.writelines(",".join(map(repr, row)) + "\n" for row in rows)
    with written_beside(_meta_path(path)) as beside:
        beside.write_text(_about(result) + "\n", encoding="utf-8")


def _read_csv(path: Path) -> Result:
    with open(path, encoding="utf-8") as file:
        names, units = [], {}
        for heading in file.readline().strip().split(","):
            name, bracket, unit = heading.partition(" [")
            if not bracket or not unit.endswith("]"):
                raise ValueError(f"heading {heading!r} is not of the form 'name [unit]'")
            names.append(name)
            units[name] = unit[:-1]
        table = np.loadtxt(file, delimiter=",", ndmin=2)
    meta = _meta_path(path)
    about = meta.read_text(encoding="utf-8") if meta.is_file() else ""
    return _result(dict(zip(names, table.T, strict=True)), units, about)


def _write_parquet(result: Result, path: Path) -> None:
    pa, pq = _pyarrow()
    names = ("time", *result.columns)
    units = {"time": "s", **result.units}
    fields = [pa.field(name, pa.float64(), nullable=False, metadata={"unit": units[name]}) for name in names]
    table = pa.table([result.time, *result.columns.values()], schema=pa.schema(fields, {"cardan": _about(result)}))
    with written_beside(path) as beside:
        pq.write_table(table, beside)


def _read_parquet(path: Path) -> Result:
    _, pq = _pyarrow()
    table = pq.read_table(path)
    units = {entry.name: (entry.metadata or {}).get(b"unit", b"").decode() for entry in table.schema}
    about = (table.schema.metadata or {}).get(b"cardan", b"").decode()
    return _result({name: table[name].to_numpy() for name in table.column_names}, units, about)


def _pyarrow() -> tuple[Any, Any]:
    try:
        import pyarrow as pa
        import pyarrow.parquet as pq
    except ImportError:
        raise InputError("Parquet files need the package pyarrow (pip install pyarrow); .csv and .nc do not") from None
    return pa, pq


def _write_netcdf(result: Result, path: Path) -> None:
    from scipy.io import netcdf_file

    with written_beside(path) as beside, netcdf_file(beside, "w", version=2) as file:
        file.title = result.info.title.encode()
        file.cardan = _about(result).encode()
        file.createDimension("time", len(result))
        for name in ("time", *result.columns):
            variable = file.createVariable(name, "f8", ("time",))
            variable[:] = result[name]
            variable.units = ("s" if name == "time" else result.units[name]).encode()


def _read_netcdf(path: Path) -> Result:
    from scipy.io import netcdf_file

    with netcdf_file(path, "r", mmap=False) as file:
        columns = {name: np.array(variable[:], dtype=float) for name, variable in file.variables.items()}
        units = {name: variable.units.decode() for name, variable in file.variables.items()}
        about = getattr(file, "cardan", b"").decode()
    return _result(columns, units, about)


_WRITERS: dict[str, Callable[[Result, Path], None]] = {
    ".csv": _write_csv, ".parquet": _write_parquet, ".nc": _write_netcdf}
_READERS: dict[str, Callable[[Path], Result]] = {".csv": _read_csv, ".parquet": _read_parquet, ".nc": _read_netcdf}
