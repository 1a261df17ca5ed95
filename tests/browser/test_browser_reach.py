"""In reach: by finger, in every window, in large letters and few colours; no word over another."""

import pytest

from suspension import problem
from suspension.course import Hgauss, the_robot
from suspension.explorer import explore, page_script, page_style

BOX = ".suspension-explorer-box.se-live"
LABELS = 200  # settings
WIDTHS = (360, 620, 1000, 1900)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Two bare pages: an explorer with all panels, and the chart."""
    folder = tmp_path_factory.mktemp("reach")
    (folder / "explorer.js").write_text(page_script(), encoding="utf-8")
    (folder / "explorer.css").write_text(page_style(), encoding="utf-8")
    known = {"asked": problem.SPEEDS, "spring_end": problem.DELTA_MAX}
    for name, compact in (("whole", False), ("chart", "chart")):
        html = explore(the_robot(), Hgauss, compact=compact, **known).html()
        (folder / f"{name}.html").write_text(
            '<!doctype html><html lang="en" data-theme="light"><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width"><title>Explorer</title>'
            '<link rel="icon" href="data:,"><link rel="stylesheet" href="explorer.css">'
            f'<script src="explorer.js" defer></script><body>{html}',
            encoding="utf-8",
        )
    return folder


def show(browser, url, **options):
    """A page whose explorers live, in a context of its own."""
    tab = browser.new_context(**options).new_page()
    tab.goto(url)
    tab.wait_for_selector(f"{BOX} canvas[aria-label]", state="attached")
    return tab


def settle(tab):
    tab.evaluate(
        "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
    )


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
  words.get(this.canvas).push([text, Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)]);
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
        edge = canvas.clientWidth + 1, low = canvas.clientHeight + 1;
      written.forEach(([text, left, right, top, bottom], i) => {
        seen.add(text);
        if (left < -1 || right > edge || top < -1 || bottom > low) faults.push([text, "is cut", n]);
        for (const [other, l, r, t, b] of written.slice(0, i))
          if (Math.min(right, r) - Math.max(left, l) > 1 && Math.min(bottom, b) - Math.max(top, t) > 1)
            faults.push([text, other, n]);
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


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("name", ALWAYS)
def test_no_word_of_a_picture_is_over_another_or_cut(browser, folder, name, width):
    tab = browser.new_context(viewport={"width": width, "height": 800}).new_page()
    tab.add_init_script(WRITTEN)
    tab.goto(f"{folder.as_uri()}/{name}.html")
    tab.wait_for_selector(f"{BOX} canvas[aria-label]", state="attached")
    seen, faults = tab.evaluate("([count, seed]) => draw(count, seed)", [LABELS, 21 + width])
    tab.context.close()
    assert not faults, (len(faults), faults[:5])
    assert len(seen) > 60 and set(seen) >= ALWAYS[name]
