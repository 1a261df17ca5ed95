"""Parts II and III are those of any robot, road and speeds that their cell of parameters has.

The other parts for another robot are in `test_other_data.py`.
"""

import ast
import contextlib
import io
import linecache
import re
from dataclasses import dataclass, field

import matplotlib.pyplot as plt
import nbformat
import numpy as np
import pytest
from cases import faults
from helpers import ROOT
from listings import numbers, printed_by

from suspension.contact import normal_forces
from suspension.exact import over_bump
from suspension.report import show
from suspension.report.words import count, number, speed_list
from suspension.road import GaussianBump
from suspension.robot import Robot

PARTS = ("02-crank-nicolson", "03-runge-kutta")
OTHERS = {  # lines below those of the cell of parameters
    "unsymmetric": (
        "L1, L2, c1, c2, k1, k2 = 0.09, 0.13, 1.2, 1.9, 700, 900\nm, Izz = 1.3, 0.02",
        "speeds = (0.2, 0.6, 1.2, 3, 6, 15)",
    ),
    "soft, on another bump": (
        "k1 = k2 = 500",
        "height, sigma, x0, distance = 0.03, 0.05, 0.6, 1.8\nspeeds = (0.5, 1.5, 4)",
    ),
    "undamped": ("c1 = c2 = 0",),
    "overdamped, on the bump's tail": (
        "c1 = c2 = 60\ndts = (0.05, 0.02, 0.002)",
        "sigma = 0.06\nspeeds = (0.3, 1)",
    ),
    "a car, at one speed": (
        "m, Izz, L1, L2, k1, k2 = 730, 1230, 1.4, 1.1, 28000, 25000",
        "c1, c2 = 1800, 1600\nheight, sigma, x0, distance = 0.1, 0.3, 4, 12\nspeeds = (12,)",
    ),
}


@dataclass
class Page:
    """What the cells of a notebook left behind, printed and showed."""

    names: dict = field(default_factory=dict)
    outputs: list = field(default_factory=list)  # printed texts and values of last lines
    texts: list = field(default_factory=list)  # Markdown

    def answer(self, item):
        (said,) = [text for text in self.texts if text.startswith(f"**Answer {item}.**")]
        return said

    def listing(self, last):
        (block,) = [text for text in self.texts if text.endswith(f"\n{last}\n```")]
        return block.removeprefix("```python\n").removesuffix("```")


def run(cell, page, code):
    """Execute a cell as a notebook does: its last line, if it is an expression, is its output."""
    name = f"<{cell.id}>"
    linecache.cache[name] = len(code), None, code.splitlines(keepends=True), name
    body = ast.parse(code).body
    last = body.pop() if body and isinstance(body[-1], ast.Expr) else None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(ast.Module(body, []), name, "exec"), page.names)
        if last:
            value = eval(compile(ast.Expression(last.value), name, "eval"), page.names)
            page.outputs.append("" if value is None else repr(value))
    page.outputs.append(printed.getvalue())


def read(part, changes, road=None):
    """Execute a notebook with other parameters, and another `Hgauss`; without its explorer."""
    page = Page(names={"__name__": "__main__"})
    patch = pytest.MonkeyPatch()
    with patch.context() as patched:
        patched.setattr(show, "svg", lambda figure: "")
        patched.setattr(show, "narrow", lambda figure: figure)
        patched.setattr(
            show, "display", lambda shown, **_: page.texts.append(getattr(shown, "data", ""))
        )
        for cell in nbformat.read(ROOT / "notebooks" / f"{part}.ipynb", as_version=4).cells:
            if cell.cell_type != "code" or cell.source.startswith("explore("):
                continue
            code = re.sub(r"^%.*\n", "", cell.source, flags=re.MULTILINE)
            if "load_spring_data" in code:
                code += "\n" + "\n".join(changes)
            if road and "def Hgauss" in code:
                code = re.sub(r"def Hgauss(.|\n)*?(?=\n\n\n)", road, code)
            run(cell, page, code)
            plt.close("all")
    page.texts = [text for text in page.texts if isinstance(text, str) and text]
    return page


@pytest.fixture(scope="module")
def pages():
    read_pages = {}

    def page(part, name):
        if (part, name) not in read_pages:
            read_pages[part, name] = read(part, OTHERS[name])
        return read_pages[part, name]

    return page


each_other = pytest.mark.parametrize("name", OTHERS)


