"""The workshop of schemes in the built book: typing, wrong input, puzzles, links, all readers."""

import gzip

import pytest
from helpers import swipe
from instruments import (
    PAGE,
    PHONE,
    gives_way_on_paper,
    objections,
    still_picture,
    visiting,
    write_notebook,
)
from instruments import pictures as pixels
from lab import run_all, serve

BOX = ".se-workshop"
KUTTA = "3 stages, order 3"


@pytest.fixture
def visit(browser, site):
    """Open the page with the workshop; in the end, no script has complained."""
    with visiting(browser, site, BOX) as go:
        yield go


def pictures(tab):
    return pixels(tab, BOX)


def entry(tab, name):
    return tab.get_by_label(name, exact=True)


def said(tab):
    return tab.locator(f"{BOX} .se-said").inner_text()


def fact(tab, name):
    return tab.locator(f"{BOX} dt", has_text=name).locator("+ dd").inner_text()


def button(tab, name):
    return tab.locator(BOX).get_by_role("button", name=name, exact=True)


def start_from(tab, name):
    tab.get_by_label("Start from").select_option(label=name)


def type_table(tab, **entries):
    for name, text in entries.items():
        entry(tab, name).fill(text)


def test_a_typed_method_is_judged_with_every_key(visit):
    tab = visit()
    assert said(tab).startswith("RK4: explicit, 4 stages, order 4. Not A-stable")
    held = tab.locator(f"{BOX} .se-trees li.se-holds")
    assert tab.locator(f"{BOX} .se-trees li").count() == 17 and held.count() == 8
    before = pictures(tab)
    box = entry(tab, "a43")
    box.focus()
    box.press("ControlOrMeta+a")
    box.press_sequentially("1/2")
    assert "order 1" in said(tab) and said(tab).startswith("Your method")
    assert held.count() < 8 and entry(tab, "c4").input_value() == "1/2"
    assert "1/48 z⁴" in fact(tab, "R(z)")
    assert all(old != new for old, new in zip(before, pictures(tab)))
    button(tab, "Undo").click()  # all that was typed into one place
    assert said(tab).startswith("RK4") and pictures(tab) == before


def test_fractions_commas_and_roots_are_numbers(visit):
    tab = visit()
    start_from(tab, "Heun")
    for one, half in (("1", "1/2"), ("1,0", "0,5"), ("√4/2", "(3-√4)/2"), ("2 / 2", " .5 ")):
        type_table(tab, a21=one, b1=half, b2=half)
        assert said(tab).startswith("Heun: explicit, 2 stages, order 2")
    type_table(tab, a21="", b1="1")
    assert entry(tab, "c2").input_value() == "0"  # nothing typed is 0
    assert fact(tab, "Order").startswith("0: the weights b sum to 1.5")


def test_wrong_input_is_said_in_its_place_and_nothing_is_lost(visit):
    tab = visit()
    before = pictures(tab)
    box = entry(tab, "b2")
    box.fill("1/3x")
    assert box.get_attribute("aria-invalid") == "true"
    error = tab.locator(f"#{box.get_attribute('aria-describedby')}")
    assert error.is_visible() and error.get_attribute("role") == "alert"
    assert error.inner_text().startswith("b2: a number or a fraction is expected")
    assert said(tab).startswith("The last table that could be read: RK4")
    assert box.input_value() == "1/3x" and pictures(tab) == before
    entry(tab, "a21").fill("?")
    assert len(error.inner_text().split("\n")) == 2
    box.fill("1/3")
    entry(tab, "a21").fill("1/2")
    assert box.get_attribute("aria-invalid") is None and not error.is_visible()
    assert said(tab).startswith("RK4")


def test_an_abscissa_of_its_own_is_told_of(visit):
    tab = visit()
    follow = button(tab, "c = row sums of a")
    entry(tab, "c2").fill("0.4")
    assert follow.get_attribute("aria-pressed") == "false"
    assert "c2 is not the sum of its row" in fact(tab, "Order")
    follow.click()
    assert entry(tab, "c2").input_value() == "1/2" and fact(tab, "Order") == "4"


