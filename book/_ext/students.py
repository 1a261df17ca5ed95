"""Notebooks to hand out, as a folder and a zip: ``python students.py students|solutions``.

In the notebooks a heading that begins with Solution or Answer folds what stands below it. In the
students' copy these folds are left out, and cells that print an answer; in the lecturer's copy the
blanks of the workbook are filled. Both carry the package, as a wheel, and the data.
"""

import ast
import copy
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import nbformat

ROOT = Path(__file__).resolve().parents[2]
KINDS = ("students", "solutions")
HEADING = re.compile(r"^#+ .*", re.MULTILINE)
SOLVED = re.compile(r"#+ (Solution|Answer)\b")
ANSWER = re.compile(r"^answer\(", re.MULTILINE)
PAGE = re.compile(r"\[([^\]]*)\]\((?:\.\./)+book/[^)]*\)")
PIN = re.compile(r"^[\w.-]+==[^\\\n]*[^\\\s]", re.MULTILINE)
START = """# {title}

With Python 3.11, 3.12, 3.13 or 3.14, in this folder:

    python -m venv .venv
    .venv/bin/python -m pip install --requirement requirements.txt
    .venv/bin/jupyter lab notebooks

On Windows it is `.venv\\Scripts\\python` and `.venv\\Scripts\\jupyter`. The blanks to fill are in
`notebooks/workbook`: each notebook there names the parts that it goes with; its number is its own.
"""
TITLES = {
    "students": "A robot meets a bump: parts and workbook",
    "solutions": "A robot meets a bump: parts and workbook, with all solutions",
}


def tagged(cell, tag):
    """Whether a cell has a tag."""
    return tag in cell.metadata.get("tags", [])


def filled(notebook):
    """A copy in which each blank of the workbook holds its solution.

    Of the fold below it stays what it says in words.
    """
    notebook, blank, kept = copy.deepcopy(notebook), None, []
    for cell in notebook.cells:
        if tagged(cell, "blank"):
            blank = cell
        if tagged(cell, "solution"):
            blank.source = cell.source
        elif not (cell.cell_type == "markdown" and HEADING.sub("", cell.source).strip() == ""):
            kept.append(cell)
    notebook.cells = kept
    return notebook


def without_solutions(notebook):
    """A copy without the folds that hold solutions and without answers.

    Code in them stays, unfolded, where later code needs a name that nothing else makes.
    """
    notebook, kept, dropped, folded = copy.deepcopy(notebook), set(), set(), False
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            pieces = []
            starts = [0, *(found.start() for found in HEADING.finditer(cell.source))]
            for start, end in zip(starts, [*starts[1:], None]):
                piece = cell.source[start:end]
                if HEADING.match(piece):
                    folded = bool(SOLVED.match(piece))
                if not folded:
                    pieces.append(piece)
            cell.source = "".join(pieces).strip()
            if cell.source:
                kept.add(cell.id)
        elif folded or ANSWER.search(cell.source):
            dropped.add(cell.id)
        else:
            kept.add(cell.id)
    kept |= needed_later(notebook.cells, dropped)
    notebook.cells = [cell for cell in notebook.cells if cell.id in kept]
    return notebook


def names(cell):
    """The names that a cell of code makes, and those that it uses."""
    lines = [line for line in cell.source.splitlines() if not line.startswith("%")]
    made, used = set(), set()
    for node in ast.walk(ast.parse("\n".join(lines))):
        if isinstance(node, ast.Name):
            (used if isinstance(node.ctx, ast.Load) else made).add(node.id)
        elif isinstance(node, ast.FunctionDef | ast.ClassDef):
            made.add(node.name)
        elif isinstance(node, ast.arg):
            made.add(node.arg)
        elif isinstance(node, ast.alias):
            made.add((node.asname or node.name).partition(".")[0])
    return made, used


def needed_later(cells, dropped):
    """Which of the cells to be dropped make a name that later cells use and no other has made."""
    known, own = set(), {}
    for cell in cells:
        if cell.cell_type == "code":
            made, _ = names(cell)
            own[cell.id] = made - known
            known |= made if cell.id not in dropped else set()
    needed, asked = set(), set()
    for cell in reversed(cells):
        if cell.cell_type == "code":
            if cell.id in dropped and not own[cell.id] & asked:
                continue
            if cell.id in dropped:
                needed.add(cell.id)
            made, used = names(cell)
            asked = (asked | used) - made
    return needed


def handed_out(notebook, kind, is_workbook):
    """What a reader of a copy gets of a notebook: no link leads out of it."""
    if kind == "students":
        notebook = without_solutions(notebook)
    elif is_workbook:
        notebook = filled(notebook)
    notebook = copy.deepcopy(notebook)
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            cell.source = PAGE.sub(r"\1", cell.source)
        elif is_workbook:
            cell.outputs, cell.execution_count = [], None
    return notebook


def make_wheel(folder, root=ROOT):
    """The package as a wheel, put into a folder in place of any that is there."""
    for old in Path(folder).glob("suspension-*.whl"):
        old.unlink()
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    run = subprocess.run(command, cwd=root, capture_output=True, encoding="utf-8", errors="replace")
    if run.returncode:
        raise RuntimeError(f"the package could not be made into a wheel:\n{run.stderr}")
    (wheel,) = Path(folder).glob("suspension-*.whl")
    return wheel


def write_copy(folder, kind, wheel, root=ROOT):
    """Write a copy, `kind` being one of `KINDS`, into a new folder."""
    folder = Path(folder)
    for path in sorted(root.glob("notebooks/*.ipynb")) + sorted(
        root.glob("notebooks/workbook/*.ipynb")
    ):
        target = folder / path.relative_to(root)
        target.parent.mkdir(parents=True, exist_ok=True)
        notebook = nbformat.read(path, as_version=4)
        nbformat.write(handed_out(notebook, kind, path.parent.name == "workbook"), target)
    (folder / "data").mkdir(parents=True)
    for path in sorted(root.glob("data/*")):
        if path.suffix in (".csv", ".mat", ".md"):
            shutil.copy(path, folder / "data")
    shutil.copy(wheel, folder)
    pins = PIN.findall((root / "requirements.txt").read_text(encoding="utf-8"))
    texts = {
        "START.md": START.format(title=TITLES[kind]),
        "constraints.txt": "\n".join([*pins, ""]),
        "requirements.txt": f"--constraint constraints.txt\njupyterlab\n./{wheel.name}\n",
    }
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")


def write_zip(folder, target):
    """Pack a folder, the same bytes from the same files."""
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as packed:
        for path in sorted(folder.rglob("*")):
            if path.is_file():
                info = zipfile.ZipInfo(path.relative_to(folder.parent).as_posix())
                info.compress_type, info.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
                packed.writestr(info, path.read_bytes())


def hand_out(kind, build, root=ROOT, wheel=None):
    """Write a copy into the folder `build`, and beside it packed; return the zip.

    The wheel is made if there is none yet.
    """
    folder = Path(build, f"suspension-{kind}")
    shutil.rmtree(folder, ignore_errors=True)
    with tempfile.TemporaryDirectory() as place:
        write_copy(folder, kind, wheel or make_wheel(place, root), root)
    packed = folder.with_suffix(".zip")
    write_zip(folder, packed)
    return packed


if __name__ == "__main__":
    (kind,) = sys.argv[1:]
    print(hand_out(kind, ROOT / "_build" / kind))
