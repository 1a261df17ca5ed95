"""The listings that answer a question run in an empty file and print what the book says."""

import re
import subprocess
import sys

import nbformat
import pytest
from helpers import ROOT

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


def printed_by(listing, folder):
    script = folder / "script.py"
    script.write_text(listing, encoding="utf-8")
    command = [sys.executable, "-I", script.name]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60)
    assert not done.stderr
    return done.stdout


def numbers(text):
    """Numbers as they are printed and as the book writes them, without signs."""
    text = re.sub(r"\s*×\s*10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda power: "e" + ascii_power(power[1]), text)
    return [abs(float(x)) for x in re.findall(r"\d+\.?\d*(?:e[-+]?\d+)?", text)]


def ascii_power(raised):
    return raised.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))


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
