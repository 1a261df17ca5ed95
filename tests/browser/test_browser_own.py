"""Your own robot and road in the built book: by hand, keys and finger; links, all readers."""

import gzip
import re

import numpy as np
import pytest
from instruments import (
    PAGE,
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

from suspension import GaussianBump, contact, profiles
from suspension.explorer.own_facts import LIMITS

BOX = ".suspension-laboratory.se-own"
SETTLED = f"{BOX} [data-settled]"
NAMES = {
    "v": "Speed v",
    "m": "Mass m",
    "Izz": "Inertia Izz",
    "L1": "Rear arm L₁",
    "L2": "Front arm L₂",
    "k1": "Rear spring k₁",
    "k2": "Front spring k₂",
    "c1": "Rear damper c₁",
    "c2": "Front damper c₂",
    "height": "Bump height h₀",
    "sigma": "Bump width σ",
    "distance": "Way to drive",
}
KILOBYTES = 450  # of the page with four instruments, gzipped
SECONDS = 0.25  # from the page's being read until this is alive, after the other instruments


@pytest.fixture
def visit(browser, site):
    """Open the page with the robot; in the end, no script has complained."""
    with visiting(browser, site, BOX) as go:
        yield go


def pictures(tab):
    tab.wait_for_selector(SETTLED, state="attached")
    return pixels(tab, BOX)


def said(tab):
    return tab.locator(f"{BOX} .se-result").inner_text()


def field(tab, name):
    return tab.locator(BOX).get_by_label(NAMES.get(name, name), exact=True)


def slider(tab, name):
    return tab.locator(BOX).get_by_label(f"{NAMES.get(name, name)}, slider", exact=True)


def button(tab, name):
    return tab.locator(BOX).get_by_role("button", name=name, exact=True)


def choose(tab, name, option):
    tab.locator(BOX).get_by_label(name, exact=True).select_option(label=option)


def put(tab, name, text):
    field(tab, name).fill(text)
    field(tab, name).press("Enter")


def error(tab, name):
    return tab.locator(f'{BOX} .se-field[data-name="{name}"] .se-error')


def table(tab, caption):
    """The rows of a table, cell by cell."""
    found = tab.locator(f"{BOX} table", has=tab.locator("caption", has_text=caption))
    return [row.inner_text().split("\t") for row in found.locator("tbody tr").all()]


def pad(tab):
    return tab.locator(f"{BOX} .se-pad")


def python(tab):
    """The names that the lines leave behind which one takes away; but for the search."""
    if not tab.locator(f"{BOX} .se-away").get_attribute("open"):
        tab.locator(f"{BOX} .se-away").evaluate("details => (details.open = true)")
    tab.wait_for_timeout(50)
    names, lines = {}, tab.locator(f"{BOX} .se-python").inner_text()
    exec(re.sub(r"^(ranges|print).*$", "ranges = None", lines, flags=re.MULTILINE), names)
    return names


def number(text):
    """The number at the beginning of a text."""
    return float(re.match(r"−?[\d.]+", text)[0].replace("−", "-"))


def settle(tab):
    tab.wait_for_selector(SETTLED, state="attached")
    return said(tab)


def draw(tab, *places):
    """A stroke of the mouse over the road, in parts of the pad from its lower left corner."""
    in_sight(tab, pad(tab))
    box = pad(tab).bounding_box()
    at = [(box["x"] + x * box["width"], box["y"] + (1 - y) * box["height"]) for x, y in places]
    tab.mouse.move(*at[0])
    tab.mouse.down()
    for place in at[1:]:
        tab.mouse.move(*place, steps=10)
    tab.mouse.up()


def in_sight(tab, element):
    """Scroll something to the middle of the window."""
    element.evaluate("element => element.scrollIntoView({ block: 'center' })")
    tab.wait_for_timeout(100)


HILL = [(0.45, 0.3), (0.55, 0.45), (0.65, 0.4), (0.75, 0.3)]


def test_every_number_changes_what_it_should(visit):
    tab = visit()
    button(tab, "Both axles alike").click()  # each by itself
    before, drawn = settle(tab), pictures(tab)
    for name in NAMES:
        start = field(tab, name).input_value()
        in_sight(tab, slider(tab, name))
        box = slider(tab, name).bounding_box()
        y, width = box["y"] + box["height"] / 2, box["width"]
        place = slider(tab, name).evaluate("input => Number(input.value)")
        x = box["x"] + 10 + place * (width - 20)
        tab.mouse.move(x, y)
        tab.mouse.down()
        tab.mouse.move(x + 0.25 * width, y, steps=6)
        tab.mouse.up()
        assert number(field(tab, name).input_value()) > number(start), name
        assert any(one != other for one, other in zip(drawn, pictures(tab), strict=True)), name
        button(tab, "Undo").click()  # one step for all of a pull
        assert field(tab, name).input_value() == start and settle(tab) == before, name
    assert pictures(tab) == drawn and button(tab, "Undo").is_enabled()  # the axles


def test_typed_numbers_and_keys(visit):
    tab = visit()
    put(tab, "m", "2,5")
    assert python(tab)["robot"].m == 2.5
    slider(tab, "m").focus()
    tab.keyboard.press("ArrowRight")
    assert number(field(tab, "m").input_value()) > 2.5
    tab.keyboard.press("Home")
    low = number(field(tab, "m").input_value())
    tab.keyboard.press("End")
    assert number(field(tab, "m").input_value()) == pytest.approx(100 * low, rel=0.01)
    put(tab, "m", "900")  # far from where one started: the slider goes along
    assert slider(tab, "m").evaluate("input => Number(input.value)") == pytest.approx(0.5, abs=0.01)
    before = said(tab)
    for text, words in (("heavy", "A number, please: 0.001 to"), ("-1", "Out of range: 0.001 to")):
        put(tab, "m", text)
        assert error(tab, "m").inner_text().startswith(words)
        assert field(tab, "m").get_attribute("aria-invalid") == "true"
        assert error(tab, "m").get_attribute("role") == "alert" and said(tab) == before
    field(tab, "m").press("Escape")
    assert field(tab, "m").input_value() == "900" and error(tab, "m").inner_text() == ""


def test_the_page_s_numbers_are_those_of_the_lines_it_gives_away(visit):
    tab = visit()
    put(tab, "v", "10")
    settle(tab)
    assert said(tab).startswith("Contact is kept at 10")
    names = python(tab)
    for row, exact in zip(table(tab, "Wheels"), names["least"], strict=True):
        assert number(row[2]) == pytest.approx(exact.force, rel=5e-3)
        assert number(row[3]) == pytest.approx(exact.X, rel=5e-3)
    for row, exact in zip(table(tab, "Groups"), names["numbers"], strict=True):
        assert number(row[2]) == pytest.approx(exact, rel=5e-4)
    found = contact.regimes(names["robot"], names["road"], 0.1, 25, distance=names["distance"])
    speeds = tab.locator(f"{BOX} .se-texts p").first.inner_text().replace("\u00a0", " ")
    for v in found.critical:
        assert f"{v:.4g}" in speeds
    draw(tab, *HILL)
    settle(tab)
    names = python(tab)
    loss = profiles.profile_loss(
        names["robot"], names["road"], names["v"], distance=names["distance"]
    )
    assert loss == names["loss"]
    if loss:
        assert f"X = {float(f'{10 * loss.t:.3g}')}" in said(tab).replace("\u00a0", " ")
    else:
        assert "is kept" in said(tab)


def test_axles_change_together_or_not_and_unequal_ones_have_no_groups(visit):
    tab = visit()
    put(tab, "k1", "500")
    assert field(tab, "k2").input_value() == "500" and len(table(tab, "Groups")) == 5
    button(tab, "Both axles alike").click()
    put(tab, "k2", "900")
    assert field(tab, "k1").input_value() == "500" and not table(tab, "Groups")
    words = tab.locator(f"{BOX} .se-reading").inner_text()
    assert "is not symmetric" in words and "“Both axles alike” makes the symmetric robot" in words
    drawn = pictures(tab)
    button(tab, "Both axles alike").click()  # the remedy
    assert field(tab, "k1").input_value() == field(tab, "k2").input_value() == "700"
    assert len(table(tab, "Groups")) == 5 and pictures(tab)[0] != drawn[0]


def test_the_vehicle_on_the_chart_is_taken_hold_of(visit):
    tab = visit()
    before = settle(tab)
    chart = tab.locator(f"{BOX} .se-sight canvas")
    in_sight(tab, chart)
    box = chart.bounding_box()

    def place():
        """Where the vehicle is, as the frame and the groups say."""
        nu, _, eta = (number(row[2]) for row in table(tab, "Groups")[:3])
        right, up = np.log(nu / 0.1) / np.log(260), np.log(eta / 0.1) / np.log(1000)
        width, height = box["width"] - 44 - 50, box["height"] - 56 - 33
        return box["x"] + 44 + right * width, box["y"] + 56 + (1 - up) * height

    x, y = place()
    tab.mouse.move(x, y)
    assert chart.evaluate("canvas => canvas.style.cursor") == "grab"
    tab.mouse.down()
    tab.mouse.move(x + 60, y + 40, steps=8)
    tab.mouse.up()
    assert number(field(tab, "v").input_value()) > 2
    assert number(field(tab, "height").input_value()) < 20
    assert place() == pytest.approx((x + 60, y + 40), abs=3) and said(tab) != before
    button(tab, "Undo").click()
    assert field(tab, "v").input_value() == "1.2" and settle(tab) == before
    tab.mouse.move(x + 100, y - 60)  # nothing is there
    tab.mouse.down()
    tab.mouse.move(x + 160, y, steps=4)
    tab.mouse.up()
    assert settle(tab) == before


def test_a_road_is_drawn_with_the_mouse_smoothed_and_taken_back(visit):
    tab = visit()
    before, drawn = settle(tab), pictures(tab)
    draw(tab, *HILL)
    assert field(tab, "Road height").is_visible() and not field(tab, "height").is_visible()
    assert all(one != other for one, other in zip(drawn, pictures(tab), strict=True))
    rough = python(tab)["bump"]
    button(tab, "Smooth").click()
    settle(tab)
    smooth = python(tab)["bump"]
    assert abs(smooth.height) / smooth.sigma < abs(rough.height) / rough.sigma
    choose(tab, "Joined by", "straight lines")
    assert 'kind="linear"' in tab.locator(f"{BOX} .se-python").inner_text()
    tall = number(field(tab, "Road height").input_value())
    put(tab, "Road height", str(tall / 2))
    assert python(tab)["road"].h.max() == pytest.approx(smooth.height / 2, rel=1e-3)
    for _ in range(4):
        button(tab, "Undo").click()
    assert settle(tab) == before and button(tab, "Undo").is_disabled()
    assert pictures(tab) == drawn
    button(tab, "Redo").click()
    assert field(tab, "Road height").is_visible()
    button(tab, "Reset").click()
    assert settle(tab) == before
    assert button(tab, "Smooth").is_disabled()
    assert button(tab, "Smooth").get_attribute("title") == "A bump is smooth"


def test_a_road_is_drawn_with_the_keys(visit):
    tab = visit()
    choose(tab, "Take", "level, to draw on")
    settle(tab)
    assert said(tab).startswith("The road is level")
    assert "draw one, paste one" in tab.locator(f"{BOX} .se-reading").inner_text()
    pad(tab).focus()
    assert pad(tab).get_attribute("role") == "application"
    for _ in range(8):
        tab.keyboard.press("ArrowRight")
    for _ in range(3):
        tab.keyboard.press("ArrowUp")
    road = python(tab)["road"]
    top = road.h.max()
    assert top > 0 and 0.3 < np.interp(top, np.sort(road.h), range(49)) / 48
    tab.keyboard.press("Shift+ArrowDown")
    assert 0.7 * top < python(tab)["road"].h.max() < top
    tab.keyboard.press("Control+z")
    assert python(tab)["road"].h.max() == pytest.approx(top)
    tab.keyboard.press("Backspace")
    assert python(tab)["road"].h.max() < top


def test_a_finger_scrolls_unless_it_pulls_sideways_or_is_told_to_draw(visit):
    tab = visit(**PHONE)
    pad(tab).evaluate("pad => scrollBy(0, pad.getBoundingClientRect().top - 430)")
    tab.wait_for_timeout(200)
    before = settle(tab)
    box = pad(tab).bounding_box()
    x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.6 * box["height"]
    touch(tab, (x, y), (x + 4, y - 100))  # up: the page scrolls
    assert tab.evaluate("scrollY") > 0 and not field(tab, "Road height").is_visible()
    pad(tab).evaluate("pad => scrollBy(0, pad.getBoundingClientRect().top - 430)")
    tab.wait_for_timeout(200)
    scrolled = tab.evaluate("scrollY")
    touch(tab, (x, y), (x + 80, y - 10))
    assert field(tab, "Road height").count() and tab.evaluate("scrollY") == scrolled
    assert settle(tab) != before
    button(tab, "Undo").click()
    assert settle(tab) == before
    button(tab, "Draw with a finger").click()
    pad(tab).evaluate("pad => scrollBy(0, pad.getBoundingClientRect().top - 430)")
    tab.wait_for_timeout(200)
    scrolled, box = tab.evaluate("scrollY"), pad(tab).bounding_box()
    x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.6 * box["height"]
    touch(tab, (x, y), (x + 4, y - 60))
    assert tab.evaluate("scrollY") == scrolled and settle(tab) != before


def test_a_finger_on_a_slider_scrolls_unless_it_pulls_sideways(visit):
    tab = visit(**PHONE)
    slider(tab, "m").evaluate("input => scrollBy(0, input.getBoundingClientRect().top - 700)")
    tab.wait_for_timeout(200)
    box = slider(tab, "m").bounding_box()
    assert box["height"] >= 44
    x, y = box["x"] + 0.2 * box["width"], box["y"] + box["height"] / 2
    scrolled = tab.evaluate("scrollY")
    touch(tab, (x, y), (x, y - 120))
    assert field(tab, "m").input_value() == "1.456" and tab.evaluate("scrollY") > scrolled
    box = slider(tab, "m").bounding_box()
    y = box["y"] + box["height"] / 2
    touch(tab, (x, y), (x + 40, y))
    assert number(field(tab, "m").input_value()) > 1.456


def test_the_verdict_stays_in_sight_while_a_phone_scrolls_through_the_numbers(visit):
    tab = visit(**PHONE)
    for name in ("v", "c2", "sigma"):
        slider(tab, name).evaluate("input => input.scrollIntoView({ block: 'end' })")
        tab.wait_for_timeout(200)
        top, bottom = tab.locator(f"{BOX} .se-sight").evaluate(
            "box => [box.getBoundingClientRect().top, box.getBoundingClientRect().bottom]"
        )
        assert 0 <= top < 120 and bottom < slider(tab, name).bounding_box()["y"]
    assert tab.evaluate("document.documentElement.scrollWidth <= innerWidth")


PASTED = [
    ("0, 0\n1, x", "Line 2: h must be a number"),
    ("0, 0\nNaN, 1", "Line 2: x must be a number"),
    ("0, 0", "Too few points: 1"),
    ("0, 0\n2, 1\n1, 2", "x must increase: line 3 lies behind line 2. Sort the points"),
    ("0, 0\n1, 40", "Too steep: a slope of 4 between line 1 and line 2"),
]


def test_a_pasted_road_is_driven_over_or_refused_with_the_reason(visit):
    tab = visit()
    before = settle(tab)
    tab.locator(f"{BOX} .se-paste summary").click()
    area = tab.get_by_label("A place and a height on each line")
    choose(tab, "x in", "cm")
    choose(tab, "h in", "mm")
    told = tab.locator(f"{BOX} .se-paste .se-error")
    for text, words in PASTED:
        area.fill(text)
        button(tab, "Drive over it").click()
        assert told.inner_text().startswith(words) and area.input_value() == text
        assert area.get_attribute("aria-describedby") == told.get_attribute("id")
        assert area.evaluate("area => area === document.activeElement") and settle(tab) == before
    area.fill("x, h\n5; 0\n15; 12,5\n25; 0")
    button(tab, "Drive over it").click()
    assert told.inner_text() == "" and area.get_attribute("aria-invalid") is None
    road = python(tab)["road"]
    assert np.diff(road.x) == pytest.approx([0.1, 0.1]) and road.h == pytest.approx([0, 0.0125, 0])
    button(tab, "This road as text").click()
    assert area.input_value() == "0, 0\n10, 12.5\n20, 0"
    button(tab, "Undo").click()
    assert settle(tab) == before


def test_units_change_what_one_reads_and_nothing_else(visit):
    tab = visit()
    names = python(tab)
    button(tab, "km/h, cm").click()
    assert field(tab, "v").input_value() == "4.32" and field(tab, "L1").input_value() == "10.7"
    assert "at 4.32\u00a0km/h" in said(tab) and "km/h" in slider(tab, "v").get_attribute(
        "aria-valuetext"
    )
    again = python(tab)
    assert (again["robot"], again["road"], again["v"]) == (
        names["robot"],
        names["road"],
        names["v"],
    )
    put(tab, "v", "36")
    assert python(tab)["v"] == 10 and "0.342 to 90" in tab.locator(
        f"{BOX} .se-texts p"
    ).first.inner_text().replace("\u00a0", " ")


def test_published_vehicles_and_other_roads_are_offered(visit):
    tab = visit()
    seen = {settle(tab)}
    for name in ("car, short hump", "motorcycle fork, short hump", "empty truck, road hump"):
        choose(tab, "Vehicle", name)
        seen.add(settle(tab))
        assert "as published by" in tab.locator(f"{BOX} .se-key").first.inner_text()
    for name in ("kerb", "pothole", "two bumps", "washboard"):
        choose(tab, "Take", name)
        seen.add(settle(tab))
        assert isinstance(python(tab)["road"], profiles.RoadProfile)
    choose(tab, "Take", "the bump")
    settle(tab)
    assert isinstance(python(tab)["road"], GaussianBump)
    assert len(seen) >= 6


def test_the_address_and_the_next_visit_bring_it_back(visit, browser, site):
    tab = visit()
    put(tab, "m", "2")
    draw(tab, *HILL)
    button(tab, "km/h, cm").click()
    state = settle(tab)
    tab.wait_for_function("location.hash.startsWith('#own:')")
    tab.wait_for_timeout(600)
    address = tab.evaluate("location.hash")
    other = visit(address)
    assert settle(other) == state and pictures(other) == pictures(tab)
    for spoiled in ("#own:m=1", address.replace("m=2", "m=x"), "#own:" + 500 * "x=1_"):
        broken = visit(spoiled)
        assert field(broken, "m").input_value() == "1.456"
    tab.goto(f"{site}{PAGE}")  # the same reader, without the address
    tab.wait_for_selector(f"{BOX} canvas[aria-label]")
    assert settle(tab) == state
    button(tab, "Reset").click()
    assert field(tab, "m").input_value() == "1.456"
    tab.evaluate("localStorage.setItem('suspension-own ' + location.pathname + ' 0', '{\"v\": 3}')")
    tab.goto(f"{site}{PAGE}")
    tab.wait_for_selector(f"{BOX} canvas[aria-label]")
    assert "at 1.2" in settle(tab)


def test_too_slow_a_drive_is_told_of(visit):
    tab = visit()
    put(tab, "distance", "90000")
    put(tab, "v", "0.01")
    assert settle(tab).startswith("No verdict at 0.01")
    assert tab.locator(f"{BOX} .se-sight").get_attribute("data-tone") == "doubt"
    put(tab, "distance", "0.3")
    assert "The way ends before both wheels" in tab.locator(f"{BOX} .se-sheet").inner_text()


COST = """async ([name, from, to]) => {
  const box = document.querySelector(".se-own .se-owner"), costs = [];
  const slider = box.querySelector(`[data-name=${name}] input[type=range]`);
  for (let n = 0; n < 60; n++) {
    const done = new Promise((next) =>
      box.addEventListener("painted", (event) => next(event.detail), { once: true }));
    slider.value = from + (to - from) * n / 60;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    costs.push(await done);
  }
  return costs.sort((a, b) => a - b);
}"""


def test_a_move_costs_no_frame(visit):
    tab = visit()
    for road in ("the bump", "two bumps", "washboard"):
        choose(tab, "Take", road)
        settle(tab)
        for name in ("m", "c1", "v"):
            for _ in range(3):  # other tests run on the same machine
                costs = tab.evaluate(COST, [name, 0.4, 0.6])
                print(f"{road}, {name}: {costs[30]:.1f} ms, at most {costs[-1]:.1f} ms")
                if costs[30] < 8:
                    break
            assert costs[30] < 8


ALIVE = """new MutationObserver((_, observer) => {
  if (!document.querySelector(".se-own canvas[aria-label]")) return;
  window.alive = performance.now();
  observer.disconnect();
}).observe(document, { subtree: true, childList: true, attributes: true });"""


def test_the_page_is_alive_at_once_and_light(browser, site, book):
    times = []
    for _ in range(8):  # other tests run on the same machine
        tab = browser.new_page(viewport={"width": 1366, "height": 900})
        tab.add_init_script(ALIVE)
        tab.goto(f"{site}{PAGE}")
        tab.wait_for_function("window.alive")
        read = "performance.getEntriesByType('navigation')[0].domInteractive"
        times.append(tab.evaluate(f"[alive - {read}, alive]"))
        tab.close()
        if times[-1][0] < 1000 * SECONDS:
            break
    best = min(times)
    print(
        f"alive {best[0]:.0f} ms after the page was read, {best[1]:.0f} ms after it was asked for"
    )
    assert best[0] < 1000 * SECONDS
    html = (book / PAGE).read_text(encoding="utf-8")
    html = re.sub(r"<noscript>.*?</noscript>", "", html)  # only without scripts
    names = {match.split("?")[0] for match in re.findall(r"_static/([\w./-]+\.(?:js|css))", html)}
    files = [book / "_static" / name for name in names] + [book / PAGE]
    weight = sum(len(gzip.compress(file.read_bytes(), 9)) for file in files if file.exists())
    size = len(gzip.compress((book / "_static" / "own.js").read_bytes(), 9))
    print(f"script {size / 1000:.0f} kB, page {weight / 1000:.0f} kB")
    assert size < 40_000 and weight < 1000 * KILOBYTES
    assert "own.js" not in (book / "notebooks" / "12-drive.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("width", [390, 1366])
def test_axe_finds_nothing(visit, width):
    tab = visit(viewport={"width": width, "height": 900})

    def spoil(tab):
        put(tab, "m", "x")
        tab.locator(f"{BOX} .se-paste summary").click()
        button(tab, "Drive over it").click()
        tab.locator(f"{BOX} .se-away summary").click()
        button(tab, "Both axles alike").click()

    found = objections(tab, BOX, spoil)
    assert not found, "\n".join(found)
    assert tab.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_forced_colours_leave_everything_to_be_seen(visit):
    tab = visit(forced_colors="active")
    before = pictures(tab)
    draw(tab, *HILL)
    assert all(one != other for one, other in zip(before, pictures(tab), strict=True))


def test_without_scripts_and_on_paper_there_is_a_still_picture(browser, site, visit):
    assert "a vehicle as a point" in still_picture(browser, site, BOX)
    assert gives_way_on_paper(visit(), BOX)


LAB_CELLS = [
    """from suspension import GaussianBump, Robot
from suspension.explorer import Own

own = Own(Robot(800, 800), GaussianBump())
own""",
    """print("set:", own.robot.m, own.v, type(own.road).__name__, own.distance > 0)""",
]


@pytest.mark.slow
def test_the_same_is_alive_in_jupyterlab_by_mouse(browser, tmp_path):
    write_notebook(tmp_path / "own.ipynb", LAB_CELLS)
    tab = browser.new_page(viewport={"width": 1300, "height": 1400})
    errors = []
    tab.on("pageerror", lambda error: errors.append(str(error)))
    with serve(tmp_path) as address:
        run_all(tab, address, "own.ipynb", f"{BOX}.se-live")
        assert not tab.locator(f"{BOX} img").is_visible()
        put(tab, "m", "2")
        in_sight(tab, slider(tab, "v"))
        box = slider(tab, "v").bounding_box()
        tab.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        tab.mouse.down()
        tab.mouse.move(box["x"] + 0.8 * box["width"], box["y"] + box["height"] / 2, steps=5)
        tab.mouse.up()
        draw(tab, *HILL)
        settle(tab)
        v = number(field(tab, "v").input_value())
        assert v > 2
        tab.locator(".jp-CodeCell .cm-content").last.click()
        tab.keyboard.press("Control+Enter")
        tab.get_by_text(f"set: 2.0 {v} RoadProfile True").wait_for(timeout=60_000)
    tab.close()
    assert not errors


def test_the_limits_of_typing_are_those_of_python():
    assert LIMITS["c1"][0] == 0 and all(low < high for low, high in LIMITS.values())
