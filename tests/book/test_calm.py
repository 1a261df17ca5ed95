"""What a page weighs, that nothing moves when it loads, and that its security policy holds."""

import gzip
import re
from contextlib import contextmanager
from functools import partial
from http.server import ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from urllib.parse import urlsplit

import pytest
from helpers import PAGES, ROOT, QuietHandler

KILOBYTES = 350  # gzipped, of a page without an explorer
REQUESTS = 20
SHIFT = 0.02  # cumulative layout shift
PAINT = 2500  # ms to the largest paint, at a sixth of the speed
POLICY = (ROOT / "README.md").read_text(encoding="utf-8").split("```text\ndefault-src")[1]
POLICY = " ".join(("default-src" + POLICY.split("```")[0]).split())
WATCH = """
window.shift = 0; window.paint = 0; window.broken = [];
new PerformanceObserver((list) => {
  for (const entry of list.getEntries()) if (!entry.hadRecentInput) window.shift += entry.value;
}).observe({type: "layout-shift", buffered: true});
new PerformanceObserver((list) => {
  for (const entry of list.getEntries()) window.paint = entry.startTime;
}).observe({type: "largest-contentful-paint", buffered: true});
addEventListener("securitypolicyviolation", (event) =>
  window.broken.push(`${event.violatedDirective} ${event.blockedURI} ${event.sourceFile}`));
"""


ASKED = """[...document.querySelectorAll("article .katex-html *")].flatMap((node) => {
  const text = [...node.childNodes].some((x) => x.nodeType === Node.TEXT_NODE && x.data.trim());
  const {fontFamily, fontWeight, fontStyle} = getComputedStyle(node);
  return text ? [[fontFamily.split(",")[0], fontWeight, fontStyle].join()] : [];
})"""

THERE = """[...document.fonts].map(({family, weight, style}) =>
  [family.replaceAll('"', ""), weight, style].join())"""


class StrictHandler(QuietHandler):
    """A file server that sends the policy of the README."""

    def end_headers(self):
        """Add the header."""
        self.send_header("Content-Security-Policy", POLICY)
        super().end_headers()


@pytest.fixture(scope="module")
def strict_site(book):
    """Address of the book on a server with the policy."""
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(StrictHandler, directory=book)) as server:
        Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()


@contextmanager
def opened(browser, address, width, slowness=1):
    """A page on a screen of some width, with a slowed processor; and what it asked for."""
    tab = browser.new_page(viewport={"width": width, "height": 800})
    asked = []
    tab.on("request", lambda request: asked.append(request.url))
    if slowness > 1:
        session = tab.context.new_cdp_session(tab)
        session.send("Emulation.setCPUThrottlingRate", {"rate": slowness})
    tab.add_init_script(WATCH)
    tab.goto(address, wait_until="networkidle")
    tab.wait_for_timeout(300)
    yield tab, asked
    tab.close()


PUNCTUATION = """() => [...document.querySelectorAll("article .together")].flatMap((span) => {
  const boxes = [...span.querySelectorAll(".katex-html > .base")]
      .map((base) => base.getBoundingClientRect()).filter((box) => box.width);
  if (!boxes.length) return [];
  return [[span.firstChild, boxes[0]], [span.lastChild, boxes.at(-1)]].flatMap(([text, base]) => {
    if (text.nodeType !== Node.TEXT_NODE || !text.data) return [];
    const range = document.createRange();
    range.selectNodeContents(text);
    const box = range.getBoundingClientRect();
    return [[span.textContent.slice(-30), box.top < base.bottom && box.bottom > base.top]];
  });
})"""


@pytest.fixture(params=PAGES)
def page(request):
    return request.param


def has_widgets(tab):
    """Whether a page has an explorer, with budgets of its own."""
    return tab.locator("article [class*=explorer]").count() > 0


def test_a_page_is_light_and_calm_and_keeps_the_policy(browser, strict_site, book, page):
    with opened(browser, f"{strict_site}{page}.html", 1280) as (tab, asked):
        shift, broken, widgets = *tab.evaluate("[shift, broken]"), has_widgets(tab)
        for width in (1280, 700, 540, *range(390, 450, 10)):
            tab.set_viewport_size({"width": width, "height": 800})
            apart = [text for text, together in tab.evaluate(PUNCTUATION) if not together]
            assert not apart, f"a line ends before punctuation at {width} px: {apart}"
    files = [book / urlsplit(url).path[1:] for url in asked if url.startswith(strict_site)]
    weight = sum(len(gzip.compress(Path(file).read_bytes(), 9, mtime=0)) for file in files)
    print(f"{page}: {weight / 1000:.0f} kB, {len(asked)} requests, shift {shift:.3f}")
    assert shift < SHIFT
    if not widgets:
        assert not broken
        assert weight <= 1000 * KILOBYTES
        assert len(asked) <= REQUESTS


