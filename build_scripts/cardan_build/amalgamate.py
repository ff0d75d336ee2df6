"""One module out of the kernel's hot modules, for the compiler.

Cython compiles a module at a time and calls between modules cost an import and lose inlining, so the
hot modules of ``cardan_kernel`` and their ``.pxd`` files are concatenated into ``_compiled.py`` and
``_compiled.pxd``. The text is the source that also runs interpreted; nothing is added but a marker
with the hash of what went in, which a later build compares with the ``.py`` files beside it.
"""

from __future__ import annotations

import ast
import hashlib
import re
from dataclasses import dataclass, field
from pathlib import Path

# Order matters: a class stands before the module that names it as a C type.
HOT_MODULES = (
    "memory", "places", "joint", "hold", "motion", "integrator", "outputs", "jump", "history", "bends", "tangent",
    "stepper", "values", "driveline", "law", "bundle", "variation",
)

# Stands in the compiled file as plain text, so that it can be read without loading the file.
MARKER = "cardan-kernel-source:"

_MARKER_PXD = '''cdef extern from *:
    """
    static const char *cardan_kernel_source(void) {{ return "{marker}{digest}"; }}
    """
    const char *cardan_kernel_source() noexcept
'''
_RELATIVE_CIMPORT = re.compile(r"from\s+\.(\w+)\s+cimport\b")
_FUNCTION = re.compile(r"(\w+)\s*\([^()]*\)\s*(?:noexcept|nogil|\s)*$")


@dataclass(frozen=True)
class Amalgamation:
    """The text for the compiler.

    Attributes
    ----------
    module : str
        Text of ``_compiled.py``.
    types : str
        Text of ``_compiled.pxd``.
    digest : str
        SHA-256 of both before the marker was added, hexadecimal.
    """

    module: str
    types: str
    digest: str


@dataclass
class _Types:
    """What the ``.pxd`` files declare, in order and without repetition."""

    cimports: list[str] = field(default_factory=list)
    externs: dict[str, list[str]] = field(default_factory=dict)
    constants: dict[str, str] = field(default_factory=dict)
    blocks: list[str] = field(default_factory=list)

    def extern_names(self) -> set[str]:
        lines = [line for body in self.externs.values() for line in body]
        return {match.group(1) for line in lines if (match := _FUNCTION.search(line.split("#")[0].rstrip()))}

    def text(self) -> str:
        parts = ["cimport cython", *self.cimports]
        parts += ["\n".join([header, *body]) for header, body in self.externs.items()]
        return "\n".join(parts + self.blocks) + "\n"


def amalgamate(kernel: Path, modules: tuple[str, ...] = HOT_MODULES) -> Amalgamation:
    """Concatenate the hot modules of a kernel.

    Parameters
    ----------
    kernel : Path
        Directory of the package ``cardan_kernel``.
    modules : tuple of str
        Module names in order of definition.

    Raises
    ------
    FileNotFoundError
        A listed module is missing.
    ValueError
        Two modules define the same name, or an integer constant differs from its ``.pxd``.
    """
    types = _Types()
    for name in modules:
        declared = kernel / f"{name}.pxd"
        if declared.is_file():
            _collect(declared.read_text(encoding="utf-8"), modules, types)
    owners: dict[str, str] = {}
    bodies = []
    for name in modules:
        path = kernel / f"{name}.py"
        if not path.is_file():
            raise FileNotFoundError(f"{path} is missing; HOT_MODULES in {__file__} lists it")
        bodies.append(f"# from {name}.py\n" + _body(path, modules, types, owners))
    module = "from __future__ import annotations\n\n" + "\n\n".join(bodies)
    digest = hashlib.sha256((module + types.text()).encode()).hexdigest()
    return Amalgamation(
        module + '\n\nSOURCE = cardan_kernel_source().decode("ascii")\n',
        types.text() + _MARKER_PXD.format(marker=MARKER, digest=digest),
        digest,
    )


def digest_inside(binary: bytes) -> str:
    """Hash of the source that a compiled kernel was made from; empty where it carries none."""
    found = re.search(re.escape(MARKER.encode()) + rb"([0-9a-f]{64})", binary)
    return found.group(1).decode() if found else ""


def _collect(text: str, modules: tuple[str, ...], types: _Types) -> None:
    """Sort the blocks of one ``.pxd`` into `types`."""
    for block in _blocks(text):
        head = block[0]
        relative = _RELATIVE_CIMPORT.match(head)
        if head == "cimport cython" or (relative and relative.group(1) in modules):
            continue
        if "cimport" in head.split():
            if head not in types.cimports:
                types.cimports.append(head)
        elif head.startswith("cdef extern from"):
            body = types.externs.setdefault(head, [])
            body += [line for line in block[1:] if line not in body]
        else:
            if head.startswith("cdef enum"):
                pairs = (line.split("#")[0].split("=") for line in block[1:])
                types.constants.update({pair[0].strip(): pair[1].strip() for pair in pairs if len(pair) == 2})
            types.blocks.append("\n".join(block))


def _blocks(text: str) -> list[list[str]]:
    """Top-level statements of a ``.pxd``: an unindented line, its decorators and its indented lines."""
    blocks: list[list[str]] = []
    open_decorator = False
    for line in text.splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        if blocks and (line[0].isspace() or line[0] == ")" or open_decorator):
            blocks[-1].append(line)
        else:
            blocks.append([line])
        open_decorator = line.startswith("@") or (open_decorator and line[0].isspace())
    return blocks


def _body(path: Path, modules: tuple[str, ...], types: _Types, owners: dict[str, str]) -> str:
    """Text of one module without what the amalgamation makes needless."""
    text = path.read_text(encoding="utf-8")
    lines = text.splitlines()
    extern = types.extern_names()
    for place, node in enumerate(ast.parse(text).body):
        replacement: str | None = None
        if isinstance(node, ast.ImportFrom):
            replacement = _import(node, modules, extern)
        elif place == 0 and isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            replacement = ""  # the module's docstring
        for name in _defined(node):
            if name in owners:
                raise ValueError(f"{path}:{node.lineno} defines {name}, which {owners[name]} defines too; "
                                 "names must be unique over the hot modules")
            owners[name] = path.name
            if name in types.constants:
                _same(path, node, name, types.constants[name])
                replacement = ""
        if replacement is not None:
            start, end = node.lineno - 1, node.end_lineno or node.lineno
            lines[start:end] = [replacement] + [""] * (end - start - 1)
    return re.sub(r"\n{4,}", "\n\n\n", "\n".join(lines)).strip("\n") + "\n"


def _import(node: ast.ImportFrom, modules: tuple[str, ...], extern: set[str]) -> str | None:
    """What an import becomes: nothing inside the amalgamation, the rest of ``math`` beside C's functions."""
    if node.module == "__future__" or (node.level == 1 and node.module in modules):
        return ""
    if node.level == 0 and node.module == "math":
        names = [alias.name for alias in node.names if alias.name not in extern]
        return f"from math import {', '.join(names)}" if names else ""
    return None


def _defined(node: ast.stmt) -> list[str]:
    if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
        return [node.name]
    if isinstance(node, ast.Assign):
        return [target.id for target in node.targets if isinstance(target, ast.Name)]
    if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
        return [node.target.id]
    return []


def _same(path: Path, node: ast.stmt, name: str, declared: str) -> None:
    value = node.value if isinstance(node, (ast.Assign, ast.AnnAssign)) else None
    if value is None or ast.dump(value) != ast.dump(ast.parse(declared, mode="eval").body):
        raise ValueError(f"{path}:{node.lineno} gives {name} another value than its .pxd, which says {declared}")
