"""The game in the built book: driving, hearing, the map, links, all readers."""

import gzip
import json
import re
from functools import cache

import numpy as np
import pytest
from helpers import serve_files
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
from node import PAGE as MODULES

from suspension import course, margin
from suspension.choice import fitted_with
from suspension.problem import SPEEDS

BOX = ".suspension-laboratory.se-game"
# Counts what is asked of the browser's sound.
LISTEN = """() => {
  window.heard = { contexts: 0, open: 0, started: 0, stopped: 0 };
  window.AudioContext = class extends AudioContext {
    constructor() { super(); heard.contexts++; heard.open++; }
    close() { heard.open--; return super.close(); }
    createOscillator() {
      const made = super.createOscillator(), { start, stop } = made;
      made.start = (at) => { heard.started++; start.call(made, at); };
      made.stop = (at) => { if (at === undefined) heard.stopped++; stop.call(made, at); };
      return made;
    }
  };
}"""


@pytest.fixture
def visit(browser, site):
    """Open the page with the game; in the end, no script has complained."""

    def settle(tab):
        tab.locator(BOX).scroll_into_view_if_needed()

    with visiting(browser, site, BOX, settle) as go:
        yield go


@cache
def facts(book):
    """What the built page was handed."""
    html = (book / PAGE).read_text(encoding="utf-8").split('class="suspension-laboratory se-game"')
    return json.loads(html[1].split('class="se-state">')[1].split("</script>")[0])["facts"]


def button(tab, name, exact=True):
    return tab.locator(BOX).get_by_role("button", name=name, exact=exact)


def said(tab):
    return tab.locator(f"{BOX} .se-said").inner_text().replace("\u00a0", " ")


def task(tab):
    return tab.locator(f"{BOX} .se-task").inner_text().replace("\u00a0", " ")


def typed(tab, name):
    return tab.locator(BOX).get_by_label(re.compile(rf"^{name} .*typed$"))


def choose(tab, k, c):
    typed(tab, "Stiffness k").fill(str(k))
    typed(tab, "Damping c").fill(str(c))
    typed(tab, "Damping c").press("Tab")


def drive(tab, *chosen):
    """Drive with what is chosen, and do not wait for the end."""
    if chosen:
        choose(tab, *chosen)
    button(tab, "Drive").click()
    button(tab, "Skip to the end").click()


def rows(tab, caption):
    found = tab.locator(f"{BOX} table", has=tab.locator("caption", has_text=caption))
    rows = found.locator("tbody tr").all()
    return [row.inner_text().replace("\u00a0", " ").split("\t") for row in rows]


def pictures(tab):
    return pixels(tab, BOX)


def pad(tab):
    return tab.locator(f"{BOX} .se-pad")


def place(tab, facts, k, c):
    """Where a suspension is on the map, in pixels of the window."""
    box = pad(tab).bounding_box()
    left, right, top, bottom = 46, box["width"] - 12, 24, box["height"] - 33
    (k0, k1), (c0, c1) = (facts["ranges"][name] for name in "kc")
    x = left + (right - left) * np.log(k / k0) / np.log(k1 / k0)
    y = bottom - (bottom - top) * np.log(c / c0) / np.log(c1 / c0)
    return box["x"] + x, box["y"] + y


def test_a_drive_is_seen_and_then_judged(visit):
    tab = visit()
    assert task(tab).startswith("Keep both wheels on the ground at 0.25, 1.2, 5 and 10 m/s")
    assert said(tab) == "Choose stiffness and damping, then drive."
    before = pictures(tab)
    button(tab, "Drive").click()
    assert said(tab) == "Driving …" and not rows(tab, "At each speed")
    moving = [pictures(tab)[0] for _ in range(3)]
    assert len({before[0], *moving}) == 4
    tab.wait_for_function("!document.querySelector('.se-game .se-said').innerText.includes('…')")
    assert said(tab).startswith("Contact is lost at 1.2 and 5 m/s. With d = 0. So near")
    assert tab.locator(f"{BOX} .se-match").get_attribute("data-tone") == "lost"
    assert [row[3:] for row in rows(tab, "Your attempts")] == [["0", "lost at 1.2 and 5 m/s"]]
    after = pictures(tab)
    assert after[0] != moving[-1] and after[1] != before[1]
    button(tab, "Drive again").click()
    button(tab, "Skip to the end").click()
    assert len(rows(tab, "Your attempts")) == 1 and pictures(tab) == after


