"""The explorer in JupyterLab: with its kernel, without it, by mouse, by keys and by finger."""

import json
import re
import shutil

import nbformat
import numpy as np
import pytest
from explorers import (
    BOX,
    BUMP_SLIDERS,
    BUMPS,
    LOPSIDED,
    PAGES,
    SLIDERS,
    compare,
    look,
    pictures,
    shown,
    slider,
    tone,
    type_in,
    words,
)
from helpers import PARITY, ROOT, swipe
from instruments import settle, write_notebook
from lab import run_all, serve, wait_until_idle
from nbformat.v4 import new_markdown_cell, new_notebook

LAB_CELLS = [
    "import numpy as np\nfrom suspension.explorer import explore\n"
    "from suspension.road import GaussianBump\nfrom suspension.robot import Robot\n" + BUMPS,
    f"box = explore({LOPSIDED}, two_bumps, v=0.8)\nbox",
    "run = box.explorer.trajectory()\n"
    "pinned = box.explorer.pin.get('v', 0)\n"
    "np.savez('run.npz', W=run.W, N=run.N, v=run.v, dt=run.dt, pinned=pinned)\n"
    "print('saved', run.v)",
]


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """A JupyterLab, as `make lab` starts it, with the book and one more notebook; its address and
    its folder."""
    folder = tmp_path_factory.mktemp("lab")
    for part in ("notebooks", "book", "data"):
        ignore = shutil.ignore_patterns("npm", "__pycache__")
        shutil.copytree(ROOT / part, folder / part, ignore=ignore)
    (folder / "_build" / "html" / "book").mkdir(parents=True)
    built = folder / "_build" / "html" / "book" / "model.html"
    built.write_text(
        "<title>Built</title><h2 id='the-same-as-matrices'>Matrices</h2>", encoding="utf-8"
    )
    write_notebook(folder / "drive.ipynb", LAB_CELLS)
    with serve(folder, "--config=book/_lab/jupyter_server_config.py") as address:
        yield address, folder


def test_the_same_cell_is_alive_in_jupyterlab(browser, lab):
    address, folder = lab
    tab = browser.new_page(viewport={"width": 1300, "height": 1200})
    errors = []
    tab.on("pageerror", lambda error: errors.append(str(error)))
    run_all(tab, address, "drive.ipynb")
    tab.get_by_text("saved 0.8").wait_for(timeout=60_000)
    assert not tab.locator(".suspension-explorer-still").first.is_visible()
    for name in SLIDERS:
        before = look(tab)
        for _ in range(3):
            track_of(tab, name)[0].press("ArrowLeft")
        tab.wait_for_timeout(600 if name in IPYWIDGETS else 150)  # by way of the kernel
        assert words(tab) != before[0], name
        assert pictures(tab) != before[1], name
    tab.get_by_role("button", name="Crank-Nicolson").click()
    page, rows = shown(tab)
    robot, road = PAGES["bumps"]
    compare((page, rows), robot, road)
    before = words(tab)
    tab.get_by_role("button", name="Pin to compare").click()
    assert "Pinned, in grey at the same X" in words(tab)
    slider(tab, "Moment").press(".")
    assert words(tab) != before
    tab.locator(".jp-CodeCell .cm-content").last.click()
    tab.keyboard.press("Control+Enter")
    tab.get_by_text(re.compile(rf"saved {page['v']!r}")).wait_for(timeout=60_000)
    kernel = np.load(folder / "run.npz")
    assert (kernel["v"], kernel["dt"]) == (page["v"], page["dt"])
    assert kernel["pinned"] == page["v"]
    assert np.abs(np.vstack([kernel["W"], kernel["N"]]) - rows).max() < PARITY
    before = tab.evaluate("document.body.dataset.jpThemeLight"), pictures(tab)
    tab.evaluate("document.body.dataset.jpThemeLight = 'false'")
    tab.wait_for_timeout(200)
    assert before[0] == "true" and pictures(tab) != before[1]
    assert not errors
    tab.close()


