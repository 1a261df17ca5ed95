"""Sphinx extension: every script and font comes from the book itself, none from another host.

npm has put require.js and the widget manager into ``book/npm/node_modules``, by version
and integrity; anywidget's module comes from the installed wheel, so that both halves match.
"""

import re
import shutil
from importlib.util import find_spec
from pathlib import Path

from sphinx.errors import ExtensionError

HERE = Path(__file__).parent
NODE_MODULES = HERE.parent / "npm" / "node_modules"
WIDGETS = NODE_MODULES / "@jupyter-widgets/html-manager/dist"
ANYWIDGET = Path(find_spec("anywidget").origin).parent / "nbextension" / "index.js"
FILES = {
    "widgets": [
        NODE_MODULES / "requirejs/require.js",
        HERE / "widget_paths.js",
        WIDGETS / "embed-amd.js",
        *WIDGETS.glob("*.woff2"),  # the icons that a widget's button may show
        ANYWIDGET,
    ],
}
# The widget manager also brings ipywidgets 7, for notebooks of that time: a quarter of its weight.
OLD_WIDGETS = re.compile(r"""(?sx) /\*! [^*]* \*/ \s* define\("@jupyter-widgets/(base|controls)7"
                             .*? (?=/\*! [^*]* \*/ \s* define\()""")
WIDGET_SCRIPTS = ["require.js", "widget_paths.js", "embed-amd.js"]  # in this order


def configure(app, config):
    """Point Sphinx and MyST-NB to the copies."""
    config.nb_ipywidgets_js = {f"widgets/{name}": {"defer": "defer"} for name in WIDGET_SCRIPTS}


def copy_files(app):
    """Copy the files to ``_static``, before Sphinx computes the checksums in their addresses."""
    if app.builder.format != "html":
        return
    for folder, sources in FILES.items():
        for source in sources:
            if not source.exists():
                raise ExtensionError(f"{source} is missing: run 'npm ci' in book/npm, or 'make'")
            copy(source, Path(app.outdir, "_static", folder, source.name))


def copy(source, target):
    """Copy a folder or a file; the widget manager without what no page of this book needs."""
    target.parent.mkdir(parents=True, exist_ok=True)
    if source.is_dir():
        shutil.copytree(source, target, dirs_exist_ok=True)
    elif source.name == "embed-amd.js":
        text, parts = OLD_WIDGETS.subn("", source.read_text(encoding="utf-8"))
        if parts != 2:
            raise ExtensionError(f"{source} holds {parts} parts of ipywidgets 7, not 2")
        target.write_text(text, encoding="utf-8")
    else:
        shutil.copyfile(source, target)


def setup(app):
    """Connect to Sphinx."""
    app.connect("config-inited", configure)
    app.connect("builder-inited", copy_files)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