def test_the_numbers_are_those_of_python(visit, book):
    tab = visit()
    drive(tab, 300, 1.3)
    robot = course.the_robot().twin
    changed = fitted_with(robot, 300, 1.3)
    exact = [margin(changed, course.Hgauss, v) for v in SPEEDS]
    table = rows(tab, "At each speed")
    for (name, contact, force, where, _), v, least in zip(table, SPEEDS, exact, strict=True):
        assert name == f"{v:g} m/s" and contact == ("kept" if least > 0 else "lost")
        assert force == (f"{least:.3g} N" if least > 0 else "–")
        assert re.match(r"(front|rear), X = 0\.\d+ m$", where)
    d = np.hypot(np.log(300 / robot.k1), np.log(1.3 / robot.c1))
    assert rows(tab, "Your attempts")[0][1:4] == ["300", "1.3", f"{d:.3g}"]
    assert f"To beat: d = {facts(book)['levels'][0]['distance']:.3g}." in task(tab)


def test_a_level_is_passed_then_solved_and_the_map_uncovered(visit, book):
    tab = visit()
    covered = pictures(tab)[1]
    drive(tab, 220, 1.2)
    assert said(tab).startswith("Contact kept at every speed, with d = 1.3. ")
    assert said(tab).endswith("It can be done with 1.05.")
    assert (
        button(tab, "The bump ✓ 1.3").is_visible() and button(tab, "Uncover the map").is_enabled()
    )
    best = facts(book)["levels"][0]["best"]
    drive(tab, np.floor(best["k"]), np.floor(100 * best["c"]) / 100)
    assert "Solved" in said(tab) and button(tab, "Uncover the map").is_disabled()
    words = tab.locator(f"{BOX} .se-plan .se-words").inner_text().replace("\u00a0", " ")
    assert f"{best['k']:.4g} N/m" in words
    tab.wait_for_timeout(1500)
    assert pictures(tab)[1] != covered
    drive(tab, 290, 1.2)
    assert rows(tab, "Your attempts")[-1][-1].endswith("(with the map)")
    button(tab, "Forget these attempts").click()
    assert not rows(tab, "Your attempts") and button(tab, "The bump").is_visible()


def test_an_unknown_road_shows_as_one_drives_over_it(visit, book):
    tab = visit()
    button(tab, "Road B").click()
    road = facts(book)["levels"][2]["bump"]
    kind = "dip" if road["height"] < 0 else "bump"
    assert task(tab).startswith("An unknown road") and "mm" not in task(tab)
    before = pictures(tab)[0]
    button(tab, "Road A").click()
    assert pictures(tab)[0] == before  # nothing tells one from the other
    button(tab, "Road B").click()
    drive(tab)
    assert task(tab).startswith(f"A {kind}. ") and pictures(tab)[0] != before
    button(tab, "Uncover the map").click()
    assert f"{abs(1000 * road['height']):.3g} mm" in task(tab)
    button(tab, "The bump").click()
    assert not rows(tab, "Your attempts")


def test_an_attempt_is_taken_again_from_its_row(visit):
    tab = visit()
    drive(tab, 400, 2)
    first, verdict = pictures(tab)[0], said(tab)
    drive(tab, 250, 1)
    assert said(tab) != verdict
    button(tab, "Take attempt 1 again").click()
    assert typed(tab, "Stiffness k").input_value() == "400"
    assert said(tab) == verdict and pictures(tab)[0] == first
    button(tab, "As it is").click()
    assert button(tab, "As it is").is_disabled() and said(tab).startswith("Choose")


