"""Sphinx extension: what a page says of itself to search engines and to those who share it.

The book is built for no address in particular. Where it is published is said by the environment:
``BOOK_ADDRESS``, the address of its first page's folder, and ``BOOK_REPOSITORY``, that of its
repository. Without the first there is no canonical address and no picture to share; without
the second there are no buttons that open a notebook elsewhere.

Tried instead: sphinxext-opengraph describes a page by its first 200 characters, cut within a word,
with the LaTeX of formulas; sphinx-notfound-page writes addresses into its page that `light_pages`
does not find, and needs to know where the book will be.
"""

import os
import re
from html import escape
from pathlib import Path
from urllib.parse import urlsplit

from docutils import nodes

BRANCH = "main"
LONGEST = 200  # characters of a description
LOST = """<section id="lost"><h1>This page is not here</h1>
<p>The address leads to no page of this book. It may have moved: look for it in the contents, or
<a href="search.html">search</a>, or start from <a href="index.html">the first page</a>.</p>
</section>"""


def configure(app, config):
    """Read the addresses, and give the book's name to all that ask for that of a project."""
    config.project = config.html_title
    config.html_baseurl = os.environ.get("BOOK_ADDRESS", "").rstrip("/")
    config.html_baseurl += "/" if config.html_baseurl else ""
    repository = os.environ.get("BOOK_REPOSITORY", "").rstrip("/")
    if repository:
        config.html_theme_options |= {
            "repository_url": repository,
            "repository_branch": os.environ.get("BOOK_BRANCH", BRANCH),
            "use_repository_button": True,
            "launch_buttons": {
                "notebook_interface": "jupyterlab",
                "binderhub_url": "https://mybinder.org",
                "colab_url": "https://colab.research.google.com",
            },
        }


def describe(app, page, template, context, doctree):
    """Add a description and what sharing services read."""
    address = app.config.html_baseurl
    title = re.sub(r"<[^>]*>", "", context.get("title", "")) or app.config.project
    if page == app.config.root_doc:
        context["docstitle"] = ""  # else the title of the first page stands there twice
    tags = {"og:type": "article", "og:site_name": app.config.html_title, "og:title": title}
    text = description(doctree) if doctree else ""
    if text:
        tags["og:description"] = text
    if address:
        tags |= {"og:url": f"{address}{page}.html", "og:image": f"{address}_static/preview.png"}
    lines = [f'<meta property="{name}" content="{escape(tags[name])}" />' for name in tags]
    if text:
        lines.append(f'<meta name="description" content="{escape(text)}" />')
    context["metatags"] = "\n".join([context.get("metatags", ""), *lines])


def description(doctree):
    """The first sentences of a page that have no formula, as far as there is room."""
    for paragraph in doctree.findall(nodes.paragraph):
        if not isinstance(paragraph.parent, nodes.section):
            continue
        copy = paragraph.deepcopy()
        for formula in list(copy.findall(nodes.math)):
            formula.replace_self(nodes.Text("$"))
        sentences = re.split(r"(?<=[.?!:]) ", " ".join(copy.astext().split()))
        text = ""
        for sentence in sentences:
            if "$" in sentence or len(text) + len(sentence) > LONGEST:
                break
            text = f"{text} {sentence}".strip()
        if text:
            return text
    return ""


def lost_page(app):
    """A page for addresses that lead nowhere; servers show it at any depth.

    There its links and its style are found from the folder of the book, if that is known.
    """
    start = urlsplit(app.config.html_baseurl).path
    base = f'<base href="{escape(start)}" />' if start else ""
    yield "404", {"title": "Not found", "body": LOST, "metatags": base}, "page.html"


def draw_preview(app, exception):
    """Draw the picture that stands for the book where it is shared."""
    if exception or app.builder.format != "html":
        return
    import matplotlib.pyplot as plt  # the other pages need it in their kernels alone

    from suspension import GaussianBump, over_bump
    from suspension.course import the_robot
    from suspension.figures import RobotDrawing

    robot, bump, v, X = the_robot(), GaussianBump(), 1.2, 0.2125
    with plt.style.context("suspension.figures.report"):
        figure, ax = plt.subplots(figsize=(12, 6.3), dpi=100)
        drawing = RobotDrawing(ax, robot, bump)
        drawing.ground(0, 0.7)
        drawing.update(over_bump(robot, bump, v, [X / v])[:, 0], X)
        ax.axis("off")
        figure.text(0.05, 0.88, app.config.project, size=40, weight="bold")
        path = Path(app.outdir, "_static", "preview.png")
        figure.savefig(path, metadata={"Software": None})
        plt.close(figure)


def setup(app):
    """Connect to Sphinx."""
    app.connect("config-inited", configure)
    app.connect("html-page-context", describe)
    app.connect("html-collect-pages", lost_page)
    app.connect("build-finished", draw_preview)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
