"""In reach: by finger, in every window, in large letters and few colours; no word over another."""

import io
import json
from itertools import pairwise

import numpy as np
import pytest
from helpers import FLAGS, find_chromium, swipe
from instruments import settle, write_pages
from PIL import Image

from suspension import problem
from suspension.course import Hgauss, the_robot
from suspension.explorer import explore

BOX = ".suspension-explorer-box.se-live"
LABELS = 200  # settings
SIZES = ((360, 800), (620, 800), (683, 384), (1000, 800), (1900, 800))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Two bare pages: an explorer with all panels, and the chart."""
    folder = tmp_path_factory.mktemp("reach")
    known = {"asked": problem.SPEEDS, "spring_end": problem.DELTA_MAX}
    bodies = {
        name: explore(the_robot(), Hgauss, compact=compact, **known).html()
        for name, compact in (("whole", False), ("chart", "chart"))
    }
    write_pages(folder, bodies)
    return folder


def show(browser, url, **options):
    """A page whose explorers live, in a context of its own."""
    tab = browser.new_context(**options).new_page()
    tab.goto(url)
    tab.wait_for_selector(f"{BOX} canvas[aria-label]", state="attached")
    return tab


# Keeps what is written into each canvas since it was cleared, and which canvas lies under which.
WRITTEN = """
const words = new WeakMap(), under = new WeakMap(), pen = CanvasRenderingContext2D.prototype,
  { clearRect, fillText, drawImage } = pen;
pen.clearRect = function (...box) {
  words.set(this.canvas, []);
  clearRect.apply(this, box);
};
pen.fillText = function (text, x, y) {
  const length = this.measureText(text).width, ratio = devicePixelRatio,
    left = x - { left: 0, center: length / 2, right: length }[this.textAlign],
    corners = [[left, y - 9], [left + length, y - 9], [left, y + 1], [left + length, y + 1]]
      .map(([x, y]) => this.getTransform().transformPoint({ x, y })),
    xs = corners.map(({ x }) => x / ratio), ys = corners.map(({ y }) => y / ratio);
  const box = [xs, ys].flatMap((all) => [Math.min(...all), Math.max(...all)]);
  words.get(this.canvas).push([text, ...box]);
  fillText.call(this, text, x, y);
};
pen.drawImage = function (image, ...place) {
  under.set(this.canvas, image);
  drawImage.call(this, image, ...place);
};
// Draws so many pictures, at random; what was written in them, and what was over or beyond what.
window.draw = async (count, seed) => {
  const box = document.querySelector(".suspension-explorer-box"), seen = new Set(), faults = [],
    random = () => (seed = (seed * 48271) % 2147483647) / 2147483647,
    press = (buttons) => buttons[Math.floor(random() * buttons.length)]?.click();
  for (let n = 0; n < count; n++) {
    for (const range of box.querySelectorAll("input[type=range]")) {
      range.value = random();
      range.dispatchEvent(new Event("input", { bubbles: true }));
    }
    for (const kind of ["[data-index]", "[data-motion]", ".se-tabs button"])
      press([...box.querySelectorAll(kind)].filter((button) => button.checkVisibility()));
    await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
    for (const canvas of box.querySelectorAll("canvas")) {
      if (!canvas.checkVisibility()) continue;
      const written = [...(words.get(under.get(canvas)) ?? []), ...(words.get(canvas) ?? [])],
        pixel = parseFloat(getComputedStyle(document.documentElement).fontSize) / 16,
        edge = canvas.clientWidth + pixel, low = canvas.clientHeight + pixel;
      const strip = canvas.clientWidth - Math.min(0.36 * canvas.clientWidth, 200) - 2,
        onStrip = ([, , right, top]) => canvas.matches(".se-robot") && right > strip && top < 21;
      faults.push(...written.filter(onStrip).map(([text]) => [text, "is on the strip", n]));
      written.forEach(([text, left, right, top, bottom], i) => {
        seen.add(text);
        if (Math.min(left, top) < -pixel || right > edge || bottom > low)
          faults.push([text, "is cut", n]);
        for (const [other, l, r, t, b] of written.slice(0, i)) {
          const [wide, high] = [
            Math.min(right, r) - Math.max(left, l), Math.min(bottom, b) - Math.max(top, t)];
          if (wide > 1 && high > 1) faults.push([text, other, n]);
        }
      });
    }
  }
  return [[...seen], faults];
};
"""
ALWAYS = {  # however narrow: words that no other may take the place of
    "whole": {"N₁ rear", "N₂ front", "kept", "lost", "contact lost", "stable", "X (m)", "t (s)"},
    "chart": {"kept", "lost", "follow", "throw", "skim", "Bump height (mm)"},
}


@pytest.mark.parametrize(("width", "height"), SIZES)
@pytest.mark.parametrize("name", ALWAYS)
def test_no_word_of_a_picture_is_over_another_or_cut(browser, folder, name, width, height):
    tab = browser.new_context(viewport={"width": width, "height": height}).new_page()
    tab.add_init_script(WRITTEN)
    tab.goto(f"{folder.as_uri()}/{name}.html")
    tab.wait_for_selector(f"{BOX} canvas[aria-label]", state="attached")
    seen, faults = tab.evaluate("([count, seed]) => draw(count, seed)", [LABELS, 21 + width])
    tab.context.close()
    assert not faults, (len(faults), faults[:5])
    seen = {{"N₁": "N₁ rear", "N₂": "N₂ front"}.get(text, text) for text in seen}
    assert len(seen) > 50 and seen >= ALWAYS[name]


SWIPE = 150  # pixels


STATE = """() => {
  const shown = document.querySelector(".suspension-explorer").trajectory(),
    { v, dt, k, c, height, sigma, scheme_index } = shown;
  const moment = document.querySelector(".se-moment").value;
  return [v, dt, k, c, height, sigma, scheme_index, Number(moment)];
}"""
TRACK = "[data-trait={}] input[type=range]"
THINGS = [
    *[(TRACK.format(name), share) for name in ("v", "k") for share in (0.2, 0.8)],
    *[
        (name, 0.7)
        for name in (".se-forces", ".se-robot", ".se-moment", ".se-play", ".se-tabs button")
    ],
]


def at(tab, name, share):
    """A point of a thing: a share of its width, of a slider's way, or its handle (None)."""
    found = tab.locator(f"{BOX} {name}").first
    box = found.bounding_box()
    share = float(found.input_value()) if share is None else share
    way = box["width"] - 20 if "range" in name else box["width"]
    return box["x"] + (box["width"] - way) / 2 + share * way, box["y"] + box["height"] / 2


