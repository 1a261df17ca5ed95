"""The reference page: every public name is there, and a name in its text leads somewhere."""

import importlib
import inspect
import json
import pkgutil
from functools import cache

import pytest
from helpers import parse

import suspension

PAGE = "book/reference.html"
MODULES = ["suspension"] + [
    module.name
    for module in pkgutil.walk_packages(suspension.__path__, "suspension.")
    if "._" not in module.name
]


@pytest.fixture(scope="module")
def page(book):
    return parse(book / PAGE).article


@pytest.fixture(scope="module")
def entries(page):
    """What has an id, by its id: to look for each among thousands takes long."""
    return {tag["id"]: tag for tag in page.find_all(id=True)}


def leads_to(entries, address):
    """What a link within the page leads to."""
    assert address.startswith("#"), address
    return entries.get(address[1:])


@pytest.mark.parametrize("module", MODULES[1:])
def test_every_public_name_is_documented_or_linked(entries, module):
    section = entries[f"module-{module}"].find_parent("section")
    linked = {link["href"].rpartition(".")[2]: link for link in section.select("p a.internal")}
    for name in importlib.import_module(module).__all__:
        entry = entries.get(f"{module}.{name}")
        if entry is None:
            assert leads_to(entries, linked[name]["href"]), name
        else:
            assert entry.find_next_sibling("dd").get_text(strip=True), name


def test_the_front_door_stands_first(page, entries):
    table = page.table
    assert table.find_previous("h2") is None
    links = {row.a.get_text(): row.a["href"] for row in table.select("tr")}
    assert sorted(links) == sorted(suspension.__all__)
    for name, address in links.items():
        assert leads_to(entries, address)["id"].endswith(f".{name}")
    for row in table.select("tr"):
        assert row.select("td")[1].get_text().strip().endswith((".", ")"))


def test_functions_and_classes_link_to_their_source(entries, book):
    source = cache(lambda path: path.read_text(encoding="utf-8"))
    for module in MODULES[1:]:
        for name in importlib.import_module(module).__all__:
            entry = entries.get(f"{module}.{name}")
            value = getattr(importlib.import_module(module), name)
            if entry is None or not (inspect.isclass(value) or inspect.isfunction(value)):
                continue
            path, _, anchor = entry.select_one("a:has(.viewcode-link)")["href"].partition("#")
            text = source(((book / PAGE).parent / path).resolve())
            assert f'id="{anchor}"' in text, name
            assert anchor == name


def test_nothing_private_is_shown(page):
    names = [entry["id"].split(".") for entry in page.select("dt.sig[id]")]
    assert len(names) > 150
    private = [name for name in names if any(part.startswith("_") for part in name)]
    assert {name[-1] for name in private} == {"__call__"}


def test_names_in_backticks_are_links_or_code(page, entries):
    assert not page.select("cite")
    scheme = entries["suspension.simulation.simulate"].find_next_sibling("dd")
    assert scheme.find("a", href="#suspension.schemes.Scheme")
    words = {code.get_text(): code for code in scheme.select("code")}
    assert words["tfinal"].find_parent("a") is None  # a parameter, not a thing of its own
    loss = entries["suspension.simulation.Trajectory.loss"].find_next_sibling("dd")
    assert loss.find("a", href="#suspension.forces.Loss")


def test_search_finds_butcher(book):
    text = (book / "searchindex.js").read_text(encoding="utf-8")
    index = json.loads(text[text.index("{") : text.rindex("}") + 1])
    hits = index["terms"]["butcher"]
    hits = hits if isinstance(hits, list) else [hits]
    assert "book/reference" in [index["docnames"][hit] for hit in hits]
