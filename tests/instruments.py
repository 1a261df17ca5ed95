"""What the browser tests of the laboratory's instruments share."""

from contextlib import contextmanager
from itertools import pairwise

import nbformat
from helpers import AXE, violations
from nbformat.v4 import new_code_cell, new_notebook

from suspension.explorer import page_script, page_style

PAGE = "notebooks/13-laboratory.html"
PIXELS = """canvas => {
  const { width, height } = canvas;
  const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
  return new Uint32Array(data.buffer).reduce((number, pixel) => (31 * number + pixel) | 0, width);
}"""
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}


@contextmanager
def visiting(browser, site, box, settle=None):
    """A function that opens the page and waits for an instrument; no script may complain.

    It takes what follows the page in its address, and options of the browser's context; `settle`
    is called with each tab.
    """
    contexts, complaints = [], []

    def go(address="", **options):
        context = browser.new_context(**({"viewport": {"width": 1366, "height": 900}} | options))
        contexts.append(context)
        tab = context.new_page()
        tab.on("pageerror", lambda error: complaints.append(str(error)))
        tab.goto(f"{site}{PAGE}{address}")
        tab.wait_for_selector(f"{box} canvas[aria-label]")
        if settle:
            settle(tab)
        return tab

    yield go
    for context in contexts:
        context.close()
    assert not complaints


def pictures(tab, box):
    """A number for each of an instrument's pictures that tells it from others."""
    tab.wait_for_timeout(100)  # two frames and more
    return [canvas.evaluate(PIXELS) for canvas in tab.locator(f"{box} canvas").all()]


def touch(tab, *points):
    """A finger's way over the screen from point to point, in pixels of the window."""
    client = tab.context.new_cdp_session(tab)

    def send(kind, *at):
        fingers = [{"x": x, "y": y} for x, y in at]
        client.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})

    send("touchStart", points[0])
    for (x0, y0), (x1, y1) in pairwise(points):
        for n in range(1, 9):
            send("touchMove", (x0 + (x1 - x0) * n / 8, y0 + (y1 - y0) * n / 8))
    send("touchEnd")
    tab.wait_for_timeout(200)


def settle(tab):
    """Wait until two frames have been drawn."""
    tab.evaluate(
        "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
    )


def write_pages(folder, bodies):
    """Bare pages of explorers by name, in the way that the book makes them."""
    (folder / "explorer.js").write_text(page_script(), encoding="utf-8")
    (folder / "explorer.css").write_text(page_style(), encoding="utf-8")
    for name, body in bodies.items():
        (folder / f"{name}.html").write_text(
            '<!doctype html><html lang="en" data-theme="light"><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width"><title>Explorer</title>'
            '<link rel="icon" href="data:,"><link rel="stylesheet" href="explorer.css">'
            f'<script src="explorer.js" defer></script><body>{body}',
            encoding="utf-8",
        )


def objections(tab, box, act):
    """What axe objects to: before and after `act`, and to the contrast in the dark."""
    tab.add_script_tag(path=AXE)
    tab.add_style_tag(content="* { transition: none !important }")
    found = violations(tab, within=box)[0]
    act(tab)
    found += violations(tab, within=box)[0]
    tab.emulate_media(color_scheme="dark")
    tab.wait_for_function("document.documentElement.dataset.theme === 'dark'")
    found += violations(tab, "color-contrast", within=box)[0]
    return found


def still_picture(browser, site, box):
    """What the image says that readers without scripts see."""
    context = browser.new_context(java_script_enabled=False)
    tab = context.new_page()
    tab.goto(f"{site}{PAGE}")
    image = tab.locator(f"{box} img")
    assert image.is_visible()
    text = image.get_attribute("alt")
    context.close()
    return text


def gives_way_on_paper(tab, box):
    """Whether the still picture is seen in print alone."""
    hidden = not tab.locator(f"{box} img").is_visible()
    tab.emulate_media(media="print")
    printed = tab.locator(f"{box} img").is_visible()
    return hidden and printed and not tab.locator(f"{box} canvas").first.is_visible()


def write_notebook(path, cells):
    """A notebook of code cells."""
    notebook = new_notebook(cells=[new_code_cell(source) for source in cells])
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    notebook.metadata.kernelspec = kernel
    nbformat.write(notebook, path)
