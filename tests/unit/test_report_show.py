"""What a notebook shows carries the names by which the book finds it."""

import subprocess
import sys

import matplotlib.pyplot as plt
import numpy as np
import pytest
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output

from suspension.report import answer, listing, say, show_figure
from suspension.report.words import Caption


@pytest.fixture(autouse=True)
def shell():
    """An IPython in which outputs can be captured."""
    yield InteractiveShell.instance()
    InteractiveShell.clear_instance()


def shown(show, *arguments, **options):
    """Data and metadata of what a call displays."""
    with capture_output() as captured:
        show(*arguments, **options)
    return [(output.data, output.metadata) for output in captured.outputs]


def name_of(metadata):
    return metadata.get("scrapbook", {}).get("name")


def test_a_figure_is_followed_by_its_caption_and_closed():
    figure = plt.figure()
    (_, picture), (text, caption) = shown(show_figure, "fig-a", Caption("A *caption*.", "An alt."))
    assert name_of(picture) == "fig-a" and picture["alt"] == "An alt."
    assert name_of(caption) == "caption-fig-a" and text["text/markdown"] == "A *caption*."
    assert not plt.fignum_exists(figure.number)


def test_an_answer_is_named_after_its_item():
    ((data, metadata),) = shown(answer, "9(iii)", "Yes.", "A table.")
    assert name_of(metadata) == "answer-9-iii"
    assert data["text/markdown"] == "**Answer 9(iii).** Yes.\n\nA table."


def test_a_sentence_without_a_name_has_none():
    assert name_of(shown(say, "One.", "Two.")[0][1]) is None


def area():
    """Print the area of a plate."""
    print(np.prod([width, height]))  # noqa: F821


def test_a_listing_runs_in_an_empty_file(tmp_path):
    text = listing("import numpy as np", {"width": 3, "height": 4, "g": 9.81}, area)
    assert "g = 9.81  # m/s²\n" in text and "Print the area" not in text
    script = tmp_path / "script.py"
    script.write_text(text.removeprefix("```python\n").removesuffix("```"), encoding="utf-8")
    done = subprocess.run([sys.executable, "-I", script], capture_output=True, text=True)
    assert done.stdout == "12\n", done.stderr
