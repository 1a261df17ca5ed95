"""Other spring data in data/: every number, verdict and sentence of Parts I to III follows.

The words for other springs still are tested one by one in `tests/unit/test_report_*.py`, and whole
books with a soft and a curved one are read in `test_other_data.py`.
"""

import os
import re
import shutil
from concurrent.futures import ThreadPoolExecutor

import nbformat
import pytest
import scipy.io
from cases import faults, readings
from helpers import ROOT
from nbclient import NotebookClient

PARTS = ("01-regression", "02-crank-nicolson", "03-runge-kutta")
SPRINGS = {
    "k = 250": {"stiffness": 250, "noise": 0.01},
    "k = 1000": {"stiffness": 1000, "noise": 0.01},
}
LOST = {
    "k = 250": "contact is lost at none of the four speeds",
    "k = 1000": "contact is lost at v = 1.2, 5 and 10 m/s",
}
UNSTABLE = {
    "k = 250": "the run with 0.2 s, predicted unstable, grows",
    "k = 1000": "the runs with 0.2 and 0.1 s, predicted unstable, grow",
}


@pytest.fixture(scope="module", params=SPRINGS)
def swapped(request, tmp_path_factory):
    """The name of a spring, and what each notebook shows with its data in place of ours."""
    tree = tmp_path_factory.mktemp("swapped")
    for folder in ("suspension", "notebooks", "data"):
        shutil.copytree(ROOT / folder, tree / folder)
    data = readings(**SPRINGS[request.param])
    scipy.io.savemat(tree / "data" / "spring_data.mat", data.to_dict("list"))
    paths = [tree / "notebooks" / f"{part}.ipynb" for part in PARTS]
    with ThreadPoolExecutor() as pool:
        texts = pool.map(shown, paths, [tree] * len(paths))
    return request.param, dict(zip(PARTS, texts))


def shown(path, tree):
    """All Markdown that a notebook computes and the alt texts of its figures, with plain spaces."""
    notebook = nbformat.read(path, as_version=4)
    notebook.cells = [cell for cell in notebook.cells if "explore(" not in cell.source]
    client = NotebookClient(notebook, resources={"metadata": {"path": str(path.parent)}})
    client.execute(env={**os.environ, "PYTHONPATH": str(tree)})
    texts = []
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            texts.append(output.get("data", {}).get("text/markdown", ""))
            texts.append(output.get("metadata", {}).get("alt", ""))
    return "\n\n".join(filter(None, texts)).replace("\u00a0", " ")


def answer(texts, part, item):
    """The answer to an item, up to the next one."""
    return texts[part].split(f"**Answer {item}.**")[1].split("**Answer")[0]


@pytest.mark.parametrize("part", PARTS)
def test_nothing_is_false_to_the_eye(swapped, part):
    _, texts = swapped
    assert len(texts[part]) > 2000
    assert not faults(texts[part])


@pytest.mark.parametrize(
    ("part", "items"), [("02-crank-nicolson", ["6(i)", "6(iii)"]), ("03-runge-kutta", ["10(i)"])]
)
def test_the_verdicts_follow_the_spring(swapped, part, items):
    name, texts = swapped
    for item in items:
        sentence = answer(texts, part, item).split("\n")[0]
        assert LOST[name] in sentence.replace("Contact", "contact")


def test_the_verdict_table_follows_the_spring(swapped):
    name, texts = swapped
    rows = answer(texts, "03-runge-kutta", "10(i)").split("\n")[4:8]
    lost = [row.split("|")[1].strip() for row in rows if row.split("|")[2].strip() == "lost"]
    assert lost == re.findall(r"[\d.]+", LOST[name].partition("v = ")[2])


def test_the_captions_follow_the_spring(swapped):
    name, texts = swapped
    lost = LOST[name].partition("v = ")[2]
    for part in PARTS[1:]:
        assert (f"(×, at {lost})" in texts[part]) == bool(lost)
    inside = "0.1 and 0.001 s" if name == "k = 250" else "0.001 s"
    assert f"all lie inside at {inside}" in texts["03-runge-kutta"]


def test_only_unstable_runs_are_called_unstable(swapped):
    name, texts = swapped
    assert UNSTABLE[name] in answer(texts, "03-runge-kutta", "9(iii)")


def test_the_regression_knows_its_data(swapped):
    name, texts = swapped
    assert "spring_data.mat" in texts["01-regression"]
    assert "These data are synthetic" not in texts["01-regression"]
    k = float(re.search(r"([\d.]+)\\ \\text\{N/m\}", texts["01-regression"])[1])
    assert k == pytest.approx(SPRINGS[name]["stiffness"], rel=0.05)
