"""The built book: its pages, links, figures and widgets; `tests/browser/` opens them."""

import re
from functools import cache
from html import unescape
from urllib.parse import unquote, urlsplit

import pytest
from execution import FOR_BROWSERS
from helpers import PAGES, ROOT, parse

from suspension.explorer.bundle import without_comments

# Of links that set a picture or an instrument, and lead to no anchor.
PREFIXES = ("explore:", "workshop:", "chain:", "own:", "game:")
INSTRUMENTS = ROOT / "suspension" / "explorer" / "page"
each_page = pytest.mark.parametrize("page", [*PAGES, "search", "genindex"])


@cache
def anchors(path):
    found = parse(path).find_all(lambda tag: tag.has_attr("id") or tag.has_attr("name"))
    return {tag.get("id") for tag in found} | {tag.get("name") for tag in found}


def addresses(soup, *attributes):
    """Every address that a page links to or loads."""
    for attribute in attributes:
        for tag in soup.find_all(attrs={attribute: True}):
            yield tag[attribute].split()[0] if tag[attribute].strip() else ""
    for tag in soup.find_all(attrs={"srcset": True}):
        yield from (part.split()[0] for part in tag["srcset"].split(","))


def is_external(address):
    return urlsplit(address).scheme not in ("", "data") or address.startswith("//")


@each_page
def test_page_is_built_and_has_one_title(book, page):
    soup = parse(book / f"{page}.html")
    assert len(soup.find_all("h1")) == 1
    assert soup.html["lang"] == "en"
    assert soup.title.get_text(strip=True)


def test_no_page_holds_a_script_or_a_style_of_an_instrument(book):
    """They are files beside the pages: a change of them has no notebook executed again."""
    sources = [path for path in INSTRUMENTS.iterdir() if path.suffix in FOR_BROWSERS]
    texts = [without_comments(path.read_text(encoding="utf-8")) for path in sources]
    longest = {max(map(str.strip, text.splitlines()), key=len) for text in texts}
    assert len(longest) > 50 and min(map(len, longest)) > 30
    for page in PAGES:
        html = (book / f"{page}.html").read_text(encoding="utf-8")
        assert not [line for line in longest if line in unescape(html)], page


@each_page
def test_internal_links_and_anchors_resolve(book, page):
    here = book / f"{page}.html"
    broken = []
    for address in addresses(parse(here), "href", "src", "data", "poster"):
        if is_external(address) or address.startswith("data:"):
            continue
        parts = urlsplit(address)
        target = (here.parent / unquote(parts.path)).resolve() if parts.path else here
        found = target.is_file() and target.is_relative_to(book)
        sets_a_picture = parts.fragment.startswith(PREFIXES)
        if found and parts.fragment and target.suffix == ".html" and not sets_a_picture:
            found = unquote(parts.fragment) in anchors(target)
        if not found:
            broken.append(address)
    assert not broken


@each_page
def test_no_script_style_image_or_font_is_on_another_host(book, page):
    here = book / f"{page}.html"
    soup = parse(here)
    loaded = [
        *addresses(soup, "src", "data", "poster"),
        *(link["href"] for link in soup.find_all("link") if link.get("rel") != ["canonical"]),
    ]
    styles = [tag.get_text() for tag in soup.find_all("style")]
    for address in loaded:
        path = here.parent / urlsplit(address).path
        if path.suffix == ".css":
            styles.append(path.read_text(encoding="utf-8"))
    for style in styles:
        loaded += re.findall(r"url\(\s*['\"]?([^'\")]+)", style)
        loaded += re.findall(r"@import\s+['\"]([^'\"]+)", style)
    assert len(loaded) > 5
    assert not [address for address in loaded if is_external(address)]


@each_page
def test_figures_have_alt_text_and_caption(book, page):
    for image in parse(book / f"{page}.html").select("article img, article svg[role=img]"):
        alt = image.get("alt") or image.get("aria-label", "")
        assert len(alt.split()) >= 3, f"alt text of a figure on {page}: {alt!r}"
        assert not re.search(r"[0-9a-f]{16}|\.(png|svg|jpe?g)\b", alt), alt
        if not image.find_parent("figure"):  # an explorer's still picture
            assert "figure-svg" not in image.get("class", [])
            continue
        caption = image.find_parent("figure").figcaption
        assert len(caption.select_one(".caption-text").get_text().split()) >= 3, alt


@each_page
def test_figures_follow_the_theme_and_the_width(book, page):
    soup = parse(book / f"{page}.html")
    figures = soup.select("article figure .figure-svg")
    shapes = {shape["id"] for shape in soup.select(".shared-shapes [id]")}
    for figure in figures:
        assert int(figure["width"]) > 0 and int(figure["height"]) > 0
        markup = str(figure)
        assert "var(--figure-ink)" in markup or "var(--figure-paper)" in markup
        assert not re.search(r"fill:\s*(#fff|#000|white|black)\b", markup)
        assert set(re.findall(r'(?:href="|url\()#([\w.-]+)', markup)) <= shapes
        assert not figure.select("[id]"), "two figures may have the same ids"
    wide, narrow = (soup.select(f"figure .figure-svg.{name}") for name in ("if-wide", "if-narrow"))
    assert len(wide) == len(narrow) == len(figures) / 2, "every figure is laid out for a phone"
    for figure in narrow:
        assert int(figure["width"]) <= 400


@pytest.mark.parametrize("page", ["01-regression", "02-crank-nicolson"])
def test_a_prediction_is_tapped_and_its_answer_folded(book, page):
    soup = parse(book / f"notebooks/{page}.html")
    asked = [bold.parent for bold in soup.select("article p > strong") if bold.string == "Predict."]
    assert asked
    for question in asked:
        choices = question.find_next_sibling()
        assert choices and "choices" in choices.get("class", [])
        assert len(choices.find_all("li")) == 3
        answer = choices.find_next_sibling()
        assert "fold" in answer["class"] and answer.summary.get_text() == "Answer"
        assert answer.p.find("strong", recursive=False) is answer.p.contents[0]


def test_references_are_in_alphabetical_order_and_labelled_by_author_and_year(book):
    found = parse(book / "book/references.html").select("div.citation > .label")
    labels = [label.get_text(strip=True).strip("[]") for label in found]
    assert len(labels) > 30 and all(re.search(r", (\d{4}|undated)$", label) for label in labels)
    authors = [re.split(" and |, | et al", label)[0].casefold() for label in labels]
    assert authors == sorted(authors)


def test_the_landing_page_shows_a_figure(book):
    assert parse(book / "book/index.html").select("article figure .figure-svg")


@each_page
def test_no_page_needs_a_widget_manager(book, page):
    soup = parse(book / f"{page}.html")
    assert not soup.find_all("script", type=re.compile("jupyter.widget"))
    scripts = [script.get("src", "") for script in soup.find_all("script")]
    assert not [name for name in scripts if "require" in name or "embed" in name]


def test_every_notebook_page_was_executed(book):
    for page in PAGES:
        if page.startswith("notebooks/"):
            soup = parse(book / f"{page}.html")
            assert soup.select(".cell_output"), page
            assert not soup.select(".output.traceback"), page


@each_page
def test_formulas_are_set_and_need_no_script(book, page):
    soup = parse(book / f"{page}.html")
    for formula in soup.select("article .math"):
        assert formula.select_one(".katex-html") and formula.select_one("math"), formula
    scripts = " ".join(str(script) for script in soup.find_all("script")).lower()
    assert "mathjax" not in scripts and "katex" not in scripts
