"""Readings that one drags in the built book, and the verdicts that follow."""

import re

import pytest
from instruments import (
    PHONE,
    gives_way_on_paper,
    objections,
    still_picture,
    touch,
    visiting,
    write_notebook,
)
from instruments import pictures as pixels
from lab import run_all, serve

BOX = ".suspension-laboratory.se-chain"
LEFT, RIGHT, TOP, BOTTOM = 52, 20, 24, 33  # pixels beside the frame of the readings
READING = re.compile(r"^Reading (\d+) of (\d+), at ([\d.]+): (−?[\d.]+)\sN")


@pytest.fixture
def visit(browser, site):
    """Open the page with the readings; in the end, no script has complained."""

    def settle(tab):
        tab.locator(f"{BOX} .se-pad").scroll_into_view_if_needed()
        tab.wait_for_timeout(200)

    with visiting(browser, site, BOX, settle) as go:
        yield go


def pad(tab):
    return tab.locator(f"{BOX} .se-pad")


def button(tab, name):
    return tab.locator(BOX).get_by_role("button", name=name)


def told(tab):
    """Stiffness and verdicts, as one reads them."""
    return tab.locator(f"{BOX} .se-result").inner_text()


def chosen(tab):
    """Number, count, place and force of the reading that is chosen."""
    text = tab.locator(f"{BOX} .se-words").inner_text()
    n, count, x, force = READING.match(text).groups()
    return int(n), int(count), float(x), float(force.replace("−", "-"))


def table(tab, caption):
    """The rows of a table, cell by cell."""
    found = tab.locator(f"{BOX} table", has=tab.locator("caption", has_text=caption))
    return [row.inner_text().split("\t") for row in found.locator("tbody tr").all()]


def pictures(tab):
    return pixels(tab, BOX)


def place(tab, n):
    """Where the n-th reading is in the window, in pixels, as the axes have it at first."""
    state = tab.locator(f"{BOX} .se-state").evaluate("script => JSON.parse(script.textContent)")
    readings = state["readings"]
    box = pad(tab).bounding_box()
    x, force = readings[n]
    forces = [force for _, force in readings]
    low, high = min(0, *forces), max(0, *forces)
    least, most = low - 0.2 * (high - low), high + 0.2 * (high - low)
    width, height = box["width"] - LEFT - RIGHT, box["height"] - TOP - BOTTOM
    end = max(x for x, _ in readings)
    up = (force - least) / (most - least)
    return box["x"] + LEFT + width * x / end, box["y"] + TOP + height * (1 - up)


def drag(tab, n, up):
    """Drag the n-th reading by mouse, so many pixels up."""
    x, y = place(tab, n)
    tab.mouse.move(x, y)
    tab.mouse.down()
    tab.mouse.move(x, y - up, steps=8)
    tab.mouse.up()


def test_a_reading_is_dragged_and_everything_follows(visit):
    tab = visit()
    before, drawn = told(tab), pictures(tab)
    tables = [table(tab, name) for name in ("Coefficients", "Critical speeds", "Asked speeds")]
    drag(tab, 3, 60)
    n, count, _, force = chosen(tab)
    assert (n, count) == (4, 21) and force > 3
    assert told(tab) != before and told(tab).startswith("k = ")
    after = [table(tab, name) for name in ("Coefficients", "Critical speeds", "Asked speeds")]
    assert after[0] != tables[0] and after[1] != tables[1] and len(after[0]) == 3
    assert [row[0] for row in after[2]] == [row[0] for row in tables[2]]
    assert all(one != other for one, other in zip(drawn, pictures(tab), strict=True))
    button(tab, "Undo").click()
    assert told(tab) == before and button(tab, "Undo").is_disabled()
    button(tab, "Redo").click()
    assert told(tab) != before
    button(tab, "Reset").click()
    assert told(tab) == before


def test_the_address_keeps_the_readings(visit):
    tab = visit()
    drag(tab, 3, 60)
    button(tab, "Preload +").click()
    button(tab, "Add an outlier").click()
    tab.keyboard.press("Tab")
    tab.wait_for_function("location.hash.startsWith('#chain:r=')")
    tab.wait_for_timeout(500)
    state, address = told(tab), tab.evaluate("location.hash")
    other = visit(address)
    assert told(other) == state
    assert table(other, "Coefficients") == table(tab, "Coefficients")
    button(other, "Reset").click()
    other.wait_for_function("location.hash === ''")
    assert told(other) == told(visit())
    button(other, "Undo").click()
    assert told(other) == state
    for spoiled in ("#chain:r=x", "#chain:r=0_1;0_2;0_3;0_4", "#chain:r=<b>", "#chain:"):
        broken = visit(spoiled)
        assert told(broken) == told(visit())


