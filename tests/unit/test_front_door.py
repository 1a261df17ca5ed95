"""``import suspension`` gives the names of the contract, and costs little."""

import inspect
import json
import subprocess
import sys
from functools import cached_property
from importlib import metadata
from pathlib import Path
from pkgutil import iter_modules

import pytest
from helpers import ROOT

import suspension
from suspension.flight import Event, Flight
from suspension.forces import Loss
from suspension.road import RoadProfile, RoughRoad
from suspension.simulation import Trajectory

CONTRACT = (
    "Robot GaussianBump FlatRoad Scheme EULER BACKWARD_EULER CRANK_NICOLSON RK4 "
    "simulate over_bump margin critical_speeds regimes highest_bump fly explore __version__"
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


def test_what_it_does_not_have_it_says():
    with pytest.raises(AttributeError, match="'suspension' has no attribute 'explorers'"):
        _ = suspension.explorers


@pytest.mark.slow  # a process that loads all of it
def test_explore_is_loaded_when_it_is_first_used():
    code = (
        "import sys, suspension; assert 'explore' in dir(suspension);"
        "before = 'suspension.explorer' in sys.modules;"
        "print(before, suspension.explore is sys.modules['suspension.explorer'].explore)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False", "True"]


# `explore` is not among them: most of its arguments are whatever the sliders take.
FUNCTIONS = [name for name in suspension.__all__ if name.islower() and name != "explore"]
CLASSES = ["Robot", "GaussianBump", "FlatRoad", "Scheme"]


def untyped(function):
    """The parameters of a function without `self`, and what it returns, that say no type."""
    signature = inspect.signature(function)
    silent = [p.name for p in signature.parameters.values() if p.annotation is p.empty]
    if signature.return_annotation is signature.empty:
        silent.append("return")
    return [name for name in silent if name != "self"]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_function_at_the_door_says_its_types(name):
    assert untyped(getattr(suspension, name)) == []


@pytest.mark.parametrize(
    "kind",
    [
        *(getattr(suspension, name) for name in CLASSES),
        *(Trajectory, Flight, Event, Loss, RoadProfile, RoughRoad),
    ],
)
def test_what_comes_through_the_door_says_its_types(kind):
    public = {name: value for name, value in vars(kind).items() if not name.startswith("_")}
    if "__call__" in vars(kind):
        public["__call__"] = kind.__call__
    assert public
    for name, value in public.items():
        if isinstance(value, cached_property):
            assert untyped(value.func) == [], name
        elif isinstance(value, property):
            assert untyped(value.fget) == [], name
        elif inspect.isfunction(value):
            assert untyped(value) == [], name


def test_type_checkers_are_told_that_there_are_types():
    assert (Path(suspension.__file__).parent / "py.typed").read_bytes() == b""


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


def doors():
    """What one calls at the front door, and the methods of its classes, by name."""
    for name in suspension.__all__:
        thing = getattr(suspension, name)
        if not callable(thing):  # a scheme: its class is there, too
            continue
        yield name, thing
        methods = vars(thing) if inspect.isclass(thing) else {}
        for method, function in methods.items():
            if inspect.isfunction(function) and not method.startswith("_"):
                yield f"{name}.{method}", function


@pytest.mark.parametrize(("name", "thing"), list(doors()))
def test_what_takes_arguments_says_what_it_refuses(name, thing):
    if set(inspect.signature(thing).parameters) - {"self"}:
        told, _, refused = inspect.getdoc(thing).partition("Raises\n------\n")
        assert "ValueError\n" in refused or "and errors are those of" in told
