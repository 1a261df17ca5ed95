"""Fixtures: the built book, a web server that serves it, and a browser to read it with."""

import os
import shutil
import subprocess
import sys
import tempfile
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking",
         "--disable-component-update", "--disable-sync"]


def needs_book(item):
    """Whether a test reads the built book."""
    return "book" in getattr(item, "fixturenames", ())


def pytest_collection_modifyitems(items):
    """Tests of the book come last: until then it is built beside the others."""
    items.sort(key=needs_book)


def pytest_collection_finish(session):
    """Start to build the book if a test needs it; BOOK_HTML=_build/html takes a finished one."""
    wanted = any(map(needs_book, session.items)) and not session.config.option.collectonly
    if wanted and "BOOK_HTML" not in os.environ:
        session.config.stash[BUILD] = Build()


def pytest_sessionfinish(session):
    """Leave no build behind."""
    if BUILD in session.config.stash:
        session.config.stash[BUILD].end()


class Build:
    """The book, being built in a folder of its own."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="book-")
        self.log = Path(self.folder.name, "log")
        with self.log.open("w") as log:
            self.process = subprocess.Popen(
                [Path(sys.executable).with_name("jupyter-book"), "build", ".", "--all", "-W", "-n",
                 "--keep-going", "--path-output", self.folder.name],
                cwd=ROOT, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT)

    def html(self):
        """Wait for the pages."""
        failed = self.process.wait()
        assert not failed, "\n".join(self.log.read_text().splitlines()[-60:])
        return Path(self.folder.name, "_build", "html").resolve()

    def end(self):
        """Stop and remove it."""
        self.process.terminate()
        self.process.wait()
        self.folder.cleanup()


BUILD = pytest.StashKey[Build]()


@pytest.fixture(scope="session")
def book(request):
    """Folder of the built book."""
    if "BOOK_HTML" in os.environ:
        return Path(os.environ["BOOK_HTML"]).resolve()
    return request.config.stash[BUILD].html()


class QuietHandler(SimpleHTTPRequestHandler):
    """A file server that keeps pytest's output clean."""

    def log_message(self, *args):
        """Say nothing."""


@pytest.fixture(scope="session")
def site(book):
    """Address of the book in a sub-folder of a web server, ending in a slash."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(QuietHandler, directory=book.parent))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/{book.name}/"
    server.shutdown()
    server.server_close()


@pytest.fixture(scope="session")
def chromium():
    """Path of the system's Chromium, or a skip."""
    names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"]
    path = next(filter(None, map(shutil.which, names)), None)
    if path is None:
        pytest.skip("no Chromium found: install Debian's 'chromium' to run the browser tests")
    return path


@pytest.fixture(scope="session")
def browser(chromium):
    """A headless Chromium, driven by Playwright."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
        yield browser
        browser.close()
