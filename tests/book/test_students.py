"""What is handed out runs by itself: a zip, unpacked elsewhere, with the package from its wheel."""

import json
import re
import sys
import zipfile

import nbformat
import pytest
from helpers import ROOT, environment_with, run_python

sys.path.append(str(ROOT / "book" / "_ext"))

import students

# Executes notebooks in one process, and prints what each check says. A word on stderr is an error.
RUN = """
import json, sys
from pathlib import Path
import matplotlib
import nbformat
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output
import suspension
from suspension.practice import Feedback

matplotlib.use("agg")
shell, said = InteractiveShell.instance(), {}
for path in map(Path, sys.argv[1:]):
    shell.reset()
    words = said[path.stem] = []
    for cell in nbformat.read(path, as_version=4).cells:
        if cell.cell_type == "code":
            with capture_output() as captured:
                result = shell.run_cell(cell.source.replace("%config InlineBackend", "# "))
            result.raise_error()
            assert not captured.stderr, captured.stderr
            if isinstance(result.result, Feedback):
                words.append(str(result.result))
print(json.dumps([suspension.__file__, said]))
"""
WORKBOOK = [path.stem for path in sorted(ROOT.glob("notebooks/workbook/*.ipynb"))]


@pytest.fixture(scope="module")
def copies(tmp_path_factory):
    """Both copies, unpacked, by kind."""
    folder = tmp_path_factory.mktemp("copies")
    for kind in students.KINDS:
        with zipfile.ZipFile(students.hand_out(kind, folder / "made")) as packed:
            packed.extractall(folder / "unpacked")
    return {kind: folder / "unpacked" / f"suspension-{kind}" for kind in students.KINDS}


@pytest.fixture(scope="module")
def python(copies, tmp_path_factory):
    """The interpreter of an environment with the wheel of the students' copy."""
    (wheel,) = copies["students"].glob("*.whl")
    return environment_with(wheel, tmp_path_factory.mktemp("env"))


def executed(python, copy, *paths):
    """What the checks of notebooks say, by the name of a notebook."""
    where, said = json.loads(run_python(python, "-c", RUN, *paths, cwd=copy / "notebooks"))
    assert str(ROOT) not in where
    return said


def sources(folder):
    """The text of each notebook below a folder."""
    return {
        path: "\n".join(cell.source for cell in nbformat.read(path, as_version=4).cells)
        for path in sorted(folder.rglob("*.ipynb"))
    }


def test_a_copy_has_all_that_it_needs(copies):
    for kind, copy in copies.items():
        (wheel,) = copy.glob("suspension-*.whl")
        assert f"./{wheel.name}" in (copy / "requirements.txt").read_text(encoding="utf-8")
        assert (copy / "data" / "spring_data.csv").is_file()
        assert (copy / "START.md").is_file(), kind
        parts = {path.name for path in ROOT.glob("notebooks/*.ipynb")}
        assert {path.name for path in copy.glob("notebooks/*.ipynb")} == parts
        assert [path.stem for path in sorted(copy.glob("notebooks/workbook/*"))] == WORKBOOK


def test_the_versions_are_those_of_the_project(copies):
    pins = (copies["students"] / "constraints.txt").read_text(encoding="utf-8").splitlines()
    names = {pin.partition("==")[0] for pin in pins}
    assert {"jupyterlab", "numpy", "scipy", "statsmodels", "ipykernel"} <= names
    assert all(re.fullmatch(r"[\w.-]+==[\w.!+]+( ; .+)?", pin) for pin in pins)


def test_the_students_copy_holds_no_solution_and_no_answer(copies):
    wanted = {path.name: path for path in ROOT.glob("notebooks/*.ipynb")}
    solutions = [
        cell.source
        for path in ROOT.glob("notebooks/workbook/*.ipynb")
        for cell in nbformat.read(path, as_version=4).cells
        if "solution" in cell.metadata.get("tags", [])
    ]
    assert len(solutions) > 20
    for path, text in sources(copies["students"]).items():
        assert not re.search(r"^#+ (Solution|Answer)\b", text, re.MULTILINE), path
        assert not re.search(r"^answer\(", text, re.MULTILINE), path
        assert not [solution for solution in solutions if solution in text], path
        if path.parent.name == "notebooks":
            whole = sources(wanted[path.name].parent)[wanted[path.name]]
            stays = re.compile(r"^#+ (?:Exercise|Proof|Check)\b.*", re.MULTILINE)
            assert stays.findall(text) == stays.findall(whole)