@pytest.fixture
def phone(browser, folder):
    """The whole explorer on a phone, with room to scroll."""
    size = {"width": 390, "height": 844}
    tab = show(
        browser, f"{folder.as_uri()}/whole.html", viewport=size, has_touch=True, is_mobile=True
    )
    tab.add_style_tag(content="body { padding: 10px 0 900px }")
    settle(tab)
    yield tab
    tab.context.close()


def test_a_swipe_that_begins_on_anything_scrolls_and_sets_nothing(phone):
    start = phone.evaluate(STATE)
    things = [*THINGS, (TRACK.format("v"), None), (TRACK.format("k"), None)]
    for name, share in things:
        for dx in (0, 30, -40):
            phone.evaluate("scrollTo(0, 0)")
            phone.wait_for_timeout(100)
            swipe(phone, *at(phone, name, share), dx, -SWIPE)
            assert phone.evaluate("scrollY") > SWIPE / 2, (name, dx)
            assert phone.evaluate(STATE) == start, (name, dx)


def test_a_sideways_pull_moves_a_slider_by_its_way_and_a_picture_in_time(phone):
    for name, share, value in [
        (TRACK.format("v"), None, 0),
        (TRACK.format("v"), 0.1, 0),
        (TRACK.format("k"), None, 2),
        (".se-moment", 0.9, 7),
        (".se-forces", 0.3, 7),
        (".se-robot", 0.5, 7),
    ]:
        before = phone.evaluate(STATE)
        swipe(phone, *at(phone, name, share), 60, 6)
        after = phone.evaluate(STATE)
        changed = [n for n, (old, new) in enumerate(zip(before, after, strict=True)) if old != new]
        assert value in changed and set(changed) <= {value, 7}, name
        assert phone.evaluate("scrollY") == 0
        if value == 0:  # from where it was, not from where the finger came down
            way = phone.locator(f"{BOX} {name}").bounding_box()["width"] - 20
            assert after[0] / before[0] == pytest.approx(250 ** (60 / way), rel=0.02)


def test_a_tap_sets_the_time_but_no_slider(phone):
    before = phone.evaluate(STATE)
    swipe(phone, *at(phone, TRACK.format("v"), 0.9), 0, 0)
    assert phone.evaluate(STATE) == before
    swipe(phone, *at(phone, ".se-forces", 0.6), 0, 0)
    after = phone.evaluate(STATE)
    assert after[:-1] == before[:-1] and after[-1] > before[-1] + 0.2


