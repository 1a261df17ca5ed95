"""Stored outputs of a notebook are taken as long as they are those of the package as it stands."""

import importlib.util
import json
from pathlib import Path
from types import SimpleNamespace

import execution
import pytest
from helpers import ROOT
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

NOTEBOOK = new_notebook(cells=[new_code_cell("a"), new_markdown_cell("b"), new_code_cell("c")])


@pytest.fixture
def project(tmp_path):
    """A folder with a package of a module and a script."""
    for name in ("suspension/robot.py", "suspension/page/model.js", "data/spring_data.csv"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("before", encoding="utf-8")
    (tmp_path / "requirements.txt").write_text("before", encoding="utf-8")
    return tmp_path


def edit(project, name):
    (project / name).write_text("after", encoding="utf-8")


@pytest.mark.parametrize(
    ("name", "counts"),
    {
        "suspension/robot.py": True,
        "suspension/new.mplstyle": True,
        "data/spring_data.csv": True,
        "data/spring_data.mat": True,
        "requirements.txt": True,
        "suspension/page/model.js": False,
        "suspension/page/explorer.css": False,
        "notes.md": False,
    }.items(),
)
def test_outputs_are_kept_until_something_changes_that_makes_them(project, name, counts):
    before = execution.fingerprint(project)
    assert execution.fingerprint(project) == before
    edit(project, name)
    assert (execution.fingerprint(project) != before) == counts


def test_the_place_of_outputs_follows_the_code_alone():
    cells = [*NOTEBOOK.cells[:1], new_markdown_cell("other"), *NOTEBOOK.cells[2:]]
    path, build = Path("01-a.ipynb"), Path("_build")
    place = execution.place(path, NOTEBOOK, "1", build)
    assert execution.place(path, new_notebook(cells=cells), "1", build) == place
    assert execution.place(path, new_notebook(cells=cells[1:]), "1", build) != place
    assert execution.place(path, NOTEBOOK, "2", build) != place


# --- what nbval executes ------------------------------------------------------------------------


@pytest.fixture
def hook(project, monkeypatch):
    """A function that runs a notebook's cells with the hook of `notebooks/conftest.py` around."""
    path = ROOT / "notebooks" / "conftest.py"
    spec = importlib.util.spec_from_file_location("conftest_of_notebooks", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setattr(module, "ROOT", project)

    def run(*cells):
        parent = SimpleNamespace(nb=NOTEBOOK)
        for cell in cells:
            item = SimpleNamespace(path=Path("01-a.ipynb"), parent=parent)
            around = module.pytest_runtest_call(item)
            next(around)
            try:
                item.test_outputs = [cell()]
            except ZeroDivisionError as error:
                with pytest.raises(ZeroDivisionError):
                    around.throw(error)
            else:
                with pytest.raises(StopIteration):
                    around.send(None)
        return sorted((project / "_build").rglob("*.json"))

    return run


def test_nbval_keeps_outputs_where_the_book_looks(project, hook):
    (kept,) = hook(lambda: "first", lambda: "second")
    common = execution.fingerprint(project)
    assert kept == execution.place(Path("01-a.ipynb"), NOTEBOOK, common, project / "_build")
    outputs = json.loads(kept.read_text(encoding="utf-8"))["outputs"]
    assert outputs == [["first"], ["second"]]


@pytest.mark.parametrize("when", [0, 1])
def test_nbval_keeps_nothing_of_a_package_that_is_edited_meanwhile(project, hook, when):
    cells = [lambda: "first", lambda: "second"]
    cells[when] = lambda: edit(project, "suspension/robot.py")
    assert not hook(*cells)


def test_nbval_keeps_nothing_of_a_notebook_with_an_error_or_of_half_a_notebook(hook):
    assert not hook(lambda: "first", lambda: 1 / 0)
    assert not hook(lambda: "first")
