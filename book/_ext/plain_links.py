"""Sphinx extension: plain Markdown links to figures, tables, equations and references.

Notebooks hold plain Markdown, so that they read well in JupyterLab too. There one writes
``[the fit](#fig-fit)``, ``[Eq. of motion](../book/model.md#eq-motion)`` or
``[Hairer 1993](../book/references.md#hairer1993)``; in the book the first two get their numbers:
"the fit (Fig. 3)", "Eq. of motion (Eq. 6)".
"""

from docutils import nodes
from sphinx.addnodes import pending_xref
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinx.util.nodes import make_refnode

NAMES = {"figure": "Fig.", "table": "Table", "displaymath": "Eq."}


class NumberedLinks(SphinxPostTransform):
    """Resolve ``page.md#label`` for every kind of label; append the number of a numbered target."""

    default_priority = 8  # before MyST, which knows headings only

    def run(self, **kwargs):
        """Visit the links of one page."""
        for link in list(self.document.findall(pending_xref)):
            if link["reftype"] == "myst" and link["refexplicit"]:
                self.resolve(link)
        for link in list(self.document.findall(nodes.reference)):
            if "id_link" in link and "refid" in link:
                self.append_number(link, self.env.docname, link["refid"])

    def resolve(self, link):
        """Replace a link to a labelled figure, table, equation, section or reference."""
        label = link.get("reftargetid") or link["reftarget"]
        page, anchor = self.find(label)
        if page is None or (link["refdomain"] == "doc" and page != link["reftarget"]):
            return  # an unlabelled heading, a whole page, or an error that MyST will report
        text = nodes.inline("", "", *[child.deepcopy() for child in link.children])
        new = make_refnode(self.app.builder, self.env.docname, page, anchor, text)
        self.append_number(new, page, anchor)
        link.replace_self(new)

    def find(self, label):
        """Page and anchor of a label, or a pair of None."""
        if label in self.env.domains["std"].anonlabels:
            return self.env.domains["std"].anonlabels[label]
        if label in self.env.domains["math"].equations:
            return self.env.domains["math"].equations[label][0], f"equation-{label}"
        for citation in self.env.domains["cite"].citations:
            if citation.citation_id == label:
                return citation.bibliography_key.docname, label
        return None, None

    def number(self, page, anchor):
        """'Fig. 3' for a numbered target, else None."""
        for kind, numbers in self.env.toc_fignumbers.get(page, {}).items():
            if anchor in numbers:
                return f"{NAMES.get(kind, kind)} {'.'.join(map(str, numbers[anchor]))}"
        return None

    def append_number(self, link, page, anchor):
        """Add ' (Fig. 3)' to the text of a link."""
        number = self.number(page, anchor)
        if number:
            number = number.replace(" ", "\N{NO-BREAK SPACE}")
            link += nodes.inline("", f" ({number})", classes=["number"])


def setup(app):
    """Connect to Sphinx."""
    app.add_post_transform(NumberedLinks)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
