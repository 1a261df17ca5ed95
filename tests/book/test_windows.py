"""The book's machinery on a system that does not speak UTF-8 by itself: one page, built there."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import yaml
from helpers import ROOT, windows_locale


def test_a_page_is_built_with_the_letters_of_windows(book, tmp_path):
    tree = tmp_path / "book"
    for part in ("suspension", "data", "book", "benchmarks"):
        shutil.copytree(ROOT / part, tree / part, symlinks=True)
    for part in ("pyproject.toml", "requirements.txt", "README.md", "LICENSE", "_config.yml"):
        shutil.copy(ROOT / part, tree)
    contents = {"format": "jb-book", "root": "book/references"}
    (tree / "_toc.yml").write_text(yaml.safe_dump(contents), encoding="utf-8")
    jupyter_book = Path(sys.executable).with_name("jupyter-book")
    run = subprocess.run(
        [jupyter_book, "build", ".", "--all"],
        cwd=tree,
        env=os.environ | windows_locale(tmp_path) | {"PYTHONPATH": str(tree)},
        capture_output=True,
        encoding="utf-8",
        errors="replace",
    )
    assert run.returncode == 0, (run.stdout + run.stderr)[-3000:]
    here, there = (
        (folder / "_build" / "html" / "book" / "references.html").read_text(encoding="utf-8")
        for folder in (book.parents[1], tree)
    )
    # Names with letters that Windows does not have come out alike.
    names = {word for word in here.split() if any(ord(letter) > 255 for letter in word)}
    assert names and names <= set(there.split())
