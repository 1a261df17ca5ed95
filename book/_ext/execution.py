"""Sphinx extension: notebooks run side by side, and again when anything they use has changed.

MyST-NB would run one notebook after another, every time, or take outputs from a cache that does not
notice a change of the package. Here each notebook runs on a core of its own before the pages are
read, and its outputs are kept under a number that changes with its code, the package, the data, the
required versions and Python. MyST-NB then reads the notebooks as if they had been stored so.
"""

import hashlib
import json
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError
from sphinx.errors import ExtensionError
from sphinx.util import logging
from traitlets.config import Config

logger = logging.getLogger(__name__)
USED = ("suspension/**/*", "data/*", "requirements.txt")
FOR_BROWSERS = {".js", ".css"}  # handed to them as they are: no output holds any of it
ENCRYPTED = Config(KernelManager={"transport_encryption": "auto"})  # or every kernel warns


def take_over(app, config):
    """Run the notebooks here instead of in MyST-NB, unless `_config.yml` turns that off."""
    config.add("run_notebooks", config.nb_execution_mode != "off", "env", bool)
    config.nb_execution_mode = "off"
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # each kernel has one core
    # Kernels import the package from here, whether or not it is installed.
    paths = [str(app.srcdir), os.environ.get("PYTHONPATH")]
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, paths))


def fingerprint(root):
    """A number that changes with the package, the data, the required versions or Python."""
    digest = hashlib.sha256(sys.version.encode())
    for pattern in USED:
        for path in sorted(root.glob(pattern)):
            if path.suffix in FOR_BROWSERS or "__pycache__" in path.parts:
                continue
            if path.is_file():
                digest.update(f"{path.relative_to(root)}\0".encode() + path.read_bytes())
    return digest.hexdigest()


def code_cells(notebook):
    """The cells that are run."""
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def place(path, notebook, common, build):
    """Where the outputs of a notebook are kept, by a number that changes with its code."""
    code = "\0".join(cell.source for cell in code_cells(notebook))
    number = hashlib.sha256(f"{common}\0{code}".encode()).hexdigest()
    return build / ".notebooks" / f"{path.stem}-{number[:16]}.json"


def keep(outputs, file):
    """Store the outputs of a notebook's cells."""
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps({"outputs": outputs}), encoding="utf-8")


def run_all(app, env, pages):
    """Run those notebooks whose outputs are not known; drop outputs that are no longer of use."""
    if not app.config.run_notebooks:
        return
    common = fingerprint(Path(app.srcdir))
    env.executed = {}
    missing = []
    build = Path(app.outdir).parent
    for page in sorted(env.found_docs):
        path = Path(env.doc2path(page))
        if path.suffix == ".ipynb":
            notebook = nbformat.read(path, as_version=4)
            env.executed[page] = place(path, notebook, common, build)
            if not env.executed[page].exists():
                missing.append((path, env.executed[page], app.config.nb_execution_timeout))
    folder = build / ".notebooks"
    folder.mkdir(parents=True, exist_ok=True)
    for old in set(folder.iterdir()) - set(env.executed.values()):
        old.unlink()
    logger.info("running %d notebooks", len(missing))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(run, *zip(*missing)) if missing else [])


def run(path, result, timeout):
    """Run a notebook and store the outputs of its cells."""
    notebook = nbformat.read(path, as_version=4)
    folder = {"metadata": {"path": str(path.parent)}}
    client = NotebookClient(
        notebook, timeout=timeout, kernel_name="python3", resources=folder, config=ENCRYPTED
    )
    try:
        client.execute()
    except CellExecutionError as error:
        raise ExtensionError(f"{path}: {error}") from error
    keep([cell.outputs for cell in code_cells(notebook)], result)


def put_outputs(app, page, source):
    """Give MyST-NB a notebook with its outputs."""
    path = getattr(app.env, "executed", {}).get(page)
    if path is None:
        return
    notebook = nbformat.reads(source[0], as_version=4)
    state = nbformat.from_dict(json.loads(path.read_text(encoding="utf-8")))
    for cell, outputs in zip(code_cells(notebook), state.outputs):
        cell.outputs = outputs
    source[0] = nbformat.writes(notebook)


def setup(app):
    """Connect to Sphinx."""
    app.connect("config-inited", take_over)
    app.connect("env-before-read-docs", run_all, priority=100)
    app.connect("source-read", put_outputs, priority=100)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
