"""Sphinx extension: the licences of all that others wrote and the built book contains, in a file.

Every page links to it in its footer.
"""

from importlib.metadata import distribution
from pathlib import Path

import matplotlib

NPM = Path(__file__).parents[1] / "npm" / "node_modules"
# Styles and scripts of the pages.
PACKAGES = (
    "sphinx",
    "sphinx-book-theme",
    "pydata-sphinx-theme",
    "myst-nb",
    "sphinx-copybutton",
    "sphinx-design",
    "sphinx-togglebutton",
)
BROWSER_PACKAGES = ("katex",)
# The letters in figures are outlines of theirs.
FONTS = Path(matplotlib.get_data_path(), "fonts", "ttf")
ICONS = """Font Awesome Free by @fontawesome, https://fontawesome.com, as in pydata-sphinx-theme.
Icons: CC BY 4.0, https://creativecommons.org/licenses/by/4.0/
Fonts: SIL OFL 1.1, https://openfontlicense.org. Code: MIT."""
FILE = "_static/third-party.txt"


def notices():
    """Name, version and licence text of each."""
    for name in PACKAGES:
        package = distribution(name)
        texts = [
            path.locate().read_text(encoding="utf-8")
            for path in package.files
            if path.name.upper().startswith(("LICENSE", "BOOTSTRAP.JS.LICENSE"))
        ]
        yield f"{name} {package.version}", "\n\n".join(texts)
    yield "Font Awesome", ICONS
    for name in BROWSER_PACKAGES:
        for path in sorted((NPM / name).glob("LICENSE*")):
            yield name, path.read_text(encoding="utf-8")
    for path in sorted(FONTS.glob("LICENSE_*")):
        name = path.name.removeprefix("LICENSE_")
        yield f"matplotlib's font {name}", path.read_text(encoding="utf-8")


def write(app, exception):
    """Write the file."""
    if exception or app.builder.format != "html":
        return
    parts = [f"{'=' * 80}\n{name}\n{'=' * 80}\n\n{text.strip()}\n" for name, text in notices()]
    Path(app.outdir, FILE).write_text("\n".join(parts), encoding="utf-8")


def link(app, page, template, context, doctree):
    """Let every page's footer lead to the file."""
    address = context["pathto"](FILE, 1)
    context["theme_extra_footer"] = f'<a href="{address}">Licences of third parties</a>'


def setup(app):
    """Connect to Sphinx."""
    app.connect("html-page-context", link)
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
