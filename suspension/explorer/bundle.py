"""One ES module out of several, for a place that takes only one.

An anywidget has a single script. The page's modules import one another by plain named imports;
each of them becomes a function that is called once and returns what the module exports, so that
names stay as private as they were, and the module asked for stands at the end. Comments on lines of
their own stay behind: a sixth of what a reader would have to load.
"""

import re
from pathlib import Path

__all__ = ["PAGE", "bundle", "script", "style", "without_comments"]

PAGE = Path(__file__).parent / "page"  # the modules and style sheets of all live pictures

NAME = r"[A-Za-z_]\w*"
IMPORT = re.compile(
    rf'^import \{{\s*({NAME}(?:,\s*{NAME})*),?\s*\}} from "\./({NAME})\.js";$', re.MULTILINE
)
EXPORT = re.compile(rf"^export (?=(?:function\*?|const|class) ({NAME})\b)", re.MULTILINE)
COMMENT = re.compile(r"^[ \t]*(?://.*|/\*(?s:.*?)\*/)\n", re.MULTILINE)
# What is left of these words is something else, like `export * from` or `import(..)`.
OTHER = re.compile(r"^\s*(?:import|export)\b.*|\bimport\s*[(.].*", re.MULTILINE)


def bundle(folder, entry):
    """The text of an ES module with everything that it imports.

    Parameters
    ----------
    folder : pathlib.Path
        Where the modules lie, all of them side by side.
    entry : str
        Name of the module that imports the others, without ``.js``; what it exports, the bundle
        exports.

    Returns
    -------
    text : str

    Raises
    ------
    ValueError
        If a module imports itself through others, or a name that the other one does not export,
        or if it holds any other form of ``import`` and ``export`` than
        ``import { a, b } from "./c.js";`` and ``export function``, ``const`` or ``class``.
    """
    parts, exported, opened = [], {}, []

    def add(module):
        """Append a module, after those that it imports."""
        if module in exported:
            return
        if module in opened:
            raise ValueError(f"{module}.js imports itself: {' > '.join([*opened, module])}")
        opened.append(module)
        text = without_comments((folder / f"{module}.js").read_text(encoding="utf-8"))
        for names, other in IMPORT.findall(text):
            add(other)
            unknown = set(re.findall(NAME, names)) - set(exported[other])
            if unknown:
                raise ValueError(f"{module}.js imports {sorted(unknown)}, not in {other}.js")
        text = IMPORT.sub(r"const { \1 } = $\2;", text)
        exported[module] = EXPORT.findall(text)
        _refuse_others(module, EXPORT.sub("", text), is_entry=module == entry)
        if module != entry:
            text = EXPORT.sub("", text)
            names = ", ".join(exported[module])
            text = f"const ${module} = (() => {{\n{text}return {{ {names} }};\n}})();\n"
        parts.append(text)

    add(entry)
    return "".join(parts)


def script(entry):
    """A module of `PAGE` as a classic script, which runs by itself and leaves no name behind."""
    return f"(() => {{\n{bundle(PAGE, entry)}}})();\n"


def style(*names):
    """Style sheets of `PAGE`, one after another, without comments on lines of their own."""
    sheets = ((PAGE / f"{name}.css").read_text(encoding="utf-8") for name in names)
    return "".join(map(without_comments, sheets))


def without_comments(text):
    """A script or a style sheet without the comments that stand on lines of their own."""
    return COMMENT.sub("", text)


def _refuse_others(module, text, is_entry):
    """Raise ValueError if a module still imports or exports, but for the entry's default."""
    if is_entry:
        text = re.sub(r"^export default ", "", text, count=1, flags=re.MULTILINE)
    found = OTHER.search(text)
    if found:
        raise ValueError(f"{module}.js has a form that is not known here: {found[0].strip()}")
