"""The book on paper: the answer sheet is complete, both files can be navigated, nothing is cut."""

import re
import subprocess
import sys

import pytest
from helpers import PAGES, ROOT
from pypdf import PdfReader

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


def text_of(reader):
    return " ".join(page.extract_text() for page in reader.pages)


def titles(outline):
    return [title for entry in outline for title in
            (titles(entry) if isinstance(entry, list) else [entry.title])]  # fmt: skip


def test_every_item_is_answered_in_order(printed):
    text = re.sub(r"\s+", "", text_of(printed["answers"]))
    places = [text.find(f"Answer{item}.") for item in ITEMS.split()]
    assert -1 not in places
    assert places == sorted(places)


@pytest.mark.parametrize("name", ["answers", "book"])
def test_nothing_is_cut(printed, name):
    for page in printed[name].pages:
        assert [float(side) for side in page.mediabox[2:]] == pytest.approx(A4, abs=2)
        places = []

        def note(text, matrix, text_matrix, font, size, places=places):
            if text.strip():
                places.append(matrix[0] * text_matrix[4] + matrix[4])

        page.extract_text(visitor_text=note)
        assert not places or max(places) < A4[0] - 20, "text begins beyond the right margin"


@pytest.mark.parametrize("name", ["answers", "book"])
def test_no_sheet_is_empty(printed, name):
    empty = [
        number
        for number, page in enumerate(printed[name].pages, 1)
        if len(page.extract_text().split()) < 5 and len(page.get_contents().get_data()) < 3000
    ]
    assert not empty


def test_the_book_has_bookmarks_and_a_list_of_contents_with_sheets(printed):
    reader = printed["book"]
    bookmarks = titles(reader.outline)
    assert sum(title == "The model" for title in bookmarks) == 1
    assert len(bookmarks) > 3 * len(PAGES)
    contents = " ".join(page.extract_text() for page in reader.pages[:4])
    sheet = re.search(r"The model\s*(\d+)", contents)
    assert sheet and "A half-robot" in reader.pages[int(sheet[1]) - 1].extract_text()


def figures(reader):
    """How many figures a PDF is tagged with."""
    found, todo, seen = 0, [reader.trailer["/Root"].raw_get("/StructTreeRoot")], set()
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
            found += item.get("/S") == "/Figure"
            todo += [item.raw_get("/K")] if "/K" in item else []
    return found


def test_the_answer_sheet_prints_every_figure_of_the_page(printed, book):
    html = (book / "book/answers.html").read_text(encoding="utf-8")
    assert figures(printed["answers"]) == len(re.findall(r'class="figure-svg (?:if-)?wide', html))
