"""Sphinx extension: figures written into the page, so that they follow its theme and its width.

A `picture` holds an SVG as it was drawn and, if there is one, its layout for a phone. In the page
their colours become variables of the style sheet: greys are mixed of the page's ink and paper,
other colours have a variable of their own, ``--figure-0072b2``, and stay as they are where the
style sheet says nothing of it. What the pictures of a page share, like the outlines of letters,
stands in it once.
"""

import hashlib
import re
import xml.etree.ElementTree as ET
from pathlib import Path

from docutils import nodes
from sphinx.transforms import SphinxTransform
from sphinx.transforms.post_transforms import SphinxPostTransform

SVG = "{http://www.w3.org/2000/svg}"
HREF = "{http://www.w3.org/1999/xlink}href"
COLOUR = re.compile(r"#([0-9a-fA-F]{6}|[0-9a-fA-F]{3})\b|\b(white|black)\b")
PAINT = ("fill", "stroke", "stop-color", "color")
NUMBER = re.compile(r"-?\d+\.\d+(?![\de])")
REFERENCE = re.compile(r"#([\w.-]+)")
RULE = re.compile(r"\.([\w-]+)\s*\{([^}]*)\}")
POINT = 4 / 3  # CSS pixels

ET.register_namespace("", SVG[1:-1])


class picture(nodes.General, nodes.Inline, nodes.Element):
    """A figure: the attributes `wide` and `narrow` hold SVG text, `alt` what it shows."""


class DrawnPictures(SphinxTransform):
    """Make a picture of every SVG file that a page shows as an image."""

    default_priority = 101  # after the notebooks' figures, before Sphinx collects images

    def apply(self):
        """Visit the images of one page."""
        for image in list(self.document.findall(nodes.image)):
            path = Path(self.env.doc2path(self.env.docname)).parent / image["uri"]
            if path.suffix == ".svg" and path.is_file():
                self.env.note_dependency(str(path))
                phone = path.with_suffix(".narrow.svg")
                narrow = phone.read_text(encoding="utf-8") if phone.exists() else ""
                wide = path.read_text(encoding="utf-8")
                image.replace_self(picture(wide=wide, narrow=narrow, alt=image.get("alt", "")))


class InlinePictures(SphinxPostTransform):
    """Turn the pictures of a page into HTML."""

    default_priority = 900
    formats = ("html",)

    def run(self, **kwargs):
        """Write each picture, and before the first one what they share."""
        shared = {}
        found = list(self.document.findall(picture))
        for node in found:
            layouts = [("wide", node["wide"])]
            if node["narrow"]:
                layouts = [("if-wide", node["wide"]), ("if-narrow", node["narrow"])]
            html = "".join(inline(text, node["alt"], name, shared) for name, text in layouts)
            node.replace_self(nodes.raw("", html, format="html"))
        if shared:
            sheet = '<svg class="shared-shapes" width="0" height="0" aria-hidden="true"><defs>'
            html = sheet + "".join(shared.values()) + "</defs></svg>"
            self.document.insert(0, nodes.raw("", html, format="html"))


def inline(text, alt, name, shared):
    """The HTML of one layout; what it refers to moves to `shared`, by its id."""
    root = ET.fromstring(text)
    apply_classes(root)
    strip(root)
    fixed = {part for group in root.iter() if is_map(group) for part in group.iter()}
    for element in root.iter():
        recolour(element, keep_greys=element in fixed)
        round_numbers(element)
    definitions = take_definitions(root)
    names = {}
    for element in definitions:
        old = element.get("id")
        element.set("id", f"s-{old}")
        markup = write(element)
        if shared.get(f"s-{old}", markup) != markup:  # elsewhere on the page it means another thing
            element.set("id", f"s-{old}-{hashlib.sha256(markup.encode()).hexdigest()[:8]}")
        names[old] = element.get("id")
    for part in [root, *definitions]:
        refer(part, names)
    for element in definitions:
        shared[element.get("id")] = write(element)
    width, height = (size_in_pixels(root, side) for side in (0, 1))
    root.attrib = {
        "class": f"figure-svg {name}",
        "viewBox": root.get("viewBox"),
        "width": f"{width:.0f}",
        "height": f"{height:.0f}",
        "role": "img",
        "aria-label": alt,
    }
    return write(root)