def test_everything_is_done_by_keys(visit, book):
    tab = visit()
    tab.get_by_label("Stiffness k", exact=True).focus()
    for _ in range(5):
        tab.keyboard.press("ArrowLeft")
    k = float(typed(tab, "Stiffness k").input_value())
    assert 770 < k < 790
    typed(tab, "Damping c").focus()
    typed(tab, "Damping c").press("ControlOrMeta+a")
    typed(tab, "Damping c").press_sequentially("1,25")
    tab.keyboard.press("Enter")  # drives, too
    assert said(tab) == "Driving …"
    button(tab, "Skip to the end").press("Enter")
    assert rows(tab, "Your attempts")[0][2] == "1.25"
    pad(tab).focus()
    assert "arrow keys" in pad(tab).get_attribute("aria-label")
    for key, name, ratio in (
        ("ArrowRight", "Stiffness k", np.exp(0.02)),
        ("Shift+ArrowLeft", "Stiffness k", np.exp(-0.1)),
        ("ArrowUp", "Damping c", np.exp(0.02)),
        ("Shift+ArrowDown", "Damping c", np.exp(-0.1)),
    ):
        before = float(typed(tab, name).input_value())
        tab.keyboard.press(key)
        after = float(typed(tab, name).input_value())
        assert after / before == pytest.approx(ratio, rel=2e-3)
    tab.keyboard.press("Enter")
    button(tab, "Skip to the end").press(" ")
    assert len(rows(tab, "Your attempts")) == 2


def test_wrong_input_is_said_in_its_place(visit):
    tab = visit()
    for wrong in ("abc", "", "99", "1e9"):
        box = typed(tab, "Stiffness k")
        box.fill(wrong)
        box.press("Enter")
        assert box.get_attribute("aria-invalid") == "true" and box.input_value() == wrong
        error = tab.locator(f"#{box.get_attribute('aria-describedby')}")
        assert error.inner_text() == "A number from 100 to 3200 is expected."
        assert error.get_attribute("role") == "alert" and not rows(tab, "Your attempts")
    box.fill("300")
    box.press("Tab")
    assert box.get_attribute("aria-invalid") is None and not error.is_visible()


def test_a_place_on_the_map_is_taken_by_mouse(visit, book):
    tab = visit()
    pad(tab).scroll_into_view_if_needed()
    tab.mouse.click(*place(tab, facts(book), 300, 2))
    assert float(typed(tab, "Stiffness k").input_value()) == pytest.approx(300, rel=0.02)
    assert float(typed(tab, "Damping c").input_value()) == pytest.approx(2, rel=0.02)
    tab.mouse.move(*place(tab, facts(book), 300, 2))
    tab.mouse.down()
    tab.mouse.move(*place(tab, facts(book), 1000, 6), steps=6)
    tab.mouse.up()
    tab.mouse.move(0, 0)
    assert float(typed(tab, "Stiffness k").input_value()) == pytest.approx(1000, rel=0.02)


def test_a_finger_taps_pulls_and_scrolls(visit, book):
    tab = visit(**PHONE)
    pad(tab).evaluate("pad => scrollBy(0, pad.getBoundingClientRect().top - 250)")
    tab.wait_for_timeout(200)
    x, y = place(tab, facts(book), 300, 2)
    tab.touchscreen.tap(x, y)
    assert float(typed(tab, "Stiffness k").input_value()) == pytest.approx(300, rel=0.05)
    scrolled = tab.evaluate("scrollY")
    touch(tab, (x, y), place(tab, facts(book), 800, 6))  # the ring is in hand
    assert float(typed(tab, "Stiffness k").input_value()) == pytest.approx(800, rel=0.05)
    assert tab.evaluate("scrollY") == scrolled
    x, y = place(tab, facts(book), 150, 0.6)
    touch(tab, (x, y), (x, y - 120))  # elsewhere the page scrolls
    assert tab.evaluate("scrollY") > scrolled
    assert float(typed(tab, "Stiffness k").input_value()) == pytest.approx(800, rel=0.05)
    for name in ("Stiffness k", "Damping c"):
        assert tab.get_by_label(name, exact=True).bounding_box()["height"] >= 44


