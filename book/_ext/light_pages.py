"""Sphinx extension: one style sheet and one script for all pages, without what no page uses.

Theme and extensions put a dozen style sheets, a dozen scripts and some inline scripts into every
page. After the build, what all pages load becomes ``_static/book.css`` and ``_static/book.js``. The
style sheet keeps the rules whose classes occur on some page or in some script: a fourth of 540 kB.
The fonts keep the characters that the pages show and come with scripts that run before a page is
drawn, so that nothing moves: icons with ``_static/first.js``, those of formulas with
``_static/fonts.js`` on the pages that have formulas. No inline script is left: the pages work
under the Content-Security-Policy that the README gives.
"""

import base64
import hashlib
import json
import logging
import re
import shutil
from io import BytesIO
from pathlib import Path
from posixpath import dirname, join, normpath

import tinycss2
from fontTools.subset import Options, Subsetter
from fontTools.ttLib import TTFont

logging.getLogger("fontTools").setLevel(logging.ERROR)  # it tells of timestamps

STYLE = re.compile(r'\s*<link\b[^>]*\bhref="([^"?]+)[^"]*"[^>]*rel="stylesheet"[^>]*>|'
                   r'\s*<link\b[^>]*rel="stylesheet"[^>]*\bhref="([^"?]+)[^"]*"[^>]*>')  # fmt: skip
SCRIPT = re.compile(r"\s*<script\b([^>]*)>(.*?)</script>", re.DOTALL)
SOURCE = re.compile(r'src="([^"?]+)[^"]*"')
PRELOAD = re.compile(r'\s*<link rel="preload" as="script"[^>]*>')
HANDLER = re.compile(r' onclick="([^"]*)"')
# Sets the page's name for a service that this book does not use.
PAGE_NAME = re.compile(r"DOCUMENTATION_OPTIONS\.pagename = .*;")
NESTING = ("media", "supports", "layer", "container")  # rules that hold rules
PRIVATE_USE = 0xE000  # code points from here on are icons
PARTS = Path(__file__).parents[1] / "style"  # of the first scripts
FORMULA = 'class="katex-html"'
SEARCH = ("searchtools.js", "language_data.js", "searchindex.js")  # only the search page searches


def start_afresh(app):
    """Empty the folder of the pages: an older build has left files that cannot be lightened."""
    for path in Path(app.outdir).iterdir() if app.builder.format == "html" else []:
        shutil.rmtree(path) if path.is_dir() else path.unlink()


def lighten(app, exception):
    """Rewrite all pages, when everything else is done with them."""
    if exception or app.builder.format != "html":
        return
    out = Path(app.outdir)
    paths = [path for path in sorted(out.rglob("*.html")) if out / "_static" not in path.parents]
    pages = {path: path.read_text(encoding="utf-8") for path in paths}
    pages = {path: text for path, text in pages.items() if "<script" in text}  # not a redirection
    scripts = {path: list(find_scripts(path, text, out)) for path, text in pages.items()}
    common = on_all(scripts)
    bundle = ";\n".join(read_script(item) for item in common)
    bundle = re.sub(r"(?m)^//# sourceMappingURL=.*$", "", bundle)
    (out / "_static" / "book.js").write_text(bundle, encoding="utf-8")

    styles = {path: find_styles(path, text, out) for path, text in pages.items()}
    shared = on_all(styles)
    words = used_words(pages.values(), [bundle, *other_scripts(out)])
    characters = set().union(*pages.values())
    sheet = "\n".join(rebased(path, out) for path in shared)
    sheet, fonts = pruned(sheet, words, characters, out)
    theme, loader = (
        (PARTS / name).read_text(encoding="utf-8") for name in ("first.js", "fonts.js")
    )
    of_formulas = [font for font in fonts if "KaTeX" in font[0]]
    icons = [font for font in fonts if font not in of_formulas]
    files = {
        "book.css": sheet,
        "fonts.css": "".join(font_face(*font) for font in fonts),
        "first.js": theme + loader.replace("FONTS", json.dumps(icons, indent=0)),
        "fonts.js": loader.replace("FONTS", json.dumps(of_formulas, indent=0)),
    }
    for name, content in files.items():
        (out / "_static" / name).write_text(content, encoding="utf-8")

    for path, text in pages.items():
        path.write_text(rewritten(path, text, out, set(common), set(shared)), encoding="utf-8")
    for path in {*shared, *(item for item in common if isinstance(item, Path))}:
        path.unlink()
    remove_unused(out)


def on_all(found):
    """What all pages have, in order, once."""
    first, *others = found.values()
    return [item for item in dict.fromkeys(first) if all(item in other for other in others)]


def find_styles(path, text, out):
    """The style sheets of a page, in order."""
    return [local(path, first or second, out) for first, second in STYLE.findall(text)]


