"""A curve that a reader draws in the built book, and the answer that is laid beside it."""

import re

import pytest
from helpers import AXE, violations
from instruments import PIXELS, touch, write_notebook
from lab import run_all, serve

PAGE = "notebooks/04-one-chart.html"
ASKED, ANSWERED = ".suspension-prediction.se-asked", ".suspension-prediction.se-answered"
BOTH = ".suspension-prediction"
W = [(0.02, 0.95), (0.35, 0.2), (0.7, 0.7), (0.98, 0.3)]  # falls, rises and falls
DOWN = [(0.02, 0.95), (0.98, 0.1)]
LIMITS = ("follow", "throw", "skim")


@pytest.fixture
def visit(browser, site):
    """Open the page with the prediction; in the end, no script has complained."""
    contexts, complaints = [], []

    def go(**options):
        context = browser.new_context(**({"viewport": {"width": 1366, "height": 900}} | options))
        contexts.append(context)
        tab = context.new_page()
        tab.on("pageerror", lambda error: complaints.append(str(error)))
        tab.goto(f"{site}{PAGE}")
        tab.wait_for_selector(f"{ASKED} canvas[aria-label]")
        tab.locator(f"{ASKED} .se-pad").scroll_into_view_if_needed()
        return tab

    yield go
    for context in contexts:
        context.close()
    assert not complaints


def places(tab, points):
    """Points in fractions of the frame, from its lower left corner, as pixels of the window."""
    box = tab.locator(f"{ASKED} .se-pad").bounding_box()
    return [(box["x"] + x * box["width"], box["y"] + (1 - y) * box["height"]) for x, y in points]


def draw(tab, points):
    """Draw by mouse."""
    tab.locator(f"{ASKED} .se-pad").scroll_into_view_if_needed()
    first, *others = places(tab, points)
    tab.mouse.move(*first)
    tab.mouse.down()
    for place in others:
        tab.mouse.move(*place, steps=12)
    tab.mouse.up()


def words(tab, which=ASKED):
    return tab.locator(f"{which} .se-words").inner_text()


def button(tab, name, which=ASKED):
    return tab.locator(which).get_by_role("button", name=name, exact=True)


def picture(tab, which=ASKED):
    tab.wait_for_timeout(100)  # two frames and more
    return tab.locator(f"{which} canvas").evaluate(PIXELS)


def test_a_curve_is_drawn_by_mouse_taken_back_and_cleared(visit):
    tab = visit()
    empty = picture(tab)
    assert "Nothing is drawn yet" in words(tab)
    assert button(tab, "Undo").is_disabled() and button(tab, "Clear").is_disabled()
    assert not tab.locator(ANSWERED).is_visible()  # there is nothing to lay beside it
    draw(tab, W[:2])
    assert "Go on" in words(tab) and not tab.locator(ANSWERED).is_visible()
    part = picture(tab)
    draw(tab, W[1:])
    assert words(tab).startswith("Your curve falls, rises and falls.")
    assert len({empty, part, picture(tab)}) == 3
    assert tab.locator(ANSWERED).is_visible()
    button(tab, "Undo").click()
    assert picture(tab) == part and "Go on" in words(tab)
    button(tab, "Clear").click()
    assert picture(tab) == empty and "Nothing is drawn yet" in words(tab)


def test_the_answer_is_laid_beside_it_step_by_step(visit):
    tab = visit()
    draw(tab, W)
    seen = [picture(tab, ANSWERED)]
    assert "Lay on it what you have derived" in words(tab, ANSWERED)
    for n, name in enumerate(LIMITS):
        button(tab, name, ANSWERED).click()
        assert button(tab, name, ANSWERED).get_attribute("aria-pressed") == "true"
        assert len(words(tab, ANSWERED).split("\n")) == n + 1
        assert re.search(rf"^{name}\b", words(tab, ANSWERED), re.MULTILINE)
        seen.append(picture(tab, ANSWERED))
    button(tab, "the exact curve", ANSWERED).click()
    assert "Where you drew, the exact curve" in words(tab, ANSWERED)
    seen.append(picture(tab, ANSWERED))
    assert len(set(seen)) == len(seen)
    for name in (*LIMITS, "the exact curve"):
        button(tab, name, ANSWERED).click()
    assert picture(tab, ANSWERED) == seen[0]


