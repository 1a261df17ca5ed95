"""The book on paper: the answer sheet is complete, both files can be navigated, nothing is cut."""

import re
import subprocess
import sys

import pytest
from helpers import PAGES, ROOT, parse
from pypdf import PdfReader
from pypdfium2 import PdfDocument

ITEMS = (
    "1(i) 1(ii) 1(iii) 1(iv) 2(i) 2(ii) 3(i) 3(ii) 4(i) 4(ii) 5(i) 5(ii) 5(iii) 6(i) 6(ii) 6(iii)"
)
ITEMS += " 7(i) 7(ii) 8(i) 8(ii) 9(i) 9(ii) 9(iii) 9(iv) 10(i) 10(ii)"
A4 = (595, 842)  # points


@pytest.fixture(scope="module")
def printed(book, chromium):
    """The answer sheet and the whole book, printed anew from the built pages."""
    command = [sys.executable, ROOT / "book" / "paper.py"]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr
    folder = ROOT / "_build" / "pdf"
    return {name: PdfReader(folder / f"{name}.pdf") for name in ("answers", "book")}


@pytest.fixture(scope="module")
def texts(printed):
    """The text of every sheet of both, and the left and right end of its pieces, in points."""
    return {
        name: [read(sheet.get_textpage()) for sheet in PdfDocument(reader.stream)]
        for name, reader in printed.items()
    }


def read(sheet):
    """The text of a sheet, and where its pieces begin and end, shape (n, 2)."""
    boxes = [sheet.get_rect(i) for i in range(sheet.count_rects())]
    return sheet.get_text_range(), [(left, right) for left, _, right, _ in boxes]


def titles(outline):
    return [title for entry in outline for title in
            (titles(entry) if isinstance(entry, list) else [entry.title])]  # fmt: skip


def test_every_item_is_answered_in_order(texts):
    text = re.sub(r"\s+", "", " ".join(text for text, _ in texts["answers"]))
    places = [text.find(f"Answer{item}.") for item in ITEMS.split()]
    assert -1 not in places
    assert places == sorted(places)


@pytest.mark.parametrize("name", ["answers", "book"])
def test_nothing_is_cut(printed, texts, name):
    for page, (_, places) in zip(printed[name].pages, texts[name]):
        assert [float(side) for side in page.mediabox[2:]] == pytest.approx(A4, abs=2)
        assert all(20 < left and right < A4[0] - 20 for left, right in places), "text is cut"


@pytest.mark.parametrize("name", ["answers", "book"])
def test_no_sheet_is_empty(printed, texts, name):
    empty = [
        number
        for number, (page, (text, _)) in enumerate(zip(printed[name].pages, texts[name]), 1)
        if len(text.split()) < 5 and len(page.get_contents().get_data()) < 3000
    ]
    assert not empty


def test_the_book_has_bookmarks_and_a_list_of_contents_with_sheets(printed, texts):
    parts = [entry.title for entry in printed["book"].outline if not isinstance(entry, list)]
    assert parts[0] == "Contents" and parts.count("The model") == 1
    assert len(parts) == 1 + len(PAGES)
    bookmarks = titles(printed["book"].outline)
    assert len(bookmarks) > 3 * len(PAGES)
    assert not [title for title in bookmarks if title[: len(title) // 2] * 2 == title]
    sheets = [text for text, _ in texts["book"]]
    sheet = re.search(r"The model\s*(\d+)", " ".join(sheets[:4]))
    assert sheet and "A half-robot" in sheets[int(sheet[1]) - 1]


def figures(reader):
    """The alternative texts of the figures that a PDF is tagged with."""
    found, todo, seen = [], [reader.trailer["/Root"].raw_get("/StructTreeRoot")], set()
    while todo:
        item = todo.pop()
        if hasattr(item, "idnum"):
            if item.idnum in seen:
                continue
            seen.add(item.idnum)
            item = item.get_object()
        if isinstance(item, list):
            todo += [
                item.raw_get(i) if hasattr(item, "raw_get") else item[i] for i in range(len(item))
            ]
        elif isinstance(item, dict):
            if item.get("/S") == "/Figure" and "/Alt" in item:
                found.append(item["/Alt"])
            todo += [item.raw_get("/K")] if "/K" in item else []
    return found


def test_the_answer_sheet_prints_the_five_figures_of_the_page(printed, book):
    page = parse(book / "book/answers.html")
    shown = [image["aria-label"] for image in page.select("svg.if-wide, svg.wide")]
    assert len(shown) == 5
    assert sorted(figures(printed["answers"])) == sorted(shown)


def test_the_answer_sheet_can_be_handed_in(printed):
    assert len(printed["answers"].pages) <= 12


def test_the_book_without_its_reference_can_be_bound(printed):
    book = printed["book"]
    parts = [entry for entry in book.outline if not isinstance(entry, list)]
    at = [book.get_destination_page_number(entry) for entry in parts]
    (i,) = [i for i, entry in enumerate(parts) if entry.title.startswith("Reference to")]
    assert len(book.pages) - (at[i + 1] - at[i]) <= 150
