"""The explorer as its readers meet it: in a static page, in the built book, in JupyterLab."""

import json
import os
import re
from importlib.util import module_from_spec, spec_from_file_location

import nbformat
import numpy as np
import pytest
from helpers import PARITY, ROOT, largest_difference, serve_files
from ipywidgets.embed import embed_data
from lab import run_all, serve
from nbformat.v4 import new_code_cell, new_notebook

from suspension.contact import first_loss
from suspension.course import the_robot
from suspension.explorer import DTS, SCHEMES, explore
from suspension.explorer.tables import vary_stiffness
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.simulation import simulate

BOX = ".suspension-explorer-box"
SLIDERS = ["Speed v (m/s)", "Step Δt (ms)", "Stiffness k (N/m)", "Moment"]
STATE = "application/vnd.jupyter.widget-state+json"
PLAIN = {0x2212: "-", 0xD7: "x", 0xA0: " "}  # the page's minus, times and fixed space
MARK = 'type="application/vnd.jupyter.widget-view+json"'  # stands in every page with an explorer
BUMPS = """
def two_bumps(x):
    (H1, d1), (H2, d2) = GaussianBump()(x), GaussianBump(0.018, 0.02, 0.85)(x)
    return H1 + H2, d1 + d2
"""
exec(BUMPS)  # the notebook below defines it by the same lines
LOPSIDED = "Robot(700, 1000, L1=0.12, L2=0.09, c1=2.0, c2=0.5)"
PAGES = {
    "bump": (Robot(793.2, 793.2), GaussianBump()),
    "bumps": (eval(LOPSIDED), two_bumps),  # noqa: F821
}


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """A folder with a bare page for each of PAGES and the scripts that the book copies."""
    path = ROOT / "book" / "_ext" / "local_assets.py"
    spec = spec_from_file_location("local_assets", path)
    assets = module_from_spec(spec)
    spec.loader.exec_module(assets)
    folder = tmp_path_factory.mktemp("pages")
    for source in assets.FILES["widgets"]:
        assets.copy(source, folder / "widgets" / source.name)
    scripts = "".join(f'<script src="widgets/{name}"></script>' for name in assets.WIDGET_SCRIPTS)
    for name, (robot, road) in PAGES.items():
        box = explore(robot, road)
        state = embed_data([box], drop_defaults=False)["manager_state"]
        state = json.dumps(state).replace("</", "<\\/")
        (folder / f"{name}.html").write_text(
            '<!doctype html><html lang="en" data-theme="light"><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width"><title>Explorer</title>'
            '<link rel="icon" href="data:,">'
            f"<body><main>{box._repr_mimebundle_()['text/html']}</main>"
            f'<script type="{STATE}">{state}</script>{scripts}</body></html>',
            encoding="utf-8",
        )
    return folder


@pytest.fixture(params=["http", "file"])
def address(request, pages):
    """Where the pages are: in a folder of a server, or files."""
    if request.param == "file":
        yield pages.as_uri() + "/"
        return
    with serve_files(pages.parent) as address:
        yield f"{address}{pages.name}/"


@pytest.fixture
def visit(browser):
    """Open a page that has an explorer; in the end, it has complained of nothing."""
    tabs, complaints = [], []

    def go(url, **context):
        tab = browser.new_page(**({"viewport": {"width": 1000, "height": 1000}} | context))
        tabs.append(tab)
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
        tab.wait_for_selector(f"{BOX} canvas[aria-label]")
        return tab

    yield go
    for tab in tabs:
        tab.close()
    assert not complaints


def slider(tab, name, nth=0):
    return tab.locator(BOX).nth(nth).get_by_role("slider", name=name)


def words(tab, nth=0):
    """The words, when they have settled."""
    tab.wait_for_timeout(450)
    return tab.locator(f"{BOX} [aria-live]").nth(nth).inner_text()


def pictures(tab, nth=0):
    """What is drawn in the three panels."""
    return (
        tab.locator(f"{BOX} .suspension-explorer")
        .nth(nth)
        .evaluate(
            "root => [...root.querySelectorAll('canvas')].map((canvas) => canvas.toDataURL())"
        )
    )


def shown(tab, nth=0):
    """The run in the page: the settings, and [W, N], shape (6, J+1)."""
    run = tab.locator(f"{BOX} .suspension-explorer").nth(nth).evaluate("root => root.trajectory()")
    return run, np.array(run["W"] + run["N"], dtype=float)


