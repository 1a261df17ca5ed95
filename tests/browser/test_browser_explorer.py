"""The explorer as its readers meet it: in a static page and in the built book."""

import io
import json
import os
import re
from itertools import combinations
from urllib.parse import urlencode

import numpy as np
import pytest
from explorers import (
    BOX,
    BUMP_SLIDERS,
    PAGES,
    PLAIN,
    SLIDERS,
    VIEW,
    compare,
    look,
    pictures,
    shown,
    slider,
    tone,
    type_in,
    words,
)
from helpers import AXE, PARITY, parse, serve_files, violations
from instruments import settle, write_pages
from PIL import Image

from suspension import problem
from suspension.contact import margin
from suspension.course import the_robot
from suspension.explorer import SCHEMES, explore
from suspension.explorer.family import Family, Range
from suspension.flight import fly
from suspension.forces import first_loss
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import Scheme

CHART_SLIDERS = [SLIDERS[3], BUMP_SLIDERS[0]]
MARK = '<div class="suspension-explorer-box'  # stands in every page with an explorer
HEUN = Scheme("Heun", 2, a=[[0, 0], [1, 0]], b=[1 / 2, 1 / 2], c=[0, 1])
KNOWN = {"asked": problem.SPEEDS, "spring_end": problem.DELTA_MAX}
CHART, RACE, SMALL = "chart", "race", "small"  # more pages, of the first robot and bump


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """A folder with a bare page for each of PAGES, in the way that the book makes them."""
    folder = tmp_path_factory.mktemp("pages")
    presets = [("Long steps", {"v": 5, "dt": 0.05, "scheme": "Crank-Nicolson"})]
    boxes = {
        name: explore(robot, road, schemes=(*SCHEMES, HEUN), presets=presets, **KNOWN)
        for name, (robot, road) in PAGES.items()
    }
    boxes[CHART] = explore(*PAGES["bump"], compact="chart", **KNOWN)
    boxes[RACE] = explore(*PAGES["bump"], compact="race", motion="flying", **KNOWN)
    boxes[SMALL] = explore(*PAGES["bump"], compact=True, motion="flying", **KNOWN)
    bodies = {
        name: f"<main><h1>Explorer</h1>{box.html()}"
        '<p>What happens <a href="#explore:v=5&motion=flying">at 5 m/s</a>, and '
        '<a href="#explore:v=1.2&dt=0.1&scheme=Crank-Nicolson">by a long step</a>?</p></main>'
        for name, box in boxes.items()
    }
    write_pages(folder, bodies)
    return folder


@pytest.fixture(scope="module")
def served(pages):
    """Where the pages are, in a folder of a server."""
    with serve_files(pages.parent) as address:
        yield f"{address}{pages.name}/"


@pytest.fixture(params=["http", "file"])
def address(request, pages, served):
    """Where the pages are: in a folder of a server, or files."""
    return served if request.param == "http" else pages.as_uri() + "/"


@pytest.fixture
def visit(browser):
    """Open a page that has an explorer; in the end, it has complained of nothing."""
    contexts, complaints = [], []

    def go(url, init="", **options):
        context = browser.new_context(**({"viewport": {"width": 1200, "height": 900}} | options))
        contexts.append(context)
        tab = context.new_page()
        tab.add_init_script(init)
        start = url.rsplit("/", 2)[0] if url.startswith("http") else "file://"
        tab.on("pageerror", lambda error: complaints.append(str(error)))
        tab.on("console", lambda line: line.type == "error" and complaints.append(line.text))
        tab.on("requestfailed", lambda request: complaints.append(request.url))
        tab.on(
            "request",
            lambda request: (
                complaints.append(request.url)
                if not request.url.startswith((start, "data:", "blob:"))
                else None
            ),
        )
        tab.goto(url)
        tab.wait_for_selector(f"{BOX} canvas[aria-label]", state="attached")
        return tab

    yield go
    for context in contexts:
        context.close()
    assert not complaints


def headline(tab):
    settle(tab)
    return tab.locator(".se-headline").inner_text().translate(PLAIN)


def go_to(tab, **settings):
    """Set the picture by the page's address."""
    tab.evaluate("hash => { location.hash = hash; }", f"explore:{urlencode(settings)}")


def place(reach, rng):
    """A value somewhere on a slider."""
    u = rng.uniform()
    if reach.logarithmic:
        return reach.low * (reach.high / reach.low) ** u
    return reach.low + u * (reach.high - reach.low)


def ranges_of(family):
    """Where every slider begins and ends."""
    return {"v": Range(*family.speeds, True)} | family.ranges


def family_at(settings):
    """The robot and the bump of the page "bump" at some settings."""
    family = Family(*PAGES["bump"])
    return (
        family.robot_at(settings["k"], settings["c"]),
        family.road_at(settings["height"], settings["sigma"]),
    )


def turn(tab, rng, family, nth=0):
    """Turn every slider to a random place, by keys and by typing, and choose a scheme."""
    units = {"dt": 1000, "height": 1000, "sigma": 1000}
    names = dict(zip(("v", "dt", "k", "c", "height", "sigma"), SLIDERS + BUMP_SLIDERS))
    for trait, name in names.items():
        if name in BUMP_SLIDERS and not family.has_bump:
            continue
        value = place(ranges_of(family)[trait], rng) * units.get(trait, 1)
        type_in(tab, name, f"{value:.7g}", nth)
        for _ in range(int(rng.integers(3))):
            slider(tab, name, nth).press(str(rng.choice(["ArrowLeft", "ArrowRight"])))
    buttons = tab.locator(BOX).nth(nth).get_by_role("group", name="Scheme").get_by_role("button")
    buttons.nth(int(rng.integers(buttons.count()))).click()


@pytest.mark.parametrize("name", PAGES)
def test_the_page_has_what_simulate_has(visit, pages, name):
    robot, road = PAGES[name]
    tab, rng = visit(f"{pages.as_uri()}/{name}.html"), np.random.default_rng(7)
    seen = {}
    for _ in range(int(os.environ.get("EXPLORER_SETTINGS", 6))):
        turn(tab, rng, Family(robot, road))
        run = shown(tab)
        seen[run[0]["v"]] = compare(run, robot, road, (*SCHEMES, HEUN))
    print(f"{name}: {len(seen)} settings, largest difference {max(seen.values()):.1e}")
    assert len(seen) > 4