def test_a_link_shares_an_attempt(visit):
    tab = visit(permissions=["clipboard-read", "clipboard-write"])
    assert button(tab, "Copy a link to this attempt").is_disabled()
    button(tab, "Road A").click()
    drive(tab, 350, 1.25)
    address = tab.evaluate("location.hash")
    assert address == "#game:road=1&k=350&c=1.25"
    button(tab, "Copy a link to this attempt").click()
    tab.get_by_text("Copied").wait_for()
    assert tab.evaluate("navigator.clipboard.readText()").endswith(address)
    other = visit(address)
    assert said(other) == said(tab) and task(other).startswith("A bump.")
    assert rows(other, "At each speed") == rows(tab, "At each speed")
    assert rows(other, "Your attempts")[0][-1].endswith("(from the link)")
    assert button(other, "Road A").is_visible()  # not passed by who opens it
    for spoiled in ("#game:road=9&k=300&c=1", "#game:k=x", "#game:road=0&k=1e9&c=<b>"):
        broken = visit(spoiled)
        assert said(broken).startswith("Choose") and not rows(broken, "Your attempts")


# --- sound --------------------------------------------------------------------------------------


def heard(tab):
    return tab.evaluate("heard")


@pytest.fixture
def listen(visit):
    """A page that counts what is asked of the browser's sound."""

    def go(**options):
        tab = visit(**options)
        tab.evaluate(LISTEN)
        return tab

    return go


def test_there_is_no_sound_until_it_is_turned_on(listen):
    tab = listen()
    speaker = button(tab, "Sound")
    assert speaker.get_attribute("aria-pressed") == "false"
    drive(tab)
    assert heard(tab) == {"contexts": 0, "open": 0, "started": 0, "stopped": 0}
    assert not tab.locator(f"{BOX} .se-legend").is_visible()
    choose(tab, 500, 1.5)
    speaker.click()  # nothing is driven: nothing to hear
    assert heard(tab)["contexts"] == 1 and heard(tab)["started"] == 0
    assert "an octave higher" in tab.locator(f"{BOX} .se-legend").inner_text()
    button(tab, "Drive").click()
    written = tab.evaluate("document.querySelector('.se-match').score()")
    sounds = sum(len(written[name]) for name in ("voices", "knocks", "chimes"))
    assert heard(tab)["started"] == sounds and heard(tab)["stopped"] == 0
    button(tab, "Skip to the end").click()
    assert heard(tab)["stopped"] == sounds
    speaker.click()
    assert heard(tab)["open"] == 0 and speaker.get_attribute("aria-pressed") == "false"


def test_it_stops_when_the_page_is_hidden_or_the_game_out_of_sight(listen):
    tab = listen()
    button(tab, "Sound").click()
    button(tab, "Drive").click()
    started = heard(tab)["started"]
    assert started > 2
    tab.evaluate("""() => {
      Object.defineProperty(document, "hidden", { get: () => true, configurable: true });
      document.dispatchEvent(new Event("visibilitychange"));
    }""")
    assert heard(tab)["stopped"] == started
    button(tab, "Skip to the end").click()
    button(tab, "Drive again").click()  # still hidden
    assert heard(tab)["started"] == started
    tab.evaluate("delete document.hidden")
    button(tab, "Skip to the end").click()
    button(tab, "Drive again").click()
    again = heard(tab)["started"]
    assert again > started
    tab.evaluate("scrollTo(0, 0)")
    tab.wait_for_timeout(300)
    assert heard(tab)["stopped"] == again


def test_what_is_heard_can_be_chosen_and_is_written(listen):
    tab = listen()
    button(tab, "Sound").click()
    drive(tab)
    captions = tab.locator(f"{BOX} .se-log li")
    tab.locator(f"{BOX} .se-log summary").click()
    assert captions.first.inner_text().replace("\u00a0", " ").startswith("At 1.2 m/s.")
    assert "front wheel leaves the ground" in captions.nth(1).inner_text()
    before = heard(tab)["started"]
    tab.get_by_label("Hear").select_option(label="10\u00a0m/s")
    assert heard(tab)["started"] > before  # driven once more
    button(tab, "Skip to the end").click()
    assert captions.first.inner_text().replace("\u00a0", " ").startswith("At 10 m/s.")
    assert "No silence" in captions.last.inner_text()
    assert len(rows(tab, "Your attempts")) == 1
    assert tab.locator(f"{BOX} .se-caption").inner_text() == captions.last.inner_text()