def press(tab, name, key, times, nth=0):
    for _ in range(times):
        slider(tab, name, nth).press(key)


def turn(tab, rng, nth=0):
    """Turn every slider to a random place, by keys and by typing."""
    speed = tab.locator(BOX).nth(nth).get_by_role("textbox", name="Speed v (m/s)")
    speed.fill(f"{10 ** rng.uniform(-1, np.log10(25)):.6g}")
    speed.press("Enter")
    for name, count in (("Step Δt (ms)", len(DTS)), ("Stiffness k (N/m)", 13)):
        slider(tab, name, nth).press("Home")
        press(tab, name, "ArrowRight", int(rng.integers(count)), nth)
    tab.locator(BOX).nth(nth).get_by_role("button", name=SCHEMES[rng.integers(2)].name).click()


def compare(page_run, robot, road):
    """Assert that the page has what `simulate` has; return the largest difference."""
    page, rows = page_run
    robot = vary_stiffness(robot)[0][page["k"]]
    scheme = SCHEMES[page["scheme"]]
    run = simulate(robot, road, v=page["v"], dt=page["dt"], tfinal=1.25 / page["v"], scheme=scheme)
    difference = largest_difference(rows, run)
    assert difference < PARITY, page["v"]
    assert first_loss(run.T, rows[4:]) == run.loss
    return difference


@pytest.mark.parametrize("name", PAGES)
def test_the_page_has_what_simulate_has(visit, pages, name):
    tab, rng = visit(f"{pages.as_uri()}/{name}.html"), np.random.default_rng(7)
    seen = {}
    for _ in range(int(os.environ.get("EXPLORER_SETTINGS", 16))):
        turn(tab, rng)
        run = shown(tab)
        seen[tuple(run[0][key] for key in ("v", "dt", "k", "scheme"))] = compare(run, *PAGES[name])
    print(f"{name}: {len(seen)} settings, largest difference {max(seen.values()):.1e}")
    assert len(seen) > 10


@pytest.mark.parametrize("name", PAGES)
def test_every_control_moves_the_picture_and_the_words(visit, address, name):
    tab = visit(f"{address}{name}.html")
    for control in [*SLIDERS, "Crank-Nicolson", "RK4"]:
        before = words(tab), pictures(tab)
        if control in SLIDERS:
            handle, track = slider(tab, control), slider(tab, control).locator("xpath=../..")
            start, along = handle.bounding_box(), track.bounding_box()
            tab.mouse.move(start["x"] + start["width"] / 2, start["y"] + start["height"] / 2)
            tab.mouse.down()
            tab.mouse.move(along["x"] + 0.62 * along["width"], start["y"] + 5, steps=4)
            tab.mouse.up()
        else:
            tab.get_by_role("button", name=control).click()
        after = words(tab), pictures(tab)
        assert after[0] != before[0], control
        robot, forces, stability = map(str.__ne__, before[1], after[1])
        assert forces, control
        assert robot or control not in SLIDERS[:1] + SLIDERS[2:], control
        assert stability == (control not in ("Speed v (m/s)", "Moment")), control


