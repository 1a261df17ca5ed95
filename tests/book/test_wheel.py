"""The package as others get it: a wheel in a clean environment, far from this folder."""

import re
import shutil
import sys
import zipfile

import numpy as np
import pytest
from helpers import ROOT, environment_with, run_python
from scipy import io

README = (ROOT / "README.md").read_text(encoding="utf-8")
EXAMPLE = re.search(r"```python\n(.*?)```\s+```text\n(.*?)```", README, re.DOTALL)
WHERE = "import suspension; print(suspension.__file__)"


@pytest.fixture(scope="module")
def python(tmp_path_factory):
    """The interpreter of an environment with the wheel; the other libraries are borrowed."""
    folder = tmp_path_factory.mktemp("wheel")
    options = ["--no-deps", "--no-build-isolation", "--quiet", "--disable-pip-version-check"]
    pip = ["-m", "pip", "wheel", *options, "--wheel-dir", folder, ROOT]
    run_python(sys.executable, *pip, cwd=folder)
    (wheel,) = folder.glob("*.whl")
    return environment_with(wheel, folder / "env")


def test_the_readme_has_an_example_with_its_output():
    assert EXAMPLE


def test_it_is_the_wheel_that_is_imported(python, tmp_path):
    assert str(ROOT) not in run_python(python, "-c", WHERE, cwd=tmp_path)


def test_the_readmes_example_prints_what_the_readme_says(python, tmp_path):
    code, output = EXAMPLE.groups()
    assert run_python(python, "-c", code, cwd=tmp_path) == output


def test_it_finds_its_data_its_style_and_its_page(python, tmp_path):
    code = (
        "import matplotlib.pyplot as plt\n"
        "from suspension.course import the_robot\n"
        "from suspension.explorer import Explorer\n"
        "plt.style.use('suspension.figures.report')\n"
        "print(round(the_robot().k1), len(Explorer._esm) > 9999, len(Explorer._css) > 999)\n"
    )
    k, *found = run_python(python, "-c", code, cwd=tmp_path).split()
    assert 750 < int(k) < 850
    assert found == ["True", "True"]


def test_it_says_what_it_reads(python, tmp_path):
    assert "spring_data.csv" in run_python(python, "-m", "suspension.springs", cwd=tmp_path)


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """What a wheel is made of, with a lecturer's data beside the project's, out of git's sight."""
    tree = tmp_path_factory.mktemp("tree")
    for part in ("suspension", "data"):
        shutil.copytree(ROOT / part, tree / part, ignore=shutil.ignore_patterns("__pycache__"))
    for part in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / part, tree)
    (tree / ".gitignore").write_text("*.mat\n", encoding="utf-8")
    x = np.linspace(0, 1, 9)
    fields = {"delta_over_delta_max": x, "force": 640 * 0.0165 * x}
    io.savemat(tree / "data" / "spring_data.mat", fields)
    return tree


@pytest.fixture(scope="module")
def lecturers(tree, tmp_path_factory):
    """The folder of a wheel that a lecturer has made, unpacked."""
    folder = tmp_path_factory.mktemp("lecturers")
    run_python(sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", folder, cwd=tree)
    (wheel,) = folder.glob("*.whl")
    zipfile.ZipFile(wheel).extractall(folder)
    return folder


def test_a_wheel_carries_the_data_that_the_book_was_built_from(lecturers, tmp_path):
    where = run_python(sys.executable, "-c", WHERE, cwd=tmp_path, PYTHONPATH=str(lecturers))
    assert where.startswith(str(lecturers))
    says = run_python(
        sys.executable, "-m", "suspension.springs", cwd=tmp_path, PYTHONPATH=str(lecturers)
    )
    assert "spring_data.mat" in says and "synthetic" not in says and "640.0 N/m" in says


def test_a_wheel_carries_nothing_else_from_the_folder_of_the_data(lecturers, tree):
    carried = {path.name for path in (lecturers / "suspension" / "data").iterdir()}
    assert carried == {"spring_data.csv", "spring_data.mat", "vehicles.csv"}
    assert carried < {path.name for path in (tree / "data").iterdir()}
