"""Data flow one way: a module reaches only those before it, and few import anything heavy."""

import ast
import re
from graphlib import TopologicalSorter

import pytest
from helpers import ROOT

PACKAGE = ROOT / "suspension"
# The floors of the core, from the ground up. What stands on one floor reaches lower ones only.
CORE = (
    "_checks robot road problem schemes forces simulation _formats _readings springs course exact "
    "least_force critical branches contact profiles similarity vehicles flight spring_law motion "
    "extremes sweep small_angle frequency rides choice travel accuracy uncertainty measured tyre "
    "energy"
).split()
ROOMS = ("figures", "report", "explorer", "practice")  # may stand on all of the core
FACADES = {"animation": "figures"}  # a name of the contract, kept in a room
DRAWING = {"figures", "report", "explorer", "animation"}
ONLY_IN = {
    "matplotlib": DRAWING,
    "IPython": DRAWING,
    "ipywidgets": DRAWING,
    "anywidget": DRAWING,
    "traitlets": DRAWING,
    "pandas": {"springs"},
    "statsmodels": {"springs"},
}
# What is loaded on demand, inside a function: by whoever asks for a table, or for sliders.
ON_DEMAND = {"simulation": {"pandas"}, "suspension": {"suspension.explorer.explore"}}
# What a room may use of another: the report shows figures, the explorer a still one and a caption.
NEIGHBOURS = {
    "figures": set(),
    "report": {"figures"},
    "explorer": {"figures", "report"},
    "practice": set(),
}


def dotted(path):
    """``suspension/figures/style.py`` as ``figures.style``, a package by its own name."""
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(part for part in parts if part != "__init__") or "suspension"


def imports(node, within=False):
    """The imports below a node, and whether each is within a function; none for type checkers."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.Import | ast.ImportFrom):
            yield child, within
        elif isinstance(child, ast.If) and ast.unparse(child.test) == "TYPE_CHECKING":
            yield from imports(ast.Module(child.orelse, []), within)
        else:
            yield from imports(child, within or isinstance(child, ast.FunctionDef))


def imported(path):
    """Everything a module imports, by dotted name, but for what it may import on demand."""
    at_once, later = set(), set()
    for node, within in imports(ast.parse(path.read_text(encoding="utf-8"))):
        names = later if within else at_once
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        else:
            assert node.level == 0 and node.names[0].name != "*", "hides what is imported"
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    on_demand = ON_DEMAND.get(dotted(path), set())
    assert on_demand <= later
    return at_once | later - on_demand


IMPORTS = {dotted(path): imported(path) for path in sorted(PACKAGE.rglob("*.py"))}


def module_of(name):
    """The module of ours that an imported name is, or is in; None if it is another's."""
    parts = name.split(".")
    if parts[0] != "suspension":
        return None
    for end in range(len(parts), 1, -1):
        if ".".join(parts[1:end]) in IMPORTS:
            return ".".join(parts[1:end])
    return "suspension"


GRAPH = {
    module: {found for found in map(module_of, names) if found not in (None, module)}
    for module, names in IMPORTS.items()
}


def room(module):
    """The part of the package that a module belongs to: a module of the core, or a folder."""
    return module.split(".")[0]


def reached(module):
    """All modules that a module imports, directly or through others."""
    return GRAPH[module].union(*map(reached, GRAPH[module]))


def test_no_module_imports_itself_through_others():
    TopologicalSorter(GRAPH).prepare()


def test_every_module_has_its_place():
    assert {room(module) for module in IMPORTS} == {"suspension", *CORE, *ROOMS, *FACADES}


@pytest.mark.parametrize("module", CORE)
def test_a_module_of_the_core_reaches_only_those_below_it(module):
    assert reached(module) <= set(CORE[: CORE.index(module)])


@pytest.mark.parametrize("page", ["README.md", "CONTRIBUTING.md"])
def test_a_map_names_every_module_below_those_on_which_it_stands(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    rows = [
        [name for name in re.findall(r"`(?:suspension/)?(\w+)(?:\.py)?`", cell) if name in CORE]
        for cell in re.findall(r"^\| (`.*?`) \|", text, re.MULTILINE)
    ]
    named = [name for row in rows for name in row]
    hidden = {name for name in CORE if name.startswith("_") and page == "README.md"}
    assert sorted(named) == sorted(set(CORE) - hidden)
    above = hidden
    for row in rows:
        above = above.union(row)
        for name in row:
            assert reached(name) <= above, name


@pytest.mark.parametrize("module", [module for module in IMPORTS if room(module) in ROOMS])
def test_a_room_stands_on_the_core_and_its_neighbours_alone(module):
    mine = room(module)
    assert {room(other) for other in GRAPH[module]} <= {mine, *CORE, *NEIGHBOURS[mine]}


@pytest.mark.parametrize("module", FACADES)
def test_a_facade_reaches_one_room(module):
    assert {room(other) for other in GRAPH[module]} == {FACADES[module]}


def test_the_front_door_opens_to_the_core_alone():
    assert GRAPH["suspension"] <= set(CORE)


@pytest.mark.parametrize("module", IMPORTS)
def test_nothing_goes_through_the_front_door(module):
    assert "suspension" not in GRAPH[module]


@pytest.mark.parametrize("module", IMPORTS)
def test_heavy_libraries_stay_where_they_belong(module):
    used = {name.split(".")[0] for name in IMPORTS[module]}
    assert not {name for name in used & set(ONLY_IN) if room(module) not in ONLY_IN[name]}