WIDE = {"width": 1366, "height": 768}
ALL_SLIDERS = [*SLIDERS, *BUMP_SLIDERS]
IPYWIDGETS = SLIDERS[:2]  # those of speed and step, in JupyterLab
LIVE = f"{BOX}.se-live"
FRAME = f".suspension-explorer-frame:has({LIVE})"


def reach_explorer(tab, nth=0):
    """Bring an explorer's upper edge to that of its notebook."""
    for _ in range(2):  # once more, for cells above it get their true heights when they are seen
        tab.locator(FRAME).nth(nth).evaluate("box => box.scrollIntoView({ block: 'start' })")
        tab.wait_for_timeout(700)


def track_of(tab, name, nth=0):
    """What takes a slider's keys, and what a mouse sees of it, in JupyterLab."""
    if name not in IPYWIDGETS:
        return (slider(tab, name, nth),) * 2
    widget = tab.locator(FRAME).nth(nth).locator(".jupyter-widgets .widget-slider")
    widget = widget.nth(IPYWIDGETS.index(name))
    assert widget.locator(".widget-label").inner_text() == name
    return widget.locator(".noUi-handle"), widget.locator(".noUi-target")


def answered(tab):
    """Wait until the kernel has answered what a slider of ipywidgets asked."""
    tab.wait_for_timeout(600)
    settle(tab)


def pull_widget(tab, name, nth=0, way=40):
    """The same as `pull` for a slider of ipywidgets, by its handle: numbers the explorer has."""
    handle, track = track_of(tab, name, nth)
    trait = ("v", "dt")[IPYWIDGETS.index(name)]
    box, edge = handle.bounding_box(), track.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    way = way if x < edge["x"] + 0.6 * edge["width"] else -way

    def value():
        answered(tab)
        return shown(tab, nth)[0][trait]

    seen = [value()]
    tab.mouse.move(x, y)
    tab.mouse.down()
    tab.mouse.move(x + way, y + 2, steps=5)
    seen.append(value())
    tab.mouse.move(x, y, steps=5)
    tab.mouse.up()
    return [*seen, value()]


def pull(tab, name, nth=0, way=40):
    """Drag a slider's handle and back: the value before, on the way, and after."""
    if name in IPYWIDGETS:
        return pull_widget(tab, name, nth, way)
    track = slider(tab, name, nth)
    track.scroll_into_view_if_needed()
    box, place = track.bounding_box(), float(track.input_value())
    x = box["x"] + 10 + place * (box["width"] - 20) + 3  # not in its very middle
    y = box["y"] + box["height"] / 2
    way = way if place < 0.6 else -way

    def value():
        settle(tab)
        return track.get_attribute("aria-valuetext")

    seen = [value()]
    tab.mouse.move(x, y)
    tab.mouse.down()
    tab.mouse.move(x + way, y + 2, steps=5)
    seen.append(value())
    tab.mouse.move(x, y, steps=5)
    tab.mouse.up()
    return [*seen, value()]