def test_a_finger_moves_a_reading_by_a_clear_pull_and_scrolls_beside_it(visit):
    tab = visit(**PHONE)
    pad(tab).evaluate("pad => scrollBy(0, pad.getBoundingClientRect().top - 200)")
    before, scrolled = told(tab), tab.evaluate("scrollY")
    x, y = place(tab, 4)
    touch(tab, (x, y), (x, y - 4))  # a tremor chooses, and moves nothing
    assert told(tab) == before and chosen(tab)[0] == 5
    touch(tab, (x, y), (x, y - 70))
    assert told(tab) != before and tab.evaluate("scrollY") == scrolled
    moved = told(tab)
    x, y = place(tab, 18)
    touch(tab, (x, y + 120), (x, y + 20))  # nothing is there: the page scrolls
    assert tab.evaluate("scrollY") > scrolled and told(tab) == moved


def test_the_keys_choose_move_take_out_and_take_back(visit):
    tab = visit()
    before = told(tab)
    button(tab, "Magnify").focus()
    tab.keyboard.press("Tab")
    assert pad(tab).evaluate("pad => pad === document.activeElement")
    assert pad(tab).get_attribute("role") == "application"
    assert "arrow keys" in pad(tab).get_attribute("aria-label")
    assert chosen(tab)[0] == 1
    for _ in range(4):
        tab.keyboard.press("ArrowRight")
    n, count, _, start = chosen(tab)
    assert n == 5
    tab.keyboard.press("ArrowUp")
    small = chosen(tab)[3] - start
    tab.keyboard.press("Shift+ArrowUp")
    assert chosen(tab)[3] - start == pytest.approx(11 * small, abs=0.02) and small > 0
    assert told(tab) != before
    tab.keyboard.press("Delete")
    assert chosen(tab)[:2] == (5, count - 1)
    for _ in range(3):
        tab.keyboard.press("Control+z")
    assert told(tab) == before
    tab.keyboard.press("Control+Shift+Z")
    assert told(tab) != before


def test_readings_are_taken_out_down_to_four_and_it_is_said_why_not_further(visit):
    tab = visit()
    pad(tab).focus()
    tab.keyboard.press("ArrowRight")
    widths = []
    while not button(tab, "Delete").is_disabled():
        tab.keyboard.press("Delete")
        widths.append(told(tab))
    assert chosen(tab)[1] == 4 and len(widths) == 17
    assert "nothing is left to tell the scatter by" in button(tab, "Delete").get_attribute("title")
    tab.keyboard.press("Delete")
    assert chosen(tab)[1] == 4
    button(tab, "Reset").click()
    button(tab, "Undo").click()
    assert told(tab) == widths[-1]


def test_a_preload_leaves_the_stiffness_and_contradicts_the_line(visit):
    tab = visit()
    before, line = told(tab), tab.locator(f"{BOX} .se-texts p").first.inner_text()
    for _ in range(3):
        button(tab, "Preload +").click()
    assert told(tab) == before
    after = tab.locator(f"{BOX} .se-texts p").first.inner_text()
    assert "outside the ellipse" in after and after != line
    for _ in range(3):
        button(tab, "Preload −").click()
    assert tab.locator(f"{BOX} .se-texts p").first.inner_text() == line


def test_outliers_come_as_long_as_there_is_room(visit):
    tab = visit()
    before = told(tab)
    button(tab, "Add an outlier").click()
    assert chosen(tab)[1] == 22 and told(tab) != before
    for _ in range(11):
        button(tab, "Add an outlier").click()
    assert chosen(tab)[1] == 33 and button(tab, "Add an outlier").is_disabled()
    assert "room" in button(tab, "Add an outlier").get_attribute("title")


