"""The whole book, built with other spring data: no page breaks, and none says what is not so."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import scipy.io
from bs4 import BeautifulSoup
from helpers import ROOT

PARTS = ("suspension", "notebooks", "data", "book", "benchmarks", "_config.yml", "_toc.yml")
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


def soft_spring(path):
    """250 N/m, as a spreadsheet writes it: nothing flies, and RK4 is stable at 0.1 s."""
    x = np.linspace(0, 1, 15)
    force = 250 * 0.0165 * x + np.random.default_rng(5).normal(0, 0.02, x.size)
    lines = [f"{a:.4f};{b:.3f}".replace(".", ",") for a, b in zip(x, force)]
    path = path / "spring_data.csv"
    path.write_text("\n".join(["delta_over_delta_max;force", *lines, ""]))


def curved_spring(path):
    """A preload and a curvature that no test for linearity can miss, in the course's format."""
    x = np.linspace(0, 1, 22)
    force = 1.5 + 11 * x + 4 * x**2 + np.random.default_rng(6).normal(0, 0.05, x.size)
    scipy.io.savemat(path / "spring_data.mat", {"delta_over_delta_max": x, "force": force})


@pytest.fixture(scope="module", params=[soft_spring, curved_spring], ids=lambda make: make.__name__)
def pages(request, tmp_path_factory):
    """The readable text of every page of a book that was built with such data, by its name."""
    tree = tmp_path_factory.mktemp(request.param.__name__)
    for part in PARTS:
        if (ROOT / part).is_dir():
            shutil.copytree(ROOT / part, tree / part, ignore=shutil.ignore_patterns("*.mat"))
        else:
            shutil.copy(ROOT / part, tree)
    request.param(tree / "data")
    build = [Path(sys.executable).with_name("jupyter-book"), "build", ".", "--all"]
    run = subprocess.run(
        [*build, "-W", "-n", "--keep-going"],
        cwd=tree,
        env=os.environ | {"PYTHONPATH": str(tree)},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, (run.stdout + run.stderr)[-3000:]
    built = tree / "_build" / "html"
    return {
        str(path.relative_to(built)): readable(path)
        for folder in ("book", "notebooks")
        for path in sorted((built / folder).glob("*.html"))
        if path.stem not in NOT_ABOUT_THE_SPRING
    }


def readable(path):
    """What a reader reads on a page, alternative texts included: no code, no formulas."""
    article = BeautifulSoup(path.read_text(), "html.parser").find("article")
    for image in article.find_all("img"):
        image.replace_with(f" {image.get('alt', '')} ")
    for node in article.select("pre, script, style, code, .math, .suspension-explorer-box"):
        node.decompose()
    return article.get_text(" ").replace("\u00a0", " ")


@pytest.mark.parametrize("what", NEVER)
def test_no_page_shows(pages, what):
    found = {
        page: [
            text[max(at.start() - 40, 0) : at.end() + 40] for at in re.finditer(NEVER[what], text)
        ]
        for page, text in pages.items()
    }
    assert not {page: places for page, places in found.items() if places}


def test_no_page_calls_the_data_synthetic(pages):
    claims = re.compile(r"these data are synthetic|data are \*{0,2}synthetic", re.IGNORECASE)
    assert not [page for page, text in pages.items() if claims.search(text)]


def test_a_curved_spring_is_not_called_linear(pages, request):
    curved = request.node.callspec.params["pages"] is curved_spring
    text = pages["notebooks/01-regression.html"]
    assert ("is not justified" in text or "is justified" not in text) == curved