def test_what_stands_before_and_after_a_solution_stays():
    cells = [
        nbformat.v4.new_markdown_cell("ask\n\n#### Solution\n\nsecret\n\n## Next\n\nstays"),
        nbformat.v4.new_markdown_cell("#### Solution"),
        nbformat.v4.new_code_cell("secret = 1"),
        nbformat.v4.new_code_cell("needed = 3"),
        nbformat.v4.new_markdown_cell("secret\n\n### Proof\n\nstays"),
        nbformat.v4.new_code_cell("stays = needed"),
        nbformat.v4.new_code_cell('answer("1(i)", secret)'),
        nbformat.v4.new_markdown_cell("[the model](../book/model.md#a) and [a part](01-a.ipynb)"),
    ]
    notebook = nbformat.v4.new_notebook(cells=cells)
    made = students.handed_out(notebook, "students", is_workbook=False)
    assert [cell.source for cell in made.cells] == [
        "ask\n\n## Next\n\nstays",
        "needed = 3",
        "### Proof\n\nstays",
        "stays = needed",
        "the model and [a part](01-a.ipynb)",
    ]
    assert "secret" in notebook.cells[0].source  # the book's own stays as it is


def test_the_lecturers_copy_keeps_what_a_solution_says_in_words():
    cells = [
        nbformat.v4.new_markdown_cell("Guess first."),
        nbformat.v4.new_code_cell("x = ...", metadata={"tags": ["blank"]}),
        nbformat.v4.new_code_cell("check(x)"),
        nbformat.v4.new_markdown_cell("#### Solution\n\nIt is wider."),
        nbformat.v4.new_code_cell("x = 1", metadata={"tags": ["solution"]}),
        nbformat.v4.new_markdown_cell("## Next"),
        nbformat.v4.new_code_cell("y = ...", metadata={"tags": ["blank"]}),
        nbformat.v4.new_markdown_cell("#### Solution"),
        nbformat.v4.new_code_cell("y = 2", metadata={"tags": ["solution"]}),
    ]
    notebook = nbformat.v4.new_notebook(cells=cells)
    kinds = {
        "students": ["Guess first.", "x = ...", "check(x)", "## Next", "y = ..."],
        "solutions": [
            "Guess first.",
            "x = 1",
            "check(x)",
            "#### Solution\n\nIt is wider.",
            "y = 2",
        ],
    }
    for kind, wanted in kinds.items():
        made = students.handed_out(notebook, kind, is_workbook=True)
        assert [cell.source for cell in made.cells] == wanted


def test_links_of_a_copy_lead_to_its_own_notebooks(copies):
    link = re.compile(r"\]\(([^)#\s]+\.(?:ipynb|md))")
    for copy in copies.values():
        seen = 0
        for path in copy.rglob("*.ipynb"):
            for cell in nbformat.read(path, as_version=4).cells:
                for target in link.findall(cell.source) if cell.cell_type == "markdown" else ():
                    assert (path.parent / target).is_file(), (path, target)
                    seen += 1
        assert seen > 20


def test_the_students_copy_runs_and_asks_to_fill_the_blanks(copies, python):
    copy = copies["students"]
    said = executed(python, copy, *(f"workbook/{name}.ipynb" for name in WORKBOOK))
    assert list(said) == WORKBOOK
    for words in said.values():
        assert len(words) >= 3
        assert all(each.startswith("Fill in the blank of `") for each in words), words


def test_a_part_without_its_solutions_runs(copies, python):
    (part,) = copies["students"].glob("notebooks/01-*.ipynb")
    assert executed(python, copies["students"], part.name) == {part.stem: []}


def test_the_solutions_copy_runs_and_passes_every_check(copies, python):
    copy = copies["solutions"]
    said = executed(python, copy, *(f"workbook/{name}.ipynb" for name in WORKBOOK))
    blanks = executed(python, copies["students"], *(f"workbook/{name}.ipynb" for name in WORKBOOK))
    for name, words in said.items():
        assert len(words) == len(blanks[name])
        assert all(each.startswith("Right: ") for each in words), words


def test_the_same_files_make_the_same_zip(copies, tmp_path):
    for name in ("a", "b"):
        students.write_zip(copies["students"], tmp_path / f"{name}.zip")
    assert (tmp_path / "a.zip").read_bytes() == (tmp_path / "b.zip").read_bytes()
