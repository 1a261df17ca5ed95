"""Sphinx extension: a downloaded notebook says how to get the package that it imports."""

import os
from pathlib import Path

import nbformat

HERE = """This notebook is a page of *{title}*. It imports the book's package, `suspension`, which
needs Python 3.11 to 3.13. Unless it is opened in the folder of the project, run once:

```
%pip install {source}
```"""


def say_what_is_needed(app, exception):
    """Add a first cell to the notebooks that the pages offer."""
    if exception or app.builder.format != "html":
        return
    repository = os.environ.get("BOOK_REPOSITORY", "").rstrip("/")
    source = f'"suspension @ git+{repository}"' if repository else "/path/to/the/project"
    for path in sorted(Path(app.outdir, "_sources").rglob("*.ipynb")):
        notebook = nbformat.read(path, as_version=4)
        text = HERE.format(title=app.config.project, source=source)
        notebook.cells.insert(0, nbformat.v4.new_markdown_cell(text, id="needs-suspension"))
        nbformat.write(notebook, path)


def setup(app):
    """Connect to Sphinx."""
    app.connect("build-finished", say_what_is_needed)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
