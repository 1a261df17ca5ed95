"""A downloaded notebook says what it needs, and that works; a lost address leads back."""

import re
import subprocess
import sys
from zipfile import ZipFile

import nbformat
import pytest
import yaml
from helpers import PAGES, ROOT

TITLE = yaml.safe_load((ROOT / "_config.yml").read_text(encoding="utf-8"))["title"]
NOTEBOOKS = [page for page in PAGES if page.startswith("notebooks/")]
ASK = "import sys; sys.path.insert(0, 'book/_ext'); import downloads; print(downloads.head(*{!r}))"


def head(*arguments):
    """The first cell for a book with some addresses."""
    run = subprocess.run(
        [sys.executable, "-c", ASK.format(arguments)], cwd=ROOT, capture_output=True, text=True
    )
    assert run.returncode == 0, run.stderr
    return run.stdout


def first_cell(book, page):
    return nbformat.read(book / "_sources" / f"{page}.ipynb", as_version=4).cells[0].source


@pytest.mark.parametrize("page", NOTEBOOKS)
def test_it_names_the_book_and_a_package_that_the_book_has(book, page):
    text = first_cell(book, page)
    assert f"a page of *{TITLE}*" in text
    (wheel,) = (book / "_static").glob("*.whl")
    assert text.split("%pip install ")[1].split("\n")[0].endswith(wheel.name)
    names = ZipFile(wheel).namelist()
    assert {"suspension/__init__.py", "suspension/explorer/page/view.js"} <= set(names)
    assert any(name.startswith("suspension/data/spring_data.") for name in names)


def test_the_package_is_fetched_from_where_the_book_is_published():
    wheel, address, repository = "_static/s-1.whl", "https://a.org/b/", "https://git.org/me/b"
    commands = {
        f"%pip install {address}{wheel}\n": (address, repository),
        f'%pip install "suspension @ git+{repository}"\n': ("", repository),
        "%pip install s-1.whl\n": ("", ""),
    }
    for command, where in commands.items():
        text = head("A book", wheel, *where)
        assert command in text
        assert (wheel in text.split("```")[0]) == (where == ("", "")), "where else is the file?"


def test_a_wheel_from_a_server_can_be_installed(book, site, tmp_path):
    (wheel,) = (book / "_static").glob("*.whl")
    pip = [sys.executable, "-m", "pip", "install", "--no-deps", "--quiet", "--target", tmp_path]
    subprocess.run([*pip, f"{site}_static/{wheel.name}"], check=True)
    assert (tmp_path / "suspension" / "__init__.py").is_file()


def test_no_page_shows_a_name_that_nobody_has_set(book):
    for path in book.rglob("*.html"):
        assert "Project name not set" not in path.read_text(encoding="utf-8"), path
    assert f"# Project: {TITLE}".encode() in (book / "objects.inv").read_bytes().splitlines()


def test_the_page_for_lost_addresses_leads_back_from_any_depth(book):
    text = (book / "404.html").read_text(encoding="utf-8")
    base = re.search(r'<base href="([^"]*)"', text)
    links = re.findall(r'<a href="([^"]*)">(?:search|the first page)</a>', text)
    assert links == ["search.html", "index.html"]
    canonical = re.search(r'<link rel="canonical" href="https?://[^/]*(/.*)book/',
                          (book / "book/index.html").read_text(encoding="utf-8"))  # fmt: skip
    assert (base and base[1]) == (canonical and canonical[1])
