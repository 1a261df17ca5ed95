"""Print the built book: ``python book/paper.py`` writes the answer sheet and the whole book as PDF.

The pages of the book are joined into one, which a headless Chromium prints twice: the first time to
see on which sheet every part begins, the second time with the numbers in the list of contents.
"""

import re
import shutil
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from bs4 import BeautifulSoup
from playwright.sync_api import sync_playwright
from pypdf import PdfReader, PdfWriter
from pypdf.generic import NameObject, TextStringObject

ROOT = Path(__file__).resolve().parents[1]
HTML = ROOT / "_build" / "html"
PDF = ROOT / "_build" / "pdf"
ANSWERS = "book/answers"
NEXT = re.compile(r'<link rel="next"[^>]*href="([^"#]+)')
BROWSERS = (
    *("chromium-headless-shell", "chromium", "chromium-browser"),
    *("google-chrome", "google-chrome-stable"),
)
MARGINS = {"top": "16mm", "bottom": "18mm", "left": "20mm", "right": "20mm"}
LONG = 25  # rows: a longer table begins where it stands, and goes on overleaf
FOOT = """<div style="font: 8pt sans-serif; width: 100%; text-align: center; color: #444">
<span class="pageNumber"></span></div>"""
STYLE = """
html { font-size: 13px; }
body { background: #fff; color: #000; }
main { max-width: none; padding: 0; }
article.page { break-before: page; --measure: 100%; line-height: 1.4; }
article.page:first-of-type { break-before: auto; }
article.page :is(p, ul, ol) { margin-bottom: 0.6em; }
article.page :is(h2, h3, h4) { margin: 1.1em 0 0.5em; }
article.page h1 { font-size: 1.9rem; margin: 0 0 0.7em; }
article.page h2 { font-size: 1.5rem; }
article.page h3 { font-size: 1.2rem; }
article.page h4 { font-size: 1.05rem; }
article.page table { margin: 0.5em auto; line-height: 1.25; }
article.page :is(td, th) { padding: 0.15em 0.6em; }
article.page :is(td, th) p { margin: 0; }
article.page table.long { break-inside: auto; }
article.page tr { break-inside: avoid; }
article.page .leads { break-after: avoid; } /* a sentence stays with its table */
article.page figure { margin: 0.6em 0; }
article.page figcaption { margin-top: 0.3em; }
article.page .figure-svg { max-height: 80mm; }
article.page :is(div.cell, div.cell_input, div.cell_output) { margin: 0.3em 0; padding: 0; }
/* Chromium breaks no box that scrolls, and no flexible one as the theme's around listings. */
article.page :is(div.cell, div.cell_input, div.cell_output, div[class*=highlight-]),
article.page :is(div.highlight, pre) { display: block; break-inside: auto; overflow: visible; }
article.page div.highlight pre {
  padding: 0.4em 0.5em; font-size: 0.8rem; line-height: 1.25; orphans: 4; widows: 4;
}
article.page .se-layout > :not(.se-place) { display: none; }
article.page :is(button, input, select) { display: none; }
.sheets a { display: flex; line-height: 1.35; color: inherit; text-decoration: none; }
.sheets a.inner { padding-left: 1.5em; }
.sheets a .dots { flex: 1; border-bottom: 1px dotted #888; margin: 0 0.4em 0.3em; }
.sheets { break-after: page; }
.book-title { font-size: 1.8em; font-weight: bold; margin: 0 0 1em; }
"""
# To see where every part begins nothing need be painted.
UNSEEN = "main svg, main img, main .katex { visibility: hidden; }"


def page_names():
    """The pages of the book, in its order: each page leads to the next."""
    name = "book/index"
    while name:
        yield name
        following = NEXT.search((HTML / f"{name}.html").read_text(encoding="utf-8"))
        address = following and (HTML / name).parent.joinpath(following[1]).resolve()
        name = address and address.relative_to(HTML).with_suffix("").as_posix()


def article(name, names):
    """The text of a page, with ids of its own; links to pages that are printed lead there."""
    page = HTML / f"{name}.html"
    soup = BeautifulSoup(page.read_text(encoding="utf-8"), "html.parser")
    body = soup.find("article")
    shapes = soup.select_one(".shared-shapes")
    if shapes and not body.select_one(".shared-shapes"):
        body.insert(0, shapes)
    for node in body.select("script, .prev-next-area, .headerlink, .copybtn"):
        node.decompose()
    for details in body.find_all("details"):
        if "hide" in details.get("class", []):
            details.decompose()  # plumbing
        else:
            details["open"] = ""  # proofs and solutions unfold
    for table in body.find_all("table"):
        lead = table.find_previous("p")
        if lead and not lead.find_parent("table"):
            lead["class"] = [*lead.get("class", []), "leads"]
        if len(table.find_all("tr")) > LONG:
            table["class"] = [*table.get("class", []), "long"]
    prefix = name.replace("/", "-")
    for node in body.find_all(id=True):
        node["id"] = f"{prefix}--{node['id']}"
    for node in body.find_all(True):
        for key in ("href", "clip-path", "style", "marker-end", "marker-start", "mask"):
            if key in node.attrs and node.name != "a":
                node[key] = re.sub(r"(^#|url\(#)", rf"\g<1>{prefix}--", node[key])
    for link in body.find_all("a", href=True):
        link["href"] = printed_address(link["href"], page, names)
        if not link["href"]:
            del link["href"]
    for image in body.find_all("img", src=True):
        if not image["src"].startswith("data:"):
            image["src"] = page.parent.joinpath(image["src"]).resolve().as_uri()
    body.name = "article"
    body["class"] = "page bd-article"
    body["id"] = prefix
    return body


