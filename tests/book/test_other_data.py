"""The book with other spring data and another robot: every number, verdict and sentence follows.

All code of the notebooks runs with them (`displays`), and what a reader would read is put together
from text and outputs, without the pages around it: that pages can be made of these is tested with
the data that the book ships with. The words for other springs still are tested one by one in
`tests/unit/test_report_*.py`.
"""

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import nbformat
import numpy as np
import pytest
import scipy.io
from cases import faults, loading_and_unloading, readings
from displays import run_apart
from helpers import PAGES, ROOT, windows_locale

from suspension import RK4, GaussianBump, Robot, critical_speeds, margin
from suspension.problem import SPEEDS, STEPS
from suspension.report.words import number
from suspension.springs import fit_spring, load_spring_data

NOTEBOOKS = sorted(ROOT.glob("notebooks/*.ipynb"))
NEVER = {
    "a number that is none": r"\bnan\b|\binf\b|\bNone\b|\bnone m/s",
    "a number of a programming language": r"\d[eE][+-]?\d",
    "more digits than are known": r"\d\.\d{11}",
    "a percentage rounded to nothing": r"(?<![\d.])0(\.0+)?\s?%",
    "a probability rounded to nothing": r"p\s=\s0(\.0+)?(?![\d.])",
    "a hyphen for a minus": r"(?<![\w).\]}–/-])-\d",
    "a list of nothing": r"\b(at|of|by) and\b",
}
NOT_READ = re.compile(
    r"```.*?```|\$\$.*?\$\$|\$[^$]*\$|`[^`]*`|\]\([^)]*\)|^\|[:|-]+\|$|</?[a-z][^<>]*>",
    re.DOTALL | re.MULTILINE,
)
LINK = re.compile(r"\]\(([^)\s]*)\)")
QUOTED = re.compile(r"\{result\}`?\s?([\w-]+)")


ALONG = {"m": 2.0, "L1": 0.12, "L2": 0.095, "c2": 2.2}


# --- the data ---------------------------------------------------------------------------------


def soft_spring(folder):
    """250 N/m, as a spreadsheet writes it: nothing flies, and RK4 is stable at 0.1 s."""
    data = readings(250, noise=0.02, points=15).round(3)
    text = data.to_csv(index=False, sep=";", decimal=",")
    (folder / "spring_data.csv").write_text(text, encoding="utf-16")


def curved_spring(folder):
    """A preload and a curvature that no test for linearity can miss, in the course's format; and
    from Part IV on a robot that is not symmetric."""
    (folder / "robot.json").write_text(json.dumps(ALONG), encoding="utf-8")
    data = readings(667, preload=1.5, curvature=4, points=22)
    scipy.io.savemat(folder / "spring_data.mat", {name: data[name].to_numpy() for name in data})


def three_displacements(folder):
    """Three loads, five times each: they fit a parabola, and say nothing of a cubic term."""
    x = np.repeat([0, 0.5, 1], 5)
    force = 13.2 * x + np.random.default_rng(4).normal(0, 0.1, x.size)
    write(folder, x, force.round(3))


def perfect_line(folder):
    """Readings without any scatter: all intervals are points."""
    x = np.linspace(0, 1, 11).round(1)
    write(folder, x, (13.2 * x).round(2))


def both_ways(folder):
    """A spring that gives back less than it took: residuals of one sign stand together."""
    force, x = loading_and_unloading()
    write(folder, x, force.round(3))


def four_readings(folder):
    """The fewest that are read: one degree of freedom, intervals that reach below zero."""
    x = np.array([0, 0.3, 0.7, 1])
    write(folder, x, 13.2 * x + np.array([0.1, -0.2, 0.15, 0]))


def write(folder, x, force):
    rows = [f"{float(a)},{float(b)}" for a, b in zip(x, force)]
    text = "\n".join(["delta_over_delta_max,force", *rows, ""])
    (folder / "spring_data.csv").write_text(text, encoding="utf-8")


# --- the book ---------------------------------------------------------------------------------


class Book(NamedTuple):
    """What a reader reads in each notebook, what it names for other pages, and the spring.

    Attributes
    ----------
    pages : dict of str to str
        Text and outputs, without code and formulas, by the notebook's name.
    shown : dict of str to list of dict
        What was displayed in each notebook, by MIME type.
    results : dict of str to list of str
        What was shown under a name, as often as it was.
    links : dict of str to list of str
        Where the computed sentences of a notebook lead.
    along : dict
        What else the robot of Part IV and further has than the problem's.
    """

    name: str
    pages: dict
    shown: dict
    results: dict
    links: dict
    data: object
    along: dict

    @property
    def fit(self):
        return fit_spring(self.data)

    @property
    def robot(self):
        """That of Parts II and III, which have a cell of parameters."""
        k = self.fit.stiffness
        return Robot(k, k)

    def answer(self, item):
        """What a notebook shows as the answer to an item."""
        (text,) = self.results["answer-" + item.replace("(", "-").replace(")", "")]
        return read(text)