def test_the_magnified_picture_moves_a_reading_by_less(visit):
    tab = visit()
    plain = pictures(tab)
    button(tab, "Magnify").click()
    assert button(tab, "Magnify").get_attribute("aria-pressed") == "true"
    assert pictures(tab)[0] != plain[0] and pictures(tab)[1:] == plain[1:]
    box = pad(tab).bounding_box()
    for up in range(-120, 121, 8):  # look for the first reading on its vertical
        tab.mouse.move(box["x"] + LEFT, box["y"] + (box["height"] - 9) / 2 - up)
        if pad(tab).evaluate("pad => pad.style.cursor"):
            break
    tab.mouse.down()
    tab.mouse.move(box["x"] + LEFT, box["y"] + box["height"] / 2 - up - 30, steps=5)
    tab.mouse.up()
    assert chosen(tab)[0] == 1 and abs(chosen(tab)[3]) < 0.5


def test_a_move_costs_no_frame(visit):
    tab = visit()
    x, y = place(tab, 5)
    costs = tab.evaluate(
        """([x, y]) => {
          const pad = document.querySelector(".se-chain .se-pad"), costs = [];
          pad.setPointerCapture = () => {};
          const send = (name, dy) => pad.dispatchEvent(new PointerEvent(name,
            { pointerId: 1, pointerType: "mouse", clientX: x, clientY: y - dy, bubbles: true }));
          send("pointerdown", 0);
          for (let dy = 0; dy < 90; dy += 0.5) {
            const start = performance.now();
            send("pointermove", dy);
            costs.push(performance.now() - start);
          }
          send("pointerup", 90);
          return costs.sort((a, b) => a - b);
        }""",
        [x, y],
    )
    assert chosen(tab)[0] == 6
    assert costs[len(costs) // 2] < 8, costs[len(costs) // 2]


def test_without_scripts_and_on_paper_there_is_a_still_picture(browser, site, visit):
    assert "the critical speeds over the" in still_picture(browser, site, BOX)
    assert gives_way_on_paper(visit(), BOX)


@pytest.mark.parametrize("width", [390, 1366])
def test_axe_finds_nothing_whatever_was_done(visit, width):
    tab = visit(viewport={"width": width, "height": 900})

    def change(tab):
        pad(tab).focus()
        tab.keyboard.press("Shift+ArrowUp")
        button(tab, "Add an outlier").click()

    found = objections(tab, BOX, change)
    assert not found, "\n".join(found)
    assert tab.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_forced_colours_leave_everything_to_be_seen(visit):
    tab = visit(forced_colors="active")
    before = pictures(tab)
    drag(tab, 3, 60)
    assert all(one != other for one, other in zip(before, pictures(tab), strict=True))


def test_the_pictures_say_what_they_show(visit):
    tab = visit()
    names = [c.get_attribute("aria-label") for c in tab.locator(f"{BOX} canvas").all()]
    assert (
        "21 readings" in names[0]
        and "ellipse" in names[1]
        and "5 m/s: " in names[2].replace("\u00a0", " ")
    )
    drag(tab, 3, 60)
    after = [c.get_attribute("aria-label") for c in tab.locator(f"{BOX} canvas").all()]
    assert all(one != other for one, other in zip(names[:2], after))
    for status in (".se-result", ".se-words"):
        assert tab.locator(f"{BOX} {status}").get_attribute("role") == "status"


LAB_CELL = """from suspension import GaussianBump, Robot
from suspension.explorer import Chain
from suspension.springs import load_spring_data

chain = Chain(
    load_spring_data(), Robot(800, 800), GaussianBump(), asked=[5], vmin=2, vmax=12
)
chain"""


@pytest.mark.slow
def test_the_same_readings_are_alive_in_jupyterlab(browser, tmp_path):
    write_notebook(tmp_path / "chain.ipynb", [LAB_CELL])
    tab = browser.new_page(viewport={"width": 1300, "height": 1400})
    errors = []
    tab.on("pageerror", lambda error: errors.append(str(error)))
    with serve(tmp_path) as address:
        run_all(tab, address, "chain.ipynb", f"{BOX}.se-live")
        before = told(tab)
        pad(tab).focus()
        tab.keyboard.press("ArrowRight")
        for _ in range(5):
            tab.keyboard.press("Shift+ArrowUp")
        assert told(tab) != before and len(table(tab, "Asked speeds")) == 1
        button(tab, "Undo").click()
        button(tab, "Reset").click()
        assert told(tab) == before
    tab.close()
    assert not errors
