"""The documentation inside the FMU: complete, self-contained, the same each time, and its example runs."""

from __future__ import annotations

import json
import math
import re
import subprocess
import sys
import zipfile
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import cardan_kernel
import pytest
from cardan_build import documentation_page, documentation_text, equations, notices, sketch
from cardan_build.mathml import mathml
from cardan_kernel.variables import VARIABLES

VOID = frozenset({"meta", "br", "hr", "img", "link", "input"})
FORMULAS = [formula for group in (*equations.GROUPS, equations.HOLD) for formula, _ in group.formulas]


class Page(HTMLParser):
    """Collects what a page holds; refuses tags that do not nest."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.loads: list[str] = []
        self.tags: set[str] = set()
        self.words: dict[str, list[str]] = {}
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        found = dict(attrs)
        self.ids += [str(found["id"])] if "id" in found else []
        self.links += [str(found["href"])] if tag == "a" else []
        self.loads += [str(value) for name, value in attrs if name in ("src", "srcset", "data", "poster", "xlink:href")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        assert self.open and self.open[-1] == tag, f"</{tag}> at {self.getpos()} closes {self.open[-1:]}"
        self.open.pop()

    def handle_data(self, data: str) -> None:
        for tag in set(self.open):
            self.words.setdefault(tag, []).append(data)


def made(**changes: object) -> str:
    arguments = {"version": "1.2.3", "text": "A < B", "digest": "ab" * 32, "binaries": ("_compiled.abi3.so",)}
    return documentation_page.page(VARIABLES, **{**arguments, **changes})  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def page() -> Page:
    return Page(made())


def test_page_is_well_formed(page: Page) -> None:
    assert page.open == []
    assert len(set(page.ids)) == len(page.ids)
    assert {"svg", "math", "table", "title"} <= page.tags


def test_page_loads_nothing_and_its_links_lead_somewhere(page: Page, fmu: Path) -> None:
    assert page.loads == []
    assert page.tags.isdisjoint({"script", "link", "img", "iframe", "object", "embed"})
    style = "".join(page.words["style"])
    assert "url(" not in style and "@import" not in style
    addresses = set(re.findall(r"[a-z]+://[^\s\"'<]+", made()))
    assert addresses == {"http://www.w3.org/2000/svg"}, "a name of a namespace, which nobody loads"
    with zipfile.ZipFile(fmu) as opened:
        names = set(opened.namelist())
    for link in page.links:
        assert link[1:] in page.ids if link.startswith("#") else f"documentation/{link}" in names, link


def test_every_variable_stands_in_the_table_in_the_order_of_its_value_reference(page: Page) -> None:
    rows = re.findall(r"<tr><td><code>([^<]+)</code></td><td>([^<]*)</td><td>([^<]*)</td><td>([^<]*)</td><td>([^<]*)",
                      made())
    assert [name for name, *_ in rows] == [each.name for each in VARIABLES]
    for (_, meaning, unit, start, allowed), variable in zip(rows, VARIABLES, strict=True):
        assert unescape(meaning).removesuffix(" (tunable)") == variable.description
        assert meaning.endswith(" (tunable)") == (variable.variability == "tunable")
        assert unit.startswith(variable.unit or variable.type)
        assert (start == "") == (variable.start is None)
        assert start in ("", "false") or float(start) == variable.start
        assert (allowed == "") == (variable.minimum is None)
    shown = {name: allowed for name, *_, allowed in rows}
    assert shown["joint1.angle"] == "0 ≤ .. &lt; π/2"
    assert shown["hold.degree"] == "0, 1, 3 or 5"
    assert shown["model.tolerance"] == "1e-13 to 0.1"
    assert shown["input.inertia"] == "≥ 0"


def test_names_in_the_prose_are_names_of_variables() -> None:
    prose = "".join(value for value in vars(documentation_text).values() if isinstance(value, str))
    quoted = set(re.findall(r"<code>((?:model|input|output|shaft|joint[12]|hold|energy|layout)\.[a-z0-9_.]+)</code>",
                            prose + "".join(meaning for group in equations.GROUPS for _, meaning in group.formulas)))
    assert quoted >= {"hold.restart", "joint2.angle", "energy.residual", "layout.nonuniformity"}
    assert quoted <= {each.name for each in VARIABLES}


@pytest.mark.parametrize("symbol", ["J", "k", "d", "β", "φ", "ψ", "θ", "κ", "ω", "r", "g", "c", "s", "D", "T", "U", "M",
                                    "P", "C", "K", "p", "δ", "sin", "cos", "tan", "atan2", "load", "drive", "∂"])
def test_equations_have_their_symbols(page: Page, symbol: str) -> None:
    assert symbol in page.words["math"]


@pytest.mark.parametrize("formula", FORMULAS)
def test_every_formula_is_drawn(formula: str) -> None:
    element = ElementTree.fromstring(mathml(formula))
    assert element.get("alttext") == formula
    shape = {"mfrac": 2, "msub": 2, "msup": 2, "msubsup": 3}
    assert all(len(each) == shape[each.tag] for each in element.iter() if each.tag in shape)
    assert "\\" not in "".join(element.itertext())
    assert mathml(formula) in made()


def test_formulas_are_read_as_written() -> None:
    inside = re.sub(r"</?math[^>]*>", "", mathml(r"T_{out} = \frac{c}{D^2}"))
    assert inside == ("<mrow><msub><mi>T</mi><mrow><mi>out</mi></mrow></msub><mo>=</mo><mfrac><mrow><mi>c</mi></mrow>"
                      "<mrow><msup><mi>D</mi><mn>2</mn></msup></mrow></mfrac></mrow>")
    assert "<msubsup><mi>r</mi><mn>1</mn><mn>2</mn></msubsup>" in mathml("r_1^2")
    assert "<msup><mi>r</mi><mo>&#8242;</mo></msup>" in mathml("r'")
    for wrong in (r"\nothing", r"\frac{a", r"\frac a b", "{a"):
        with pytest.raises(ValueError, match=re.escape(wrong)):
            mathml(wrong)


@pytest.mark.parametrize("draw", [sketch.driveline, sketch.joint_dial, sketch.shaft_dial, sketch.icon])
def test_sketches_are_inside_their_frame(draw: object) -> None:
    root = ElementTree.fromstring(draw())  # type: ignore[operator]
    _, _, width, height = (float(each) for each in root.attrib["viewBox"].split())
    assert root[0].tag.endswith("title")
    for each in root.iter():
        for name, limit in (("x", width), ("x1", width), ("x2", width), ("cx", width),
                            ("y", height), ("y1", height), ("y2", height), ("cy", height)):
            assert 0.0 <= float(each.get(name, 0.0)) <= limit, ElementTree.tostring(each)


def test_sketch_names_what_it_shows(page: Page) -> None:
    words = {word.strip() for word in page.words["svg"]}
    assert {"J", "1", "2a", "2b", "3", "k", "d", "joint 1", "joint 2", "β", "φ", "in", "out", "ψ", "θ",
            "input.torque", "output.torque", "e", "n", "a", "b"} <= words


def test_version_and_source_are_on_the_page_and_in_the_model_description(fmu: Path) -> None:
    with zipfile.ZipFile(fmu) as opened:
        text = opened.read("documentation/index.html").decode()
        described = ElementTree.fromstring(opened.read("modelDescription.xml"))
        names = opened.namelist()
    assert described.get("version") == cardan_kernel.__version__
    assert f"<h1>CardanDriveline {cardan_kernel.__version__}</h1>" in text
    source = described.find("VendorAnnotations/Tool/source")
    assert source is not None
    digest = source.attrib["sha256"]
    assert re.fullmatch("[0-9a-f]{64}", digest)
    assert digest in text
    assert any(name.startswith(f"resources/cardan_kernel_{digest[:12]}/") for name in names)
    assert all(kernel in text for kernel in source.attrib["compiledKernels"].split())


def test_what_depends_on_torques_is_as_the_page_says(fmu: Path) -> None:
    with zipfile.ZipFile(fmu) as opened:
        described = ElementTree.fromstring(opened.read("modelDescription.xml"))
    running = list(described.iterfind("ModelStructure/Outputs/Unknown"))
    assert len(running) > 30
    assert {each.attrib["dependencies"] for each in running} == {""}
    torques = {str(place + 1) for place, each in enumerate(VARIABLES)
               if each.causality == "input" and ".torque" in each.name}
    fed = {VARIABLES[int(each.attrib["index"]) - 1].name
           for each in described.iterfind("ModelStructure/InitialUnknowns/Unknown")
           if torques & set(each.attrib["dependencies"].split())}
    assert {"input.acceleration", "output.acceleration", "input.reaction_torque", "joint1.torque_in"} <= fed
    assert fed.isdisjoint({"input.angle", "input.speed", "output.angle", "output.speed"})


def test_page_is_the_same_each_time_and_escapes_what_it_is_given() -> None:
    assert made() == made()
    assert "A &lt; B." in made()
    assert "none (interpreted only)" in made(binaries=())
    code = "from tests.build.test_documentation import made; import sys; sys.stdout.buffer.write(made().encode())"
    other = subprocess.run([sys.executable, "-B", "-c", code], capture_output=True, check=True,
                           cwd=Path(__file__).parents[2])
    assert other.stdout.decode() == made()


def test_example_on_the_page_runs(fmu: Path, tmp_path: Path) -> None:
    match = re.search(r'<pre id="example">(.*?)</pre>', made(), re.DOTALL)
    assert match is not None
    (tmp_path / "CardanDriveline.fmu").write_bytes(fmu.read_bytes())
    code = unescape(match.group(1)) + (
        "\nimport json, os\nprint(json.dumps([float(abs(result['energy.residual']).max()), len(result)]), flush=True)"
        "\nos._exit(0)")
    done = subprocess.run([sys.executable, "-I", "-B", "-c", code], capture_output=True, text=True, cwd=tmp_path,
                          check=False)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    slowest, fastest = (float(each) for each in lines[-2].split())
    largest = 314.0 * math.cos(0.26) / math.cos(0.35)  # ratio at the start, where joint 1 has its largest
    assert 0.95 * largest < slowest < 0.995 * largest < fastest < 1.001 * largest
    residual, rows = json.loads(lines[-1])
    assert rows == 201
    assert residual < 1e-4, "of 7e4 J of kinetic energy, at a tolerance of 1e-9"


def test_licences_are_inside(fmu: Path) -> None:
    with zipfile.ZipFile(fmu) as opened:
        texts = {name: opened.read(f"documentation/licenses/{name}.txt").decode() for name in
                 ("license", "pythonfmu", "fmi")}
        needs = opened.read("documentation/externalDependencies.txt").decode()
    assert "cardan-driveline contributors" in texts["license"]
    assert "NTNU" in texts["pythonfmu"]
    assert texts["fmi"] == notices.FMI_HEADERS
    assert "Modelica Association" in texts["fmi"] and "Redistributions in binary form" in texts["fmi"]
    assert "Python 3.9 or later" in needs and "LD_PRELOAD" in needs
