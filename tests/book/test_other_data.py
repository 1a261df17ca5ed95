"""The whole book, built with other spring data: every number, verdict and sentence follows.

The words for other springs still are tested one by one in `tests/unit/test_report_*.py`.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
import scipy.io
from bs4 import BeautifulSoup
from helpers import ROOT, windows_locale

from suspension import RK4, GaussianBump, Robot, margin
from suspension.springs import fit_spring, load_spring_data

PARTS = ("suspension", "notebooks", "data", "book", "benchmarks", "_config.yml", "_toc.yml")
PARTS += ("pyproject.toml", "README.md", "LICENSE")  # what a wheel is made from
NOT_ABOUT_THE_SPRING = ("reference", "references", "speed")
NEVER = {
    "a number that is none": r"\bnan\b|\binf\b|\bNone\b|\bnone m/s",
    "a number of a programming language": r"\d[eE][+-]?\d",
    "more digits than are known": r"\d\.\d{11}",
    "a percentage rounded to nothing": r"(?<![\d.])0(\.0+)?\s?%",
    "a probability rounded to nothing": r"p\s=\s0(\.0+)?(?![\d.])",
    "a hyphen for a minus": r"(?<![\w).\]}–/-])-\d",
    "a list of nothing": r"\b(at|of|by) and\b",
}


ASKED = (0.25, 1.2, 5, 10)  # m/s
STEPS = (0.2, 0.1, 0.001)  # s


class Book(NamedTuple):
    """The readable text of every page, by its name, and what the pages are about."""

    pages: dict
    data: Path
    robot: Robot

    def answer(self, part, item):
        """What a notebook's page says from an answer to the next one."""
        text = " ".join(self.pages[f"notebooks/{part}.html"].split())
        return text.split(f"Answer {item}.")[1].split("Answer")[0]


def soft_spring(path):
    """250 N/m, as a spreadsheet writes it: nothing flies, and RK4 is stable at 0.1 s."""
    x = np.linspace(0, 1, 15)
    force = 250 * 0.0165 * x + np.random.default_rng(5).normal(0, 0.02, x.size)
    lines = [f"{a:.4f};{b:.3f}".replace(".", ",") for a, b in zip(x, force)]
    path = path / "spring_data.csv"
    path.write_text("\n".join(["delta_over_delta_max;force", *lines, ""]), encoding="utf-8")
    return path


def curved_spring(path):
    """A preload and a curvature that no test for linearity can miss, in the course's format."""
    x = np.linspace(0, 1, 22)
    force = 1.5 + 11 * x + 4 * x**2 + np.random.default_rng(6).normal(0, 0.05, x.size)
    path = path / "spring_data.mat"
    scipy.io.savemat(path, {"delta_over_delta_max": x, "force": force})
    return path


@pytest.fixture(scope="module", params=[soft_spring, curved_spring], ids=lambda make: make.__name__)
def book(request, tmp_path_factory):
    """A book that was built with such data, on a system that does not speak UTF-8 by itself."""
    tree = tmp_path_factory.mktemp(request.param.__name__)
    for part in PARTS:
        if (ROOT / part).is_dir():
            shutil.copytree(ROOT / part, tree / part, ignore=shutil.ignore_patterns("*.mat"))
        else:
            shutil.copy(ROOT / part, tree)
    data = request.param(tree / "data")
    system = windows_locale(tmp_path_factory.mktemp("locale"))
    build = [Path(sys.executable).with_name("jupyter-book"), "build", ".", "--all"]
    run = subprocess.run(
        [*build, "-W", "-n", "--keep-going"],
        cwd=tree,
        env=os.environ | system | {"PYTHONPATH": str(tree)},
        capture_output=True,
        encoding="utf-8",
        errors="replace",
    )
    assert run.returncode == 0, (run.stdout + run.stderr)[-3000:]
    built = tree / "_build" / "html"
    pages = {
        str(path.relative_to(built)): readable(path)
        for folder in ("book", "notebooks")
        for path in sorted((built / folder).glob("*.html"))
        if path.stem not in NOT_ABOUT_THE_SPRING
    }
    k = fit_spring(load_spring_data(data)).stiffness
    return Book(pages, data, Robot(k, k))


def readable(path):
    """What a reader reads on a page, alternative texts included: no code, no formulas."""
    article = BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser").find("article")
    for image in article.find_all("img"):
        image.replace_with(f" {image.get('alt', '')} ")
    for node in article.select("pre, script, style, code, .math, .suspension-explorer-box"):
        node.decompose()
    return article.get_text(" ").replace("\u00a0", " ")


@pytest.mark.parametrize("what", NEVER)
def test_no_page_shows(book, what):
    found = {
        page: [
            text[max(at.start() - 40, 0) : at.end() + 40] for at in re.finditer(NEVER[what], text)
        ]
        for page, text in book.pages.items()
    }
    assert not {page: places for page, places in found.items() if places}


def test_no_page_calls_the_data_synthetic(book):
    claims = re.compile(r"these data are synthetic|data are \*{0,2}synthetic", re.IGNORECASE)
    assert not [page for page, text in book.pages.items() if claims.search(text)]
    assert f", {len(load_spring_data(book.data))} readings" in book.pages["book/answers.html"]


def test_a_curved_spring_is_not_called_linear(book):
    curved = book.data.suffix == ".mat"
    text = book.pages["notebooks/01-regression.html"]
    assert ("is not justified" in text or "is justified" not in text) == curved


def test_the_verdicts_follow_the_spring(book):
    lost = [v for v in ASKED if margin(book.robot, GaussianBump(), v) < 0]
    for part, item in (
        ("02-crank-nicolson", "6(i)"),
        ("02-crank-nicolson", "6(iii)"),
        ("03-runge-kutta", "10(i)"),
    ):
        rows = re.findall(r"(?<!\S)(0\.25|1\.2|5|10) (kept|lost)\b", book.answer(part, item))
        assert rows == [(f"{v:g}", "lost" if v in lost else "kept") for v in ASKED]
        sentence = re.search(r"[Cc]ontact is lost at (.*?)(, and|:|\.\s)", book.answer(part, item))[
            1
        ]
        if lost:
            assert re.findall(r"[\d.]+", sentence) == [f"{v:g}" for v in lost]
        else:
            assert sentence == "none of the four speeds"


def test_only_unstable_runs_are_called_unstable(book):
    limit = RK4.max_stable_dt(book.robot.eigenvalues)
    told = book.answer("03-runge-kutta", "9(iii)")
    grows = re.search(r"runs? with ([^,]*?) s, predicted unstable,", told)
    unstable = [f"{dt:g}" for dt in STEPS if dt > limit]
    assert (re.findall(r"[\d.]+", grows[1]) if grows else []) == unstable