def test_stages_come_and_go(visit):
    tab = visit()
    tab.get_by_label("Stages").select_option("6")
    assert entry(tab, "a66").is_visible() and "6 stages, order 4" in said(tab)
    tab.get_by_label("Stages").select_option("1")
    assert entry(tab, "a11").is_visible() and not entry(tab, "a22").count()
    for _ in range(2):
        button(tab, "Undo").click()
    assert said(tab).startswith("RK4")


def test_turning_a_number_lets_the_order_fall_and_the_region_change(visit):
    tab = visit()
    before = pictures(tab)
    entry(tab, "a32").focus()
    slider = tab.get_by_label("Turn a32")
    slider.focus()
    for _ in range(6):
        slider.press("ArrowRight")
    assert entry(tab, "a32").input_value() == "0.53" and "order 1" in said(tab)
    assert pictures(tab)[0] != before[0]
    box = slider.bounding_box()  # by hand
    tab.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    tab.mouse.down()
    tab.mouse.move(box["x"] + 0.7 * box["width"], box["y"] + box["height"] / 2, steps=5)
    tab.mouse.up()
    assert float(entry(tab, "a32").input_value()) > 0.7
    while button(tab, "Undo").is_enabled():
        button(tab, "Undo").click()
    assert said(tab).startswith("RK4") and pictures(tab)[0] == before[0]


def lever(tab, j):
    return tab.locator(BOX).get_by_label(f"at {('z', 'z²', 'z³', 'z⁴')[j - 1]}", exact=True)


def bent(tab):
    return tab.locator(f"{BOX} .se-bend .se-words").inner_text()


def test_a_number_of_the_polynomial_is_moved_and_the_order_falls(visit):
    tab = visit()
    before, table = pictures(tab), [entry(tab, f"b{j}").input_value() for j in range(1, 5)]
    assert "Move a number" in bent(tab) and button(tab, "Back").is_disabled()
    lever(tab, 3).focus()
    for _ in range(20):
        tab.keyboard.press("ArrowRight")
    assert "1 + z + 1/2 z² + 1/5 z³ + 1/24 z⁴" in fact(tab, "R(z)")
    assert "order 2" in said(tab) and fact(tab, "Order") == "2"
    assert "1/5 at z³ in place of 1/6" in bent(tab) and "falls from 4 to 2" in bent(tab)
    assert lever(tab, 3).get_attribute("aria-valuetext") == "1/5, the exponential has 1/6"
    assert all(old != new for old, new in zip(before, pictures(tab)))
    assert "is 0.2" in tab.locator(f"{BOX} .se-trees li", has_text="b·Ac =").inner_text()
    button(tab, "Undo").click()  # one pull of one number is one step
    assert said(tab).startswith("RK4") and pictures(tab) == before
    lever(tab, 4).press("ArrowLeft")
    lever(tab, 2).press("ArrowLeft")
    told = "The R(z) of RK4 with 0.495 at z² in place of 1/2, 0.0413 at z⁴ in place of 1/24."
    assert bent(tab).startswith(told)
    button(tab, "Back to RK4").click()
    assert [entry(tab, f"b{j}").input_value() for j in range(1, 5)] == table
    assert pictures(tab) == before


def test_a_bent_number_goes_back_to_where_it_was_and_is_kept_by_the_address(visit):
    tab = visit()
    type_table(tab, a21="0.4", a32="0.6")
    was = said(tab), fact(tab, "R(z)")
    lever(tab, 4).focus()
    tab.keyboard.press("ArrowRight")
    tab.wait_for_timeout(600)
    button(tab, "Keep to compare").click()
    state = said(tab), fact(tab, "R(z)")
    tab.wait_for_function("location.hash.includes('kb=')")
    other = visit(tab.evaluate("location.hash"))
    assert (said(other), fact(other, "R(z)")) == state
    assert "like yours" in other.locator(f"{BOX} .se-view-work .se-words").inner_text()
    button(tab, "Back to where it was").click()
    assert (said(tab), fact(tab, "R(z)")) == was