def test_nothing_moves_on_a_slow_phone(browser, strict_site, page):
    for _ in range(3):  # other tests run on the same machine
        with opened(browser, f"{strict_site}{page}.html", 390, slowness=6) as (tab, _):
            shift, paint = tab.evaluate("[shift, paint]")
            widgets = has_widgets(tab)
        print(f"{page}: shift {shift:.3f}, largest paint after {paint:.0f} ms")
        assert shift < SHIFT
        if paint < PAINT or widgets:
            return
    pytest.fail(f"{page}: the largest paint comes after {paint:.0f} ms")


@pytest.mark.parametrize("page", ["book/model", "search", "404"])
def test_the_theme_button_needs_no_inline_script(browser, strict_site, page):
    with opened(browser, f"{strict_site}{page}.html", 1280) as (tab, _):
        assert tab.evaluate("broken") == []
        button, root = tab.locator(".theme-switch-button").first, "document.documentElement"
        seen = set()
        for _ in range(3):
            button.click()
            seen.add(tab.evaluate(f"{root}.dataset.mode"))
        assert seen == {"light", "dark", "auto"}


def test_the_policy_allows_no_script_from_text():
    assert "unsafe-eval" not in POLICY
    assert "script-src 'self';" in POLICY


@pytest.mark.parametrize("words", ["Butcher", "__proto__", "constructor"])
def test_the_search_survives_any_word(browser, strict_site, words):
    with opened(browser, f"{strict_site}search.html?q={words}", 1280) as (tab, _):
        tab.wait_for_function("document.querySelector('.search-summary')?.innerText.includes('found')"
                              " || document.body.innerText.includes('did not match')")  # fmt: skip
        if words == "Butcher":
            assert tab.locator("#search-results li a").count()


@pytest.mark.parametrize("page", PAGES)
def test_only_pages_with_formulas_wait_for_their_fonts(book, page):
    text = (book / f"{page}.html").read_text(encoding="utf-8")
    head = text.split("</head>")[0]
    waits = re.findall(r'<script src="[^"]*/_static/(\w+\.js)', head)
    formulas = 'class="katex"' in text
    assert waits == (["first.js", "fonts.js"] if formulas else ["first.js"])
    weight = sum(len(gzip.compress((book / "_static" / name).read_bytes(), 9)) for name in waits)
    assert weight < (80_000 if formulas else 10_000)


def test_the_first_paint_waits_for_nothing_but_page_and_style(browser, book, site):
    """On a line of 400 kbit/s that compresses nothing; scripts at work later come later."""
    page, speed = "book/index.html", 50_000  # bytes a second
    text = (book / page).read_text(encoding="utf-8")
    needed = re.findall(r'(?:<script src|rel="stylesheet"[^>]* href)="\.\./([^"?]*)', text)
    assert len(needed) == 4  # theme and icons, both style sheets, and one for who has no scripts
    files = [book / page, *(book / name for name in needed if "fonts.css" not in name)]
    allowed = 1000 * (1.15 * sum(file.stat().st_size for file in files) / speed + 1)
    for _ in range(3):  # other tests run on the same machine
        tab = browser.new_page(viewport={"width": 1280, "height": 800})
        line = {"offline": False, "latency": 50, "downloadThroughput": speed}
        session = tab.context.new_cdp_session(tab)
        session.send("Network.enable")
        session.send("Network.emulateNetworkConditions", line | {"uploadThroughput": speed})
        tab.goto(site + page, wait_until="load")
        paint = tab.evaluate("performance.getEntriesByName('first-contentful-paint')[0].startTime")
        tab.close()
        print(f"{paint:.0f} of {allowed:.0f} ms")
        if paint < allowed:
            return
    pytest.fail(f"the first paint comes after {paint:.0f} ms, not {allowed:.0f}")


def test_every_formula_finds_its_fonts(browser, strict_site):
    for page in ("book/model", "notebooks/03-runge-kutta", "notebooks/05-how-we-know"):
        with opened(browser, f"{strict_site}{page}.html", 1280) as (tab, _):
            asked, there = set(tab.evaluate(ASKED)), set(tab.evaluate(THERE))
        assert len(asked) > 2 and asked <= there


def test_without_scripts_formulas_have_their_fonts(browser, strict_site):
    context = browser.new_context(java_script_enabled=False)
    tab = context.new_page()
    asked = []
    tab.on("request", lambda request: asked.append(request.url))
    tab.goto(f"{strict_site}book/model.html", wait_until="networkidle")
    context.close()
    assert [url for url in asked if url.endswith("fonts.css")]
