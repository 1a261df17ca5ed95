"""Fixtures: the built book, a web server that serves it, and a browser to read it with."""

import os
import re
from pathlib import Path

import pytest
from helpers import ROOT, find_chromium, serve_files, start_chromium
from xdist.scheduler import LoadFileScheduling

# Of these each data set is computed by itself, for a minute or so, and each page loaded by itself.
APART = re.compile(r"(.*/test_(?:other_data|pages)\.py)::.*?\[([\w/]+)")


class ByFile(LoadFileScheduling):
    """A file's tests stay in one process, but for those of different data sets, or pages."""

    def _split_scope(self, nodeid):
        apart = APART.match(nodeid)
        return "::".join(apart.groups()) if apart else super()._split_scope(nodeid)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """How `make test` shares the tests out."""
    return ByFile(config, log) if config.getvalue("dist") == "loadfile" else None


@pytest.hookimpl(tryfirst=True)  # before they are chosen by their marks
def pytest_collection_modifyitems(items):
    """Mark the tests that need the built book, or what comes with it for browsers."""
    for item in items:
        if {"book", "browser"} & set(getattr(item, "fixturenames", ())):
            item.add_marker("built")


@pytest.fixture(scope="session")
def book():
    """Folder of the built book: that of ``make book``, or the one that BOOK_HTML names."""
    folder = Path(os.environ.get("BOOK_HTML", ROOT / "_build" / "html")).resolve()
    if not (folder / "index.html").is_file():
        pytest.fail(f"no book in {folder}: 'make test' builds it first, 'make book' only builds")
    return folder


@pytest.fixture(scope="session")
def site(book):
    """Address of the book in a sub-folder of a web server, ending in a slash."""
    with serve_files(book.parent) as address:
        yield f"{address}{book.name}/"


@pytest.fixture(scope="session")
def chromium():
    """Path of the system's Chromium, or a skip."""
    path = find_chromium()
    if path is None:
        pytest.skip("no Chromium found: install Debian's 'chromium' to run the browser tests")
    return path


@pytest.fixture(scope="session")
def browser(chromium):
    """A headless Chromium, driven by Playwright."""
    with start_chromium(chromium) as browser:
        yield browser