def test_the_keyboard_reaches_and_drives_everything(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    reached = []
    for _ in range(12):
        tab.keyboard.press("Tab")
        reached.append(
            tab.evaluate("""(() => {
          const here = document.activeElement;
          return here.getAttribute("aria-label") || here.textContent;
        })()""")
        )
    controls = [*SLIDERS[:3], "Crank-Nicolson", "RK4", "Moment"]
    assert list(dict.fromkeys(name for name in reached if name in controls)) == controls
    assert any("Play" in name for name in reached)
    for name in SLIDERS:
        before = words(tab)
        slider(tab, name).press("ArrowLeft")
        assert words(tab) != before, name
        value = slider(tab, name).get_attribute("aria-valuetext")
        assert value and value != "null", name
    tab.get_by_role("button", name="Crank-Nicolson").press("Enter")
    assert "Crank-Nicolson" in words(tab)
    chosen = tab.get_by_role("button", name="Crank-Nicolson").get_attribute("aria-pressed")
    assert chosen == "true"


def test_a_typed_speed_is_taken_exactly(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    for v in (0.25, 1.2, 5, 10, 25, 0.1):
        speed = tab.get_by_role("textbox", name="Speed v (m/s)")
        speed.fill(str(v))
        speed.press("Enter")
        assert shown(tab)[0]["v"] == pytest.approx(v, rel=1e-14)


def test_the_words_say_what_the_run_says(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    text, (page, rows) = words(tab).translate(PLAIN), shown(tab)
    T = page["dt"] * np.arange(rows.shape[1])
    loss = first_loss(T, rows[4:])
    assert text.startswith(f"Contact lost: {('rear', 'front')[loss.wheel - 1]} wheel, ")
    found = re.search(r"t = ([\d.]+)\s*s, X = ([\d.]+)\s*m; smallest force (-?[\d.]+)\s*N", text)
    t, X, least = map(float, found.groups())
    assert t == pytest.approx(loss.t, rel=5e-3)
    assert X == pytest.approx(loss.t * page["v"], rel=5e-3)
    assert least == pytest.approx(rows[4:].min(), rel=5e-3)
    R = SCHEMES[1].one_step(Robot(793.2, 793.2).A, page["dt"])[0]
    growth = np.abs(np.linalg.eigvals(R)).max()
    assert f"no mode grows, the largest |R| = {growth:.5f}" in text
    error = float(re.search(r"differ by up to ([\d.]+) x 10⁻⁶ N", text)[1]) * 1e-6
    fine = simulate(Robot(793.2, 793.2), GaussianBump(), v=page["v"], dt=DTS[-1], tfinal=1.1)
    every = round(page["dt"] / DTS[-1])
    true_error = np.abs(rows[4:] - fine.N[:, ::every][:, : rows.shape[1]]).max()
    assert error == pytest.approx(true_error, rel=0.06)


def test_an_unstable_run_is_called_one_and_drawn(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    slider(tab, "Step Δt (ms)").press("Home")
    slider(tab, "Speed v (m/s)").press("Home")
    text = words(tab)
    assert text.startswith("Unstable run, so no verdict")
    assert "is unstable: a mode grows by |R| = " in text
    assert "x 10" in text.translate(PLAIN)
    assert not re.search(r"NaN|Infinity|undefined|null", text)
    _, rows = shown(tab)
    assert np.isfinite(rows).all() and np.abs(rows).max() > 1e50
    drawn = tab.locator(".se-forces").evaluate("""canvas => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      return data.filter((value, i) => i % 4 === 3 && value > 0).length / (data.length / 4);
    }""")
    assert drawn > 0.05


def test_play_moves_the_robot_and_stops_when_told(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    moment = slider(tab, "Moment")
    start = float(moment.get_attribute("aria-valuenow"))
    tab.wait_for_timeout(300)
    assert float(moment.get_attribute("aria-valuenow")) == start  # it does not start by itself
    tab.get_by_role("button", name="Play").click()
    tab.wait_for_timeout(800)
    assert float(moment.get_attribute("aria-valuenow")) > start + 20
    tab.get_by_role("button", name="Pause").click()
    rest = float(moment.get_attribute("aria-valuenow"))
    tab.wait_for_timeout(300)
    assert float(moment.get_attribute("aria-valuenow")) == rest
    tab.get_by_role("button", name="Play").click()
    moment.press("Home")
    tab.get_by_role("button", name="Play").wait_for()  # who takes the slider, stops it
    moment.press("End")
    tab.get_by_role("button", name="Play").click()
    tab.wait_for_timeout(400)
    assert 0 < float(moment.get_attribute("aria-valuenow")) < 500  # from the end, over again


def test_who_wants_little_motion_gets_steps(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html", reduced_motion="reduce")
    moment = slider(tab, "Moment")
    start = float(moment.get_attribute("aria-valuenow"))
    tab.get_by_role("button", name="Step").click()
    tab.wait_for_timeout(500)
    assert float(moment.get_attribute("aria-valuenow")) == start + 50


def test_it_follows_the_theme_while_it_changes(visit, pages):
    tab = visit(f"{pages.as_uri()}/bump.html")
    light = pictures(tab)
    ink = tab.locator("[aria-live]").evaluate("element => getComputedStyle(element).color")
    tab.evaluate("document.documentElement.dataset.theme = 'dark'")
    tab.wait_for_timeout(100)
    assert all(new != old for new, old in zip(pictures(tab), light, strict=True))
    assert tab.locator("[aria-live]").evaluate("e => getComputedStyle(e).color") != ink
    tab.evaluate("document.documentElement.dataset.theme = 'light'")
    tab.wait_for_timeout(100)
    assert pictures(tab) == light


def test_it_fits_a_phone_and_replaces_the_still_picture(visit, pages):
    tab = visit(f"{pages.as_uri()}/bumps.html", viewport={"width": 390, "height": 844})
    assert tab.evaluate("document.documentElement.scrollWidth") <= 390
    assert not tab.locator(".suspension-explorer-still").is_visible()
    for canvas in tab.locator("canvas").all():
        assert canvas.bounding_box()["width"] > 300


def test_without_scripts_a_still_picture_stands_there(browser, pages):
    tab = browser.new_page(java_script_enabled=False)
    tab.goto(f"{pages.as_uri()}/bump.html")
    still = tab.locator("img")
    assert still.is_visible()
    assert still.bounding_box()["height"] > 200
    assert len(still.get_attribute("alt").split()) > 20
    tab.close()


def test_every_explorer_of_the_book(visit, site, book):
    pages = [page for page in book.rglob("*.html") if MARK in page.read_text(encoding="utf-8")]
    assert pages
    rng = np.random.default_rng(11)
    for page in pages:
        tab = visit(site + page.relative_to(book).as_posix())
        count = tab.locator(BOX).count()
        assert count == tab.locator("img.suspension-explorer-still").count()
        assert not tab.locator("img.suspension-explorer-still").first.is_visible()
        for nth in range(count):
            for name in SLIDERS:
                before = words(tab, nth), pictures(tab, nth)
                press(tab, name, "ArrowLeft", 2, nth)
                if words(tab, nth) == before[0]:  # it stood at the end
                    press(tab, name, "ArrowRight", 3, nth)
                assert words(tab, nth) != before[0], (page, name)
                assert pictures(tab, nth) != before[1], (page, name)
            for _ in range(4):
                turn(tab, rng, nth)
                if nth == 0:  # a page's first explorer drives the problem's robot over its bump
                    compare(shown(tab, nth), the_robot(), GaussianBump())


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """A JupyterLab with one notebook; its address and its folder."""
    folder = tmp_path_factory.mktemp("lab")
    sources = [
        "import numpy as np\nfrom suspension.explorer import explore\n"
        "from suspension.road import GaussianBump\nfrom suspension.robot import Robot\n" + BUMPS,
        f"box = explore({LOPSIDED}, two_bumps, v=0.8)\nbox",
        "run = box.explorer.trajectory()\n"
        "np.savez('run.npz', W=run.W, N=run.N, v=run.v, dt=run.dt)\nprint('saved', run.v)",
    ]
    notebook = new_notebook(cells=[new_code_cell(source) for source in sources])
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    notebook.metadata.kernelspec = kernel
    nbformat.write(notebook, folder / "drive.ipynb")
    with serve(folder) as address:
        yield address, folder


def test_the_same_cell_is_alive_in_jupyterlab(browser, lab):
    address, folder = lab
    tab = browser.new_page(viewport={"width": 1300, "height": 1200})
    errors = []
    tab.on("pageerror", lambda error: errors.append(str(error)))
    run_all(tab, address, "drive.ipynb")
    tab.get_by_text("saved 0.8").wait_for(timeout=60_000)
    assert tab.locator(".suspension-explorer-still").count() == 0
    for control in [*SLIDERS, "Crank-Nicolson"]:
        before = words(tab), pictures(tab)
        if control in SLIDERS:
            press(tab, control, "ArrowLeft", 3)
        else:
            tab.get_by_role("button", name=control).click()
        assert words(tab) != before[0], control
        assert pictures(tab) != before[1], control
    page, rows = shown(tab)
    robot, road = PAGES["bumps"]
    compare((page, rows), robot, road)
    tab.locator(".jp-CodeCell .cm-content").last.click()
    tab.keyboard.press("Control+Enter")
    tab.get_by_text(re.compile(rf"saved {page['v']!r}")).wait_for(timeout=60_000)
    kernel = np.load(folder / "run.npz")
    assert (kernel["v"], kernel["dt"]) == (page["v"], page["dt"])
    assert np.abs(np.vstack([kernel["W"], kernel["N"]]) - rows).max() < PARITY
    before = tab.evaluate("document.body.dataset.jpThemeLight"), pictures(tab)
    tab.evaluate("document.body.dataset.jpThemeLight = 'false'")
    tab.wait_for_timeout(200)
    assert before[0] == "true" and pictures(tab) != before[1]
    assert not errors
    tab.close()