RENDER = """async ({ facts, level, k, c, lane, wheel }) => {
  const { makeTrack } = await import("./game_run.js"), { play, score } = await import("./sound.js");
  const drive = makeTrack(facts).drive(level, k, c), written = score(drive.lanes[lane]);
  const alone = wheel === null
    ? { ...written, voices: [], chimes: [] }
    : { ...written, voices: [written.voices[wheel]], knocks: [], chimes: [] };
  const context = new OfflineAudioContext(2, 3.2 * 44100, 44100);
  play(context, alone, 0);
  const buffer = await context.startRendering();
  const channels = [0, 1].map((i) => [...buffer.getChannelData(i)]);
  return { channels, score: written, events: drive.lanes[lane].flight.events };
}"""


def test_the_sound_itself_is_silent_in_flight_and_knocks_at_landings(browser, book):
    """What the browser would play, rendered: wheel by wheel, then the knocks alone."""
    asked = {"facts": facts(book), "level": 0, "k": 792.9, "c": 1.5, "lane": 1}
    end = asked["facts"]["distance"] / asked["facts"]["asked"][1]
    with serve_files(MODULES) as address:
        tab = browser.new_page()
        tab.goto(f"{address}sound.js")
        for wheel, base in ((0, 220), (1, 330)):
            found = tab.evaluate(RENDER, asked | {"wheel": wheel})
            near, far = np.array(found["channels"])[[wheel, 1 - wheel]]
            t = np.arange(near.size) / 44100
            assert np.sqrt(np.mean(near**2)) > 4 * np.sqrt(np.mean(far**2))
            rest = near[(t > 0.1) & (t < 0.3)]  # before the bump
            crossings = np.count_nonzero(np.diff(np.sign(rest)) > 0)
            assert crossings / 0.2 == pytest.approx(base, rel=0.06)
            own = [e for e in found["events"] if e["wheel"] == wheel]
            air = [
                (3 * lift["t"] / end, 3 * (land["t"] if land else end) / end)
                for lift, land in zip(own[::2], [*own[1::2], None])
            ]
            longest = max(air, key=lambda ends: ends[1] - ends[0])
            inside = (t > longest[0] + 1e-3) & (t < min(longest[1], 3.0) - 1e-3)
            assert inside.sum() > 2000 and np.abs(near[inside]).max() < 1e-6
            before = near[(t > longest[0] - 0.2) & (t < longest[0] - 0.02)]
            assert np.abs(before).max() > 0.01
        found = tab.evaluate(RENDER, asked | {"wheel": None})
        tab.close()
    both = np.abs(np.array(found["channels"])).max(axis=0)
    for knock in found["score"]["knocks"]:
        assert both[(t > knock["at"]) & (t < knock["at"] + 0.02)].max() > 0.08
    first = min(knock["at"] for knock in found["score"]["knocks"])
    assert both[t < first - 1e-3].max() == 0


def test_who_wants_no_motion_gets_the_verdict_at_once(listen):
    tab = listen(reduced_motion="reduce")
    button(tab, "Sound").click()
    button(tab, "Drive").click()
    assert said(tab).startswith("Contact is lost") and heard(tab)["started"] > 2
    assert heard(tab)["stopped"] == 0  # the sound goes on
    captions = tab.locator(f"{BOX} .se-log li")
    assert tab.locator(f"{BOX} .se-caption").inner_text() == captions.last.text_content()


# --- for everybody ------------------------------------------------------------------------------


