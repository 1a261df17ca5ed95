"""The first commands: those of the README work, and a machine that lacks something is told so."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from helpers import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")
WINDOWS = re.search(r"```bat\n(.*?)```", README, re.DOTALL)[1].splitlines()


def run(command, folder):
    """Exit code and output of a command, as if no other `make` had called it."""
    own = {name: value for name, value in os.environ.items() if not name.startswith("MAKE")}
    done = subprocess.run(command, cwd=folder, env=own, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def test_the_commands_for_windows_are_those_of_make():
    assert WINDOWS[0] == "py -m venv .venv"
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for line in WINDOWS[1:4]:
        program, *arguments = line.removeprefix(".venv\\Scripts\\").split()
        made = " ".join(["$(BIN)/" + program, *arguments]).replace(" --quiet", "")
        assert made in makefile.replace(" --quiet", ""), line


@pytest.mark.parametrize("line", [*WINDOWS[1:3], WINDOWS[4]])
def test_a_command_for_windows_works(line):
    program, *arguments = line.removeprefix(".venv\\Scripts\\").split()
    assert program == "python"
    harmless = {
        "pip": ["--dry-run", "--no-index"],
        "pytest": ["--collect-only", "tests/unit/test_words.py"],
    }
    code, output = run([sys.executable, *arguments, *harmless[arguments[1]]], ROOT)
    assert code == 0, output[-2000:]


@pytest.fixture
def bare(tmp_path):
    """A copy of what `make` needs, in a folder with spaces, with programs of its own."""
    folder = tmp_path / "a folder with spaces"
    (folder / "bin").mkdir(parents=True)
    for name in ("Makefile", "requirements.txt", "pyproject.toml"):
        shutil.copy(ROOT / name, folder)
    return folder


def fake_python(folder, code):
    """A Python that runs some code before what it is told to run."""
    program = folder / "bin" / "python3"
    start = "import sys; " + code
    program.write_text(
        f"#!/bin/sh\nshift\nexec {sys.executable} -c '{start}\nexec(sys.argv[1])' \"$@\"\n",
        encoding="utf-8",
    )
    program.chmod(0o755)
    return str(folder / "bin" / "python3")


@pytest.mark.skipif(shutil.which("make") is None, reason="needs make")
@pytest.mark.parametrize(
    ("code", "told"),
    [
        ("sys.version_info = (3, 9, 0)", "is not Python 3.11, 3.12, 3.13 or 3.14"),
        ("sys.version_info = (3, 15, 0)", "is not Python 3.11, 3.12, 3.13 or 3.14"),
        ("sys.modules.update(ensurepip=None)", "apt install python3-venv"),
    ],
)
def test_make_says_what_is_missing(bare, code, told):
    python = Path(fake_python(bare, code)).relative_to(bare)
    result, output = run(["make", f"PYTHON={python}", ".venv/.installed"], bare)
    assert result
    assert told in output.splitlines()[0], output
    assert not (bare / ".venv").exists()


@pytest.mark.skipif(shutil.which("make") is None, reason="needs make")
def test_lab_starts_as_root_and_in_the_folder_of_the_project():
    output = run(["make", "--dry-run", "--assume-old=.venv/.installed", "lab"], ROOT)[1]
    assert "jupyter trust notebooks/*.ipynb" in output  # or their figures are hidden at first
    assert "--notebook-dir" not in output
    assert ("--allow-root" in output) == (hasattr(os, "getuid") and os.getuid() == 0)


@pytest.mark.skipif(shutil.which("make") is None, reason="needs make")
@pytest.mark.parametrize("target", ["book", "pdf", "notebooks", "students", "solutions"])
def test_make_says_what_it_does_in_a_line_a_step(target):
    output = run(["make", "--dry-run", "--always-make", target], ROOT)[1]
    steps = re.findall(r'^echo "(.*)"', output, re.MULTILINE)
    assert steps[0].startswith("Setting up the environment") and len(steps) >= 2
    for step in steps:
        assert re.search(r"^[A-Z].* \.\.\.$", step)


@pytest.mark.slow
def test_a_kernel_of_the_book_warns_of_nothing(tmp_path):
    code = (
        "import sys; sys.path.insert(0, 'notebooks'); import nbformat, normalise\n"
        "cells = [nbformat.v4.new_code_cell('print(1)')]\n"
        "nbformat.write(nbformat.v4.new_notebook(cells=cells), sys.argv[1])\n"
        "normalise.main(sys.argv[1:])\n"
        "sys.path.insert(0, 'book/_ext'); import execution; from pathlib import Path\n"
        "execution.run(Path(sys.argv[1]), Path(sys.argv[1] + '.json'), 60)\n"
    )
    code, output = run([sys.executable, "-c", code, str(tmp_path / "a.ipynb")], ROOT)
    assert code == 0 and "WARN" not in output, output


@pytest.mark.skipif(shutil.which("make") is None, reason="needs make")
def test_make_pdf_asks_for_a_browser_before_it_builds_the_book():
    output = run(["make", "--dry-run", "pdf"], ROOT)[1]
    assert 0 < output.index("paper.py --check") < output.index("jupyter-book build")
    paper = [sys.executable, str(ROOT / "book" / "paper.py"), "--check"]
    done = subprocess.run(paper, env={"PATH": ""}, capture_output=True, text=True)
    assert done.returncode == 1 and "apt install chromium" in done.stderr
