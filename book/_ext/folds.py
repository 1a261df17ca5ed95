"""Sphinx extension: sections that unfold.

A heading that begins with Solution, Proof, Check or Answer opens a section that the page shows
folded. In JupyterLab the same heading is collapsed by its cell's ``jp-MarkdownHeadingCollapsed``,
so that one plain heading serves both, with code cells and figures below it.

A list between a paragraph that begins with **Predict.** and the fold of its answer are choices: the
page's script makes them buttons, of which the one that is tapped stays marked and opens the answer.
"""

from docutils import nodes
from sphinx.transforms import SphinxTransform

FOLDED = ("Solution", "Proof", "Check", "Answer")
PREDICT = "Predict."


class fold(nodes.General, nodes.Element):
    """A folded section; its first child is the heading."""


class fold_title(nodes.General, nodes.TextElement):
    """What is seen of it before it is unfolded."""


class FoldSections(SphinxTransform):
    """Replace the sections, before the contents list is made of them."""

    default_priority = 880

    def apply(self):
        """Visit the sections of one page."""
        for section in list(self.document.findall(nodes.section)):
            title = section[0]
            if title.astext().startswith(FOLDED):
                mark_choices(section)
                folded = fold("", ids=section["ids"], names=section["names"])
                folded += fold_title("", "", *title.children)
                folded += section.children[1:]
                section.replace_self(folded)


def mark_choices(section):
    """Mark the list before an answer as choices, if a prediction asks for them."""
    before = section.parent.children[: section.parent.index(section)]
    if len(before) > 1 and isinstance(before[-1], nodes.bullet_list):
        if before[-2].astext().startswith(PREDICT):
            before[-1]["classes"].append("choices")


def visit_fold(writer, node):
    """Open the element; its ids are those of the section."""
    writer.body.append(writer.starttag(node, "details", CLASS="fold"))


def depart_fold(writer, node):
    """Close it."""
    writer.body.append("</details>\n")


def visit_fold_title(writer, node):
    """Open the line that is always seen."""
    writer.body.append(writer.starttag(node, "summary", ""))


def depart_fold_title(writer, node):
    """Close it."""
    writer.body.append("</summary>\n")


def setup(app):
    """Connect to Sphinx."""
    app.add_node(fold, html=(visit_fold, depart_fold))
    app.add_node(fold_title, html=(visit_fold_title, depart_fold_title))
    app.add_transform(FoldSections)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