def test_a_fraction_is_not_bent_and_it_is_said_why(visit):
    tab = visit()
    start_from(tab, "SDIRK, order 2")
    assert bent(tab).startswith("R is a fraction here")
    assert not tab.locator(f"{BOX} .se-bend input:visible").count()
    start_from(tab, "Heun")
    assert tab.locator(f"{BOX} .se-bend input:visible").count() == 2
    tab.get_by_label("Stages").select_option("3")  # a stage that nothing uses
    assert tab.locator(f"{BOX} .se-bend input:visible").count() == 2


WHERE = """box => {
  const canvas = document.querySelector(`${box} .se-view-region canvas`);
  canvas.scrollIntoView({ block: "center" });
  const { left, top, width, height } = canvas.getBoundingClientRect();
  return { left, top, width, height };
}"""


def place(tab, re, im):
    """Where a z is in the window, as the picture of the region has it."""
    at = tab.evaluate(WHERE, BOX)
    unit = (at["height"] - 42) / 9
    zero = 4 + 0.66 * (at["width"] - 8)
    return at["left"] + zero + unit * re, at["top"] + at["height"] / 2 + 1 - unit * im


def test_the_border_is_pulled_by_mouse(visit):
    tab = visit()
    limit = fact(tab, "Longest")
    x, y = place(tab, -2.785, 0)  # where RK4 ends
    tab.mouse.move(x, y)
    assert tab.locator(f"{BOX} .se-view-region canvas").evaluate("c => c.style.cursor") == "grab"
    tab.mouse.down()
    tab.mouse.move(*place(tab, -3.4, 0), steps=6)
    tab.mouse.up()
    value = float(lever(tab, 3).input_value())
    x = 3.4  # |1 - x + x²/2 - c x³ + x⁴/24| = 1
    assert value / 600 == pytest.approx((x**2 / 2 - x + x**4 / 24) / x**3, abs=0.003)
    assert "at z³ in place of 1/6" in bent(tab) and "order 2" in said(tab)
    assert fact(tab, "Longest") != limit
    button(tab, "Undo").click()
    assert said(tab).startswith("RK4") and fact(tab, "Longest") == limit
    tab.mouse.move(*place(tab, -1, 0.5))  # inside there is nothing to take hold of
    tab.mouse.down()
    tab.mouse.move(*place(tab, -2, 0.5), steps=3)
    tab.mouse.up()
    assert said(tab).startswith("RK4")


def test_a_finger_pulls_the_border_sideways_and_scrolls_along_it(visit):
    tab = visit(**PHONE)
    x, y = place(tab, -2.785, 0)
    swipe(tab, x, y, -40, 3)
    assert "at z³ in place of 1/6" in bent(tab)
    button(tab, "Undo").click()
    x, y = place(tab, -2.785, 0)
    height = tab.evaluate("scrollY")
    swipe(tab, x, y, 5, -150)
    assert tab.evaluate("scrollY") > height + 60 and said(tab).startswith("RK4")


def test_what_is_further_down_begins_by_itself_and_what_is_asked_for_at_once(visit):
    tab = visit()
    tab.wait_for_function(
        "document.querySelectorAll('.suspension-laboratory.se-live').length === 4"
    )
    below = visit("#chain:")
    chain = below.locator(".suspension-laboratory.se-chain")
    assert "se-live" in chain.get_attribute("class")
    below.wait_for_timeout(1000)  # all others have begun, and have not moved it out of sight
    box = chain.bounding_box()
    assert box["y"] < 900 and box["y"] + box["height"] > 0


def test_two_methods_race_at_equal_work(visit):
    tab = visit()
    words = tab.locator(f"{BOX} .se-view-work .se-words")
    assert "Keep a method" in words.inner_text() and button(tab, "Forget it").is_disabled()
    button(tab, "Keep to compare").click()
    assert "like yours" in words.inner_text()
    alone = pictures(tab)
    start_from(tab, "Heun")
    assert words.inner_text().startswith("At equal work RK4 takes 27 steps (108 evaluations)")
    assert "wins by a factor of" in words.inner_text()
    assert pictures(tab)[3] != alone[3]
    button(tab, "Forget it").click()
    assert "Keep a method" in words.inner_text()


