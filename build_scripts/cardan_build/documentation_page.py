"""The page for people, ``documentation/index.html``: one file that loads nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from math import pi
from typing import Any

from . import documentation_text as words
from . import equations, sketch
from .mathml import mathml

HEADINGS = {"parameter": "Parameters", "input": "Inputs", "output": "Outputs"}
STYLE = """
:root { --blue: #1f4e79; --line: #d8dfe5; --soft: #f4f7f9; --text: #20262c; --grey: #5b6770 }
* { box-sizing: border-box }
body { font: 16px/1.55 system-ui, "Segoe UI", "Liberation Sans", Arial, sans-serif; color: var(--text);
  max-width: 62rem; margin: 0 auto; padding: 1.5rem 1rem 4rem; background: white; overflow-wrap: break-word }
h1 { color: var(--blue); margin: 0; font-size: 2rem; line-height: 1.2 }
h2 { color: var(--blue); margin: 2.6rem 0 .6rem; padding-bottom: .25rem; border-bottom: 2px solid var(--line) }
h3 { margin: 1.6rem 0 .4rem }
a { color: var(--blue) }
.lead { font-size: 1.15rem; margin: .4rem 0; color: var(--grey) }
nav { margin: 1.2rem 0; display: flex; flex-wrap: wrap; gap: .4rem }
nav a { border: 1px solid var(--line); border-radius: 1rem; padding: .1rem .75rem; text-decoration: none;
  font-size: .9rem }
nav a:hover { background: var(--soft) }
code, pre { font-family: ui-monospace, Consolas, "DejaVu Sans Mono", monospace; font-size: .86em }
pre { background: var(--soft); border: 1px solid var(--line); border-radius: 6px; padding: .8rem 1rem;
  overflow-x: auto }
.wide { overflow-x: auto; margin: .6rem 0 }
table { border-collapse: collapse; width: 100%; font-size: .88rem; min-width: 40rem }
table.narrow { min-width: 0 }
th, td { border-bottom: 1px solid var(--line); padding: .3rem .6rem; text-align: left; vertical-align: top }
th { background: var(--soft) }
.variables td:not(:nth-child(2)) { white-space: nowrap }
.variables td:nth-child(4) { text-align: right }
figure { margin: 1rem 0 }
figure svg { display: block; width: 100%; height: auto }
figure .side { overflow-x: auto }
figure .side svg { min-width: 44rem }
.dials { display: flex; flex-wrap: wrap; gap: 1rem 2rem; justify-content: center }
.dials div { flex: 1 1 16rem; max-width: 22rem }
figcaption { color: var(--grey); font-size: .9rem }
.formula { border-left: 3px solid var(--line); padding: .35rem 0 .35rem 1rem; margin: .7rem 0; overflow-x: auto }
.formula math { display: block; text-align: left; margin: 0; font-size: 1.1rem; padding: .2rem 0 }
.formula mfrac > * { padding: .12em .2em }
.formula p { margin: .2rem 0 0; color: var(--grey); font-size: .9rem }
dt { font-weight: 600; margin-top: .8rem }
dd { margin: 0 0 0 1.2rem }
.facts td:first-child { white-space: nowrap; width: 1%; color: var(--grey) }
.hash { overflow-wrap: anywhere }
@media (max-width: 40rem) { body { font-size: 15px } h1 { font-size: 1.6rem } }
@media print { nav { display: none } body { max-width: none } }
"""


def page(variables: Sequence[Any], *, version: str, text: str, digest: str, binaries: Sequence[str]) -> str:
    """Return the page; the same arguments give the same text.

    Parameters
    ----------
    variables : sequence of Variable
        ``cardan_kernel.variables.VARIABLES``.
    version, text : str
        Version and one-line description of the model.
    digest : str
        SHA-256 of the sources inside, hexadecimal.
    binaries : sequence of str
        File names of the compiled kernels inside.
    """
    sections = (
        ("what", "What it is", words.PURPOSE),
        ("use", "First use", words.START),
        ("signs", "Signs and zero positions", _figures() + words.SIGNS),
        ("equations", "Equations", "".join(_equations(group) for group in equations.GROUPS) + words.AFTER_EQUATIONS),
        ("variables", "Variables", _tables(variables)),
        ("hold", "Torque between communication points", _formulas(equations.HOLD) + words.HOLD),
        ("state", "State and rollback", words.STATE),
        ("errors", "Refused steps and messages", words.ERRORS),
        ("limits", "Limits", words.LIMITS),
        ("troubles", "Troubleshooting", _troubles()),
        ("ports", "Ports", words.PORTS),
        ("about", "Version, licence, citation", _about(version, digest, binaries)),
    )
    links = "\n".join(f'<a href="#{key}">{heading}</a>' for key, heading, _ in sections)
    body = "\n".join(f'<section id="{key}">\n<h2>{heading}</h2>\n{content}</section>'
                     for key, heading, content in sections)
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>CardanDriveline {escape(version)}</title>\n<style>{STYLE}</style></head>\n<body>\n"
            f"<header><h1>CardanDriveline {escape(version)}</h1>\n"
            f'<p class="lead">{escape(text)}. FMI 2.0 co-simulation, SI units.</p></header>\n'
            f"<nav>{links}</nav>\n{body}\n</body></html>\n")


def _figures() -> str:
    return (f'<figure><div class="side">{sketch.driveline()}</div>\n<figcaption>The driveline from the side, drawn for '
            "θ = 0: both joints bend the same way, n<sub>1</sub> and n<sub>2</sub> point away from you. The curved "
            "arrows show the near side of the shaft under a positive torque.</figcaption></figure>\n"
            f'<figure><div class="dials"><div>{sketch.joint_dial()}</div><div>{sketch.shaft_dial()}</div></div>\n'
            "<figcaption>Left: a joint; its input trunnion a at φ<sub>in</sub> from the joint plane, its output "
            "trunnion b at φ<sub>out</sub> from the normal. Right: the intermediate shaft; ψ from b<sub>1</sub> to "
            "a<sub>2</sub>, θ from n<sub>1</sub> to n<sub>2</sub>.</figcaption></figure>\n")


def _equations(group: equations.Equations) -> str:
    return f"<h3>{group.title}</h3>\n<p>{group.text}</p>\n{_formulas(group)}"


def _formulas(group: equations.Equations) -> str:
    return "".join(f'<div class="formula">{mathml(formula)}<p>{meaning}</p></div>\n'
                   for formula, meaning in group.formulas)


def _tables(variables: Sequence[Any]) -> str:
    tables = "\n".join(_table(heading, [each for each in variables if each.causality == causality])
                       for causality, heading in HEADINGS.items())
    return ("<p>Units are SI; the display unit stands in brackets. The value reference of a variable is its place in "
            f"this list, counted from 0.</p>\n{tables}\n")


def _table(heading: str, variables: Sequence[Any]) -> str:
    rows = "\n".join(_row(variable) for variable in variables)
    return (f'<h3>{heading}</h3>\n<div class="wide"><table class="variables"><tr><th>Name</th><th>Meaning</th>'
            f"<th>Unit</th><th>Start</th><th>Allowed</th></tr>\n{rows}\n</table></div>")


def _row(variable: Any) -> str:
    start = "" if variable.start is None else f"{variable.start:.10g}" if variable.type == "Real" else variable.start
    unit = variable.unit if variable.type == "Real" else variable.type
    display = f" ({variable.display})" if variable.display else ""
    tunable = " (tunable)" if variable.variability == "tunable" else ""
    cells = (f"<code>{escape(variable.name)}</code>", escape(variable.description) + tunable, escape(unit + display),
             escape(str(start).lower()), _allowed(variable))
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def _allowed(variable: Any) -> str:
    """The range of a variable; the kernel's checks have the same in words."""
    low, high = variable.minimum, variable.maximum
    if variable.name == "hold.degree":
        return "0, 1, 3 or 5"
    if high is not None and variable.unit == "rad" and high < pi / 2:
        return f"{low:g} ≤ .. &lt; π/2"
    if low is not None and high is not None:
        return f"{low:g} to {high:g}"
    return "" if low is None else f"≥ {low:g}"


def _troubles() -> str:
    return "<dl>" + "\n".join(f"<dt>{sign}</dt><dd>{cure}</dd>" for sign, cure in words.TROUBLES) + "</dl>\n"


def _about(version: str, digest: str, binaries: Sequence[str]) -> str:
    kernels = ", ".join(f"<code>{escape(each)}</code>" for each in binaries) or "none (interpreted only)"
    facts = (
        ("Version", escape(version)),
        ("Source", f'<span class="hash">SHA-256 <code>{escape(digest)}</code></span>, also in the model description '
                   "(VendorAnnotations); the modules under <code>resources</code> end with its first twelve digits"),
        ("Compiled kernels", kernels),
        ("Licence", 'MIT: <a href="licenses/license.txt">license.txt</a>. Inside too: PythonFMU, MIT '
                    '(<a href="licenses/pythonfmu.txt">pythonfmu.txt</a>), and its use of the FMI headers, BSD '
                    '(<a href="licenses/fmi.txt">fmi.txt</a>)'),
        ("Needs", 'Python 3.9 or later in the importing process: <a href="externalDependencies.txt">'
                  "externalDependencies.txt</a>"),
    )
    rows = "\n".join(f"<tr><td>{name}</td><td>{value}</td></tr>" for name, value in facts)
    return (f'<table class="narrow facts">{rows}</table>\n<p>To cite it, name the version and the source hash, with '
            "which results can be repeated:</p>\n<pre>@software{cardan_driveline,\n"
            "  title   = {CardanDriveline: a universal-joint driveline as an FMI 2.0 co-simulation FMU},\n"
            "  author  = {{cardan-driveline contributors}},\n"
            f"  version = {{{escape(version)}}},\n  note    = {{source SHA-256 {escape(digest[:12])}}}\n}}</pre>\n")