def test_another_curve_is_told_something_else(visit):
    tab = visit()
    told = []
    for points in (W, DOWN):
        button(tab, "Clear").click() if told else None
        draw(tab, points)
        if not told:
            button(tab, "the exact curve", ANSWERED).click()
        told.append(words(tab, ANSWERED))
    assert told[0] != told[1] and "Yours falls." in told[1]


def test_a_finger_draws_on_the_frame_and_scrolls_beside_it(visit):
    tab = visit(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    before = tab.evaluate("scrollY")
    touch(tab, *places(tab, W))
    assert words(tab).startswith("Your curve falls, rises and falls.")
    assert tab.evaluate("scrollY") == before
    drawn = words(tab)
    beside = places(tab, [(-0.04, 0.6), (-0.04, 1.4)])  # over the numbers of the axis
    touch(tab, *beside)
    assert tab.evaluate("scrollY") > before and words(tab) == drawn


def test_the_keys_draw_too_and_say_where_they_are(visit):
    tab = visit()
    pad = tab.locator(f"{ASKED} .se-pad")
    pad.focus()
    assert pad.get_attribute("role") == "application"
    assert "arrow keys" in pad.get_attribute("aria-label")
    for key in ["Enter", *["ArrowRight", "ArrowDown"] * 12, *["ArrowRight", "ArrowUp"] * 12]:
        pad.press(key)
    assert re.match(r"At ν = 100: [\d.]+\.", words(tab))
    undone = words(tab)
    pad.press("Backspace")
    button(tab, "Undo").focus()  # the pen is laid down
    assert words(tab).startswith("Your curve falls and rises.") and words(tab) != undone
    assert tab.locator(f"{ASKED} .se-words").get_attribute("role") == "status"
    described = tab.locator(f"{ASKED} canvas").get_attribute("aria-label")
    assert "Your curve falls and rises" in described


def test_what_was_drawn_is_there_again(visit):
    tab = visit()
    draw(tab, W)
    tab.reload()
    tab.wait_for_selector(f"{ASKED} canvas[aria-label]")
    assert words(tab).startswith("Your curve falls, rises and falls.")
    assert tab.locator(ANSWERED).is_visible() and not button(tab, "Undo").is_disabled()
    key = tab.evaluate("Object.keys(localStorage).find(name => name.includes('prediction'))")
    for spoiled in ("[1", "[[[1, null]]]", "{}", '"x"'):
        tab.evaluate("([key, text]) => localStorage.setItem(key, text)", [key, spoiled])
        tab.reload()
        tab.wait_for_selector(f"{ASKED} canvas[aria-label]")
        assert "Nothing is drawn yet" in words(tab)


def test_a_stroke_costs_no_frame(visit):
    tab = visit()
    draw(tab, W)
    box = [round(part) for part in places(tab, [(0.1, 0.1)])[0]]
    costs = tab.evaluate(
        """([x, y]) => {
          const pad = document.querySelector(".suspension-prediction .se-pad"), costs = [];
          pad.setPointerCapture = () => {};
          const send = (name, dx) => pad.dispatchEvent(new PointerEvent(name,
            { pointerId: 1, clientX: x + dx, clientY: y - dx / 4, bubbles: true }));
          send("pointerdown", 0);
          for (let dx = 0; dx < 300; dx++) {
            const start = performance.now();
            send("pointermove", dx);
            costs.push(performance.now() - start);
          }
          send("pointerup", 300);
          return costs.sort((a, b) => a - b);
        }""",
        box,
    )
    assert costs[len(costs) // 2] < 8


def test_without_scripts_and_on_paper_there_are_empty_axes(browser, site, visit):
    context = browser.new_context(java_script_enabled=False)
    tab = context.new_page()
    tab.goto(f"{site}{PAGE}")
    still = tab.locator(f"{ASKED} img")
    assert still.is_visible() and "Empty logarithmic axes" in still.get_attribute("alt")
    assert not tab.locator(f"{ANSWERED}").is_visible()
    context.close()
    tab = visit()
    draw(tab, W)
    assert not tab.locator(f"{ASKED} img").is_visible()
    tab.emulate_media(media="print")
    assert tab.locator(f"{ASKED} img").is_visible()
    for which in (ASKED, ANSWERED):
        assert not tab.locator(f"{which} canvas").is_visible()
        assert not tab.locator(f"{which} button").first.is_visible()


@pytest.mark.parametrize("width", [390, 1366])
def test_axe_finds_nothing_whatever_is_drawn_and_laid_on(visit, width):
    tab = visit(viewport={"width": width, "height": 900})
    tab.add_script_tag(path=AXE)
    tab.add_style_tag(content="* { transition: none !important }")
    found = violations(tab, within=BOTH)[0]
    draw(tab, W)
    for name in (*LIMITS, "the exact curve"):
        button(tab, name, ANSWERED).click()
    found += violations(tab, within=BOTH)[0]
    tab.emulate_media(color_scheme="dark")
    tab.wait_for_function("document.documentElement.dataset.theme === 'dark'")
    found += violations(tab, "color-contrast", within=BOTH)[0]
    assert not found, "\n".join(found)


def test_forced_colours_leave_everything_to_be_seen(visit):
    tab = visit(forced_colors="active")
    empty = picture(tab)
    draw(tab, W)
    assert picture(tab) != empty
    before = picture(tab, ANSWERED)
    button(tab, "the exact curve", ANSWERED).click()
    assert picture(tab, ANSWERED) != before
    pressed, other = (
        button(tab, name, ANSWERED).evaluate("button => getComputedStyle(button).backgroundColor")
        for name in ("the exact curve", "follow")
    )
    assert pressed != other


def test_a_choice_that_is_tapped_stays_beside_the_answer(visit, browser, site):
    tab = visit()
    choices = tab.locator("ul.choices button")
    answer = tab.locator("ul.choices + details")
    assert choices.count() == 3 and answer.get_attribute("open") is None
    for nth in (0, 2):
        choices.nth(nth).click()
        pressed = [choices.nth(i).get_attribute("aria-pressed") for i in range(3)]
        assert pressed == ["true" if i == nth else "false" for i in range(3)]
        assert answer.get_attribute("open") is not None
    assert choices.nth(2).is_visible()
    context = browser.new_context(java_script_enabled=False)
    tab = context.new_page()
    tab.goto(f"{site}{PAGE}")
    assert tab.locator("ul.choices li").count() == 3
    assert not tab.locator("ul.choices button").count()
    context.close()


LAB_CELLS = [
    """import numpy as np

from suspension.explorer import Prediction

x = np.geomspace(0.05, 100, 50)
asked = Prediction("w", (0.05, 100), (0.1, 100), "speed ν", "height η")
asked""",
    """lines = {"throw": 0.4 * x, "skim": 100 / x}
asked.answer(x, lines, np.minimum(0.4 * x, 100 / x))""",
]


@pytest.mark.slow
def test_the_same_prediction_is_alive_in_jupyterlab(browser, tmp_path):
    write_notebook(tmp_path / "predict.ipynb", LAB_CELLS)
    tab = browser.new_page(viewport={"width": 1300, "height": 1200})
    errors = []
    tab.on("pageerror", lambda error: errors.append(str(error)))
    with serve(tmp_path) as address:
        run_all(tab, address, "predict.ipynb", f"{ASKED}.se-live")
        assert not tab.locator(f"{ASKED} img").is_visible()
        assert not tab.locator(f"{ANSWERED}.se-live").is_visible()
        draw(tab, W)
        assert words(tab).startswith("Your curve falls, rises and falls.")
        before = picture(tab, f"{ANSWERED}.se-live")
        button(tab, "the exact curve", f"{ANSWERED}.se-live").click()
        told = words(tab, f"{ANSWERED}.se-live")
        assert "the exact curve rises and falls. Yours falls, rises and falls." in told
        assert picture(tab, f"{ANSWERED}.se-live") != before
    tab.close()
    assert not errors