@pytest.mark.parametrize("name", ["02-crank-nicolson", "12-drive"])
def test_by_mouse_in_jupyterlab(browser, lab, name):
    """Every slider has a track, a whole label, a picture in sight, and comes back where it was."""
    tab = browser.new_page(viewport=WIDE)
    run_all(tab, lab[0], f"notebooks/{name}.ipynb")
    tab.wait_for_timeout(2000)
    for width, height in ((1366, 768), (1000, 768), (2200, 1200)):
        tab.set_viewport_size({"width": width, "height": height})
        reach_explorer(tab)
        for control in tab.locator(LIVE).first.locator(".se-control").all():
            label = control.locator(".se-name")
            if control.get_attribute("data-trait") not in ("v", "dt"):
                assert control.locator("input[type=range]").bounding_box()["width"] >= 120
            parts = [control.locator(part).bounding_box() for part in (".se-name", ".se-number")]
            edge = control.bounding_box()
            assert label.bounding_box()["height"] < 30  # one line
            number = control.locator("input[type=text]")
            assert number.evaluate("e => e.scrollWidth <= e.clientWidth")
            assert label.evaluate("e => e.scrollWidth <= e.clientWidth + 1 || !e.clientWidth")
            assert parts[0]["x"] + parts[0]["width"] <= parts[1]["x"] + 1  # nothing is covered
            assert parts[1]["x"] + parts[1]["width"] <= edge["x"] + edge["width"] + 1
        for control in IPYWIDGETS:
            assert track_of(tab, control)[1].bounding_box()["width"] >= 120, (control, width)
            assert not tab.locator(LIVE).first.get_by_role("slider", name=control).count()
        sight = tab.locator(".jp-NotebookPanel .jp-WindowedPanel-outer").bounding_box()
        low = sight["y"] + sight["height"]
        for part in (track_of(tab, SLIDERS[0])[1], tab.locator(f"{LIVE} .se-robot").first):
            box = part.bounding_box()
            assert sight["y"] - 1 <= box["y"] and box["y"] + box["height"] <= low + 1, width
        if (width, height) == (1366, 768):  # every slider, and every picture
            for part in (slider(tab, BUMP_SLIDERS[-1]), tab.locator(f"{LIVE} .se-forces").first):
                box = part.bounding_box()
                assert sight["y"] - 1 <= box["y"] and box["y"] + box["height"] <= low + 1
    tab.set_viewport_size(WIDE)
    reach_explorer(tab)
    for control in ALL_SLIDERS:
        before = look(tab)
        start, moved, after = pull(tab, control)
        assert start == after != moved, control
        assert look(tab) == before
        box = track_of(tab, control)[1].bounding_box()
        tab.mouse.click(box["x"] + 0.8 * box["width"], box["y"] + box["height"] / 2)
        answered(tab)
        changed = look(tab)
        assert changed[0] != before[0] and changed[1] != before[1], control
        assert not re.search("NaN|undefined|Infinity", changed[0])
    tab.close()


def test_keys_and_typed_numbers_in_jupyterlab(browser, lab):
    address, folder = lab
    tab = browser.new_page(viewport=WIDE)
    run_all(tab, address, "drive.ipynb")
    tab.get_by_text("saved 0.8").wait_for(timeout=60_000)
    kernel = np.load(folder / "run.npz")
    assert (kernel["v"], kernel["dt"]) == (0.8, 0.001)  # as Python set them, nothing written back
    type_in(tab, SLIDERS[0], "0.812345678")  # a number that no slider offers
    answered(tab)
    for name, trait in zip(IPYWIDGETS, ("v", "dt"), strict=True):
        handle, _ = track_of(tab, name)
        low, high = {"v": (0.1, 25), "dt": (0.00025, 0.2)}[trait]
        values = []
        for key in (None, "ArrowRight", "ArrowLeft", "PageUp"):
            if key:
                handle.press(key)
            answered(tab)
            values.append(shown(tab)[0][trait])
        ways = np.diff(np.log(values)) / np.log(high / low)
        assert 0 < ways[0] <= 0.02 < ways[2] < 0.2, name
        assert values[2] == values[0], name
    for name in SLIDERS[2:]:
        track = slider(tab, name)
        places = [float(track.input_value())]
        for key in ("ArrowRight", "ArrowLeft", "PageUp"):
            track.press(key)
            places.append(float(track.input_value()))
        small, page = abs(places[1] - places[0]), abs(places[3] - places[2])
        assert 0 < small <= 0.02 < page < 0.2, name
        assert places[2] == pytest.approx(places[0], abs=0.004)
    for text in ("1,2", "1.2"):
        type_in(tab, SLIDERS[0], "3")
        type_in(tab, SLIDERS[0], text)
        assert shown(tab)[0]["v"] == 1.2
    type_in(tab, SLIDERS[0], "0.812345678")
    answered(tab)
    readout = tab.locator(FRAME).locator(".widget-readout").first
    assert readout.inner_text() == "0.812345678"
    assert readout.evaluate("e => e.scrollWidth <= e.clientWidth")
    assert shown(tab)[0]["v"] == 0.812345678  # and the kernel has the same
    tab.locator(".jp-CodeCell .cm-content").last.click()
    tab.keyboard.press("Control+Enter")
    tab.get_by_text("saved 0.812345678").wait_for(timeout=60_000)
    for nothing in ("NaN", "Infinity", "undefined"):
        stiffness = tab.locator(f"{LIVE} [data-trait=k] input[type=range]")
        stiffness.evaluate(f"e => {{ e.value = {nothing}; e.dispatchEvent(new Event('input')); }}")
        assert 150 <= shown(tab)[0]["k"] <= 2500
    tab.close()