def printed_address(address, page, names):
    """Where a link leads on paper: to a printed page, outside, or nowhere."""
    if re.match(r"[a-z]+:", address):
        return address
    path, _, anchor = address.partition("#")
    target = page.parent.joinpath(path).resolve() if path else page
    name = target.with_suffix("").relative_to(HTML).as_posix() if HTML in target.parents else ""
    if name not in names:
        return ""
    prefix = name.replace("/", "-")
    return f"#{prefix}--{anchor}" if anchor else f"#{prefix}"


def joined(title, articles, numbers, style):
    """One page that holds all, behind a list of contents if there is more than one."""
    lines = []
    for body in articles if len(articles) > 1 else []:
        for heading in body.select("h1, h2"):
            at = heading.get("id") or heading.find_parent(id=True)["id"]
            kind = "inner" if heading.name == "h2" else "outer"
            lines.append(
                f'<a class="{kind}" href="#{at}"><span>{heading.get_text()}</span>'
                f'<span class="dots"></span><span>{numbers.get(at, "")}</span></a>'
            )
    head = f'<p class="book-title">{title}</p><h1>Contents</h1>'
    contents = f'<nav class="sheets">{head}{"".join(lines)}</nav>'
    static = (HTML / "_static").as_uri()
    return f"""<!doctype html><html lang="en" data-theme="light"><head><meta charset="utf-8">
<title>{title}</title><link rel="stylesheet" href="{static}/book.css">
<link rel="stylesheet" href="{static}/fonts.css"><style>{style}</style></head>
<body><main class="bd-main"><div class="bd-content"><div class="bd-article-container">
{contents if lines else ""}{"".join(map(str, articles))}</div></div></main></body></html>"""


def starts(path):
    """The sheet, from 1, on which each destination of a PDF lies."""
    reader = PdfReader(path)
    return {
        name.removeprefix("/"): reader.get_destination_page_number(place) + 1
        for name, place in reader.named_destinations.items()
    }


def mend_bookmarks(path):
    """Write each title once: Chromium repeats that of a heading moved to the next sheet."""
    if not any(map(is_doubled, flat(PdfReader(path).outline))):
        return  # to write the file again takes long
    writer = PdfWriter(clone_from=path)
    for bookmark in filter(is_doubled, flat(writer.outline)):
        title = bookmark.title[: len(bookmark.title) // 2]
        bookmark.node[NameObject("/Title")] = TextStringObject(title)
    writer.write(path)


def is_doubled(bookmark):
    """Whether a title consists of the same words twice."""
    half = len(bookmark.title) // 2
    return bookmark.title[:half] == bookmark.title[half:]


def flat(outline):
    """All bookmarks, whatever their level."""
    for entry in outline:
        yield from flat(entry) if isinstance(entry, list) else [entry]


def print_pages(browser, names, path):
    """Print pages of the book into a file; return the number of sheets."""
    articles = [article(name, names) for name in names]
    title = articles[0].h1.get_text()
    numbers = {}
    with TemporaryDirectory() as folder:
        source = Path(folder, "book.html")
        for final in (False, True) if len(names) > 1 else (True,):
            style = STYLE if final else STYLE + UNSEEN
            source.write_text(joined(title, articles, numbers, style), encoding="utf-8")
            tab = browser.new_page()
            tab.goto(source.as_uri(), wait_until="networkidle")
            tab.evaluate("document.fonts.ready")
            tab.pdf(
                path=path,
                format="A4",
                margin=MARGINS,
                print_background=True,
                display_header_footer=True,
                header_template="<span></span>",
                footer_template=FOOT,
                outline=final,
                tagged=final,
            )
            tab.close()
            numbers = starts(path)
    mend_bookmarks(path)
    return len(PdfReader(path).pages)


def find_browser():
    """The program that prints; ends with what to do if there is none."""
    program = next(filter(None, map(shutil.which, BROWSERS)), None)
    if program is None:
        sys.exit("Printing needs Chromium or Chrome; on Debian: apt install chromium")
    return program


def main():
    """Print both; say where they are."""
    program = find_browser()
    if not (HTML / "index.html").exists():
        sys.exit("There is no book in _build/html: run 'make book' first")
    PDF.mkdir(parents=True, exist_ok=True)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        for file, names in (("answers", [ANSWERS]), ("book", list(page_names()))):
            path = PDF / f"{file}.pdf"
            print(f"{path.relative_to(ROOT)}: {print_pages(browser, names, path)} sheets")
        browser.close()


if __name__ == "__main__":
    find_browser() if "--check" in sys.argv else main()