def spread(tab, x, y, way):
    """Two fingers come down beside a point and part."""
    session = tab.context.new_cdp_session(tab)
    for n in range(9):
        points = [
            {"x": x + side * (30 + way * n / 8), "y": y, "id": (side + 1) // 2} for side in (-1, 1)
        ]
        kind = "touchMove" if n else "touchStart"
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        tab.wait_for_timeout(16)
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    tab.wait_for_timeout(250)


def test_two_fingers_enlarge_the_page_and_set_nothing(phone):
    start = phone.evaluate(STATE)
    session = phone.context.new_cdp_session(phone)
    for name, share in [(".se-robot", 0.5), (".se-forces", 0.5), (TRACK.format("v"), 0.5)]:
        spread(phone, *at(phone, name, share), 100)
        if "range" not in name:  # Chromium has its sliders enlarge nothing
            assert phone.evaluate("visualViewport.scale") > 1.5, name
        assert phone.evaluate(STATE) == start, name
        session.send("Emulation.resetPageScaleFactor")
        phone.evaluate("scrollTo(0, 0)")


def test_a_field_under_a_finger_has_letters_that_no_phone_enlarges(phone):
    sizes = phone.locator(".se-number input, .se-pace").evaluate_all(
        "all => all.map((field) => parseFloat(getComputedStyle(field).fontSize))"
    )
    assert len(sizes) > 6 and min(sizes) >= 16


WINDOWS = [(1366, 650), (1920, 970), (2560, 1300), (844, 390), (390, 844)]
NEEDED = (".se-play", ".se-headline", ".se-robot", TRACK.format("v"), TRACK.format("k"))


def out_of_sight(tab, nth, names):
    """Which of some parts of an explorer are not wholly in the window, or lie under the header."""
    return tab.evaluate(
        """([nth, names]) => {
          const box = document.querySelectorAll(".suspension-explorer-box.se-live")[nth];
          return names.filter((name) => {
            const part = box.querySelector(name);
            const { left, right, top, bottom } = part.getBoundingClientRect(),
              there = document.elementFromPoint((left + right) / 2, top + 1);
            const isInside = Math.min(left, top, innerWidth - right, innerHeight - bottom) > -1;
            return !isInside || !part.contains(there);
          });
        }""",
        [nth, list(names)],
    )


@pytest.mark.parametrize(("width", "height"), WINDOWS)
def test_play_verdict_scene_and_sliders_are_in_sight_together(browser, site, book, width, height):
    is_phone = min(width, height) < 500
    options = {
        "viewport": {"width": width, "height": height},
        "has_touch": is_phone,
        "is_mobile": is_phone,
        "reduced_motion": "reduce",
    }
    drive = next(book.glob("notebooks/*-drive.html"))
    tab = show(browser, site + drive.relative_to(book).as_posix(), **options)
    if not is_phone:  # as the page opens
        assert out_of_sight(tab, 0, NEEDED) == []
    tab.locator(BOX).first.evaluate("box => box.scrollIntoView()")
    assert out_of_sight(tab, 0, NEEDED) == []
    box, fold = tab.locator(BOX).first.bounding_box(), tab.locator("details.hide").first
    assert fold.bounding_box()["y"] >= box["y"] + box["height"]
    tab.goto(f"{site}index.html")
    tab.wait_for_selector(f"{BOX} canvas[aria-label]", state="attached")
    nth = tab.evaluate(
        """selector => [...document.querySelectorAll(selector)].findIndex((box) =>
          box.querySelector(".se-robot") && box.querySelector("[data-trait=v]"))""",
        BOX,
    )
    tab.locator(BOX).nth(nth).evaluate("box => box.scrollIntoView()")
    assert out_of_sight(tab, nth, NEEDED[:-1]) == []
    tab.context.close()


@pytest.mark.parametrize(("width", "height"), WINDOWS)
def test_the_race_and_its_play_and_the_chart_and_its_sliders_are_in_sight(
    browser, site, width, height
):
    """The race as the landing page opens, for it plays by itself; on its side, once it is there."""
    is_phone = min(width, height) < 500
    tab = show(
        browser,
        f"{site}book/index.html",
        viewport={"width": width, "height": height},
        has_touch=is_phone,
        is_mobile=is_phone,
        reduced_motion="reduce",
    )
    if height < 500:
        tab.locator(BOX).first.evaluate("box => box.scrollIntoView()")
    assert out_of_sight(tab, 0, (".se-headline", ".se-race", ".se-play", ".se-moment")) == []
    tab.locator(BOX).nth(1).evaluate("box => box.scrollIntoView()")
    sliders = [TRACK.format(name) for name in ("c", "height")]
    assert out_of_sight(tab, 1, (".se-headline", ".se-chart", *sliders)) == []
    tab.context.close()


@pytest.mark.parametrize(("width", "height"), WINDOWS)
def test_no_picture_moves_when_the_words_change(browser, folder, width, height):
    """The words above have room for the longest."""
    tab = show(
        browser, f"{folder.as_uri()}/whole.html", viewport={"width": width, "height": height}
    )
    tab.add_init_script(WRITTEN)
    tab.reload()
    tab.wait_for_selector(f"{BOX} canvas[aria-label]", state="attached")
    places = tab.evaluate(
        """async () => {
      const status = document.querySelector(".se-status"), heights = {};
      new MutationObserver(() => {
        heights[Math.round(status.offsetHeight)] ??= status.textContent;
      }).observe(status, { childList: true, characterData: true, subtree: true });
      await draw(LABELS, 33);
      return heights;
    }""".replace("LABELS", str(LABELS))
    )
    tab.context.close()
    assert len(places) == 1, places


def test_on_a_phone_they_stay_in_sight_while_the_sliders_scroll(phone):
    for name in ("c", "sigma"):
        phone.locator(TRACK.format(name)).evaluate("e => e.scrollIntoView({ block: 'end' })")
        assert out_of_sight(phone, 0, [*NEEDED[:3], TRACK.format(name)]) == []


@pytest.mark.parametrize(("width", "height"), WINDOWS[:3])
def test_full_screen_uses_the_window_and_says_how_to_leave(browser, folder, width, height):
    tab = show(
        browser, f"{folder.as_uri()}/whole.html", viewport={"width": width, "height": height}
    )
    tab.get_by_role("button", name="Full screen", exact=True).click()
    leave = tab.get_by_role("button", name="Exit full screen")
    leave.wait_for()
    tab.wait_for_timeout(300)
    assert tab.evaluate("document.fullscreenElement.scrollHeight") <= height
    parts = [
        tab.locator(part).bounding_box()
        for part in (".se-panels", ".se-tools", ".se-details", ".se-key")
    ]
    for upper, lower in pairwise(parts):
        assert 0 <= lower["y"] - upper["y"] - upper["height"] < 12
    assert height - 24 < parts[-1]["y"] + parts[-1]["height"] <= height
    leave.click()
    tab.get_by_role("button", name="Full screen", exact=True).wait_for()
    tab.context.close()


def marks_and_bands(tab, part, below):
    """The critical speeds on a slider, where its bands change, and its marks above and below."""
    critical = tab.locator(".suspension-explorer").evaluate("root => root.trajectory().critical")
    box = part.bounding_box()
    image = Image.open(io.BytesIO(tab.screenshot(clip=box))).convert("RGB")
    pixels = np.asarray(image, dtype=int)
    changes = np.abs(np.diff(pixels[pixels.shape[0] // 2 + below], axis=0)).sum(axis=1) > 60
    marks = []
    for row in (6, -7):
        dark = np.abs(pixels[row] - pixels[row, 0]).sum(axis=1) > 200
        marks.append(len(np.flatnonzero(np.diff(dark.astype(int)) > 0)))
    places = 10 + (box["width"] - 20) * np.log(np.array(critical) / 0.1) / np.log(250)
    return places, np.flatnonzero(changes) + 1, marks


def test_forced_colours_keep_the_bands_and_the_marks(browser, folder):
    tab = show(browser, f"{folder.as_uri()}/whole.html", forced_colors="active")
    track = tab.locator(TRACK.format("v"))
    places, changes, marks = marks_and_bands(tab, track, below=13)
    assert len(places) == 3 and all(np.abs(changes - place).min() < 2 for place in places)
    assert marks == [len(places), len(problem.SPEEDS)]
    for name in ("k", "c"):  # the robot's own value is marked by this background
        mark = "e => getComputedStyle(e, '::after').backgroundColor === getComputedStyle(e).color"
        assert tab.locator(f"[data-trait={name}]").evaluate(mark)
    tab.context.close()


def test_in_jupyterlab_a_strip_shows_the_bands_that_its_slider_has_not(browser, folder):
    tab = show(browser, f"{folder.as_uri()}/whole.html")
    tab.evaluate("document.body.className = 'suspension-explorer-frame'")  # as the widget has it
    assert not tab.locator(TRACK.format("v")).is_visible()
    control = tab.locator("[data-trait=v]")
    height = control.bounding_box()["height"]
    number = tab.locator("[data-trait=v] .se-number").bounding_box()["height"]
    assert 20 < height - number < 32  # a strip below the number
    below = round(number + (height - number) / 2 - height / 2)
    places, changes, _ = marks_and_bands(tab, control, below)
    at = tab.locator(TRACK.format("v")).input_value()
    width = control.bounding_box()["width"]
    for place in (*places, 8 + float(at) * (width - 20)):
        assert np.abs(changes - place).min() < 2
    tab.context.close()


@pytest.fixture
def enlarged(browser, folder, tmp_path):
    """The whole explorer in a browser whose reader has asked for larger letters."""
    chromium = find_chromium(whole=True)
    if chromium is None:
        pytest.skip("only Chromium's shell is there, which has no settings")
    contexts = []

    def open_with(sizes, width, height):
        (tmp_path / "Default").mkdir()
        preferences = json.dumps({"webkit": {"webprefs": sizes}})
        (tmp_path / "Default" / "Preferences").write_text(preferences, encoding="utf-8")
        context = browser.browser_type.launch_persistent_context(
            tmp_path,
            executable_path=chromium,
            args=list(FLAGS),
            viewport={"width": width, "height": height},
        )
        contexts.append(context)
        tab = context.new_page()
        tab.add_init_script(WRITTEN)
        tab.goto(f"{folder.as_uri()}/whole.html")
        tab.wait_for_selector(f"{BOX} canvas[aria-label]", state="attached")
        return tab

    yield open_with
    for context in contexts:
        context.close()


def cut_parts(tab):
    """What a control or a line of words has no room for."""
    parts = tab.locator(".se-number input, .se-name, button, summary, .se-clock")
    return parts.evaluate_all("""parts => parts
      .filter((part) => part.checkVisibility() && part.scrollWidth > part.clientWidth + 1)
      .filter((part) => part.clientWidth) // text within a line has none
      .map((part) => part.value || part.textContent)""")


def test_in_jupyterlab_a_finger_gets_the_native_sliders(phone):
    """Those of ipywidgets do not let it scroll."""
    phone.evaluate("document.body.className = 'suspension-explorer-frame'")
    for name in ("v", "dt"):
        assert phone.locator(TRACK.format(name)).is_visible()


def test_large_letters_cut_no_number_and_no_name(enlarged):
    """With a least size of letters, which a length in `em` knows nothing of."""
    tab = enlarged({"minimum_font_size": 24, "minimum_logical_font_size": 24}, 1366, 900)
    assert tab.locator(".se-name").first.bounding_box()["height"] > 24  # the letters are large
    assert cut_parts(tab) == []


@pytest.mark.parametrize(("width", "height"), [(1366, 768), (2560, 1300), (390, 844)])
def test_letters_twice_as_large_are_so_in_pictures_too(enlarged, width, height):
    tab = enlarged({"default_font_size": 32}, width, height)
    letters = tab.locator(".se-name").first.evaluate("e => getComputedStyle(e).fontSize")
    assert letters in ("26px", "28px")
    assert cut_parts(tab) == []
    assert tab.evaluate("document.documentElement.scrollWidth") <= width
    tall = tab.locator(".se-forces").evaluate(
        "canvas => canvas.getContext('2d').getTransform().a / devicePixelRatio"
    )
    assert tall == 2
    seen, faults = tab.evaluate("([count, seed]) => draw(count, seed)", [LABELS // 4, 5])
    assert not faults and len(seen) > 30, faults[:5]
    before = tab.evaluate(STATE)
    tab.locator(".se-forces").evaluate("canvas => canvas.scrollIntoView({ block: 'center' })")
    box = tab.locator(".se-forces").bounding_box()
    left, right = box["x"] + 2 * 38, box["x"] + box["width"] - 2 * 16  # as panels.js has them
    tab.mouse.click(left + 0.25 * (right - left), box["y"] + box["height"] / 2)
    settle(tab)
    assert tab.evaluate(STATE)[-1] == pytest.approx(0.25, abs=0.01) != before[-1]
