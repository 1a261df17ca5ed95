"""A link that names a part leads to that part; the table of contents has them in order."""

import json
import re

import pytest
from helpers import ROOT

LINK = re.compile(r"\[(Part [IVX]+)[^\]]*\]\((?:\.\./)?(?:notebooks/)?(\d\d-[a-z-]+)\.ipynb")
SOURCES = [
    *ROOT.glob("notebooks/*.ipynb"),
    *ROOT.glob("book/*.md"),
    *ROOT.glob("suspension/report/*.py"),
    ROOT / "README.md",
]
NUMERALS = "I II III IV V VI VII VIII IX X XI XII".split()


def title(name):
    """The heading of a notebook."""
    (path,) = ROOT.glob(f"notebooks/{name}.ipynb")
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return "".join(cells[0]["source"]).splitlines()[0].lstrip("# ")


def test_parts_are_numbered_in_the_order_of_the_contents():
    names = re.findall(r"notebooks/([\w-]+)", (ROOT / "_toc.yml").read_text(encoding="utf-8"))
    parts = [title(name).split(":")[0] for name in names if title(name).startswith("Part ")]
    assert parts == [f"Part {numeral}" for numeral in NUMERALS[: len(parts)]]


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.name)
def test_a_link_that_names_a_part_leads_to_it(path):
    text = path.read_text(encoding="utf-8")
    wrong = [(part, name) for part, name in LINK.findall(text) if not title(name).startswith(part)]
    assert not wrong
    own = title(path.stem) if path.suffix == ".ipynb" else ""
    if own.startswith("Part "):
        number = NUMERALS.index(own.split(":")[0].split()[1]) + 1
        assert set(re.findall(r"### Exercise (\d+)\.", text)) <= {str(number)}
