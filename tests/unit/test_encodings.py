"""Files are read alike on every machine: each is opened with its encoding.

Where nothing is said, Python takes that of the system, on Windows often a code page of 256 letters.
"""

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest
from helpers import ROOT, windows_locale


def sources(folder):
    """Python's files below a folder; not those from npm, which the book may just be installing."""
    for place, folders, files in os.walk(ROOT / folder):
        folders[:] = [name for name in folders if name != "node_modules"]
        yield from (Path(place, name) for name in files if name.endswith(".py"))


SOURCES = [
    path
    for folder in ("suspension", "book", "notebooks", "data", "tests", "benchmarks")
    for path in sorted(sources(folder))
]
# What is read and written while the package, the tools of the book and the notebooks are at work.
AT_WORK = r"""
import sys, warnings
from pathlib import Path
root, tmp = map(Path, sys.argv[1:])
ours = r"(suspension|normalise|paper|" + "|".join(p.stem for p in root.glob("book/_ext/*.py")) + ")"
warnings.filterwarnings("error", category=EncodingWarning, module=ours + r"\b")
sys.path[:0] = map(str, (root, root / "book" / "_ext", root / "book", root / "notebooks"))
from importlib import import_module
for path in sorted(root.glob("suspension/**/*.py")):
    import_module(".".join(path.relative_to(root).with_suffix("").parts).removesuffix(".__init__"))
for path in [*root.glob("book/_ext/*.py"), root / "book/paper.py", root / "notebooks/normalise.py"]:
    import_module(path.stem)
from suspension import springs
springs.load_spring_data()
import nbformat, normalise
greek = "\u03c9 \u2265 \u22121"
cell = nbformat.v4.new_code_cell(f"print({greek!r})")
nbformat.write(nbformat.v4.new_notebook(cells=[cell]), tmp / "a.ipynb")
normalise.main([tmp / "a.ipynb"])
assert greek in (tmp / "a.ipynb").read_text(encoding="utf-8").split("outputs")[1]
"""


def opens(call):
    """Whether a call opens a text file, and whether it says in which encoding."""
    name = getattr(call.func, "attr", getattr(call.func, "id", None))
    said = any(keyword.arg == "encoding" for keyword in call.keywords)
    mode = call.args[1] if name == "open" and len(call.args) > 1 else None
    text = not (isinstance(mode, ast.Constant) and "b" in mode.value)
    is_open = name == "open" and isinstance(call.func, ast.Name) and text
    is_method = isinstance(call.func, ast.Attribute) and name in ("read_text", "write_text")
    return is_open or is_method, said


@pytest.mark.slow
def test_every_file_is_opened_with_its_encoding():
    silent = [
        f"{path.relative_to(ROOT)}:{node.lineno}"
        for path in SOURCES
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and opens(node) == (True, False)
    ]
    assert len(SOURCES) > 100
    assert not silent


def test_the_linter_asks_for_it_too():
    ruff = [sys.executable, "-m", "ruff", "check", "--stdin-filename", str(ROOT / "new.py"), "-"]
    code = 'with open("file") as file:\n    print(file.read())\n'
    run = subprocess.run(ruff, input=code, cwd=ROOT, capture_output=True, encoding="utf-8")
    assert "unspecified-encoding" in run.stdout


@pytest.mark.slow
def test_package_and_tools_work_with_the_letters_of_windows(tmp_path):
    environment = os.environ | windows_locale(tmp_path) | {"PYTHONWARNDEFAULTENCODING": "1"}
    run = subprocess.run(
        [sys.executable, "-c", AT_WORK, ROOT, tmp_path],
        env=environment,
        capture_output=True,
        encoding="cp1252",
    )
    assert run.returncode == 0, run.stderr
