"""Sphinx extension: what a notebook computed, shown on another page.

A notebook names a sentence, a table or a figure with ``myst_nb.glue(name, value)``; any page shows
it with ``{result}`name` `` within a line, or with the ``{result}`` directive as a block of its own.
MyST-NB's own ``{glue}`` cannot do that for Markdown from another page, nor set an alt text there.
"""

import base64
import hashlib
import json
import os
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import directives
from docutils.statemachine import StringList
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective, SphinxRole

logger = logging.getLogger(__name__)
PICTURES = {"image/svg+xml": (".svg", str.encode), "image/png": (".png", base64.b64decode)}


def notebooks_first(app, env, pages):
    """Read the notebooks before the pages that show their results; forget the last build's."""
    pages.sort(key=lambda page: (Path(env.doc2path(page)).suffix != ".ipynb", page))
    for page in pages:
        results_file(env, page).unlink(missing_ok=True)


def results_file(env, page):
    """Where MyST-NB writes what a page has glued."""
    return Path(env.mystnb_config.output_folder, page + ".glue.json")


def find(env, name, location):
    """The MIME bundle of a named result; an unknown or doubled name is a warning, so an error."""
    files = [results_file(env, page) for page in sorted(env.found_docs)]
    pages = [json.loads(path.read_text()) for path in files if path.exists()]
    found = [page[name]["data"] for page in pages if name in page]
    if len(found) != 1:
        known = sorted({key for page in pages for key in page})
        logger.warning("%d results are called %r, of %s", len(found), name, known,
                       location=location)
    return found[0] if found else {"text/plain": f"[{name}]"}


class ResultRole(SphinxRole):
    """A sentence or a number within a line."""

    def run(self):
        """Parse the Markdown where it is shown, so that its mathematics and links work."""
        data = find(self.env, self.text, self.get_location())
        text = data.get("text/markdown") or data["text/plain"].strip("'")
        return self.inliner.parse(text.strip(), self.lineno, None, nodes.inline())


class ResultDirective(SphinxDirective):
    """A paragraph, a table, or a figure with its own alt text, name and caption (the content)."""

    required_arguments = 1
    has_content = True
    option_spec = {  # noqa: RUF012
        "alt": directives.unchanged_required,
        "name": directives.unchanged_required,
        "width": directives.length_or_percentage_or_unitless,
    }

    def run(self):
        """Show the richest form the notebook gave."""
        data = find(self.env, self.arguments[0], self.get_location())
        for mime, (suffix, decode) in PICTURES.items():
            if mime in data:
                return [self.figure(decode(data[mime]), suffix)]
        if self.content:
            logger.warning("%s is no picture, yet has a caption", self.arguments[0],
                           location=self.get_location())
        if "text/html" in data:
            return [nodes.container("", nodes.raw("", data["text/html"], format="html"),
                                    classes=["pst-scrollable-table-container"])]
        return self.parse(data.get("text/markdown") or data["text/plain"])

    def parse(self, text):
        """Markdown to nodes."""
        node = nodes.Element()
        lines = StringList(text.splitlines(), source=self.get_source_info()[0])
        self.state.nested_parse(lines, self.content_offset, node)
        return node.children

    def figure(self, data, suffix):
        """The image as a numbered figure."""
        name = hashlib.sha256(data).hexdigest() + suffix
        path = Path(self.env.mystnb_config.output_folder, name)
        path.write_bytes(data)
        uri = "/" + Path(os.path.relpath(path, self.env.srcdir)).as_posix()
        image = nodes.image(uri=uri, alt=self.options.get("alt", ""))
        if "width" in self.options:
            image["width"] = self.options["width"]
        figure = nodes.figure("", image)
        self.set_source_info(figure)
        for paragraph in self.parse("\n".join(self.content))[:1]:
            figure += nodes.caption("", "", *paragraph.children)
        self.add_name(figure)
        return figure


def setup(app):
    """Connect to Sphinx."""
    app.add_role("result", ResultRole())
    app.add_directive("result", ResultDirective)
    app.connect("env-before-read-docs", notebooks_first)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
