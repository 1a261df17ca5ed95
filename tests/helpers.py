"""What several tests share, and the explorer's benchmark: where things are, a server, a browser."""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
import threading
import venv
import warnings
from contextlib import contextmanager
from functools import cache, partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import numpy as np
import yaml
from bs4 import BeautifulSoup

ROOT = Path(__file__).resolve().parents[1]
AXE = ROOT / "book" / "npm" / "node_modules" / "axe-core" / "axe.min.js"
PARITY = 1e-9  # how closely the explorer's page follows `simulate`
BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
SHELL = "chromium-headless-shell"  # the same without windows, settings and half of the work
FLAGS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)


def files_of(entry):
    """The page of a table-of-contents entry and all below it."""
    if isinstance(entry, list):
        return [page for item in entry for page in files_of(item)]
    own = [entry[key] for key in ("root", "file") if key in entry]
    below = [entry[key] for key in ("parts", "chapters", "sections", "entries") if key in entry]
    return own + files_of(below)


# All pages of the book, without the endings of their files.
PAGES = [
    re.sub(r"\.(md|ipynb)$", "", page)
    for page in files_of(yaml.safe_load((ROOT / "_toc.yml").read_text(encoding="utf-8")))
]


@cache
def parse(path):
    """A page of the built book, taken apart; it takes a second or two, so once."""
    return BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser")


class Quantity:
    """What numbers with units are to NumPy: as pint's, it gives bare ones away, with a warning."""

    def __init__(self, magnitude, units="metre"):
        self.magnitude, self.units = magnitude, units

    def __array__(self, dtype=None, copy=None):
        """The magnitudes alone."""
        warnings.warn("the unit of the quantity is stripped", UserWarning, stacklevel=2)
        return np.asarray(self.magnitude, dtype)

    def __float__(self):
        """Only a number without a dimension is a float."""
        raise TypeError(f"cannot convert from {self.units!r} to 'dimensionless'")

    def __len__(self):
        """As that of the magnitudes; a scalar has none."""
        return len(self.magnitude)

    def __getitem__(self, key):
        """A part, with the same units."""
        return Quantity(self.magnitude[key], self.units)

    def __repr__(self):
        """As that of pint."""
        return f"<Quantity({self.magnitude}, {self.units!r})>"


class UnitArray(np.ndarray):
    """The other kind, of unyt and astropy: an array that carries its units along."""

    def __new__(cls, values, units="metre"):
        """A view of the values."""
        made = np.asarray(values, float).view(cls)
        made.units = units
        return made

    def __array_finalize__(self, other):
        """Parts and results have units as well."""
        self.units = getattr(other, "units", None)


def plain(text):
    """A text without its no-break spaces."""
    return text.replace("\xa0", " ")


def near(actual, expected, relative):
    """Assert that two arrays differ by at most `relative` of the largest expected element.

    An element of a history may pass through zero, where no relative error of its own makes sense.
    """
    actual, expected = np.asarray(actual), np.asarray(expected)
    allowed = relative * np.abs(expected).max()
    np.testing.assert_allclose(actual, expected, rtol=0, atol=allowed)


def shaded(ax):
    """The ranges of x that are shaded, not hatched, over the whole height: shape (n, 2)."""
    to_data = ax.transData.inverted()
    patches = [patch for patch in ax.patches if not patch.get_hatch()]
    return [patch.get_extents().transformed(to_data).intervalx.tolist() for patch in patches]


def largest_difference(page, run):
    """Between all of a page's [W, N], shape (6, J+1), and those of a Trajectory.

    Relative to the largest state, or force, so far if that is above 1.
    """
    assert page.shape == (6, len(run.T))

    def worst(rows, ours):
        so_far = np.maximum.accumulate(np.abs(ours).max(axis=0))
        return (np.abs(rows - ours) / np.maximum(so_far, 1)).max()

    return max(worst(page[:4], run.W), worst(page[4:], run.N))


class QuietHandler(SimpleHTTPRequestHandler):
    """A file server that keeps the terminal clean."""

    def log_message(self, *args):
        """Say nothing."""


class PatientServer(ThreadingHTTPServer):
    """A server that turns nobody away: who is comes again, but seconds later."""

    request_queue_size = 128


@contextmanager
def serve_files(folder):
    """Serve a folder on this machine; its address, ending in a slash."""
    server = PatientServer(("127.0.0.1", 0), partial(QuietHandler, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}/"
    finally:
        server.shutdown()
        server.server_close()


def windows_locale(folder):
    """Variables of the environment in which text has the 256 letters of Windows, if possible.

    Where the system cannot make such a locale (it takes ``localedef`` and its sources, on Debian
    those of the package ``locales``), there are 128 letters, or 256 on Windows itself.
    """
    name = "en_US.CP1252"
    command = ["localedef", "-i", "en_US", "-f", "CP1252", str(folder / name)]
    made = shutil.which("localedef") and not subprocess.run(command, capture_output=True).returncode
    own = {"LOCPATH": str(folder), "LC_ALL": name} if made else {"LC_ALL": "C"}
    return own | {"PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}


def find_chromium(*, whole=False):
    """Path of the system's Chromium, or None; the `whole` one has a reader's settings."""
    names = BROWSERS if whole else (SHELL, *BROWSERS)
    return next(filter(None, map(shutil.which, names)), None)


@contextmanager
def start_chromium(path):
    """A headless Chromium, driven by Playwright."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=list(FLAGS))
        try:
            yield browser
        finally:
            browser.close()


def swipe(tab, x, y, dx, dy):
    """A finger comes down, moves in eight steps and is lifted."""
    session = tab.context.new_cdp_session(tab)
    for n in range(9):
        kind, point = (
            ("touchMove" if n else "touchStart"),
            {"x": x + dx * n / 8, "y": y + dy * n / 8},
        )
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [point]})
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    tab.wait_for_timeout(250)


def run_python(python, *arguments, cwd, **environment):
    """What a Python prints; an error is shown as it came."""
    done = subprocess.run(
        [python, *arguments],
        cwd=cwd,
        env=os.environ | environment,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def environment_with(wheel, folder):
    """The interpreter of a new environment with a wheel; the other libraries are borrowed."""
    venv.create(folder, with_pip=False)
    python = folder / "bin" / "python"
    install = ["-m", "pip", "--python", python, "install", "--no-deps", "--quiet", wheel]
    run_python(sys.executable, *install, cwd=folder)
    ask = "import sysconfig; print(sysconfig.get_path('purelib'))"
    site = run_python(python, "-c", ask, cwd=folder)
    # The folder's own .pth files are not followed, so the checkout stays out of sight.
    pointer = Path(site.strip(), "borrowed.pth")
    pointer.write_text(sysconfig.get_path("purelib") + "\n", encoding="utf-8")
    return python


def violations(tab, *rules, within="html"):
    """What axe, once loaded, objects to, by some or all of its rules; how many found nothing."""
    options = {"resultTypes": ["violations"]} | ({"runOnly": list(rules)} if rules else {})
    result = tab.evaluate("([within, options]) => axe.run(within, options)", [within, options])
    found = [
        f"{violation['id']}: {violation['help']}: {node['target']} {node['failureSummary']}"
        for violation in result["violations"]
        for node in violation["nodes"]
    ]
    return found, len(result["passes"])
