"""What the explorer costs its reader: from slider to picture, from opening to use, and in bytes.

    python benchmarks/bench_explorer.py [folder of the built book]

Needs Chromium, Playwright and a built book; prints a table with the budget beside each number, and
the time from slider to picture in JupyterLab.
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

MOVES = 120
OPENINGS = 7
MARK = 'type="application/vnd.jupyter.widget-view+json"'  # stands in every page with an explorer

# The first "painted" event is the moment the page can be used; it comes with the drawn frame.
WATCH = """
window.moves = [];
let pressed = 0;
document.addEventListener("keydown", (event) => { pressed = event.timeStamp; }, true);
document.addEventListener("painted", () => {
  window.usable ??= performance.now();
  const start = pressed, channel = new MessageChannel();
  pressed = 0;
  // A message posted while a frame is being made arrives when that frame has been painted.
  channel.port1.onmessage = () => { if (start) moves.push(performance.now() - start); };
  channel.port2.postMessage(0);
}, true);
"""


def slider_to_picture(page):
    """Times in ms from a key on the speed's or the stiffness's slider to the painted picture."""
    page.wait_for_selector(".suspension-explorer canvas")
    speed = page.get_by_role("textbox", name="Speed v (m/s)").first
    speed.fill("0.25")
    speed.press("Enter")
    step = page.get_by_role("slider", name="Step Δt (ms)").first
    while step.get_attribute("aria-valuetext") != "1":
        step.press("ArrowRight" if float(step.get_attribute("aria-valuetext")) > 1 else "ArrowLeft")
        page.wait_for_timeout(100)
    run = page.evaluate("document.querySelector('.suspension-explorer').trajectory()")
    steps = len(run["W"][0]) - 1
    page.evaluate("moves.length = 0")
    for name in ("Speed v (m/s)", "Stiffness k (N/m)"):
        page.get_by_role("slider", name=name).first.focus()
        for i in range(MOVES // 2):
            page.keyboard.press(["ArrowLeft", "ArrowRight"][i % 2])
            page.wait_for_timeout(50 + 7 * (i % 5))  # not in step with the screen
    return steps, page.evaluate("moves")


def report(steps, moves, budgets=("", "")):
    """One line about the times from slider to picture."""
    median, p95 = statistics.median(moves), statistics.quantiles(moves, n=20)[-1]
    print(
        f"  slider to picture, {steps} steps, {len(moves)} moves: "
        f"median {median:.1f} ms{budgets[0]}, 95 % {p95:.1f} ms{budgets[1]}"
    )


def in_jupyterlab(browser):
    """The same slider in JupyterLab, with a kernel behind it."""
    with tempfile.TemporaryDirectory() as folder, serve(Path(folder)) as address:
        shutil.copy(ROOT / "notebooks/07-drive.ipynb", folder)
        tab = browser.new_page(viewport={"width": 1280, "height": 900})
        tab.add_init_script(WATCH)
        run_all(tab, address, "07-drive.ipynb")
        tab.wait_for_timeout(5000)
        print("07-drive in JupyterLab")
        report(*slider_to_picture(tab))
        tab.close()


def weigh(browser, url):
    """Bytes of all that a page loads, each file gzipped if that helps."""
    sizes, page = {}, browser.new_page()
    page.on("response", lambda answer: sizes.setdefault(answer.url, answer))
    page.goto(url, wait_until="networkidle")
    total = 0
    for address, answer in list(sizes.items()):
        if address.startswith("http") and answer.ok:
            body = answer.body()
            total += min(len(body), len(gzip.compress(body)))
    page.close()
    return total


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
    with serve_files(book) as address, start_chromium(find_chromium()) as browser:
        for live_page in live:
            usable = []
            for _ in range(OPENINGS):
                tab = browser.new_page()  # a context of its own, so nothing is cached
                tab.add_init_script(WATCH)
                tab.goto(address + live_page.as_posix())
                tab.wait_for_function("window.usable")
                usable.append(tab.evaluate("usable") / 1000)
                if len(usable) < OPENINGS:
                    tab.close()
            steps, moves = slider_to_picture(tab)
            tab.close()
            size = weigh(browser, address + live_page.as_posix())
            print(f"{live_page}")
            report(steps, moves, (" (< 16)", " (< 50)"))
            print(
                f"  opened to usable, {OPENINGS} times: median {statistics.median(usable):.2f} s,"
                f" longest {max(usable):.2f} s (< 2)"
            )
            print(f"  weight, gzipped: {size / 1e6:.2f} MB (<= 1.8)")
        others = {
            page: weigh(browser, address + page.as_posix()) for page in pages if page not in live
        }
        if others:
            heaviest = max(others, key=others.get)
            print(
                f"{len(others)} other pages, gzipped: at most {others[heaviest] / 1e6:.2f} MB "
                f"(<= 1.2), {heaviest}"
            )
        in_jupyterlab(browser)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "_build/html").resolve())