def test_a_move_costs_no_frame(visit):
    tab = visit()
    drive(tab)
    button(tab, "Uncover the map").click()
    tab.wait_for_timeout(2500)
    costs = tab.evaluate(
        """async () => {
          const root = document.querySelector(".se-match"), costs = [];
          const slider = root.querySelector("input[type=range]");
          for (let n = 0; n < 60; n++) {
            const done = new Promise((next) =>
              root.addEventListener("painted", (event) => next(event.detail), { once: true }));
            slider.value = String(300 + 5 * n);
            slider.dispatchEvent(new Event("input", { bubbles: true }));
            costs.push(await done);
          }
          return costs.sort((a, b) => a - b);
        }"""
    )
    print(f"{costs[len(costs) // 2]:.1f} ms")
    assert costs[len(costs) // 2] < 8


def test_its_script_comes_where_it_is_needed_and_is_small(book):
    size = len(gzip.compress((book / "_static" / "game.js").read_bytes(), 9))
    print(f"{size / 1000:.0f} kB")
    assert size < 40_000
    assert "game.js" in (book / PAGE).read_text(encoding="utf-8")
    assert "game.js" not in (book / "notebooks" / "12-drive.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("width", [390, 1366])
def test_axe_finds_nothing_whatever_was_done(visit, width):
    tab = visit(viewport={"width": width, "height": 900})

    def act(tab):
        button(tab, "Sound").click()
        drive(tab, 300, 1.5)
        button(tab, "Uncover the map").click()
        typed(tab, "Stiffness k").fill("x")
        typed(tab, "Stiffness k").press("Tab")

    found = objections(tab, BOX, act)
    assert not found, "\n".join(found)
    assert tab.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_forced_colours_leave_everything_to_be_seen(visit):
    tab = visit(forced_colors="active")
    before = pictures(tab)
    drive(tab, 300, 1.5)
    button(tab, "Uncover the map").click()
    tab.wait_for_timeout(1500)
    assert all(one != other for one, other in zip(before, pictures(tab), strict=True))


def test_the_pictures_say_what_they_show(visit):
    tab = visit()
    labels = [c.get_attribute("aria-label") for c in tab.locator(f"{BOX} canvas").all()]
    assert "Before the drive" in labels[0] and "No attempt yet" in labels[1]
    drive(tab, 300, 1.5)
    labels = [c.get_attribute("aria-label") for c in tab.locator(f"{BOX} canvas").all()]
    assert "1.2 m/s: lost: " in labels[0].replace("\u00a0", " ") and "Your attempt" in labels[1]
    assert tab.locator(f"{BOX} .se-said").get_attribute("role") == "status"


def test_without_scripts_and_on_paper_there_is_a_still_picture(browser, site, visit):
    assert "Contact is lost at 1.2 and 5" in still_picture(browser, site, BOX)
    assert gives_way_on_paper(visit(), BOX)


LAB_CELLS = [
    """from suspension import GaussianBump, Robot
from suspension.explorer import Game

game = Game(Robot(800, 800), GaussianBump(), [1.2, 5], [100, 300, 900], [0.5, 1, 2])
game""",
    """print("tried:", [[level, round(k), c] for level, k, c, _ in game.attempts])
print("in Python:", game.judge(game.k, game.c).reached)""",
]


@pytest.mark.slow
def test_the_same_game_is_alive_in_jupyterlab(browser, tmp_path):
    write_notebook(tmp_path / "game.ipynb", LAB_CELLS)
    tab = browser.new_page(viewport={"width": 1300, "height": 1400})
    errors = []
    tab.on("pageerror", lambda error: errors.append(str(error)))
    with serve(tmp_path) as address:
        run_all(tab, address, "game.ipynb", f"{BOX}.se-live")
        assert not tab.locator(f"{BOX} img").is_visible()
        assert not button(tab, "Copy a link to this attempt").count()
        slider = tab.get_by_label("Stiffness k", exact=True)
        slider.scroll_into_view_if_needed()
        box = slider.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        at = float(typed(tab, "Stiffness k").input_value())
        share = np.log(at / 100) / np.log(9)
        tab.mouse.move(box["x"] + 8 + (box["width"] - 16) * share, y)  # its handle
        tab.mouse.down()
        tab.mouse.move(x, y, steps=5)
        tab.mouse.up()
        moved = float(typed(tab, "Stiffness k").input_value())
        assert moved == pytest.approx(300, rel=0.05)
        choose(tab, 250, 1.5)
        button(tab, "Drive").click()
        button(tab, "Skip to the end").click()
        assert said(tab).startswith("Contact kept at every speed")
        tab.locator(".jp-CodeCell .cm-content").last.click()
        tab.keyboard.press("Control+Enter")
        tab.get_by_text("tried: [[0, 250, 1.5]]").wait_for(timeout=60_000)
        tab.get_by_text("in Python: True").wait_for()
    tab.close()
    assert not errors
