"""Build the book twice, from copies of what git has, and compare every file: ``make twice``.

``python tests/twice.py`` exits with 1 and names the files that differ. It takes as long as two
builds, so `make test` leaves it out; continuous integration runs it.
"""

import filecmp
import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from helpers import ROOT

FIXED = {"PYTHONHASHSEED": "0", "SOURCE_DATE_EPOCH": "1795478400"}


def build(folder):
    """Copy what git tracks into a folder, build the book there, and return where it is."""
    files = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True)
    for name in files.stdout.decode().split("\0"):
        if name and (ROOT / name).is_file():
            target = folder / name
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes((ROOT / name).read_bytes())
    program = Path(sys.executable).with_name("jupyter-book")
    command = [program, "build", ".", "--all", "-W", "-n", "--keep-going"]
    run = subprocess.run(
        command, cwd=folder, env=os.environ | FIXED, capture_output=True, text=True
    )
    if run.returncode:
        sys.exit(run.stdout + run.stderr)
    return folder / "_build" / "html"


def differences(left, right):
    """Files that only one of two folders has, or that differ."""
    names = {path.relative_to(side) for side in (left, right) for path in side.rglob("*")}
    for name in sorted(names):
        if (left / name).is_dir() and (right / name).is_dir():
            continue
        both = (left / name).is_file() and (right / name).is_file()
        if not both or not filecmp.cmp(left / name, right / name, shallow=False):
            yield str(name)


if __name__ == "__main__":
    with TemporaryDirectory() as first, TemporaryDirectory() as second:
        found = list(differences(build(Path(first)), build(Path(second))))
    print("\n".join(found) or "the same, byte for byte")
    sys.exit(bool(found))