def local(path, address, out):
    """The file that an address on a page means."""
    return out / normpath(join(dirname(path.relative_to(out).as_posix()), address))


def find_scripts(path, text, out):
    """The classic scripts of a page, in order: files as paths, inline ones as text."""
    for attributes, body in SCRIPT.findall(text):
        if "type=" in attributes or "data-cfasync" in attributes:
            continue
        source = SOURCE.search(attributes)
        body = PAGE_NAME.sub("", body).strip()
        if source and Path(source[1]).name not in SEARCH:
            yield local(path, source[1], out)
        elif not source and body:
            yield body


def read_script(item):
    """The code of a script."""
    return item.read_text(encoding="utf-8") if isinstance(item, Path) else item


def other_scripts(out):
    """The code of the scripts that some pages load."""
    return [path.read_text(encoding="utf-8") for path in sorted((out / "_static").rglob("*.js"))]


def rewritten(path, text, out, common, shared):
    """A page with one style sheet and one script in place of those that all pages have."""
    is_search = path.name == "search.html"
    up = "../" * (len(path.relative_to(out).parts) - 1)
    scripts = [f'<script defer src="{up}_static/book.js{version(out, "book.js")}"></script>']

    def style(found):
        return "" if local(path, found[1] or found[2], out) in shared else found[0]

    def script(found):
        attributes, body = found.groups()
        if "type=" in attributes:
            return found[0]
        source = SOURCE.search(attributes)
        if source:
            name = Path(source[1]).name
            if local(path, source[1], out) not in common and (is_search or name not in SEARCH):
                defer = "" if "defer" in attributes else " defer"
                scripts.append(found[0].strip().replace("<script", f"<script{defer}"))
            return ""
        body = PAGE_NAME.sub("", body).strip()
        if body and body not in common and "data-cfasync" not in attributes:
            name = f"inline-{hashlib.sha256(body.encode()).hexdigest()[:12]}.js"
            (out / "_static" / name).write_text(body + "\n", encoding="utf-8")
            scripts.append(f'<script defer src="{up}_static/{name}"></script>')
        return ""

    text = PRELOAD.sub("", STYLE.sub(style, SCRIPT.sub(script, text)))
    text = HANDLER.sub(r' data-click="\1"', text)
    head = [
        f'\n<script src="{up}_static/{name}{version(out, name)}"></script>'
        for name in (["first.js", "fonts.js"] if FORMULA in text else ["first.js"])
    ]
    head += [
        f'\n<noscript><link rel="stylesheet" href="{up}_static/fonts.css" /></noscript>',
        f'\n<link rel="stylesheet" href="{up}_static/book.css{version(out, "book.css")}" />',
    ]
    # At the end, where they take nothing of the line while the style is on its way.
    text = text.replace("</body>", "\n".join([*scripts, "</body>"]))
    # After what sets the character set and the title, before page-specific files.
    return re.sub(r"(?=\s*<noscript>|\s*</head>)", lambda _: "".join(head), text, count=1)


def version(out, name):
    """A tail for an address, so that no browser shows the file of an older book."""
    return f"?v={hashlib.sha256((out / '_static' / name).read_bytes()).hexdigest()[:8]}"


def rebased(path, out):
    """A style sheet, with addresses as seen from ``_static``."""
    folder = dirname(path.relative_to(out / "_static").as_posix())

    def address(found):
        if found[1].startswith(("data:", "#", "http")):
            return found[0]
        return f"url({normpath(join(folder, found[1]))})"

    text = re.sub(r"url\((?!['\"])([^)]+)\)", address, path.read_text(encoding="utf-8"))
    other = r"""@import\s+(?:url\()?['"]([^'"]+)['"]\)?;"""
    return re.sub(other, lambda found: rebased(path.parent / found[1], out), text)


def used_words(pages, scripts):
    """All classes and ids of the pages, and every word of a script, which may add it as a class."""
    named = (names for page in pages for names in re.findall(r'\b(?:class|id)="([^"]*)"', page))
    words = {name for names in named for name in names.split()}
    return words | {word for script in scripts for word in re.findall(r"[\w-]+", script)}


def pruned(sheet, words, characters, out):
    """A style sheet without the rules for classes that nothing has, and the fonts it asks for."""
    rules = list(kept(tinycss2.parse_stylesheet(sheet, True, True), words))
    text = "\n".join(rule for rule in rules if not rule.startswith("@font-face"))
    fonts = [
        cut_down(rule, text, characters | set(text), out)
        for rule in rules
        if rule.startswith("@font-face")
    ]
    return text + "\n", [font for font in fonts if font]