def test_by_finger_in_jupyterlab(browser, lab):
    """What begins on a slider scrolls and sets nothing, or pulls, and the kernel knows."""
    address, _ = lab
    context = browser.new_context(viewport={"width": 820, "height": 1180}, has_touch=True)
    tab = context.new_page()
    run_all(tab, address, "drive.ipynb")
    tab.get_by_text("saved 0.8").wait_for(timeout=60_000)
    sight = tab.locator(".jp-NotebookPanel .jp-WindowedPanel-outer")
    for name in SLIDERS:
        slider(tab, name).evaluate("e => e.scrollIntoView({ block: 'center' })")
        tab.wait_for_timeout(500)
        before, height = shown(tab)[0], sight.evaluate("e => e.scrollTop")
        track = slider(tab, name).bounding_box()
        place = track["x"] + 0.3 * track["width"], track["y"] + track["height"] / 2
        swipe(tab, *place, 4, 150)
        assert shown(tab)[0] == before and sight.evaluate("e => e.scrollTop") < height - 50, name
    handle = track["x"] + 10 + float(slider(tab, SLIDERS[0]).input_value()) * (track["width"] - 20)
    slider(tab, SLIDERS[0]).evaluate("e => e.scrollIntoView({ block: 'center' })")
    tab.wait_for_timeout(500)
    track = slider(tab, SLIDERS[0]).bounding_box()
    swipe(tab, handle, track["y"] + track["height"] / 2, 60, 3)
    settle(tab)
    v = shown(tab)[0]["v"]
    assert v > 1
    tab.locator(".jp-CodeCell .cm-content").last.click()
    tab.keyboard.press("Control+Enter")
    tab.get_by_text(f"saved {v!r}").wait_for(timeout=60_000)
    context.close()


def save(tab):
    tab.keyboard.press("Control+s")
    tab.wait_for_function("!document.querySelector('.jp-mod-dirty')")
    tab.wait_for_timeout(1500)


def test_a_notebook_opens_unchanged_saves_clean_and_keeps_its_pictures(browser, lab):
    address, folder = lab
    file = folder / "notebooks" / "12-drive.ipynb"
    before = file.read_text(encoding="utf-8")
    tab = browser.new_page(viewport=WIDE)
    tab.goto(f"{address}lab/tree/notebooks/12-drive.ipynb?reset")
    wait_until_idle(tab)
    tab.wait_for_timeout(1000)
    assert tab.locator(".jp-mod-dirty").count() == 0
    picture = tab.locator(".jp-OutputArea-output.jp-RenderedSVG").first
    assert picture.bounding_box()["height"] > 200
    assert "Run All Cells" in picture.locator("img, svg").first.evaluate(
        "e => decodeURIComponent(e.src ?? e.outerHTML)"
    )
    run_all(tab, address, "notebooks/12-drive.ipynb")
    wait_until_idle(tab)
    save(tab)
    assert "widget-view" not in file.read_text(encoding="utf-8")
    old, new = json.loads(before), json.loads(file.read_text(encoding="utf-8"))
    assert [new[key] for key in ("metadata", "nbformat_minor")] == [
        old[key] for key in ("metadata", "nbformat_minor")
    ]
    for was, cell in zip(old["cells"], new["cells"], strict=True):
        assert {**cell, "outputs": 0} == {**was, "outputs": 0}
        kinds = [[sorted(out.get("data", {})) for out in c.get("outputs", [])] for c in (was, cell)]
        assert kinds[0] == kinds[1]
    tab.close()


