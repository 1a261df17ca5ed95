"""Data flow one way: a module reaches only those before it, and few import anything heavy."""

import ast
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[2] / "suspension"
# Helpers beside these may stand anywhere, as long as nothing reaches what comes after it.
ORDER = (
    "_checks springs robot road schemes exact contact simulation flight course "
    "plots animation explorer"
).split()
DRAWING = {"plots", "error_figures", "figures", "animation", "explorer"}
ONLY_IN = {
    "matplotlib": DRAWING,
    "ipywidgets": DRAWING,
    "anywidget": DRAWING,
    "traitlets": DRAWING,
    "IPython": DRAWING | {"report"},
    "pandas": {"springs"},
    "statsmodels": {"springs"},
}


def imported(path):
    """Everything a module imports, at its top or inside a function, by dotted name."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0 and node.names[0].name != "*", "hides what is imported"
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return names


IMPORTS = {path.stem: imported(path) for path in sorted(PACKAGE.glob("*.py"))}
GRAPH = {
    module: {name.split(".")[1] for name in names if name.startswith("suspension.")}
    for module, names in IMPORTS.items()
}


def reached(module):
    """All modules that a module imports, directly or through others."""
    return GRAPH[module].union(*map(reached, GRAPH[module]))


def test_no_module_imports_itself_through_others():
    TopologicalSorter(GRAPH).prepare()


@pytest.mark.parametrize("module", [module for module in ORDER if module in GRAPH])
def test_a_module_reaches_only_those_before_it(module):
    assert not reached(module) & set(ORDER[ORDER.index(module) :])


@pytest.mark.parametrize("module", GRAPH)
def test_heavy_libraries_stay_where_they_belong(module):
    used = {name.split(".")[0] for name in IMPORTS[module]}
    assert not {name for name in used if module not in ONLY_IN.get(name, {module})}


def test_the_package_itself_imports_nothing():
    assert not IMPORTS["__init__"]
