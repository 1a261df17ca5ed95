"""Notebooks are short, executed and compared; nbval itself runs them beside these tests."""

import re

import nbformat
import pytest
from helpers import ROOT
from normalise import normalise

MYST = re.compile(r"\{[a-z:-]+\}`|^(```|:::+) ?\{|^\(.*\)=$", re.MULTILINE)
PARTS = sorted(ROOT.glob("notebooks/*.ipynb"))
COMMITTED = ("03-runge-kutta", "05-how-we-know", "06-how-sure", "08-measured-spring")
WORKBOOK = sorted(ROOT.glob("notebooks/workbook/*.ipynb"))


def name(path):
    """What tests call a notebook."""
    return path.relative_to(ROOT / "notebooks").with_suffix("").as_posix()


each_notebook = pytest.mark.parametrize("path", PARTS + WORKBOOK, ids=name)


def code_cells(path):
    return [cell for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "code"]


def is_compared(cell):
    return "nbval-ignore-output" not in cell.metadata.get("tags", [])


@pytest.mark.parametrize("path", PARTS, ids=name)
def test_is_a_page_of_the_book(path):
    assert f"notebooks/{path.stem}" in (ROOT / "_toc.yml").read_text(encoding="utf-8")


def test_nbval_runs_them_and_compares(request):
    config = request.config
    assert config.option.nbval and not config.option.nbval_lax
    assert "notebooks" in config.getini("testpaths")


@each_notebook
def test_was_executed(path):
    counts = [cell.execution_count for cell in code_cells(path)]
    assert counts == list(range(1, len(counts) + 1))


@each_notebook
def test_stores_numbers_to_compare(path):
    stored = [
        str(output) for cell in code_cells(path) if is_compared(cell) for output in cell.outputs
    ]
    assert any(character.isdigit() for text in stored for character in text)


@each_notebook
def test_stores_figures_but_neither_widgets_nor_errors(path):
    notebook = nbformat.read(path, as_version=4)
    outputs = [output for cell in code_cells(path) for output in cell.outputs]
    mimes = {mime for output in outputs for mime in output.get("data", {})}
    rich = {mime for mime in mimes if mime.startswith(("image/", "application/"))}
    assert rich <= {"image/svg+xml"}
    live = "show_figure|explore|Prediction|Workshop|Chain|Own|Game"  # these as still pictures
    shown = re.compile(rf"\b({live})\(")
    shows = sum(bool(shown.search(cell.source)) for cell in code_cells(path))
    assert sum("image/svg+xml" in output.get("data", {}) for output in outputs) == shows
    assert "widgets" not in notebook.metadata
    assert not [output for output in outputs if output.output_type == "error"]


@each_notebook
def test_is_as_make_notebooks_leaves_it(path):
    notebook = nbformat.read(path, as_version=4)
    assert normalise(notebook) == notebook


@each_notebook
def test_code_fits_the_page(path):
    for cell in code_cells(path):
        assert max(map(len, cell.source.splitlines()), default=0) <= 84, cell.source


@each_notebook
def test_holds_plain_markdown_only(path):
    """No MyST roles or directives: JupyterLab would show their source."""
    for cell in nbformat.read(path, as_version=4).cells:
        if cell.cell_type == "markdown":
            assert not MYST.search(cell.source)


def predictions(path):
    """Of each prediction of a notebook: its question, the heading of its fold, its answer."""
    cells = nbformat.read(path, as_version=4).cells
    asked = [i for i, cell in enumerate(cells) if "**Predict.**" in cell.source]
    return [cells[i : i + 3] for i in asked]


@pytest.mark.parametrize("name", COMMITTED)
def test_a_prediction_has_choices_to_tap_and_a_computed_answer(name):
    found = predictions(ROOT / "notebooks" / f"{name}.ipynb")
    assert found
    for question, fold, answer in found:
        words = question.source.partition("**Predict.**")[2]
        choices = re.findall(r"^- (.*)$", words, re.MULTILINE)
        assert len(choices) >= 3 and words.rstrip().endswith(choices[-1])
        assert re.fullmatch(r"#+ Answer", fold.source)
        assert answer.cell_type == "code" and "remove-input" in answer.metadata["tags"]
        assert answer.outputs[0].data["text/markdown"].startswith("**")


@pytest.mark.parametrize("path", WORKBOOK, ids=name)
def test_a_workbook_is_short_and_each_blank_has_a_check_and_a_folded_solution(path):
    cells = nbformat.read(path, as_version=4).cells
    words = sum(len(cell.source.split()) for cell in cells if cell.cell_type == "markdown")
    assert words <= 900
    blanks = [i for i, cell in enumerate(cells) if "blank" in cell.metadata.get("tags", [])]
    assert len(blanks) >= 3
    for i in blanks:
        blank, check, fold, solution = cells[i : i + 4]
        assert "..." in blank.source
        assert check.source.startswith("practice.check_")
        assert fold.source.splitlines()[0] == "#### Solution"
        assert fold.metadata["jp-MarkdownHeadingCollapsed"]
        assert solution.metadata["tags"] == ["solution"] and "..." not in solution.source
        (output,) = check.outputs
        assert output.data["text/plain"].startswith("Fill in the blank of `")
    assert sum("solution" in cell.metadata.get("tags", []) for cell in cells) == len(blanks)
