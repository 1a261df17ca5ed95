"""axe-core finds nothing to object to on any page, in the light or in the dark."""

import pytest
import yaml
from helpers import ROOT

AXE = ROOT / "book" / "npm" / "node_modules" / "axe-core" / "axe.min.js"
TOC = yaml.safe_load((ROOT / "_toc.yml").read_text())
ALL_EXPLORERS_SPEAK = """
[...document.querySelectorAll(".suspension-explorer-box")]
    .every(box => box.querySelector(".se-headline")?.innerText)
"""
PAGES = [TOC["root"], *(page["file"] for part in TOC["parts"] for page in part["chapters"])]


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("page", [*PAGES, "search"])
def test_axe_finds_no_violation(browser, site, page, theme):
    context = browser.new_context(color_scheme=theme, viewport={"width": 1280, "height": 900})
    tab = context.new_page()
    tab.goto(f"{site}{page}.html")
    tab.wait_for_load_state("networkidle")
    tab.wait_for_function(ALL_EXPLORERS_SPEAK)
    tab.add_script_tag(path=AXE)
    result = tab.evaluate("axe.run(document, {resultTypes: ['violations']})")
    context.close()
    found = [
        f"{violation['id']}: {violation['help']}: {node['target']} {node['failureSummary']}"
        for violation in result["violations"]
        for node in violation["nodes"]
    ]
    assert len(result["passes"]) > 10  # axe did look
    assert not found, "\n".join(found)