def test_every_control_moves_the_picture_and_the_words(visit, address):
    tab = visit(f"{address}bump.html")
    for control in [*SLIDERS, *BUMP_SLIDERS, "Moment", "Crank-Nicolson", "RK4", "Flying"]:
        before = look(tab)
        if control in (*SLIDERS, *BUMP_SLIDERS, "Moment"):
            track = slider(tab, control).bounding_box()
            middle = track["y"] + track["height"] / 2
            tab.mouse.move(track["x"] + 0.3 * track["width"], middle)
            tab.mouse.down()
            tab.mouse.move(track["x"] + 0.62 * track["width"], middle + 3, steps=4)
            tab.mouse.up()
        else:
            tab.get_by_role("button", name=control, exact=True).click()
        after = look(tab)
        assert after[0] != before[0], control
        changed = {panel for panel in before[1] if after[1][panel] != before[1][panel]}
        assert "se-forces" in changed, control
        assert ("se-stability" in changed) == (
            control in (*SLIDERS[1:], "Crank-Nicolson", "RK4")
        ), control
        if control in (*SLIDERS[:1], *SLIDERS[2:], *BUMP_SLIDERS):
            assert "se-speeds" in changed, control


def test_the_keyboard_reaches_and_drives_everything(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    reached = []
    for _ in range(55):
        tab.keyboard.press("Tab")
        reached.append(
            tab.evaluate("""(() => {
          const here = document.activeElement;
          return here.getAttribute("aria-label") || here.textContent;
        })()""")
        )
    schemes = [scheme.name for scheme in SCHEMES]
    controls = [
        *SLIDERS,
        *BUMP_SLIDERS,
        *schemes,
        "Long steps",
        "Previous event",
        "Next event",
        "Moment",
        "Scale of time",
        "Linear",
        "Flying",
        "5 m/s",
        "Undo",
        "Redo",
        "Reset",
    ]
    assert list(dict.fromkeys(name for name in reached if name in controls)) == controls
    assert any("Play" in name for name in reached)
    for name in [*SLIDERS, *BUMP_SLIDERS, "Moment"]:
        before = words(tab)
        slider(tab, name).press("ArrowLeft")
        assert words(tab) != before, name
    for name in [*SLIDERS, *BUMP_SLIDERS]:
        value = slider(tab, name).get_attribute("aria-valuetext")
        assert re.match(r"[\d.]+ \S", value), name
    tab.get_by_role("button", name="Crank-Nicolson").press("Enter")
    assert "Crank-Nicolson" in words(tab)
    pressed = tab.get_by_role("button", name="Crank-Nicolson").get_attribute("aria-pressed")
    assert pressed == "true"
    slider(tab, "Speed v (m/s)").press("End")
    slider(tab, "Speed v (m/s)").press("PageDown")
    assert 10 < shown(tab)[0]["v"] < 20  # not at once to the other end


def test_typed_numbers_are_taken_exactly(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    for text, v in (
        ("7.5", 7.5),
        ("0,5", 0.5),
        ("25", 25),
        ("0.1", 0.1),
        ("1.23456789", 1.23456789),
    ):
        type_in(tab, SLIDERS[0], text)
        assert shown(tab)[0]["v"] == v
    type_in(tab, SLIDERS[1], "0,7")
    assert shown(tab)[0]["dt"] == pytest.approx(0.0007, rel=1e-15)


def test_what_is_out_of_range_is_said_and_changes_nothing(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    field = tab.get_by_role("textbox", name=f"{SLIDERS[0]}, typed")
    for text in ("-3", "100", "fast", ""):
        type_in(tab, SLIDERS[0], text)
        tab.get_by_role("alert").filter(has_text=re.compile("0.1 to 25 m/s")).wait_for()
        assert shown(tab)[0]["v"] == 1.2
        assert field.get_attribute("aria-invalid") is not None
        field.blur()
        assert field.input_value() == "1.2" and field.get_attribute("aria-invalid") is None


def test_the_words_say_what_the_run_says(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    text, (page, rows) = words(tab), shown(tab)
    T = page["dt"] * np.arange(rows.shape[1])
    loss = first_loss(T, rows[4:])
    wheel = ("rear", "front")[loss.wheel - 1]
    assert text.lstrip("✗ ").startswith(f"Contact lost ({wheel} wheel, ")
    t, X = map(float, re.search(r"t = ([\d.]+) s, X = ([\d.]+) m", text).groups())
    assert t == pytest.approx(loss.t, rel=5e-3)
    assert X == pytest.approx(loss.t * page["v"], rel=5e-3)
    least = float(re.search(r"Least force (-?[\d.]+) N", text)[1])
    assert least == pytest.approx(rows[4:].min(), rel=5e-3)
    R = SCHEMES[3].one_step(Robot(793.2, 793.2).A, page["dt"])[0]
    assert f"the largest |R| = {np.abs(np.linalg.eigvals(R)).max():.5f}" in text


# Where a green tick stood although the exact motion loses contact, or the other way round.
DOUBTS = [
    ("Crank-Nicolson", 1.2, 100),
    ("Crank-Nicolson", 1.2, 200),
    ("Crank-Nicolson", 5, 50),
    ("Crank-Nicolson", 5, 200),
    ("RK4", 25, 5),
]


def test_a_run_that_misses_a_loss_is_not_believed(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    for scheme, v, dt in DOUBTS:
        go_to(tab, scheme=scheme, v=v, dt=dt / 1000)
        text = headline(tab)
        assert tone(tab) == "doubt", text
        assert re.search(r"Exactly: contact lost \((rear|front) wheel", text), text
        assert "The run says: contact" in words(tab)
        page = shown(tab)[0]  # the moment shown is that of the exact loss
        t = float(re.search(r"t = ([\d.]+) s   X", words(tab))[1])
        assert t == pytest.approx(page["exact"]["lost"]["t"], rel=5e-3)


def test_the_headline_is_never_surer_than_the_exact_margin(visit, pages):
    tab, rng = visit(f"{pages.as_uri()}/bump.html"), np.random.default_rng(12)
    tones = set()
    for _ in range(30):
        settings = {
            name: place(reach, rng) for name, reach in ranges_of(Family(*PAGES["bump"])).items()
        }
        settings["sigma"] = 0.01 + 0.2 * settings["sigma"]  # so that no wheel starts on the bump
        go_to(tab, scheme=rng.choice([scheme.name for scheme in SCHEMES]), **settings)
        text, exact = headline(tab), tab.locator(VIEW).evaluate("root => root.trajectory().exact")
        lost = bool(exact["lost"])
        tones.add(tone(tab))
        if tone(tab) == "kept":
            assert not lost and text.lstrip("✓ ").startswith("Contact kept"), text
        elif tone(tab) == "lost":
            assert lost and text.lstrip("✗ ").startswith("Contact lost"), text
        else:
            assert ("Exactly: contact lost" in text) == lost, text
        assert (
            lost == (margin(*family_at(settings), settings["v"]) < 0) or abs(exact["least"]) < 0.01
        )
    assert tones == {"kept", "lost", "doubt"}


def test_an_unstable_run_is_called_one_and_drawn(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    slider(tab, SLIDERS[1]).press("End")
    slider(tab, SLIDERS[0]).press("Home")
    text = words(tab)
    assert "Unstable: RK4 at Δt = 200 ms makes a mode grow by |R| = " in text
    assert tone(tab) == "doubt" and not re.search(r"NaN|Infinity|undefined|null", text)
    _, rows = shown(tab)
    assert np.isfinite(rows).all() and np.abs(rows).max() > 1e50
    drawn = tab.locator(".se-forces").evaluate("""canvas => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      return data.filter((value, i) => i % 4 === 3 && value > 0).length / (data.length / 4);
    }""")
    assert drawn > 0.05


def test_it_really_flies(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    tab.get_by_role("button", name="5 m/s", exact=True).click()
    tab.get_by_role("button", name="Flying").click()
    flight = fly(*PAGES["bump"], v=5, tfinal=0.25)
    assert headline(tab).lstrip("✗ ").startswith("Off the ground")
    page = shown(tab)[0]
    found = [(event["wheel"] + 1, event["kind"]) for event in page["events"]]
    assert found == [(event.wheel, event.kind) for event in flight.events]
    air = re.search(r"rear ([\d.]+) ms, front ([\d.]+) ms", words(tab)).groups()
    np.testing.assert_allclose(np.array(air, float) / 1000, flight.airtime, rtol=0.01)
    tab.get_by_role("link", name="at 5 m/s").click()
    t = float(re.search(r"t = ([\d.]+) s   X", words(tab))[1])
    highest = flight.T[flight.gaps.max(axis=0).argmax()]
    assert t == pytest.approx(highest, rel=0.02)  # the moment shown is in the air
    type_in(tab, SLIDERS[0], "0.25")
    assert "No wheel leaves the ground" in headline(tab) and tone(tab) == "kept"


def drag(tab, panel, start, end):
    box = tab.locator(f".se-{panel}").bounding_box()
    at = [(box["x"] + x * box["width"], box["y"] + y * box["height"]) for x, y in (start, end)]
    tab.mouse.move(*at[0])
    tab.mouse.down()
    tab.mouse.move(*at[1], steps=5)
    tab.mouse.up()
    settle(tab)


def test_the_pictures_can_be_grabbed(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    state = "({moment: Number(document.querySelector('.se-moment').value)})"
    before = tab.evaluate(state)["moment"]
    drag(tab, "robot", (0.5, 0.5), (0.7, 0.5))
    assert tab.evaluate(state)["moment"] > before + 0.05
    drag(tab, "forces", (0.3, 0.5), (0.9, 0.6))
    assert tab.evaluate(state)["moment"] > 0.8
    drag(tab, "speeds", (0.5, 0.5), (0.75, 0.5))
    assert 2 < shown(tab)[0]["v"] < 10
    type_in(tab, SLIDERS[1], "50")
    settle(tab)
    place = tab.locator(VIEW).evaluate("root => root.modesAt()")
    for x, y in place[:1]:
        drag(tab, "stability", (x, y), (x + 0.3 * (place[-1][0] - x), 0.5 + (y - 0.5) * 0.6))
    assert 0.0005 < shown(tab)[0]["dt"] < 0.049


def test_the_map_over_speed_and_stiffness_sets_both(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    curve = pictures(tab)["se-speeds"]
    tab.get_by_role("button", name="Map over v and k").click()
    tab.wait_for_timeout(1500)
    filled = pictures(tab)["se-speeds"]
    assert filled != curve
    assert "stiffness" in tab.locator(".se-speeds").get_attribute("aria-label")
    drag(tab, "speeds", (0.5, 0.5), (0.8, 0.3))
    page = shown(tab)[0]
    assert 5 < page["v"] < 15 and 1000 < page["k"] < 2200
    assert (page["exact"]["lost"] is not None) == (page["exact"]["least"] <= 0)
    tab.get_by_role("button", name="Map over v and k").click()
    assert pictures(tab)["se-speeds"] != filled


def test_presets_pins_and_reset(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    start = shown(tab)[0], pictures(tab)
    for v in ("0.25", "1.2", "5", "10"):
        tab.get_by_role("button", name=f"{v} m/s", exact=True).click()
        assert shown(tab)[0]["v"] == float(v)
    tab.get_by_role("button", name="Pin to compare").click()
    pinned = pictures(tab)
    assert pinned["se-robot"] != start[1]["se-robot"]
    slider(tab, SLIDERS[3]).press("PageDown")
    text, with_pin = look(tab)
    assert "Pinned, in grey at the same X: v = 10 m/s, k = 793 N/m, c = 1.5 N s/m, RK4" in text
    tab.get_by_role("button", name="Unpin 10 m/s").click()
    assert pictures(tab)["se-forces"] != with_pin["se-forces"] != pinned["se-forces"]
    assert "Pinned" not in words(tab)
    tab.get_by_role("button", name="Pin to compare").click()
    tab.get_by_role("button", name="Flying").click()
    tab.get_by_role("button", name="Long steps").click()
    page = shown(tab)[0]
    assert (page["v"], page["dt"], page["scheme_index"]) == (5, 0.05, 2)
    tab.get_by_role("button", name="Reset").click()
    assert {key: shown(tab)[0][key] for key in ("v", "dt", "k", "c")} == {
        key: start[0][key] for key in ("v", "dt", "k", "c")
    }
    assert "Pinned, in grey at the same X: v = 10 m/s" in words(tab)  # Reset keeps it
    tab.get_by_role("button", name="Unpin 10 m/s").click()
    assert pictures(tab) == start[1]


def test_a_pinned_run_shares_the_axes_and_is_in_the_address(visit, pages):
    """The peaks of a stiff run stay in the picture when a soft one is beside it."""
    tab = visit(f"{pages.as_uri()}/bump.html", init=WRITTEN)

    def highest():
        settle(tab)
        tab.evaluate("written.length = 0")
        tab.set_viewport_size({"width": 1200, "height": tab.viewport_size["height"] + 20})
        settle(tab)
        forces = tab.evaluate("""() => {
          const picture = document.querySelector(".se-forces"), { height } = picture;
          return written.filter((line) => line[1] < 38 && line[5] === height && line[3] > 40
            && /^[−\\d.]+$/.test(line[0])).map(([text]) => Number(text.replace("−", "-")));
        }""")
        return max(forces)

    stiff = highest()
    go_to(tab, k=300)
    assert highest() < stiff
    go_to(tab, **{"k": 300, "pin.v": 1.2, "view": "speeds", "mapped": "true", "pace": "same"})
    assert highest() == stiff
    text = words(tab)
    assert "Pinned, in grey at the same X: v = 1.2 m/s, k = 793 N/m" in text
    type_in(tab, SLIDERS[0], "1.3")
    tab.wait_for_function("location.hash.includes('v=1.3') && location.hash.includes('pin.v=1.2')")
    assert all(part in tab.url for part in ("k=300", "view=speeds", "mapped=true", "pace=same"))
    before = look(tab)
    tab.reload()
    tab.wait_for_selector(f"{BOX} canvas[aria-label]")
    tab.wait_for_timeout(1500)  # the map
    assert look(tab) == before
    assert (
        tab.get_by_role("button", name="Map over v and k").get_attribute("aria-pressed") == "true"
    )
    assert tab.get_by_role("combobox", name="Scale of time").input_value() == "same"


def test_what_one_did_is_undone_and_done_again(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    undo, redo = (tab.get_by_role("button", name=name, exact=True) for name in ("Undo", "Redo"))
    assert undo.get_attribute("aria-disabled") == redo.get_attribute("aria-disabled") == "true"
    states = [look(tab)]
    for act in (
        lambda: tab.get_by_role("button", name="5 m/s", exact=True).click(),
        lambda: tab.get_by_role("button", name="Pin to compare").click(),
        lambda: drag(tab, "speeds", (0.5, 0.5), (0.75, 0.5)),
        lambda: tab.get_by_role("button", name="Flying").click(),
        lambda: tab.get_by_role("button", name="Reset").click(),
    ):
        act()
        states.append(look(tab))
    for state in states[-2::-1]:
        undo.click()
        assert look(tab) == state
    assert undo.get_attribute("aria-disabled") == "true"
    redo.click()
    assert look(tab) == states[1]
    slider(tab, SLIDERS[2]).press("Control+Shift+Z")
    assert look(tab) == states[2]
    slider(tab, SLIDERS[2]).press("Control+z")
    tab.keyboard.press("Control+z")
    assert look(tab) == states[0]
    type_in(tab, SLIDERS[0], "7")
    tab.keyboard.press("Control+z")  # in the number, which is as it was set
    assert shown(tab)[0]["v"] == 1.2


def test_the_address_keeps_the_state(visit, address):
    tab = visit(f"{address}bump.html")
    type_in(tab, SLIDERS[0], "7.5")
    tab.get_by_role("button", name="Flying").click()
    tab.wait_for_function("location.hash.includes('v=7.5') && location.hash.includes('flying')")
    tab.reload()
    tab.wait_for_selector(f"{BOX} canvas[aria-label]")
    assert shown(tab)[0]["v"] == 7.5 and headline(tab).startswith("Off the ground")
    tab.goto("about:blank")
    tab.go_back()
    tab.wait_for_selector(f"{BOX} canvas[aria-label]")
    assert shown(tab)[0]["v"] == 7.5
    tab.get_by_role("button", name="Reset").click()
    tab.wait_for_function("location.hash === ''")


def test_a_link_is_where_undo_ends(visit, address):
    """Who opens one and changes something comes back to it, not to how the page begins."""
    tab = visit(f"{address}bump.html#explore:v=7.5&motion=flying")
    undo = tab.get_by_role("button", name="Undo", exact=True)
    assert undo.get_attribute("aria-disabled") == "true"
    slider(tab, SLIDERS[0]).press("Control+z")
    assert shown(tab)[0]["v"] == 7.5
    slider(tab, SLIDERS[0]).press("End")
    undo.click()
    assert shown(tab)[0]["v"] == 7.5 and headline(tab).startswith("Off the ground")
    assert undo.get_attribute("aria-disabled") == "true"


def test_phrases_and_links_set_the_picture(visit, address):
    tab = visit(f"{address}bump.html")
    tab.get_by_role("link", name="at 5 m/s").click()
    assert shown(tab)[0]["v"] == 5 and headline(tab).lstrip("✗ ").startswith("Off the ground")
    tab.get_by_role("link", name="by a long step").click()
    assert tone(tab) == "doubt" and (shown(tab)[0]["v"], shown(tab)[0]["dt"]) == (1.2, 0.1)
    tab.wait_for_timeout(1300)
    tab.go_back()
    assert shown(tab)[0]["v"] == 5
    tab.go_back()
    assert (shown(tab)[0]["v"], shown(tab)[0]["dt"]) == (1.2, 0.001)
    other = visit(f"{address}bump.html#explore:v=99&k=x&facts=1&scheme=nothing&dt=0.002")
    assert (shown(other)[0]["v"], shown(other)[0]["dt"]) == (25, 0.002)  # at most what is offered


def test_what_one_takes_away_is_what_is_shown(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    type_in(tab, SLIDERS[0], "7.5")
    type_in(tab, SLIDERS[1], "2")
    tab.get_by_text("Take away").click()
    _, rows = shown(tab)
    code = tab.locator(".se-python").inner_text()
    namespace = {}
    exec(code, namespace)
    assert np.abs(namespace["run"].N - rows[4:]).max() < PARITY
    with tab.expect_download() as download:
        tab.get_by_role("button", name="Numbers (CSV)").click()
    table = np.loadtxt(download.value.path(), delimiter=",", skiprows=1)
    np.testing.assert_array_equal(table[:, 2:].T, rows)
    with tab.expect_download() as download:
        tab.get_by_role("button", name="Picture (PNG)").click()
    assert download.value.path().read_bytes()[:4] == b"\x89PNG"
    assert download.value.path().stat().st_size > 20_000
    tab.get_by_role("button", name="Picture (PNG)").press("Escape")
    assert not code_shown(tab)
    assert tab.evaluate("document.activeElement.localName") == "summary"
    tab.keyboard.press("Enter")
    assert code_shown(tab)
    tab.locator(".se-robot").click()
    assert not code_shown(tab)


def code_shown(tab):
    return tab.locator(".se-python").is_visible()


def test_the_bands_lie_under_the_handle(visit, pages):
    """Where the colour of the speed's track changes, the handle stands at that speed."""
    tab = visit(f"{pages.as_uri()}/bump.html")
    track = slider(tab, SLIDERS[0])
    track.press("Home")
    critical = shown(tab)[0]["critical"]
    settle(tab)
    row = np.asarray(Image.open(io.BytesIO(track.screenshot())).convert("RGB"), dtype=int)
    line = row[row.shape[0] // 2, 24:-4]  # past the handle
    changes = 24 + np.flatnonzero(np.abs(np.diff(line, axis=0)).sum(axis=1) > 60) + 1
    places = 10 + (row.shape[1] - 20) * np.log(np.array(critical) / 0.1) / np.log(250)
    assert len(critical) == 3
    np.testing.assert_allclose(
        sorted({changes[np.abs(changes - x).argmin()] for x in places}), places, atol=1.6
    )
    ticks = row[6, 24:].sum(axis=1) < 600
    assert len(np.flatnonzero(np.diff(ticks.astype(int)) > 0)) == len(critical)
    ticks = row[-7, 24:].sum(axis=1) < 600
    assert len(np.flatnonzero(np.diff(ticks.astype(int)) > 0)) == 4  # the asked speeds


def test_play_moves_the_robot_and_stops_when_told(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    moment = slider(tab, "Moment")

    def now():
        return float(moment.input_value())

    start = now()
    tab.wait_for_timeout(300)
    assert now() == start  # a whole one does not start by itself
    tab.get_by_role("button", name="Play").click()
    tab.wait_for_timeout(300)
    assert 0 < now() < start  # the first play begins at the start, before the bump
    tab.wait_for_timeout(900)
    tab.get_by_role("button", name="Pause").click()
    tab.wait_for_timeout(300)  # the last frame may still have to be drawn
    rest = now()
    tab.wait_for_timeout(300)
    assert now() == rest
    tab.get_by_role("button", name="Play").click()
    moment.press("Home")
    tab.get_by_role("button", name="Play").wait_for()  # who takes the slider, stops it
    moment.press("End")
    tab.get_by_role("button", name="Play").click()
    tab.wait_for_timeout(400)
    assert 0 < now() < 0.5  # from the end, over again


def scales(tab):
    """What the list beside Play says, of every run in the same time and of all slowed alike."""
    options = tab.get_by_role("combobox", name="Scale of time").locator("option").all_inner_texts()
    return [text.translate(PLAIN) for text in options]


def test_the_clock_says_its_scale_of_time(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    seen = {}
    for v in (0.25, 1.2, 10):
        type_in(tab, SLIDERS[0], f"{v:g}")
        settle(tab)
        seen[v] = scales(tab)
    assert seen == {
        0.25: ["8 s: slowed 1.6 x", "always slowed 8 x"],
        1.2: ["8 s: slowed 7.7 x", "always slowed 8 x"],
        10: ["8 s: slowed 64 x", "always slowed 8 x"],
    }
    tab.get_by_role("combobox", name="Scale of time").select_option("same")
    moment, places = slider(tab, "Moment"), []
    for v in (10, 1):
        type_in(tab, SLIDERS[0], f"{v:g}")
        moment.press("Home")
        tab.get_by_role("button", name="Play").click()
        tab.wait_for_timeout(400)
        places.append(float(moment.input_value()))
        tab.get_by_role("button", name="Pause").click()
    assert 4 < places[0] / places[1] < 20  # ten times as far along, in as much time
    tab.get_by_role("button", name="1.2 m/s", exact=True).click()  # to the loss of contact
    assert scales(tab)[0] == "8 s: slowed 23 x"


def test_one_steps_from_event_to_event_by_buttons_and_keys(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    go_to(tab, v=5, motion="flying", time=0)
    flight, seen = fly(*PAGES["bump"], v=5, tfinal=0.25), []
    on, back = (tab.get_by_role("button", name=f"{way} event") for way in ("Next", "Previous"))
    for _ in range(30):
        if on.get_attribute("aria-disabled") == "true":
            break
        on.click()
        text = words(tab)
        seen.append(
            (float(re.search(r"t = ([\d.]+) s   X", text)[1]), text.split("   ")[-1].strip())
        )
    turns = [(t, what) for t, what in seen if "leaves" in what or "lands" in what]
    assert len(turns) == len(flight.events) == 4
    for (t, what), event in zip(turns, flight.events, strict=True):
        assert t == pytest.approx(event.t, abs=1.1e-3)
        wheel = ("rear", "front")[event.wheel - 1]
        how = {"lift-off": "leaves the ground", "landing": "lands"}[event.kind]
        assert what == f"{wheel} wheel {how}"
    assert seen[-1][1] == "the end"
    assert {"front wheel on top of the bump", "rear wheel on top of the bump"} < {
        w for _, w in seen
    }
    for v, event in (("0.25", "least force, "), ("1.2", "front wheel: contact lost")):
        go_to(tab, v=10)
        tab.get_by_role("button", name=f"{v} m/s", exact=True).click()
        assert event in words(tab)  # where one looks first is an event, not close to one
    go_to(tab, v=5, motion="flying", time=1)
    back.click()
    assert seen[-2][1] in words(tab)
    slider(tab, "Moment").press(",")
    assert seen[-3][1] in words(tab)
    slider(tab, "Moment").press(".")
    assert seen[-2][1] in words(tab)
    assert slider(tab, "Moment").get_attribute("aria-valuetext").endswith(seen[-2][1])


@pytest.mark.parametrize("name", [RACE, SMALL])
def test_a_small_picture_plays_once_by_itself_when_it_is_seen(visit, pages, name):
    tab = visit(f"{pages.as_uri()}/{name}.html", viewport={"width": 900, "height": 700})
    moment = slider(tab, "Moment")

    def now():
        return float(moment.input_value())

    tab.get_by_role("button", name="Pause").wait_for()
    assert now() < 0.2
    first = now()
    tab.wait_for_timeout(500)
    assert now() > first
    tab.get_by_role("button", name="Play").wait_for(timeout=40_000)
    settle(tab)  # the button is renamed a frame before the moment is drawn
    rest = now()
    assert rest == 1 if name == RACE else 0.05 < rest < 0.12  # ready for a reader's own play
    tab.mouse.wheel(0, 2000)
    tab.mouse.wheel(0, -2000)
    tab.wait_for_timeout(500)
    assert now() == rest and "explore" not in tab.url  # once, and the address says nothing
    calm = visit(f"{pages.as_uri()}/{name}.html", reduced_motion="reduce")
    opened = slider(calm, "Moment").input_value()
    calm.wait_for_timeout(700)
    assert slider(calm, "Moment").input_value() == opened
    touched = visit(f"{pages.as_uri()}/{name}.html")
    touched.get_by_role("button", name="Pause").click()
    touched.wait_for_timeout(100)  # the last picture is drawn with the next frame
    stopped = slider(touched, "Moment").input_value()
    touched.wait_for_timeout(500)
    assert slider(touched, "Moment").input_value() == stopped


def test_the_race_shows_who_leaves_the_ground(visit, pages):
    tab = visit(f"{pages.as_uri()}/{RACE}.html", init=WRITTEN, reduced_motion="reduce")
    assert "At which of these speeds" in headline(tab)
    slider(tab, "Moment").press("End")
    settle(tab)
    tab.evaluate("written.length = 0")
    slider(tab, "Moment").press("ArrowLeft")
    slider(tab, "Moment").press("ArrowRight")
    settle(tab)
    lanes = [text.translate(PLAIN) for text, *_ in tab.evaluate("written")][-8:]
    said = dict(zip(lanes[::2], lanes[1::2], strict=True))
    for v in problem.SPEEDS:
        lost = margin(*PAGES["bump"], v) < 0
        assert said[f"{v:g} m/s"].endswith("left the ground" if lost else "stayed on the ground")
    kept = [v for v in problem.SPEEDS if margin(*PAGES["bump"], v) > 0]
    assert f"At {kept[0]:g} and {kept[1]:g} m/s both wheels stay" in headline(tab)
    label = tab.locator("canvas.se-race").get_attribute("aria-label").translate(PLAIN)
    assert headline(tab) in label
    before = float(slider(tab, "Moment").input_value())
    drag(tab, "race", (0.9, 0.5), (0.5, 0.5))
    assert float(slider(tab, "Moment").input_value()) < before


def test_bump_and_robot_are_in_the_picture_or_a_strip_says_where_one_is(visit, pages):
    """The strip's mark moves along with the robot, from one end of the road to the other."""
    tab = visit(f"{pages.as_uri()}/bump.html", reduced_motion="reduce")
    strip = """canvas => {
      const g = canvas.getContext("2d"), ratio = devicePixelRatio;
      const { width } = canvas, from = Math.round(0.6 * width), row = Math.round(19 * ratio);
      const { data } = g.getImageData(from, row, width - from, 1);
      const dark = [];
      for (let x = 0; x < width - from; x++) {
        if (data[4 * x + 3] > 200 && data[4 * x] < 60) dark.push(x);
      }
      return [dark[0], dark.at(-1)];
    }"""
    places = []
    for time in (0, 0.25, 0.5, 1):
        go_to(tab, time=time)
        settle(tab)
        places.append(tab.locator(".se-robot").evaluate(strip))
    starts = [start for start, _ in places]
    assert starts == sorted(starts) and starts[-1] > starts[0] + 100
    shares = np.diff(starts) / (starts[-1] - starts[0])
    np.testing.assert_allclose(shares, [0.25, 0.25, 0.5], atol=0.02)


def test_the_key_tells_what_is_solid_faint_a_dot_a_tick_and_a_band(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html", init=WRITTEN)
    key = tab.locator(".se-key")
    assert len(key.inner_text().split("\n")) == 2
    assert "Solid: the linear model" in key.inner_text() and "its wheels free" in key.inner_text()
    assert all(word in key.inner_text() for word in ("dots", "ticks", "bands", "pale"))
    assert "Least force (N) at every speed, linear model" in [
        text for text, *_ in tab.evaluate("written")
    ]
    go_to(tab, v=5, motion="flying")
    settle(tab)
    assert "Solid: wheels are free to leave" in key.inner_text()
    assert "faint: the linear model" in key.inner_text() and "half the height" in key.inner_text()
    go_to(tab, v=0.25, motion="flying")
    assert "No wheel leaves the ground: flying and linear are the same." in words(tab)
    assert "faint" not in key.inner_text() and "flying is the same" in key.inner_text()


def test_the_landing_page_says_which_model_each_picture_shows(visit, site, book):
    caption = parse(book / "book" / "index.html").select_one("#fig-landing figcaption").text
    assert "The curves are those of the linear model" in caption
    assert "so is the faint robot; the other one is free to leave the ground" in caption
    tab = visit(f"{site}book/index.html", init=WRITTEN, reduced_motion="reduce")
    title = "Least force (N) at every speed, linear model"
    tab.locator(BOX).last.evaluate("box => box.scrollIntoView()")
    tab.wait_for_function("title => written.some(([text]) => text === title)", arg=title)
    race, _, small = (text.inner_text() for text in tab.locator(".se-key").all())
    assert "where a wheel was off the ground" in race
    assert "Solid: wheels are free to leave the ground" in small


def test_a_flight_follows_the_scheme_and_the_step(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    seen = {}
    for scheme in ("Euler", "Backward Euler", "Crank-Nicolson", "RK4"):
        go_to(tab, v=5, motion="flying", dt=0.005, scheme=scheme, time=0.9)
        seen[scheme] = look(tab)
        assert f"By {scheme} at Δt = 5 ms" in seen[scheme][0] or "Unstable" in seen[scheme][0]
        assert shown(tab)[0]["flightStep"] == 0.005
    for panel in ("se-robot", "se-forces"):
        assert len({drawn[panel] for _, drawn in seen.values()}) == 4, panel
    go_to(tab, v=25, motion="flying", dt=0.005)
    text = headline(tab)
    assert tone(tab) == "doubt" and "This flight misses a lift-off. Exactly: wheels lift" in text


def test_who_wants_little_motion_gets_steps(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html", reduced_motion="reduce")
    moment = slider(tab, "Moment")
    start = float(moment.input_value())
    tab.get_by_role("button", name="Step", exact=True).click()
    tab.wait_for_timeout(500)
    assert float(moment.input_value()) == pytest.approx(start + 0.05)


def test_a_screen_reader_hears_the_headline_once(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    tab.evaluate("""() => {
      window.spoken = [];
      const region = document.querySelector(".se-spoken");
      new MutationObserver(() => spoken.push(region.textContent))
        .observe(region, { childList: true, characterData: true, subtree: true });
    }""")
    for _ in range(12):
        slider(tab, SLIDERS[0]).press("ArrowLeft")
        tab.wait_for_timeout(60)
    tab.wait_for_timeout(1200)
    spoken = tab.evaluate("spoken")
    assert len(spoken) == 1 and len(spoken[0]) < 160
    assert tab.locator("[aria-live], [role=status]").count() == 1


def test_it_follows_the_theme_while_it_changes(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    light = pictures(tab)
    tab.evaluate("document.documentElement.dataset.theme = 'dark'")
    dark = pictures(tab)
    assert all(dark[panel] != light[panel] for panel in light)
    tab.evaluate("document.documentElement.dataset.theme = 'light'")
    assert pictures(tab) == light


def test_forced_colours_keep_the_tracks_and_the_choice(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html", forced_colors="active")
    style = "e => { const s = getComputedStyle(e); return s.backgroundColor + s.color; }"
    chosen, other = (
        tab.get_by_role("button", name=name, exact=True).evaluate(style)
        for name in ("RK4", "Euler")
    )
    assert chosen != other
    assert slider(tab, SLIDERS[0]).evaluate("e => getComputedStyle(e).appearance") == "auto"
    tab.evaluate("document.documentElement.dataset.theme = 'dark'")  # the reader's colours win
    ink = tab.locator(VIEW).evaluate("e => getComputedStyle(e).getPropertyValue('--se-ink')")
    assert ink.strip() == "CanvasText"


@pytest.mark.parametrize("width, height", [(390, 844), (768, 1024), (1366, 768), (2560, 1440)])
def test_it_fits_the_window(visit, pages, width, height):
    viewport = {"width": width, "height": height}
    tab = visit(f"{pages.as_uri()}/bump.html", viewport=viewport, has_touch=width < 1000)
    assert tab.evaluate("document.documentElement.scrollWidth") <= width
    assert not tab.locator(".suspension-explorer-still").is_visible()
    box = tab.locator(BOX).bounding_box()
    assert box["width"] > min(0.9 * width, 1700)
    if width > 1000:  # all of it in one window
        assert box["height"] <= height
        return
    for control in tab.locator(f"{BOX} button, {BOX} input[type=range]").all():
        if control.is_visible():
            assert control.bounding_box()["height"] >= 44
    slider(tab, BUMP_SLIDERS[1]).scroll_into_view_if_needed()
    robot = tab.locator(".se-robot").bounding_box()
    assert robot["y"] >= -1 if width < 560 else True  # in sight while one drags


# Keeps what is written into pictures: [text, left, right, base line, width, height, picture].
WRITTEN = """
window.written = [];
const numbers = new Map(), { fillText } = CanvasRenderingContext2D.prototype;
CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
  if (!numbers.has(this.canvas)) numbers.set(this.canvas, numbers.size);
  const length = this.measureText(text).width, { width, height } = this.canvas;
  const left = x - { left: 0, center: length / 2, right: length }[this.textAlign];
  written.push([text, left, left + length, y, width, height, numbers.get(this.canvas)]);
  fillText.call(this, text, x, y);
};
"""


@pytest.mark.parametrize("width", [320, 390, 768, 1366, 2560])
def test_no_word_in_a_picture_is_cut_or_covers_another(visit, pages, width):
    size = {"width": width, "height": 768 if width > 400 else 844}
    tab = visit(f"{pages.as_uri()}/bump.html", viewport=size, init=WRITTEN)
    states = [
        {"v": 1.1},
        {"v": 1.2, "dt": 0.2, "scheme": "Crank-Nicolson"},
        {"v": 5, "motion": "flying"},
        {"v": 25, "dt": 0.08, "k": 2500, "c": 0, "pin.v": 1.2},
        {"v": 0.1, "dt": 0.07, "scheme": "Euler", "height": 0.06, "pin.v": 1.2},
    ]
    seen = set()
    for state in states:
        settle(tab)
        tab.evaluate("written.length = 0")
        go_to(tab, **state)
        settle(tab)
        for view in ("Speeds", "Stability", "Forces") if width < 560 else ():
            tab.get_by_role("button", name=view, exact=True).click()
            settle(tab)
        found = tab.evaluate("written")
        seen |= {text for text, *_ in found}
        boxes = {}
        for text, left, right, y, w, h, picture in found:
            assert -1 <= left and right <= w + 1 and 9 <= y <= h - 3, (state, text, left, right, w)
            boxes.setdefault(picture, {})[left, y] = text, right
        for written in boxes.values():
            for ((x, y), (text, end)), ((x2, y2), (other, end2)) in combinations(
                written.items(), 2
            ):
                apart = min(end, end2) - max(x, x2) <= 1 or abs(y - y2) >= 10
                assert apart or text == other, (state, text, other)
    held = "held down" if width < 390 else "wheels held down (linear)"
    faint = {"the pinned run", held, "wheels free to lift"}
    marks = {"missed", "contact lost"} | {f"faint: {what}" for what in faint}
    assert seen >= marks | {"N₁ rear", "N₂ front", "exact", "linear"}
    assert width < 500 or seen >= {"pinned", "spring > 16.5 mm"}


@pytest.mark.parametrize("zoom", [2, 4])
def test_enlarged_nothing_is_covered_or_cut(visit, pages, zoom):
    """A window of 1280 by 1024 pixels at 200 and 400 %."""
    viewport = {"width": 1280 // zoom, "height": 1024 // zoom}
    tab = visit(f"{pages.as_uri()}/bump.html", viewport=viewport)
    assert tab.evaluate("document.documentElement.scrollWidth") <= viewport["width"]
    covered = tab.evaluate("""() => [...document.querySelectorAll("button, input, summary")]
      .filter((control) => {
        if (!control.checkVisibility()) return false;
        control.scrollIntoView({ block: "center" });
        const { left, top, width, height } = control.getBoundingClientRect();
        const there = document.elementFromPoint(left + width / 2, top + height / 2);
        return !control.contains(there);
      }).map((control) => control.getAttribute("aria-label") || control.textContent)""")
    assert covered == []


def test_on_paper_the_pictures_keep_their_shape(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    tab.evaluate("""() => {
      window.requestAnimationFrame = () => 0; // as on paper, nothing is drawn anew
      document.querySelector("main").style.width = "600px";
    }""")
    tab.emulate_media(media="print")
    shapes = tab.evaluate("""[...document.querySelectorAll("canvas")].map((canvas) => {
      const { width, height } = canvas.getBoundingClientRect();
      return [width / height, canvas.width / canvas.height];
    })""")
    assert len(shapes) == 4
    for on_paper, drawn in shapes:
        assert on_paper == pytest.approx(drawn, rel=0.02)
    assert not tab.get_by_role("button", name="Reset").is_visible()


def test_a_vertical_swipe_on_a_slider_scrolls(visit, pages):
    tab = visit(
        f"{pages.as_uri()}/bump.html", viewport={"width": 390, "height": 700}, has_touch=True
    )
    for element in (slider(tab, SLIDERS[0]), tab.locator(".se-forces")):
        assert element.evaluate("e => getComputedStyle(e).touchAction") == "pan-y pinch-zoom"


def test_panels_do_not_jump_when_the_words_change(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html", viewport={"width": 1366, "height": 768})
    places = set()
    for key in ("Home", "End", "PageDown", "PageDown", "PageDown"):
        slider(tab, SLIDERS[0]).press(key)
        slider(tab, SLIDERS[1]).press("ArrowRight")
        settle(tab)
        places.add(tab.locator(".se-robot").bounding_box()["y"])
    assert len(places) == 1


def test_without_scripts_a_still_picture_stands_there(browser, pages):
    tab = browser.new_page(java_script_enabled=False)
    tab.goto(f"{pages.as_uri()}/bump.html")
    still = tab.locator("img")
    assert still.is_visible()
    assert still.bounding_box()["height"] > 200
    assert len(still.get_attribute("alt").split()) > 20
    assert not tab.locator(f"{BOX} input, {BOX} button").first.is_visible()
    tab.close()


@pytest.mark.parametrize("width", [390, 1280])
def test_axe_finds_nothing_in_any_state(visit, served, width):
    tab = visit(f"{served}bump.html", viewport={"width": width, "height": 900})
    tab.add_script_tag(path=AXE)
    tab.add_style_tag(
        content="[data-theme=dark] body { background: #121212; color: #eee }"
        "[data-theme=dark] a { color: #8ab4f8 }"
    )

    def press(name):
        tab.get_by_role("button", name=name, exact=True).click()

    states = {
        "at rest": lambda: None,
        "unstable": lambda: slider(tab, SLIDERS[1]).press("End"),
        "flying and compared": lambda: (press("Pin to compare"), press("Flying"), press("5 m/s")),
        "refused, and the map": lambda: (
            type_in(tab, SLIDERS[0], "1000"),
            press("Map over v and k"),
        ),
        "menu": lambda: tab.get_by_text("Take away").click(),
    }
    for state, reach in states.items():
        reach()
        settle(tab)
        found, passed = violations(tab)
        assert passed > 10  # axe did look
        tab.evaluate("document.documentElement.dataset.theme = 'dark'")  # other colours, no more
        settle(tab)
        dark, looked = violations(tab, "color-contrast")
        tab.evaluate("document.documentElement.dataset.theme = 'light'")
        assert looked == 1 or dark
        assert not found + dark, (state, "\n".join(found + dark))


@pytest.mark.parametrize("name", [CHART, RACE, SMALL])
@pytest.mark.parametrize("width", [390, 1280])
def test_axe_finds_nothing_on_a_small_one(visit, served, width, name):
    tab = visit(f"{served}{name}.html", viewport={"width": width, "height": 900})
    tab.add_script_tag(path=AXE)
    settle(tab)
    found, passed = violations(tab)
    assert passed > 10 and not found, "\n".join(found)


def test_the_damping_and_the_height_open_and_close_the_chart_s_window(visit, served):
    tab = visit(f"{served}{CHART}.html")
    canvas = tab.locator("canvas.se-chart")
    opened = look(tab)
    assert "The window is open" in opened[0] and tone(tab) == "kept"
    assert canvas.get_attribute("aria-label").translate(PLAIN).endswith(headline(tab)[-60:])
    slider(tab, CHART_SLIDERS[0]).press("End")
    closed = look(tab)
    assert "The window is closed" in closed[0] and tone(tab) == "lost"
    assert closed[1]["se-chart"] != opened[1]["se-chart"]
    slider(tab, CHART_SLIDERS[1]).press("Home")
    assert "a level road" in words(tab) and tone(tab) == "kept"
    type_in(tab, CHART_SLIDERS[0], "1.5")
    type_in(tab, CHART_SLIDERS[1], "25.4")
    assert look(tab) == opened


def test_the_charts_bump_can_be_taken_hold_of(visit, served):
    tab = visit(f"{served}{CHART}.html")
    state = json.loads(tab.locator(".se-state").text_content())
    low, high = state["facts"]["chart"]["heights"]
    box = tab.locator("canvas.se-chart").bounding_box()
    top, bottom = box["y"] + 24, box["y"] + box["height"] - 33  # as chart.js has it

    def drag(height, to):
        x, places = box["x"] + box["width"] / 2, []
        for h in (height, to):
            places.append(bottom - (bottom - top) * np.log(h / low) / np.log(high / low))
        tab.mouse.move(x, places[0])
        tab.mouse.down()
        tab.mouse.move(x, places[1], steps=3)
        tab.mouse.up()
        return shown(tab)[0]["height"]

    assert drag(0.1, 0.05) == 0.0254  # nothing is there
    assert drag(0.0254, 0.005) == pytest.approx(0.005, rel=0.03)
    assert "from there on" in words(tab) or "at every speed" in words(tab)


def test_long_random_use_complains_of_nothing_and_keeps_its_memory(visit, pages):
    """EXPLORER_MINUTES=10 for the whole of it."""
    tab, rng = visit(f"{pages.as_uri()}/bump.html"), np.random.default_rng(2)
    seconds = 60 * float(os.environ.get("EXPLORER_MINUTES", 0.1))
    use = """async ([seed, seconds]) => {
      let state = seed;
      const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
      const pick = (list) => list[Math.floor(random() * list.length)];
      const box = document.querySelector(".suspension-explorer-box");
      const ranges = [...box.querySelectorAll("input[type=range]")];
      const buttons = [...box.querySelectorAll("button")]
        .filter((button) => !/PNG|CSV|Copy|Full/.test(button.textContent));
      const frame = () => new Promise(requestAnimationFrame);
      const start = performance.now();
      let moves = 0;
      while (performance.now() - start < 1000 * seconds) {
        if (random() < 0.85) {
          const range = pick(ranges);
          range.value = random();
          range.dispatchEvent(new Event("input", { bubbles: true }));
        } else pick(buttons).click();
        moves++;
        await frame();
      }
      box.querySelector(".se-tools .se-more button:nth-of-type(2)").click();
      return moves;
    }"""
    session = tab.context.new_cdp_session(tab)

    def memory():
        session.send("HeapProfiler.collectGarbage")
        usage = session.send("Runtime.getHeapUsage")
        return usage["usedSize"] + usage.get("backingStorageSize", 0)

    slider(tab, SLIDERS[0]).press("Home")  # the longest runs there are
    slider(tab, SLIDERS[1]).press("Home")
    settle(tab)
    moves = tab.evaluate(use, [int(rng.integers(1, 10**6)), seconds / 2])
    before = memory()
    moves += tab.evaluate(use, [int(rng.integers(1, 10**6)), seconds / 2])
    after = memory()
    print(f"{moves} moves, {before / 1e6:.1f} MB, then {after / 1e6:.1f} MB")
    assert moves > 50 and after < before + 6e6


def live_pages(book):
    """The built pages with an explorer."""
    return [page for page in book.rglob("*.html") if MARK in page.read_text(encoding="utf-8")]


def test_every_explorer_of_the_book(visit, site, book):
    pages = live_pages(book)
    assert pages
    rng = np.random.default_rng(11)
    for page in pages:
        tab = visit(site + page.relative_to(book).as_posix(), reduced_motion="reduce")
        for nth in range(tab.locator(BOX).count()):
            compact = "se-compact" in tab.locator(BOX).nth(nth).get_attribute("class")
            chart, race = (
                tab.locator(BOX).nth(nth).locator(f"canvas.se-{name}").count()
                for name in (CHART, RACE)
            )
            names = CHART_SLIDERS if chart else SLIDERS[:1] if compact else [*SLIDERS, "Moment"]
            for name in ["Moment"] if race else names:
                before = look(tab, nth)
                slider(tab, name, nth).press("PageUp" if race else "PageDown")  # it is at the start
                after = look(tab, nth)
                assert after[0] != before[0] and after[1] != before[1], (page, name)
            if nth == 0 and not compact:  # a page's first drives the problem's robot over its bump
                turn(tab, rng, Family(the_robot(), GaussianBump()))
                compare(shown(tab), the_robot(), GaussianBump())


def test_no_page_of_the_book_brings_a_widget_manager(book):
    for page in book.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        assert "embed-amd" not in text and "widget-state+json" not in text, page
    for page in live_pages(book):
        assert page.read_text(encoding="utf-8").count("_static/explorer.js") == 1


def test_phrases_of_the_book_set_its_picture(visit, site, book):
    tab = visit(f"{site}notebooks/12-drive.html")
    links = tab.locator("article a[href^='#explore:']")
    assert links.count() >= 5
    for nth in range(links.count()):
        wanted = dict(
            part.split("=") for part in links.nth(nth).get_attribute("href")[9:].split("&")
        )
        links.nth(nth).click()
        page = shown(tab)[0]
        for name in ("v", "dt", "k"):
            if name in wanted:
                assert page[name] == float(wanted[name])
