"""Other spring data in data/: every number, verdict and sentence of the notebooks follows."""

import os
import re
import shutil
from pathlib import Path

import nbformat
import numpy as np
import pytest
import scipy.io
from nbclient import NotebookClient

ROOT = Path(__file__).resolve().parents[2]


def spring_table(stiffness):
    """Readings of a linear spring with a little noise, as the course's file names them."""
    x = np.linspace(0, 1, 21)
    force = stiffness * 0.0165 * x + np.random.default_rng(1).normal(0, 0.01, x.size)
    return {"delta_over_delta_max": x, "force": force}


@pytest.fixture(scope="module", params=[500, 1000])
def swapped(request, tmp_path_factory):
    """The stiffness, and the text each notebook shows with such data in place of ours."""
    tree = tmp_path_factory.mktemp(f"k{request.param}")
    for folder in ("suspension", "notebooks", "data"):
        shutil.copytree(ROOT / folder, tree / folder)
    scipy.io.savemat(tree / "data" / "spring_data.mat", spring_table(request.param))
    return request.param, {
        part: shown(tree / "notebooks" / f"{part}.ipynb", tree)
        for part in ("01-regression", "02-crank-nicolson", "03-runge-kutta")
    }


def shown(path, tree):
    """All Markdown a notebook computes."""
    notebook = nbformat.read(path, as_version=4)
    client = NotebookClient(notebook, resources={"metadata": {"path": str(path.parent)}})
    client.execute(env={**os.environ, "PYTHONPATH": str(tree)})
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return "\n".join(output.get("data", {}).get("text/markdown", "") for output in outputs)


LOST = {500: "1.2 m/s", 1000: "1.2, 5 and 10 m/s"}


@pytest.mark.parametrize(
    ("part", "items"), [("02-crank-nicolson", ["6(i)", "6(iii)"]), ("03-runge-kutta", ["10(i)"])]
)
def test_the_verdicts_follow_the_stiffness(swapped, part, items):
    stiffness, texts = swapped
    for item in items:
        sentence = texts[part].split(f"**Answer {item}.**")[1].split("\n")[0]
        assert f"lost at v = {LOST[stiffness]}" in sentence


def test_the_verdict_table_follows_the_stiffness(swapped):
    stiffness, texts = swapped
    rows = texts["03-runge-kutta"].split("**Answer 10(i).**")[1].split("\n")[4:8]
    lost = [row.split("|")[1].strip() for row in rows if row.split("|")[2].strip() == "lost"]
    assert lost == LOST[stiffness].replace(" m/s", "").replace(" and ", ", ").split(", ")


def test_the_regression_knows_its_data(swapped):
    stiffness, texts = swapped
    assert "spring_data.mat" in texts["01-regression"]
    assert "These data are synthetic" not in texts["01-regression"]
    k = float(re.search(r"([\d.]+)\\ \\text\{N/m\}", texts["01-regression"])[1])
    assert k == pytest.approx(stiffness, rel=0.02)
