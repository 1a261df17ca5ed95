"""What the explorer costs its reader: from control to picture, from opening to use, and in bytes.

    python benchmarks/bench_explorer.py [folder of the built book]

Needs Chromium, Playwright and a built book; prints a table with the budget beside each number, at
full speed and at a sixth of it, and the time from control to picture in JupyterLab.
"""

import gzip
import shutil
import statistics
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from helpers import find_chromium, serve_files, start_chromium  # noqa: E402
from lab import run_all, serve  # noqa: E402

MOVES = 40  # of each control
OPENINGS = 7
SLOWER = 6
MARK = '<div class="suspension-explorer-box'  # stands in every page with an explorer

# The first "painted" event is the moment the page can be used; it comes with the drawn frame.
WATCH = """
window.moves = [];
let pressed = 0;
const frame = window.requestAnimationFrame.bind(window);
window.requestAnimationFrame = (draw) => frame((now) => {
  const start = performance.now();
  draw(now);
  window.script = performance.now() - start;
});
for (const kind of ["keydown", "input"]) {
  document.addEventListener(kind, () => { pressed ||= performance.now(); }, true);
}
document.addEventListener("painted", () => {
  window.usable ??= performance.now();
  const start = pressed, channel = new MessageChannel();
  pressed = 0;
  // A message posted while a frame is being made arrives when that frame has been painted.
  channel.port1.onmessage = () => {
    if (start) moves.push([performance.now() - start, window.script]);
  };
  channel.port2.postMessage(0);
}, true);
"""

# The first explorer of a page with a slider for the speed goes slowly: a run of many steps.
SLOW = """() => {
  const boxes = [...document.querySelectorAll(".suspension-explorer-box")],
    on = 1 + boxes.findIndex((box) => box.querySelector("[data-trait=v]"));
  location.hash = `explore:on=${on}&v=0.25&dt=0.001`;
}"""


def control_to_picture(page):
    """Steps of the run; pairs of times in ms, to the painted picture and of script, one a key."""
    page.wait_for_selector(".suspension-explorer canvas")
    page.wait_for_timeout(500)
    sliders = page.locator(".se-control input[type=range]:visible, .noUi-handle")
    page.evaluate("moves.length = 0")
    for nth in range(sliders.count()):
        sliders.nth(nth).focus()
        for i in range(MOVES):
            page.keyboard.press(["ArrowLeft", "ArrowRight"][i % 2])
            page.wait_for_timeout(50 + 7 * (i % 5))  # not in step with the screen
    steps = page.evaluate(
        """Math.max(...[...document.querySelectorAll(".suspension-explorer")]
          .map((root) => root.trajectory().W?.[0].length ?? 0)) - 1"""
    )
    return steps, page.evaluate("moves")


def report(steps, moves, slower=1, budgets=("", "", "")):
    """One line about the times from control to picture; the least ones bear no other load."""
    frames, scripts = zip(*moves)
    print(
        f"  control to picture at 1/{slower} of the speed, {steps} steps, {len(moves)} moves: "
        f"script median {statistics.median(scripts):.1f} ms{budgets[0]}, "
        f"95 % {statistics.quantiles(scripts, n=20)[-1]:.1f} ms, least {min(scripts):.1f} ms; "
        f"painted median {statistics.median(frames):.1f} ms{budgets[1]}, "
        f"95 % {statistics.quantiles(frames, n=20)[-1]:.1f} ms{budgets[2]}"
    )


def in_jupyterlab(browser):
    """The same sliders in JupyterLab, with a kernel behind them."""
    with tempfile.TemporaryDirectory() as folder, serve(Path(folder)) as address:
        shutil.copy(ROOT / "notebooks/12-drive.ipynb", folder)
        tab = browser.new_page(viewport={"width": 1280, "height": 900})
        tab.add_init_script(WATCH)
        run_all(tab, address, "12-drive.ipynb")
        tab.wait_for_timeout(5000)
        print("12-drive in JupyterLab")
        report(*control_to_picture(tab))
        tab.close()


def weigh(browser, url):
    """Bytes of all that a page loads, each file gzipped if that helps."""
    sizes, page = {}, browser.new_page()
    page.on("response", lambda answer: sizes.setdefault(answer.url, answer))
    page.goto(url, wait_until="networkidle")
    total = 0
    for address, answer in list(sizes.items()):
        if address.startswith("http") and answer.ok:
            body = page.request.get(address).body()  # the browser may have dropped its copy
            total += min(len(body), len(gzip.compress(body)))
    page.close()
    return total


def open_page(browser, url, slower):
    """A page in a context of its own, so that nothing is cached; seconds until it can be used."""
    tab = browser.new_page(viewport={"width": 1366, "height": 768})
    tab.add_init_script(WATCH)
    if slower > 1:
        session = tab.context.new_cdp_session(tab)
        session.send("Emulation.setCPUThrottlingRate", {"rate": slower})
    tab.goto(url)
    tab.wait_for_function("window.usable")
    return tab, tab.evaluate("usable") / 1000


def main(book):
    """Measure and print."""
    pages = sorted(path.relative_to(book) for path in book.rglob("*.html"))
    pages = [
        page
        for page in pages
        if not str(page).startswith("_static")
        and 'http-equiv="refresh"' not in (book / page).read_text(encoding="utf-8").lower()
    ]
    live = [page for page in pages if MARK in (book / page).read_text(encoding="utf-8")]
    if not live:
        sys.exit(f"no page with an explorer in {book}")
    with serve_files(book) as address, start_chromium(find_chromium(whole=True)) as browser:
        for live_page in live:
            print(f"{live_page}")
            url = address + live_page.as_posix()
            for slower, budget in ((1, 0.5), (SLOWER, 2.5)):
                usable = []
                for _ in range(OPENINGS if slower == 1 else 3):
                    tab, seconds = open_page(browser, url, slower)
                    usable.append(seconds)
                    tab.close()
                print(
                    f"  opened to usable at 1/{slower} of the speed: "
                    f"median {statistics.median(usable):.2f} s (< {budget}), "
                    f"least {min(usable):.2f} s"
                )
            for slower, budgets in ((1, (" (<= 8)", " (<= 16)", " (< 33)")), (SLOWER, ("",) * 3)):
                tab, _ = open_page(browser, url, slower)
                tab.evaluate(SLOW)
                report(*control_to_picture(tab), slower, budgets)
                tab.close()
            print(f"  weight, gzipped: {weigh(browser, url) / 1e3:.0f} kB (<= 450)")
        others = {
            page: weigh(browser, address + page.as_posix()) for page in pages if page not in live
        }
        if others:
            heaviest = max(others, key=others.get)
            print(
                f"{len(others)} other pages, gzipped: at most {others[heaviest] / 1e3:.0f} kB, "
                f"{heaviest}"
            )
        in_jupyterlab(browser)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "_build/html").resolve())