def read(text):
    """What is read of Markdown: no code, no formulas, no addresses."""
    return NOT_READ.sub(" ", text).replace("\u00a0", " ")


def texts(output):
    """A picture's alternative text, or Markdown; nothing of what has a page's own HTML."""
    if "alt" in output["metadata"]:
        return [output["metadata"]["alt"]]
    return [output["data"]["text/markdown"]] if "text/markdown" in output["data"] else []


def names(output):
    given = output["metadata"].get("scrapbook")
    return [given["name"]] if given else []


FIT, VERDICTS, LAW = "01-regression", "06-how-sure", "08-measured-spring"
PARTS = {
    # The spring is another one, so everything is.
    soft_spring: None,
    curved_spring: None,
    # The spring is that of the book as it ships, but less, or more, is known of it.
    three_displacements: (FIT,),
    both_ways: (FIT, VERDICTS),
    perfect_line: (FIT, VERDICTS, LAW),
    four_readings: (FIT, VERDICTS, LAW),
}


@pytest.fixture(scope="module", params=PARTS, ids=lambda make: make.__name__)
def other_book(request, tmp_path_factory):
    """A book that was computed with such data."""
    make = request.param
    folder = tmp_path_factory.mktemp(make.__name__)
    make(folder)
    (file,) = folder.glob("spring_data.*")
    system = windows_locale(tmp_path_factory.mktemp("locale"))
    paths = [path for path in NOTEBOOKS if not PARTS[make] or path.stem in PARTS[make]]
    displayed = run_apart(folder, paths, **system)
    pages, shown, results, links = {}, {}, {}, {}
    for path in paths:
        outputs = displayed[path.stem]
        shown[path.stem] = [output["data"] for cell in outputs.values() for output in cell]
        whole, computed = [], []
        for cell in nbformat.read(path, as_version=4).cells:
            if cell.cell_type == "markdown":
                whole.append(cell.source)
            for output in outputs.get(cell.id, ()):
                computed += texts(output)
                whole += texts(output)
                for name in names(output):
                    results.setdefault(name, []).append(output["data"].get("text/markdown", ""))
        pages[path.stem] = read("\n\n".join(whole))
        links[path.stem] = LINK.findall("\n".join(computed))
    along = ALONG if (folder / "robot.json").exists() else {}
    return Book(make.__name__, pages, shown, results, links, load_spring_data(file), along)


@pytest.fixture(scope="module")
def whole_book(other_book):
    """A book of which every part was computed."""
    if len(other_book.pages) < len(NOTEBOOKS):
        pytest.skip("its robot is that of the book as it ships")
    return other_book


# --- what it says -----------------------------------------------------------------------------


@pytest.mark.parametrize("what", NEVER)
def test_no_page_shows(other_book, what):
    found = {
        page: [
            text[max(at.start() - 40, 0) : at.end() + 40] for at in re.finditer(NEVER[what], text)
        ]
        for page, text in other_book.pages.items()
    }
    assert not {page: places for page, places in found.items() if places}


def test_whatever_another_page_quotes_is_shown_once(whole_book):
    pages = [ROOT / f"{page}.md" for page in PAGES if (ROOT / f"{page}.md").exists()]
    quoted = {name for page in pages for name in QUOTED.findall(page.read_text(encoding="utf-8"))}
    assert len(quoted) > 30
    assert {name: len(whole_book.results.get(name, ())) for name in quoted} == dict.fromkeys(
        quoted, 1
    )


def slugs(text):
    """The anchors that headings and labels of Markdown make."""
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    plain = [re.sub(r"[^\w\- ]", "", heading.lower()) for heading in headings]
    labels = re.findall(r"^\(([\w-]+)\)=|^:name: ([\w-]+)|\(((?:eq|sec)-[\w-]+)\)$", text, re.M)
    return {heading.replace(" ", "-") for heading in plain} | {"".join(x) for x in labels}


def test_computed_sentences_link_to_what_is_there(whole_book):
    anchors = {}
    for page in PAGES:
        for path in ROOT.glob(f"{page}.*"):
            if path.suffix == ".ipynb":
                cells = nbformat.read(path, as_version=4).cells
                text = "\n\n".join(c.source for c in cells if c.cell_type == "markdown")
            else:
                text = path.read_text(encoding="utf-8")
            anchors[path.name] = slugs(text)
    works = (ROOT / "book" / "references.bib").read_text(encoding="utf-8")
    anchors["references.md"] |= set(re.findall(r"^@\w+\{(\w+),", works, re.MULTILINE))
    assert sum(map(len, whole_book.links.values())) > 10
    for page, targets in whole_book.links.items():
        for target in targets:
            file, _, anchor = target.partition("#")
            name = Path(file).name or f"{page}.ipynb"
            assert name in anchors, target
            known = anchors[name] | whole_book.results.keys()
            assert not anchor or anchor.startswith("explore") or anchor in known, target


