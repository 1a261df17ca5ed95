"""The listings that answer a question run in an empty file and print what the book says."""

import nbformat
import pytest
from helpers import ROOT
from listings import numbers, printed_by

LISTINGS = {  # item: notebook, last line, and the answer whose numbers it prints
    "5(i)": ("02-crank-nicolson", "pitch_table()", "5(ii)"),
    "8(i)": ("03-runge-kutta", "equilibrium_check()", "8(ii)"),
    "9(i)": ("03-runge-kutta", "pitch_table()", "9(ii)"),
}


def stored_texts(notebook):
    """The Markdown that a notebook's cells have shown."""
    cells = nbformat.read(ROOT / "notebooks" / f"{notebook}.ipynb", as_version=4).cells
    outputs = [output for cell in cells for output in cell.get("outputs", ())]
    return [output.data["text/markdown"] for output in outputs if "markdown" in str(output)]


@pytest.mark.parametrize("item", LISTINGS)
def test_pasted_into_an_empty_file_it_prints_the_answer(item, tmp_path):
    notebook, last, answer = LISTINGS[item]
    texts = stored_texts(notebook)
    (block,) = [text for text in texts if text.endswith(f"\n{last}\n```")]
    listing = block.removeprefix("```python\n").removesuffix("```")
    assert "suspension" not in listing
    (said,) = [text for text in texts if text.startswith(f"**Answer {answer}.**")]
    known = [0, *numbers(said)]
    for value in numbers(printed_by(listing, tmp_path)):
        assert any(abs(value - number) <= 0.01 * number for number in known), value