def kept(rules, words):
    """The rules of a sheet, as text, as far as they may apply."""
    for rule in rules:
        if rule.type == "qualified-rule":
            selectors = [part for part in split(rule.prelude) if may_apply(part, words)]
            if selectors:
                start = ",".join(tinycss2.serialize(part).strip() for part in selectors)
                yield f"{start}{{{compact(rule.content)}}}"
        elif rule.type == "at-rule":
            name = f"@{rule.at_keyword}{tinycss2.serialize(rule.prelude).rstrip()}"
            if rule.content and rule.lower_at_keyword in NESTING:
                inner = list(kept(tinycss2.parse_rule_list(rule.content, True, True), words))
                if inner:
                    yield f"{name}{{{''.join(inner)}}}"
            elif rule.lower_at_keyword != "charset":
                yield f"{name}{{{compact(rule.content)}}}" if rule.content else f"{name};"


def compact(content):
    """Declarations in a line, without comments."""
    return tinycss2.serialize([token for token in content if token.type != "comment"]).strip()


def split(prelude):
    """The selectors of a list."""
    part = []
    for token in prelude:
        if token.type == "literal" and token.value == ",":
            yield part
            part = []
        elif token.type != "comment":
            part.append(token)
    yield part


def may_apply(selector, words):
    """Whether all classes and ids that a selector asks for occur; not those within ``:not()``."""
    for before, token in zip([None, *selector], selector):
        is_class = token.type == "ident" and before is not None and before == "."
        if (is_class or token.type == "hash") and token.value not in words:
            return False
    return True


def cut_down(rule, text, characters, out):
    """Name, file and style of a font with no more than some characters; None if it has no use."""
    found = dict(re.findall(r"(font-[a-z]+):\s*([^;}]+)", rule))
    family = found["font-family"].replace("\\", "").strip("'\" ")
    style = {"weight": found.get("font-weight", "400"), "style": found.get("font-style", "normal")}
    address = re.search(r"url\(['\"]?([^)'\"]+\.ttf)", rule)
    if not address or not is_asked_for(family, style, text.replace("\\", "")):
        return None
    font = TTFont(out / "_static" / address[1], recalcTimestamp=False)
    wanted = {ord(character) for character in characters} & set(font.getBestCmap())
    if "Awesome" in family:  # only icons, which stand in the style sheet
        wanted = {code for code in wanted if code >= PRIVATE_USE}
    if not wanted:
        return None
    subsetter = Subsetter(Options(layout_features=[], hinting=False, notdef_outline=True))
    subsetter.populate(unicodes=wanted)
    subsetter.subset(font)
    font.flavor = "woff"
    file = BytesIO()
    font.save(file)
    return family, base64.b64encode(file.getvalue()).decode(), style


def is_asked_for(family, style, text):
    """Whether some rule names a font; those of KaTeX say the weight and the style beside it.

    Text in a formula is set in its main font, which the rules for bold and italic text do not name.
    """
    rules = re.findall(r"([^{}]*)\{([^{}]*)\}", text)
    of_text = ".katex .text" if family == "KaTeX_Main" else family
    blocks = [block for chosen, block in rules if family in block or of_text in chosen]
    if "KaTeX" not in family:
        return bool(blocks)
    wanted = style["weight"] == "700", style["style"] == "italic"
    return wanted in [("font-weight:700" in b, "font-style:italic" in b) for b in blocks]


def font_face(family, data, style):
    """The rule for a font, for readers without scripts."""
    source = f"url(data:font/woff;base64,{data})"
    return (
        f'@font-face{{font-family:"{family}";font-weight:{style["weight"]};'
        f"font-style:{style['style']};src:{source}}}\n"
    )


def remove_unused(out):
    """Remove fonts that stand in the style sheet and what only the theme's own pages would load."""
    text = "".join(path.read_text(encoding="utf-8") for path in out.rglob("*.html"))
    text += (out / "_static" / "book.css").read_text(encoding="utf-8")
    for pattern in ("katex/**/*", "vendor/**/*", "styles/*", "scripts/*", "*.html", "locales/**/*",
                    "images/*", "*.png", "basic.css"):  # fmt: skip
        for path in sorted((out / "_static").glob(pattern), reverse=True):
            if path.is_file() and path.name not in text:
                path.unlink()
    for folder in sorted((out / "_static").rglob("*/"), reverse=True):
        if folder.is_dir() and not any(folder.iterdir()):
            folder.rmdir()


def all_pages(app, env, added, changed, removed):
    """Write every page in every build: what all of them load is only known together."""
    return list(env.found_docs)


def setup(app):
    """Connect to Sphinx, after the repairs of the theme."""
    app.connect("builder-inited", start_afresh, priority=0)
    app.connect("env-get-outdated", all_pages)
    app.connect("build-finished", lighten, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
