"""What a notebook shows carries the names by which the book finds it."""

import matplotlib.pyplot as plt
import pytest
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output

from suspension.report import answer, say, show_figure, source
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


def test_source_leaves_out_the_docstring():
    text = source(shown)
    assert text.startswith("```python\ndef shown") and "metadata of what" not in text
