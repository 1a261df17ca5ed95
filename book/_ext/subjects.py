"""Sphinx extension: an index by subject, and a search that puts pages before the package.

`book/subjects.toml` says under which words a section is looked for: by a page and the id of one of
its sections, or "" for the page itself. They stand in the index and are found by the search, the
words that the page itself does not use as well. Directives in the text would do the same, but stand
in JupyterLab as they are written.
"""

import tomllib
from pathlib import Path

from docutils import nodes
from sphinx import addnodes
from sphinx.transforms import SphinxTransform
from sphinx.util import logging

FILE = "book/subjects.toml"
logger = logging.getLogger(__name__)


class Subjects(SphinxTransform):
    """Put the words of a page into its sections, where Sphinx collects them."""

    default_priority = 800  # before Sphinx reads entries of the index

    def apply(self):
        """Add the entries."""
        page = self.env.docname
        for anchor, words in self.app.config.book_subjects.get(page, {}).items():
            section = next(
                (
                    section
                    for section in self.document.findall(nodes.section)
                    if not anchor or anchor in section["ids"]
                ),
                None,
            )
            if section is None:
                logger.warning("%s: %s has no section %r", FILE, page, anchor)
                continue
            entries = [("single", word, section["ids"][0], "main", None) for word in words]
            section.insert(1, addnodes.index(entries=entries))  # behind its heading


def read(app, config):
    """Read the subjects; pages are read anew when they change."""
    text = Path(app.srcdir, FILE).read_text(encoding="utf-8")
    config.book_subjects = tomllib.loads(text)


def missing(app, env):
    """Warn of pages that are not there."""
    for page in app.config.book_subjects.keys() - env.found_docs:
        logger.warning("%s: there is no page %r", FILE, page)


def setup(app):
    """Connect to Sphinx."""
    app.add_config_value("book_subjects", {}, "env", types=[dict])
    app.add_transform(Subjects)
    app.connect("config-inited", read)
    app.connect("env-updated", missing)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
