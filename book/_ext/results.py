"""Sphinx extension: what a notebook computed, shown on another page.

A notebook names a sentence, a table or a figure (`suspension.report.show`); any page shows it with
``{result}`name` `` within a line, or with the ``{result}`` directive as a block of its own.
MyST-NB's own ``{glue}`` cannot do that for Markdown from another page, nor set an alt text there.

A figure that a notebook shows with a computed caption and alt text becomes a numbered figure, here
and wherever it is quoted.
"""

import json
import re
from pathlib import Path

import nbformat
from docutils import nodes
from docutils.parsers.rst import directives
from docutils.statemachine import StringList
from pictures import picture  # beside this file
from sphinx.transforms import SphinxTransform
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective, SphinxRole

logger = logging.getLogger(__name__)
SVG = "image/svg+xml"
FIGURE_LINK = re.compile(r"\]\([^)]*#fig-[^)]*\)")


def notebooks_first(app, env, pages):
    """Read the notebooks before the pages that show their results; forget the last build's."""
    pages.sort(key=lambda page: (Path(env.doc2path(page)).suffix != ".ipynb", page))
    for page in pages:
        results_file(env, page).unlink(missing_ok=True)


def results_file(env, page):
    """Where MyST-NB writes what a page has glued."""
    return Path(env.mystnb_config.output_folder, page + ".glue.json")


def find(env, name, location):
    """A named result, as a notebook's output; an unknown or doubled name is a warning."""
    files = [results_file(env, page) for page in sorted(env.found_docs)]
    pages = [json.loads(path.read_text(encoding="utf-8")) for path in files if path.exists()]
    found = [page[name] for page in pages if name in page]
    if len(found) != 1:
        known = sorted({key for page in pages for key in page})
        logger.warning(
            "%d results are called %r, of %s", len(found), name, known, location=location
        )
    return found[0] if found else {"data": {"text/plain": f"[{name}]"}, "metadata": {}}


class ResultRole(SphinxRole):
    """A sentence or a number within a line."""

    def run(self):
        """Parse the Markdown where it is shown, so that its mathematics and links work."""
        data = find(self.env, self.text, self.get_location())["data"]
        text = data.get("text/markdown") or data["text/plain"].strip("'")
        return self.inliner.parse(text.strip(), self.lineno, None, nodes.inline())


class ResultDirective(SphinxDirective):
    """A paragraph, a table, or a figure.

    A figure brings its caption and its alt text along; the content and ``:alt:`` replace them.
    Where the page shows a figure too, ``:figure:`` is its label here, to which a sentence's link to
    that figure then leads.
    """

    required_arguments = 1
    has_content = True
    option_spec = {  # noqa: RUF012
        "alt": directives.unchanged_required,
        "figure": directives.unchanged_required,
        "name": directives.unchanged_required,
    }

    def run(self):
        """Show the richest form the notebook gave."""
        output = find(self.env, self.arguments[0], self.get_location())
        data = output["data"]
        if SVG in data:
            return [self.figure(output)]
        if self.content:
            logger.warning(
                "%s is no picture, yet has a caption",
                self.arguments[0],
                location=self.get_location(),
            )
        if "text/html" in data:
            table = nodes.raw("", data["text/html"], format="html")
            return [nodes.container("", table, classes=["pst-scrollable-table-container"])]
        text = data.get("text/markdown") or data["text/plain"]
        if "figure" in self.options:
            text = FIGURE_LINK.sub(f"](#{self.options['figure']})", text)
        return self.parse(text)

    def parse(self, text):
        """Markdown to nodes."""
        node = nodes.Element()
        lines = StringList(text.splitlines(), source=self.get_source_info()[0])
        self.state.nested_parse(lines, self.content_offset, node)
        return node.children

    def figure(self, output):
        """The image as a numbered figure."""
        figure = nodes.figure("", drawn(output, self.options.get("alt")))
        self.set_source_info(figure)
        for paragraph in self.parse(self.caption())[:1]:
            figure += nodes.caption("", "", *paragraph.children)
        self.add_name(figure)
        return figure

    def caption(self):
        """What stands under the figure, Markdown."""
        if self.content:
            return "\n".join(self.content)
        name = f"caption-{self.arguments[0]}"
        return find(self.env, name, self.get_location())["data"]["text/markdown"]


def drawn(output, alt=None):
    """The picture that an output of a notebook is, in both its layouts."""
    metadata = output["metadata"]
    alt = alt or metadata.get("alt", "")
    return picture(wide=output["data"][SVG], narrow=metadata.get("narrow", ""), alt=alt)


class ComputedFigures(SphinxTransform):
    """Make a numbered figure of each picture that a notebook shows with its caption below it.

    `suspension.report.show_figure` writes two outputs: the picture, with its name and its alt text
    in the metadata, and the caption as Markdown, which MyST-NB has parsed by now.
    """

    default_priority = 100  # before labels are collected

    def apply(self):
        """Visit the outputs of one page's cells beside what the executed notebook says of them."""
        executed = Path(self.env.mystnb_config.output_folder, self.env.docname + ".ipynb")
        if not executed.exists():
            return
        cells = nbformat.read(executed, as_version=4).cells
        for cell in list(self.document.findall(is_element("cell_code"))):
            outputs = [
                output
                for output in cells[cell["cell_index"]]["outputs"]
                if output["output_type"] in ("display_data", "execute_result")
            ]
            bundles = list(cell.findall(is_element("mime_bundle")))
            for i, output in enumerate(outputs):
                if "alt" in output.get("metadata", {}):
                    self.number(bundles[i], bundles[i + 1], output)

    def number(self, shown, caption, output):
        """Put a picture and its caption into a figure where the notebook shows the picture."""
        figure = nodes.figure("", drawn(output))
        figure.source, figure.line = shown.source, shown.line
        shown.replace_self(figure)
        paragraph = next(caption.findall(nodes.paragraph))
        figure += nodes.caption(paragraph.rawsource, "", *paragraph.children)
        caption.parent.remove(caption)
        figure["names"].append(nodes.fully_normalize_name(output["metadata"]["scrapbook"]["name"]))
        self.document.note_explicit_target(figure, figure)


def is_element(kind):
    """A condition for MyST-NB's containers of one kind."""
    return lambda node: isinstance(node, nodes.container) and node.get("nb_element") == kind


def setup(app):
    """Connect to Sphinx."""
    app.add_role("result", ResultRole())
    app.add_directive("result", ResultDirective)
    app.add_transform(ComputedFigures)
    app.connect("env-before-read-docs", notebooks_first)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