def test_no_page_calls_the_data_synthetic(other_book):
    claims = re.compile(r"these data are synthetic|data are \*{0,2}synthetic", re.IGNORECASE)
    assert not [page for page, text in other_book.pages.items() if claims.search(text)]
    assert "not the synthetic data" in other_book.results["data-source"][0]


def test_a_spring_is_called_linear_if_its_readings_allow_it(other_book):
    text = other_book.answer("1(iv)")
    assert ("is justified" in text) == other_book.fit.linearity().linear
    assert other_book.fit.linearity().linear == (other_book.name != "curved_spring")


def test_three_displacements_and_readings_without_scatter_are_not_judged(other_book):
    text = other_book.pages[FIT]
    judged = other_book.name not in ("three_displacements", "perfect_line", "four_readings")
    assert ("cubic term would be" in text) == judged
    assert ("a cubic term cannot be tried" in text) == (other_book.name == "three_displacements")
    assert ("goes through every reading" in text) == (other_book.name == "perfect_line")


def test_no_interval_is_believed_where_the_residuals_contradict_it(other_book):
    quoted = ["answer-1-ii", "answer-1-iii", "answer-1-iv", "stiffness-table"]
    if VERDICTS in other_book.pages:
        quoted += ["critical-table", "flip-note"]  # shown on the answers' page, too
    warned = {name for name in quoted if "cannot be relied on" in other_book.results[name][0]}
    assert warned == (set(quoted) if other_book.name == "both_ways" else set())
    assert ("known to about" in other_book.pages[FIT]) == (
        other_book.name not in ("both_ways", "perfect_line")
    )


def test_the_verdicts_follow_the_spring(whole_book):
    lost = [v for v in SPEEDS if margin(whole_book.robot, GaussianBump(), v) < 0]
    for item in ("6(i)", "6(iii)", "10(i)"):
        answer = whole_book.answer(item)
        rows = re.findall(r"^\| (0\.25|1\.2|5|10) \| (kept|lost)\b", answer, re.MULTILINE)
        if item != "6(iii)":
            assert rows == [(f"{v:g}", "lost" if v in lost else "kept") for v in SPEEDS]
        sentence = re.search(r"[Cc]ontact is lost at (.*?)(, and|:|\.\s|\.$)", answer)[1]
        if lost:
            assert re.findall(r"[\d.]+", sentence) == [f"{v:g}" for v in lost]
        else:
            assert sentence == "none of the four speeds"


def test_only_unstable_runs_are_called_unstable(whole_book):
    limit = RK4.max_stable_dt(whole_book.robot.eigenvalues)
    called = dict(re.findall(r"\| ([\d.]+) \| (unstable|stable) \|", whole_book.answer("9(iii)")))
    assert called == {f"{dt:g}": "unstable" if dt > limit else "stable" for dt in STEPS}


# --- what it says of another robot ------------------------------------------------------------


def test_nothing_computed_has_a_fault(whole_book):
    for shown in whole_book.shown.values():
        said = [data.get("text/markdown", "") for data in shown]
        assert not [fault for text in said for fault in faults(text)]
        plain = [data.get("text/plain", "") for data in shown]
        assert not [text for text in plain if re.search(r"\bFalse\b|\bnan\b", text)]


def test_a_part_of_the_twin_says_so(whole_book):
    robot = replace(whole_book.robot, **whole_book.along)
    length = f"$L$ = {number((robot.L1 + robot.L2) / 2)}"
    code = {path.stem: path.read_text(encoding="utf-8") for path in NOTEBOOKS}
    asked = {part for part, text in code.items() if "the_robot().twin, " in text}
    noted = {
        part
        for part, shown in whole_book.shown.items()
        for data in shown
        if "symmetric twin" in data.get("text/markdown", "") and length in data["text/markdown"]
    }
    assert asked
    if whole_book.along:
        assert asked <= noted <= {part for part, text in code.items() if ".twin" in text}
    else:
        assert not noted


def test_the_verdict_beyond_is_that_of_the_robot(whole_book):
    robot = replace(whole_book.robot, **whole_book.along)
    (text,) = whole_book.results["critical-verdict"]
    found = critical_speeds(robot, GaussianBump(), 0.3, 30)
    assert all(number(v) in text for v in found)
    if whole_book.along:
        twins = critical_speeds(whole_book.robot, GaussianBump(), 0.3, 30)
        assert len(found) and not all(number(v) in text for v in twins)
