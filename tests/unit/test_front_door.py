"""``import suspension`` gives the names of the contract, and costs little."""

import json
import subprocess
import sys
from importlib import metadata
from pkgutil import iter_modules

import pytest
from helpers import ROOT

import suspension

CONTRACT = (
    "Robot GaussianBump FlatRoad Scheme EULER BACKWARD_EULER CRANK_NICOLSON RK4 "
    "simulate over_bump margin critical_speeds regimes fly __version__"
).split()
HEAVY = ["pandas", "statsmodels", "matplotlib", "IPython", "ipywidgets", "anywidget"]
ASK = """
import sys, time
start = time.perf_counter()
import numpy, scipy.integrate, scipy.linalg, scipy.optimize, scipy.special
third = time.perf_counter()
import suspension
end = time.perf_counter()
import json
print(json.dumps([third - start, end - third, sorted(sys.modules)]))
"""


@pytest.fixture(scope="module")
def fresh():
    """Seconds for NumPy and SciPy, for the package after them, and all modules then loaded."""
    done = subprocess.run([sys.executable, "-c", ASK], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


@pytest.mark.parametrize("name", CONTRACT)
def test_the_names_of_the_contract_are_there(name):
    assert hasattr(suspension, name)
    assert name in suspension.__all__ or name == "__version__"


def test_it_promises_no_more_than_it_has():
    assert set(suspension.__all__) <= set(CONTRACT)
    for name in suspension.__all__:
        assert name in dir(suspension)


def test_no_module_has_the_name_of_something_at_the_door():
    modules = {module.name for module in iter_modules(suspension.__path__)}
    assert len(modules) > 15
    assert not modules & set(suspension.__all__)


def test_the_docstring_is_a_map_of_the_package():
    modules = {module.name for module in iter_modules(suspension.__path__)}
    for module in modules:
        assert module.startswith("_") or f"`{module}`" in suspension.__doc__, module


@pytest.mark.slow
def test_it_loads_nothing_heavy(fresh, record_property):
    numpy_and_scipy, package, modules = fresh
    record_property("import of the package after NumPy and SciPy, s", round(package, 3))
    print(f"NumPy and SciPy {numpy_and_scipy:.2f} s, then suspension {package:.2f} s")
    assert "suspension.robot" in modules
    assert not set(HEAVY) & set(modules)
    assert package < 5  # a fraction of a second on an idle machine


def test_the_version_is_the_installed_one():
    assert metadata.version("suspension") == suspension.__version__


@pytest.mark.parametrize("file, line", [("CITATION.cff", "version: {}"), ("CHANGELOG.md", "## {}")])
def test_the_version_is_the_one_that_is_cited_and_described(file, line):
    text = (ROOT / file).read_text(encoding="utf-8")
    assert f"\n{line.format(suspension.__version__)}" in text
