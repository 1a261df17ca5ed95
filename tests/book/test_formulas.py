"""Formulas: valid MathML for every browser, copied as LaTeX, set by a server that is waited for."""

import subprocess
import sys
from xml.etree import ElementTree

import pytest
from docutils import nodes
from docutils.frontend import get_default_settings
from docutils.parsers.rst import Parser
from docutils.utils import new_document
from formulas import KeepPunctuation
from helpers import PAGES, ROOT, parse

# How many children an element of MathML Core has; those that are not named have any number.
CHILDREN = {
    **dict.fromkeys(["mfrac", "mroot", "msub", "msup", "munder", "mover"], 2),
    **dict.fromkeys(["msubsup", "munderover"], 3),
}
COPIED = """(selector) => {
  getSelection().selectAllChildren(document.querySelector(selector));
  const data = new DataTransfer();
  document.dispatchEvent(new ClipboardEvent("copy", {clipboardData: data, bubbles: true}));
  return data.getData("text/plain");
}"""
# A node whose door is there before anybody listens behind it, as on a busy machine.
SLOW_NODE = """#!{python}
import os, socket, sys, time
place = sys.argv[sys.argv.index("--socket" if "--socket" in sys.argv else "--port") + 1]
is_port = place.isdigit()
door = socket.socket(socket.AF_INET if is_port else socket.AF_UNIX)
door.bind(("127.0.0.1", int(place)) if is_port else place)
time.sleep(0.5)
door.close()
if not is_port:
    os.unlink(place)
os.execv({node!r}, [{node!r}, *sys.argv[1:]])
"""
RENDER = """
import sys
from pathlib import Path
from types import SimpleNamespace
sys.path.insert(0, "book/_ext")
import formulas
from sphinxcontrib import katex
config = SimpleNamespace()
formulas.configure(None, config)
katex.KaTeXServer.katex_path = config.katex_js_path
if sys.argv[2:]:
    slow = Path(sys.argv[2])
    slow.write_text(
        slow.read_text(encoding="utf-8").format(python=sys.executable, node=katex.NODEJS_BINARY),
        encoding="utf-8",
    )
    katex.NODEJS_BINARY = str(slow)
sys.stdout.reconfigure(encoding="utf-8")
print(katex.render_latex(sys.argv[1]))
"""


def rendered(latex, *more):
    """What the book makes of a formula."""
    command = [sys.executable, "-c", RENDER, latex, *more]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, encoding="utf-8")
    assert run.returncode == 0, run.stderr
    return run.stdout


def wrong(math):
    """The elements of a formula with another number of children than they must have."""
    return [
        ElementTree.tostring(element, encoding="unicode")
        for element in math.iter()
        if len(element) != CHILDREN.get(element.tag.split("}")[-1], len(element))
    ]


@pytest.mark.parametrize("page", PAGES)
def test_formulas_are_valid_mathml(book, page):
    soup = parse(book / f"{page}.html")
    for math in soup.select("math"):
        assert not wrong(ElementTree.fromstring(str(math)))


@pytest.mark.parametrize(
    "latex", [r"\delta_{\max}", r"x^{\ln}", r"\frac{\sin}{\cos}", r"\max_k a_{\min}^{\sup}"]
)
def test_a_function_may_stand_anywhere(book, latex):
    math = rendered(latex).split('<span class="katex-mathml">')[1].split("</math>")[0] + "</math>"
    assert len(list(ElementTree.fromstring(math).iter())) > 5
    assert not wrong(ElementTree.fromstring(math))


@pytest.mark.skipif(sys.platform == "win32", reason="a script is no program there")
def test_a_server_that_does_not_listen_yet_is_waited_for(book, tmp_path):
    node = tmp_path / "node"
    node.write_text(SLOW_NODE, encoding="utf-8")
    node.chmod(0o755)
    assert "katex-html" in rendered("x", str(node))


def test_a_copied_formula_is_its_latex(browser, site):
    tab = browser.new_page()
    tab.goto(f"{site}book/model.html", wait_until="load")
    for selector in ("article p:has(.katex)", "article div.math"):
        text = "".join(tab.evaluate(COPIED, selector).split()).replace("$$", "$")
        formula = tab.locator(f"{selector} .katex").first
        latex = "".join(formula.locator("annotation").text_content().split())
        before, after = text.split(f"${latex}$")
        shown = "".join(formula.locator(".katex-html").inner_text().split())
        assert shown not in before + after
    tab.close()


@pytest.mark.parametrize("page", PAGES)
def test_no_punctuation_is_doubled_by_keeping_it_together(book, page):
    soup = parse(book / f"{page}.html")
    for span in soup.select("article .together"):
        after = span.next_sibling
        last = span.contents[-1] if isinstance(span.contents[-1], str) else ""
        assert not (last and str(after or "").startswith(last)), span.parent.get_text()


def test_the_punctuation_moves_once_though_another_text_reads_the_same():
    paragraph = nodes.paragraph()
    paragraph += [nodes.emphasis("", "mode"), nodes.Text(","), nodes.Text(" with ("), nodes.math()]
    paragraph += [nodes.Text("),"), nodes.Text("\nand "), nodes.math(), nodes.Text(",")]
    for formula in paragraph.findall(nodes.math):
        formula += nodes.Text("x")
    document = new_document("page", get_default_settings(Parser))
    document += paragraph
    before = paragraph.astext()
    KeepPunctuation(document).run()
    assert paragraph.astext() == before
    spans = [
        span.astext() for span in paragraph.findall(nodes.inline) if "together" in span["classes"]
    ]
    assert spans == ["(x),", "x,"]
