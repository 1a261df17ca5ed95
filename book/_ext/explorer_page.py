"""Sphinx extension: explorers in built pages, without a widget manager.

An explorer's cell gives HTML with native controls (`suspension.explorer.ExplorerBox.html`), a
prediction's its axes, an instrument's of the laboratory its still picture. Pages that hold one get
its script and the style sheet; the widgets, which only a kernel's front end could use, and their
state are left out. The directive ``{explorer} name`` shows an explorer that a notebook has named,
on another page, and links like ``#explore:v=1.2&dt=0.001`` set the picture of their page, or of the
page they point to; links like ``#chain:`` and ``#workshop:a=..`` lead to an instrument.
"""

import json
import re
from functools import partial
from pathlib import Path

from docutils import nodes
from myst_nb.sphinx_ import HideCodeCellNode, NbMetadataCollector
from results import find
from sphinx.addnodes import pending_xref
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinx.util.docutils import SphinxDirective

from suspension.explorer import (
    Chain,
    Game,
    Own,
    Workshop,
    page_script,
    page_style,
    prediction_script,
)
from suspension.explorer.bundle import script, style
from suspension.explorer.instrument import LABORATORY

# What a link begins with that sets a picture, or an instrument of the laboratory.
PREFIXES = ("explore:", "workshop:", "chain:", "own:", "game:")
WIDGET = "application/vnd.jupyter.widget-view+json"
EXPLORER, PREDICTION = "suspension-explorer-box", "suspension-prediction"
INSTRUMENTS = {"workshop": Workshop, "chain": Chain, "game": Game, "own": Own}  # by their files
BOX = re.compile(f"{EXPLORER}|{PREDICTION}|{LABORATORY}")
SCRIPTS = {EXPLORER: "explorer.js", PREDICTION: "prediction.js"} | {
    one.kind: f"{name}.js" for name, one in INSTRUMENTS.items()
}
FOR_NOTEBOOKS = re.compile(
    r'(?<=<div class="se-controls") hidden|<p class="se-run">.*?</p><style>.*?</style>'
)
STILL = re.compile(r'<img class="suspension-explorer-still"[^>]*>')
WIDE = "se-page se-wide"  # the classes of a box that asks for the window's whole width
STYLES = {WIDE: "wide.css"} | {one.kind: f"{name}.css" for name, one in INSTRUMENTS.items()}
WIDE_STYLE = Path(__file__).parents[1] / "style" / "wide.css"
FILES = {
    "explorer.js": page_script,
    "prediction.js": prediction_script,
    "explorer.css": page_style,
    "wide.css": lambda: WIDE_STYLE.read_text(encoding="utf-8"),
    **{f"{name}.js": partial(script, f"{name}_page") for name in INSTRUMENTS},
    **{f"{name}.css": partial(style, name) for name in INSTRUMENTS},
}


def write_files(app):
    """Write script and style to ``_static``, before Sphinx computes their checksums."""
    if app.builder.format != "html":
        return
    for name, text in FILES.items():
        path = Path(app.outdir, "_static", name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text(), encoding="utf-8")


def add_files(app, page, template, context, doctree):
    """Load scripts and style on the pages that need them; the widgets' state on none."""
    if doctree is None:
        return
    NbMetadataCollector.get_js_files(app.env, page).clear()
    html = "".join(node.astext() for node in doctree.findall(nodes.raw))
    if BOX.search(html):
        app.add_css_file("explorer.css")
    for mark, name in SCRIPTS.items():
        if mark in html:
            app.add_js_file(name, loading_method="defer")
    for mark, name in STYLES.items():
        if mark in html:
            app.add_css_file(name)


def keep_pages(app, page, source):
    """Leave out what is for readers of a notebook: the widget, and what to run for it."""
    if Path(app.env.doc2path(page)).suffix != ".ipynb":
        return
    notebook = json.loads(source[0])
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            shown = [out for out in cell["outputs"] if WIDGET not in out.get("data", {})]
            for data in (out.get("data", {}) for out in shown):
                html = "".join(data.get("text/html", ""))
                if BOX.search(html):
                    data.pop("image/svg+xml", None)
                    data["text/html"] = FOR_NOTEBOOKS.sub("", html)
            cell["outputs"] = shown
    source[0] = json.dumps(notebook)


class ExplorerDirective(SphinxDirective):
    """A named explorer of a notebook.

    The content may be a figure: then the explorer stands above its caption, and the figure's own
    image is what readers without scripts, and paper, get instead.
    """

    required_arguments = 1
    has_content = True

    def run(self):
        """Show its HTML, with the content's picture in place of its own."""
        found = find(self.env, self.arguments[0], self.get_location())["data"]
        html = found.get("text/html", self.arguments[0])
        content = nodes.Element()
        self.state.nested_parse(self.content, self.content_offset, content)
        live = nodes.raw("", STILL.sub("", html), format="html")
        for figure in content.findall(nodes.figure):
            drawn = figure.children[0]
            drawn.replace_self(
                [live, nodes.container("", drawn.deepcopy(), classes=["se-instead"])]
            )
            return content.children
        return [nodes.raw("", html, format="html"), *content.children]


class ExplorerLinks(SphinxPostTransform):
    """Links that set a picture: they lead to no anchor, and MyST must not look for one."""

    default_priority = 7  # before plain_links and MyST

    def run(self, **kwargs):
        """Visit the links of one page."""
        for link in list(self.document.findall(pending_xref)):
            page, settings = self.target(link)
            if settings is None:
                continue
            here = self.env.docname
            uri = "" if page is None else self.app.builder.get_relative_uri(here, page)
            new = nodes.reference("", "", *link.children, internal=True, refuri=f"{uri}#{settings}")
            new.children = [child.deepcopy() for child in link.children]
            link.replace_self(new)

    def target(self, link):
        """Page, None for this one, and settings of a link; None, None for any other link."""
        target, anchor = link["reftarget"], link.get("reftargetid") or ""
        if anchor.startswith(PREFIXES):
            return (target if target != self.env.docname else None), anchor
        if target.startswith(PREFIXES):
            return None, target
        return None, None


class ExplorerCells(SphinxPostTransform):
    """The cells of explorers: their folded code stands below, for the picture to be in sight.

    Their output has a class of its own, for the style sheet.
    """

    default_priority = 200  # once MyST-NB has folded it
    formats = ("html",)

    def run(self, **kwargs):
        """Visit the cells of one page."""
        for box in self.document.findall(nodes.raw):
            if BOX.search(box.astext()):
                box["classes"].append("se-output")
        for fold in list(self.document.findall(HideCodeCellNode)):
            cell = fold.parent
            if any(EXPLORER in node.astext() for node in cell.findall(nodes.raw)):
                cell.remove(fold)
                cell.append(fold)


def setup(app):
    """Connect to Sphinx."""
    app.add_directive("explorer", ExplorerDirective)
    app.add_post_transform(ExplorerCells)
    app.add_post_transform(ExplorerLinks)
    app.connect("builder-inited", write_files)
    app.connect("source-read", keep_pages, priority=110)  # once they have been run
    app.connect("html-page-context", add_files, priority=400)  # before MyST-NB adds scripts
    return {"parallel_read_safe": True, "parallel_write_safe": True}
