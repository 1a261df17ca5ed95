"""Sphinx extension: a downloaded notebook says what it needs, and the book has it.

The book carries the package that its notebooks import, as a wheel, with the data it was built from,
and the students' copy of its notebooks.
"""

import os
import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import nbformat
import students
from sphinx.errors import ExtensionError

HEAD = """This notebook is a page of *{title}*. It imports the book's package, `suspension`.
Unless it is opened in the folder of the project, {first}run once:

```
%pip install {source}
```"""


def head(title, wheel, address="", repository=""):
    """The first cell of a downloaded notebook: where its package is, as far as the book knows.

    `wheel` is the file's path in the book, `address` the book's own, ending in a slash.
    """
    if address:
        return HEAD.format(title=title, first="", source=address + wheel)
    if repository:
        source = f'"suspension @ git+{repository}"'
        return HEAD.format(title=title, first="", source=source)
    first = f"copy `{wheel}` from the book's folder into that of this notebook and "
    return HEAD.format(title=title, first=first, source=Path(wheel).name)


def build_wheel(app):
    """Put the package into the book; its path there."""
    try:
        wheel = students.make_wheel(Path(app.outdir, "_static"), app.srcdir)
    except RuntimeError as error:
        raise ExtensionError(str(error)) from None
    return f"_static/{wheel.name}"


def say_what_is_needed(app, exception):
    """Add a first cell to the notebooks that the pages offer."""
    if exception or app.builder.format != "html":
        return
    repository = os.environ.get("BOOK_REPOSITORY", "").rstrip("/")
    wheel = build_wheel(app)
    text = head(app.config.project, wheel, app.config.html_baseurl, repository)
    for path in sorted(Path(app.outdir, "_sources").rglob("*.ipynb")):
        notebook = nbformat.read(path, as_version=4)
        notebook.cells.insert(0, nbformat.v4.new_markdown_cell(text, id="needs-suspension"))
        nbformat.write(notebook, path)
    with TemporaryDirectory() as folder:
        wheel = Path(app.outdir, wheel)
        packed = students.hand_out("students", folder, Path(app.srcdir), wheel)
        shutil.copy(packed, Path(app.outdir, "_static"))


def setup(app):
    """Connect to Sphinx."""
    app.connect("build-finished", say_what_is_needed)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