def apply_classes(root):
    """Write what style elements say of classes where it applies: their names are the page's."""
    rules = [rule for style in root.iter(SVG + "style") for rule in RULE.findall(style.text or "")]
    for element in root.iter():
        classes = element.attrib.pop("class", "").split()
        style = [declarations for name, declarations in rules if name in classes]
        if style:
            element.set("style", ";".join([*style, element.get("style", "")]))


def strip(root):
    """Remove what says nothing to a reader: metadata, styles, matplotlib's white page."""
    for parent in list(root.iter()):
        for child in list(parent):
            if child.tag in (SVG + "metadata", SVG + "style") or child.get("id") == "patch_1":
                parent.remove(child)


def is_map(element):
    """Whether an element holds filled contours, whose colours mean numbers."""
    return element.get("id", "").startswith("QuadContourSet")


def take_definitions(root):
    """Take the definitions out of a picture."""
    found = []
    for parent in list(root.iter()):
        for defs in parent.findall(SVG + "defs"):
            found += list(defs)
            parent.remove(defs)
    return [element for element in found if element.get("id")]


def refer(root, names):
    """Let references follow new names; remove names of what is drawn in its place."""
    for element in root.iter():
        if element.get("id") not in names.values():
            element.attrib.pop("id", None)
        for key, value in element.attrib.items():
            if value.startswith("#") or "url(#" in value:
                new = REFERENCE.sub(lambda name: f"#{names.get(name[1], name[1])}", value)
                element.set(key, new)


def recolour(element, keep_greys):
    """Let the page's theme choose colours."""
    for key in PAINT:  # an attribute may not hold a variable, a style may
        if key in element.attrib:
            element.set("style", f"{key}:{element.attrib.pop(key)};{element.get('style', '')}")
    if "style" in element.attrib:
        style = COLOUR.sub(lambda colour: variable(colour, keep_greys), element.attrib.pop("style"))
        element.set("style", re.sub(r"\s*([:;])\s*", r"\1", style).strip("; "))


def variable(colour, keep_greys):
    """The CSS for a colour of the light theme."""
    digits = {"white": "ffffff", "black": "000000"}.get(colour[2], colour[1])
    digits = (digits if len(digits) == 6 else "".join(2 * d for d in digits)).lower()
    red, green, blue = (int(digits[i : i + 2], 16) for i in (0, 2, 4))
    if not red == green == blue:
        return f"var(--figure-{digits},#{digits})"
    if keep_greys:
        return f"#{digits}"
    if red in (0, 255):
        return "var(--figure-paper)" if red else "var(--figure-ink)"
    ink = round(100 * (1 - red / 255))
    return f"color-mix(in srgb,var(--figure-ink) {ink}%,var(--figure-paper))"


def round_numbers(element):
    """Keep hundredths of a point."""
    for key in ("d", "x", "y", "width", "height", "points"):
        if key in element.attrib:
            element.set(key, " ".join(NUMBER.sub(hundredths, element.get(key)).split()))
    place, more = re.match(r"(translate\([^)]*\))?(.*)", element.get("transform", "")).groups()
    if place:
        element.set("transform", NUMBER.sub(hundredths, place) + more)


def hundredths(number):
    """A number as text, in as few characters as it needs."""
    return f"{float(number[0]):.2f}".rstrip("0").rstrip(".").replace("-0.", "-.")


def size_in_pixels(root, side):
    """The width (side 0) or the height (1) of a picture."""
    text = root.get(("width", "height")[side])
    if text is None:
        return float(root.get("viewBox").split()[2 + side])
    return float(text.removesuffix("pt")) * (POINT if text.endswith("pt") else 1)


def write(element):
    """The markup of an element, without the namespaces that HTML does not need."""
    for part in element.iter():
        if HREF in part.attrib:
            part.set("href", part.attrib.pop(HREF))
        part.text = part.text if (part.text or "").strip() else None
        part.tail = part.tail if (part.tail or "").strip() else None
    text = ET.tostring(element, encoding="unicode", short_empty_elements=True)
    return text.replace(f' xmlns="{SVG[1:-1]}"', "")


def setup(app):
    """Connect to Sphinx."""
    app.add_node(picture)
    app.add_transform(DrawnPictures)
    app.add_post_transform(InlinePictures)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
