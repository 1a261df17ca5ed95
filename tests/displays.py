"""Execute notebooks with other spring data, in this one process, and write what they display.

``python tests/displays.py FOLDER NOTEBOOK ...`` takes the data in FOLDER for the book's and writes
FOLDER/NOTEBOOK.json for each notebook: by a cell's id, the outputs it displays. A word on stderr, a
warning say, is an error, as it is when the book is built. There is neither a kernel nor a page, and
figures are drawn and laid out, but not written: that takes longer than most of what is computed.

FOLDER/robot.json, if it is there, says what else the robot has than the problem's.
"""

import json
import os
import subprocess
import sys
import warnings
from dataclasses import replace
from pathlib import Path

import matplotlib
import nbformat
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output

from suspension import _readings, course
from suspension.report import show

FOR_A_KERNEL = "%config InlineBackend"  # how it sends figures


def displayed(shell, source):
    """What a cell displays: its outputs by MIME type, each with its metadata."""
    with capture_output() as captured:
        shell.run_cell(source.replace(FOR_A_KERNEL, "# ")).raise_error()
    if captured.stderr:
        raise RuntimeError(captured.stderr)
    return [{"data": each.data, "metadata": each.metadata or {}} for each in captured.outputs]


def run(path):
    """The outputs of a notebook, by the id of a cell."""
    shell = InteractiveShell.instance()
    shell.reset()
    found = {}
    for cell in nbformat.read(path, as_version=4).cells:
        if cell.cell_type == "code":
            try:
                found[cell.id] = displayed(shell, cell.source)
            except Exception as error:
                error.add_note(f"in the cell {cell.id} of {path.name}")
                raise
    return found


def run_apart(folder, paths, **environment):
    """Run notebooks in a process of their own; by a notebook's name, what `run` gives."""
    done = subprocess.run(
        [sys.executable, __file__, folder, *paths],
        env=os.environ | environment | {"PYTHONPATH": str(Path(__file__).parents[1])},
        capture_output=True,
        encoding="utf-8",
        errors="replace",
    )
    assert done.returncode == 0, done.stderr[-3000:]
    return {
        path.stem: json.loads((folder / f"{path.stem}.json").read_text(encoding="utf-8"))
        for path in paths
    }


def lay_out(figure):
    """All that is done for a picture of a figure but its text."""
    figure.draw_without_rendering()
    return ""


def main(folder, *paths):
    """Run the notebooks, one after the other."""
    matplotlib.use("agg")
    warnings.simplefilter("default")
    _readings.FOLDERS = (Path(folder),)
    show.svg = lay_out
    other = Path(folder, "robot.json")
    if other.exists():
        robot = replace(course.the_robot(), **json.loads(other.read_text(encoding="utf-8")))
        course.the_robot = lambda: robot
    for path in map(Path, paths):
        text = json.dumps(run(path))
        Path(folder, f"{path.stem}.json").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