def test_the_step_goes_to_its_limit_and_beyond(visit):
    tab = visit()
    button(tab, "Δt to the limit").click()
    words = tab.locator(f"{BOX} .se-view-region .se-words")
    assert "none of 4 modes outside" in words.inner_text()
    slider = tab.get_by_label("Step Δt")
    slider.focus()
    for _ in range(20):
        slider.press("ArrowRight")
    assert "none" not in words.inner_text()
    start_from(tab, "Backward Euler")
    assert "every step is stable" in said(tab) and button(tab, "Δt to the limit").is_disabled()
    told = tab.locator(f"{BOX} .se-view-forces .se-words").inner_text()
    assert "solves for 4 unknowns" in told


def test_puzzles_check_themselves(visit):
    tab = visit()
    puzzles = tab.locator(f"{BOX} .se-puzzles li")
    first, second, third = (puzzles.nth(n) for n in range(3))
    won = tab.locator(f"{BOX} .se-won")
    assert won.count() == 0 and "Cannot be won" in third.inner_text()
    start_from(tab, "Kutta, order 3")
    assert KUTTA in said(tab) and "What must change?" in first.inner_text()
    type_table(tab, a21="0.452", a31="0", a32="1/2", b1="0", b2="0", b3="1")
    assert "Won" in second.inner_text() and won.count() == 1
    assert said(tab).endswith("Puzzle 2 is solved.")
    start_from(tab, "Lobatto IIIA, order 4")
    assert "Won" in first.inner_text() and "A-stable, but implicit" in third.inner_text()


def test_the_address_keeps_a_method(visit):
    tab = visit()
    start_from(tab, "SDIRK, order 2")
    tab.get_by_label("Step Δt").press("ArrowRight")
    tab.wait_for_function("location.hash.startsWith('#workshop:')")
    tab.wait_for_timeout(500)
    state, address = said(tab), tab.evaluate("location.hash")
    other = visit(address)
    assert said(other) == state and said(other).startswith("SDIRK")
    assert fact(other, "Longest") == fact(tab, "Longest")
    knob = [t.get_by_label("Step Δt").get_attribute("aria-valuetext") for t in (tab, other)]
    assert knob[0] == knob[1] != "20 ms"
    for spoiled in (
        "#workshop:a=1_2&b=1",
        "#workshop:b=" + "1_" * 30,
        "#workshop:a=x&b=<b>&dt=1e9",
    ):
        broken = visit(spoiled)
        assert broken.locator(f"{BOX} canvas").first.is_visible() and "RK4" in said(broken)


