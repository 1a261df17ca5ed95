"""What stands before and after a formula within a line stays with it, once."""

import sys

from docutils import nodes
from docutils.frontend import get_default_settings
from docutils.parsers.rst import Parser
from docutils.utils import new_document
from helpers import ROOT

sys.path.append(str(ROOT / "book" / "_ext"))
from formulas import KeepPunctuation


def test_the_punctuation_moves_once_though_another_text_reads_the_same():
    paragraph = nodes.paragraph()
    paragraph += [nodes.emphasis("", "mode"), nodes.Text(","), nodes.Text(" with ("), nodes.math()]
    paragraph += [nodes.Text("),"), nodes.Text("\nand "), nodes.math(), nodes.Text(",")]
    for formula in paragraph.findall(nodes.math):
        formula += nodes.Text("x")
    document = new_document("page", get_default_settings(Parser))
    document += paragraph
    before = paragraph.astext()
    KeepPunctuation(document).run()
    assert paragraph.astext() == before
    spans = [
        span.astext() for span in paragraph.findall(nodes.inline) if "together" in span["classes"]
    ]
    assert spans == ["(x),", "x,"]
