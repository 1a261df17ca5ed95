"""axe-core finds nothing to object to on any page, in the light or in the dark."""

import pytest
from helpers import AXE, PAGES, violations

ALL_EXPLORERS_SPEAK = """
[...document.querySelectorAll(".suspension-explorer-box")]
    .every(box => box.querySelector(".se-headline")?.innerText)
"""


@pytest.mark.parametrize("page", [*PAGES, "search"])
def test_axe_finds_no_violation(browser, site, page):
    tab = browser.new_page(color_scheme="light", viewport={"width": 1280, "height": 900})
    tab.goto(f"{site}{page}.html")
    tab.wait_for_load_state("networkidle")
    tab.wait_for_function(ALL_EXPLORERS_SPEAK)
    # What formulas look like is hidden from readers of the screen, is of the text's colour, and
    # takes half the time.
    tab.evaluate("document.querySelectorAll('.katex-html').forEach(shown => shown.remove())")
    tab.add_script_tag(path=AXE)
    found, passed = violations(tab)
    assert passed > 10  # axe did look
    # In the dark only colours are others, as soon as they have changed.
    tab.add_style_tag(content="* { transition: none !important }")
    tab.emulate_media(color_scheme="dark")
    tab.wait_for_function("document.documentElement.dataset.theme === 'dark'")
    found_dark, passed = violations(tab, "color-contrast")
    tab.close()
    assert passed == 1
    assert not found + found_dark, "\n".join(found + found_dark)
