"""Sphinx extension: repairs of what the theme and its parts write into every page.

A repair is a regular expression and its replacement. Those of the theme must find something on
some page; one that a newer theme no longer needs is a warning, so that it gets removed.
"""

import re
from pathlib import Path

from sphinx.util import logging

logger = logging.getLogger(__name__)

OF_THE_THEME = {
    # 540 kB (gzipped) of icons as a script; the style sheet's icon font shows the same ones.
    r'\s*<!-- So that users can add custom icons -->\s*<script defer src="[^"]*fontawesome.js[^>]*>'
    r"</script>": "",
    # A second title and contents for print, where the page's own title follows.
    r'<div id="jb-print-docs-body".*?(?=<div id="searchbox">)': "",
    # The logo stands outside every landmark.
    r'<div id="pst-primary-sidebar"': r'\g<0> role="complementary" aria-label="Book"',
    # Labels that hide the visible or titled text of a button: axe label-content-name-mismatch.
    r'(<button class="btn search-button-field[^>]*?) aria-label="Search"': r"\1",
    r'(class="theme-switch [^>]*?) title="[^"]*"': r'\1 aria-hidden="true"',
}
OF_THE_CONTENT = {
    # As above, on the button that unfolds a hidden cell.
    r'<summary aria-label="Toggle hidden content">': "<summary>",
    # Roles that browsers have dropped, and a list without items.
    r' role="doc-biblioentry"': "",
    r'<div role="list" class="citation-list">': '<div class="citation-list">',
    # A header cell without a header: the corner of a pandas table.
    r'<th(?: class="head")?>(?:<p></p>)?</th>': "<td></td>",
}
OF_THE_SCRIPTS = {
    # Words that name a property of every JavaScript object are no words of the search index.
    "searchtools.js": {
        r"\{ files: (\w+)\[word\], score":
        r"{ files: Object.hasOwn(\1, word) ? \1[word] : [], score",
    },
    # What scrolls is found by measuring all of it before any is altered: the page is laid out once.
    "scripts/pydata-sphinx-theme.js": {
        r"\{(\w)\.tabIndex=(\1\.scrollWidth>\1\.clientWidth\|\|\1\.scrollHeight>\1\.clientHeight)\?0:-1\}":
        r"{const to=\2?0:-1;queueMicrotask(()=>{\1.tabIndex=to})}",
    },
}  # fmt: skip
# The icons, and a list of the source pages to which no page links.
UNUSED_FILES = ["_static/scripts/fontawesome.js*", "_modules/index.html"]


def repair(app, exception):
    """Apply the repairs to all pages."""
    if exception or app.builder.format != "html":
        return
    needed = set()
    for path in Path(app.outdir).rglob("*.html"):
        if path.is_relative_to(Path(app.outdir, "_static")):
            continue
        text = path.read_text(encoding="utf-8")
        for pattern, replacement in (OF_THE_THEME | OF_THE_CONTENT).items():
            text, count = re.subn(pattern, replacement, text, flags=re.DOTALL)
            if count:
                needed.add(pattern)
        path.write_text(text, encoding="utf-8")
    for pattern in UNUSED_FILES:
        for path in Path(app.outdir).glob(pattern):
            path.unlink()
    patterns = list(OF_THE_THEME)
    for name, repairs in OF_THE_SCRIPTS.items():
        script = Path(app.outdir, "_static", name)
        text = script.read_text(encoding="utf-8")
        for pattern, replacement in repairs.items():
            patterns.append(pattern)
            text, count = re.subn(pattern, replacement, text)
            if count:
                needed.add(pattern)
        script.write_text(text, encoding="utf-8")
    for pattern in set(patterns) - needed:
        logger.warning("no page needs this repair any more: %s", pattern)


def setup(app):
    """Connect to Sphinx."""
    app.connect("build-finished", repair)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