def test_without_its_kernel_another_notebook_shows_its_still_picture(browser, lab):
    """One that is saved as JupyterLab saves it, with a widget that will not be there."""
    address, _ = lab
    tab = browser.new_page(viewport=WIDE)
    run_all(tab, address, "drive.ipynb")
    tab.wait_for_timeout(1500)
    save(tab)
    token = next(c["value"] for c in tab.context.cookies() if c["name"] == "_xsrf")
    for session in tab.request.get(f"{address}api/sessions").json():
        tab.request.delete(f"{address}api/sessions/{session['id']}", headers={"X-XSRFToken": token})
    tab.goto(f"{address}lab/tree/drive.ipynb?reset")
    still = tab.locator(".suspension-explorer-still").first
    still.wait_for(timeout=60_000)
    tab.wait_for_timeout(4000)
    assert still.bounding_box()["height"] > 200
    assert tab.get_by_text("run the notebook (Run > Run All Cells)").first.is_visible()
    assert not tab.get_by_text("model not found").first.is_visible()
    assert (
        tab.locator(f"{BOX} input").count() == 0
        or not tab.locator(f"{BOX} input").first.is_visible()
    )
    tab.close()


def test_phrases_and_links_lead_somewhere_in_jupyterlab(browser, lab):
    address, folder = lab
    tab = browser.new_page(viewport=WIDE)
    run_all(tab, address, "notebooks/12-drive.ipynb")
    tab.wait_for_timeout(3000)
    phrase = tab.locator("a[href='#explore:v=0.25']").first
    phrase.click()
    assert shown(tab)[0]["v"] == 0.25
    tab.get_by_role("button", name="Stable, wrong").first.click()
    assert tone(tab) == "doubt"
    with tab.context.expect_page() as opened:
        tab.get_by_role("link", name="the package").click()
    assert opened.value.url == f"{address}static/book/model.html#the-same-as-matrices"
    (folder / "_build" / "html" / "book" / "model.html").unlink()  # not built: its text, rendered
    tab.bring_to_front()
    tab.get_by_role("link", name="the package").click()
    heading = tab.locator(".jp-MarkdownViewer").get_by_role("heading", name="The same, as matrices")
    heading.wait_for()
    tab.wait_for_timeout(500)
    assert 0 < heading.bounding_box()["y"] < 400
    tab.close()


def test_a_phrase_on_another_notebooks_picture_waits_until_it_is_run(browser, lab):
    address, folder = lab
    notebook = new_notebook(
        cells=[
            new_markdown_cell(
                "[drive it](../notebooks/12-drive.ipynb#explore:v=3.3&k=700)\n\n"
                "[the fit](../notebooks/06-how-sure.ipynb#fig-sensitivity)"
            )
        ]
    )
    nbformat.write(notebook, folder / "notebooks" / "links.ipynb")
    tab = browser.new_page(viewport=WIDE)
    tab.goto(f"{address}lab/tree/notebooks/links.ipynb?reset")
    tab.get_by_role("link", name="drive it").click()
    tab.locator(".jp-NotebookPanel:not(.lm-mod-hidden) .jp-mod-active").first.wait_for()
    tab.wait_for_timeout(4000)
    tab.get_by_role("menuitem", name="Run", exact=True).click()
    tab.get_by_role("menuitem", name="Run All Cells", exact=True).click()
    tab.wait_for_selector(f"{LIVE} canvas[aria-label]", timeout=90_000)
    tab.wait_for_timeout(2500)
    page = shown(tab)[0]
    assert (page["v"], page["k"]) == (3.3, 700)
    tab.goto(f"{address}lab/tree/notebooks/links.ipynb?reset")
    tab.get_by_role("link", name="the fit").click()
    tab.wait_for_function("""() => [...document.querySelectorAll(".jp-Cell.jp-mod-active")]
      .some((cell) => cell.textContent.includes("fig-sensitivity")
        && cell.getBoundingClientRect().top < innerHeight)""")
    tab.close()