def test_a_key_costs_no_frame(visit):
    tab = visit()
    for name in ("RK4", "Butcher, order 5"):
        start_from(tab, name)
        costs = tab.evaluate(
            """async () => {
              const box = document.querySelector(".se-bench"), costs = [];
              const entry = box.querySelector("input[aria-label=b1]");
              for (let n = 0; n < 60; n++) {
                const done = new Promise((next) =>
                  box.addEventListener("painted", (event) => next(event.detail), { once: true }));
                entry.value = String(0.1 + n / 1000);
                entry.dispatchEvent(new Event("input", { bubbles: true }));
                costs.push(await done);
              }
              return costs.sort((a, b) => a - b);
            }"""
        )
        print(f"{name}: {costs[len(costs) // 2]:.1f} ms")
        assert costs[len(costs) // 2] < 8


def test_its_script_comes_where_it_is_needed_and_is_small(site, book, visit):
    size = len(gzip.compress((book / "_static" / "workshop.js").read_bytes(), 9))
    print(f"{size / 1000:.0f} kB")
    assert size < 40_000
    assert "workshop.js" in (book / PAGE).read_text(encoding="utf-8")
    assert "workshop.js" not in (book / "notebooks" / "12-drive.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("width", [390, 1366])
def test_axe_finds_nothing(visit, width):
    tab = visit(viewport={"width": width, "height": 900})

    def spoil(tab):
        entry(tab, "b2").fill("x")
        button(tab, "Keep to compare").click()

    found = objections(tab, BOX, spoil)
    assert not found, "\n".join(found)
    assert tab.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_a_finger_turns_a_number(visit):
    tab = visit(**PHONE)
    slider = tab.get_by_label("Turn b1")
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    assert box["height"] >= 44
    swipe(tab, box["x"] + 0.3 * box["width"], box["y"] + box["height"] / 2, 70, 3)
    assert float(entry(tab, "b1").input_value()) > 0.5 and "order 0" in said(tab)


def test_a_finger_that_scrolls_turns_nothing(visit):
    tab = visit(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    sliders = tab.locator(f"{BOX} input[type=range]")
    assert sliders.count() == 7

    def place(slider):
        slider.evaluate("e => e.scrollIntoView({ block: 'center' })")
        tab.wait_for_timeout(200)
        box = slider.bounding_box()
        return box["x"] + 0.25 * box["width"], box["y"] + box["height"] / 2

    for slider in sliders.all():
        (x, y), value, height = place(slider), slider.input_value(), tab.evaluate("scrollY")
        swipe(tab, x, y, 5, -150)
        assert tab.evaluate("scrollY") > height + 60
        assert slider.input_value() == value
        swipe(tab, *place(slider), 50, 3)
        assert slider.input_value() != value


def test_letters_twice_as_large_leave_room_for_everything(visit):
    tab = visit(viewport={"width": 390, "height": 844})
    tab.add_style_tag(content="html { font-size: 32px }")
    tab.wait_for_timeout(300)
    narrow = tab.evaluate(
        """box => [...document.querySelectorAll(box)].filter((part) =>
      part.checkVisibility() && part.getBoundingClientRect().width < 120).length""",
        f"{BOX} :is(dd, input[type=range])",
    )
    assert narrow == 0
    edge = tab.locator(BOX).evaluate("box => box.getBoundingClientRect().right")
    for select in tab.locator(f"{BOX} select").all():
        box = select.bounding_box()
        assert box["x"] + box["width"] <= edge


def test_forced_colours_leave_everything_to_be_seen(visit):
    tab = visit(forced_colors="active")
    before = pictures(tab)
    assert len(set(before)) == 4
    start_from(tab, "Gauss-Legendre, order 4")
    assert all(old != new for old, new in zip(before, pictures(tab)))


def test_without_scripts_and_on_paper_there_is_a_still_picture(browser, site, visit):
    assert "region of absolute stability" in still_picture(browser, site, BOX)
    assert gives_way_on_paper(visit(), BOX)


LAB_CELLS = [
    """from suspension import GaussianBump, Robot
from suspension.explorer import Workshop

workshop = Workshop(Robot(800, 800), GaussianBump())
workshop""",
    """print("typed:", workshop.scheme if workshop.numbers else "nothing yet")""",
]


@pytest.mark.slow
def test_the_same_workshop_is_alive_in_jupyterlab(browser, tmp_path):
    write_notebook(tmp_path / "workshop.ipynb", LAB_CELLS)
    tab = browser.new_page(viewport={"width": 1300, "height": 1200})
    errors = []
    tab.on("pageerror", lambda error: errors.append(str(error)))
    with serve(tmp_path) as address:
        run_all(tab, address, "workshop.ipynb", f"{BOX}.se-live")
        assert not tab.locator(f"{BOX} img").is_visible()
        entry(tab, "a43").fill("1/2")
        assert "order 1" in said(tab)
        start_from(tab, "Heun")
        assert said(tab).startswith("Heun")
        tab.locator(".jp-CodeCell .cm-content").last.click()
        tab.keyboard.press("Control+Enter")
        tab.get_by_text("typed: Scheme(name='Heun', order=2").wait_for(timeout=60_000)
    tab.close()
    assert not errors