def told(page):
    """Robot, bump and speeds as the page's own parameters have them."""
    names = page.names
    robot = Robot(**{key: names[key] for key in "k1 k2 g m Izz L1 L2 c1 c2".split()})
    return robot, GaussianBump(*(names[key] for key in ("height", "sigma", "x0"))), names["speeds"]


@each_other
@pytest.mark.parametrize("part", PARTS)
def test_runs_to_its_end_and_its_words_fit(part, name, pages):
    page = pages(part, name)
    assert not [fault for text in page.texts for fault in faults(text)]
    assert not [text for text in page.outputs if re.search(r"\bFalse\b|\bnan\b", text)]


@each_other
def test_where_the_stiffness_is_from_is_said(name, pages):
    page = pages("02-crank-nicolson", name)
    fitted = name in ("undamped", "overdamped, on the bump's tail")
    k = f"{number(page.names['k1'], 4)}\u00a0N/m"
    assert k in page.answer("3(i)")
    assert ("from Part I," in page.answer("3(i)")) == fitted
    assert ("stiffness of Question 1" in page.answer("6(i)")) == fitted
    assert ("stiffnesses that were chosen" in page.answer("6(i)")) != fitted


@each_other
@pytest.mark.parametrize("part, item", [(PARTS[0], "6(i)"), (PARTS[1], "10(i)")])
def test_the_verdicts_are_those_of_the_closed_form(part, item, name, pages):
    page = pages(part, name)
    robot, bump, speeds = told(page)
    lost = []
    for v in speeds:
        T = np.linspace(0, page.names["distance"] / v, 20_001)
        N = normal_forces(robot, bump, v, T, over_bump(robot, bump, v, T))
        lost += [v] * bool((N <= 0).any())
    first = page.answer(item).split("\n")[0]
    if lost:
        assert f"Contact is lost at v = {speed_list(lost)}" in first
    else:
        assert "is lost at none" in first or "Contact is kept" in first
    tried = count(len(speeds), "speed")
    assert (tried in first) == (len(speeds) > 1)
    again = page.answer("6(iii)") if item == "6(i)" else page.answer(item)
    assert "conclusions do not change" in again or "verdicts agree" in again


@each_other
def test_the_end_of_the_way_is_the_one_that_was_chosen(name, pages):
    page = pages("02-crank-nicolson", name)
    (said,) = [text for text in page.texts if "after $X$" in text or "After $X$" in text]
    assert f"$X$ = {page.names['distance']:g} m" in said


@each_other
def test_the_error_falls_by_a_factor_of_four_whatever_the_robot(name, pages):
    """So the reference is exact, symmetric robot or not, flat ground or not."""
    page = pages("02-crank-nicolson", name)
    assert "expected factor? Yes" in page.answer("5(iii)")
    robot, bump, _ = told(page)
    exact = over_bump(robot, bump, 0, page.names["tfinal"], page.names["w0"])[2]
    for part in PARTS:
        theta = pages(part, name).names["exact_pitch"](page.names["tfinal"])
        assert theta == pytest.approx(exact, abs=1e-10)


@each_other
@pytest.mark.parametrize(
    "part, last, item",
    [
        (PARTS[0], "pitch_table()", "5(ii)"),
        (PARTS[1], "equilibrium_check()", "8(ii)"),
        (PARTS[1], "pitch_table()", "9(ii)"),
    ],
)
def test_the_script_prints_the_answer(part, last, item, name, pages, tmp_path):
    page = pages(part, name)
    known = [0, *numbers(page.answer(item))]
    for value in numbers(printed_by(page.listing(last), tmp_path)):
        close = [abs(value - said) <= 0.01 * said + 1e-10 for said in known]
        assert any(close), (value, known)


RAMP = """def Hgauss(x):
    x = np.asarray(x) - 0.5
    here = np.where(np.abs(x) < 0.2, 1 / 80, 0.0)
    return here * (0.2 - np.abs(x)), -here * np.sign(x)"""


@pytest.mark.parametrize("part, item", [(PARTS[0], "6(i)"), (PARTS[1], "10(i)")])
def test_another_road_in_its_cell_changes_the_answers(part, item):
    """A gentle ramp and back, with kinks: the bump's verdicts are not its verdicts."""
    page = read(part, (), RAMP)
    assert "lost at none of the four speeds" in page.answer(item)
    assert not [text for text in page.outputs if "False" in text]
    assert not [fault for text in page.texts for fault in faults(text)]
