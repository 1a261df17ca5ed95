"""Sphinx extension: the package's docstrings as a page, with links instead of backticks.

``{modules}`` documents the public names of modules, or of all modules of a package. In docstrings
a name in single backticks becomes a link if it is documented, and code if it is a parameter or
anything else; so do the types of parameters and results. Napoleon does the rest.
"""

import ast
import importlib
import inspect
import pkgutil
import re
from functools import cache, cached_property
from pathlib import Path

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective

logger = logging.getLogger(__name__)

PACKAGE = "suspension"
BACKTICKS = re.compile(r"(?<![`:\\])`([^`\n]+)`(?!`)")
CLASS = re.compile(r"(?<![\w.\"'`])((?:\w+\.)*[A-Z]\w*)")
# Sections of a docstring in which a line that is not indented says a type.
TYPED = ("Parameters", "Returns", "Attributes", "Yields")
OPTIONS = {
    "class": ["   :members:", "   :special-members: __call__"],
    "data": ["   :no-value:"],
    "function": [],
}


@cache
def public_modules():
    """Names of all modules without an underscore."""
    package = importlib.import_module(PACKAGE)
    found = pkgutil.walk_packages(package.__path__, PACKAGE + ".")
    return [PACKAGE, *(info.name for info in found if "._" not in info.name)]


@cache
def definitions(module):
    """What a module defines, by name in order, and where it has imported the rest from."""
    path = Path(importlib.import_module(module).__file__)
    own, imported = [], {}
    body = ast.parse(path.read_text(encoding="utf-8")).body
    later = [node for part in body if isinstance(part, ast.If) for node in part.body]
    for node in [*body, *later]:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            own.append(node.name)
        elif isinstance(node, ast.Assign):
            names = [name for target in node.targets for name in ast.walk(target)]
            own += [name.id for name in names if isinstance(name, ast.Name)]
        elif isinstance(node, ast.ImportFrom):
            imported |= {alias.asname or alias.name: node.module for alias in node.names}
    return own, imported


def public_names(module):
    """The names that a module documents: those of the front door first, then as it has them."""
    front = importlib.import_module(PACKAGE).__all__
    promised = importlib.import_module(module).__all__
    own = [name for name in definitions(module)[0] if name in promised]
    return sorted(dict.fromkeys(own), key=lambda name: name not in front)


@cache
def home(module, name):
    """The full name of a documented object that a module knows as `name`, or None."""
    if module not in public_modules():
        return None
    if name in public_names(module):
        return f"{module}.{name}"
    origin = definitions(module)[1].get(name, "")
    return home(origin, name) if origin.startswith(PACKAGE) else None


def anywhere(name):
    """The full name of the only documented object so called, or None."""
    found = [f"{module}.{name}" for module in public_modules() if name in public_names(module)]
    return found[0] if len(found) == 1 else None


def resolve(name, module, within, is_module):
    """The full name of what a docstring means by `name`, or None.

    `within` is the class that the docstring belongs to, or a member of which it describes.
    """
    if within and has_member(f"{module}.{within}", name):
        return f"{module}.{within}.{name}"
    if name.startswith(PACKAGE + "."):
        parent, _, last = name.rpartition(".")
        return name if name in public_modules() else home(parent, last)
    if is_module:  # of its neighbours, and of its own parts
        for candidate in (f"{module}.{name}", f"{module.rpartition('.')[0]}.{name}"):
            if candidate in public_modules():
                return candidate
    head, _, member = name.partition(".")
    found = home(module, head) or anywhere(head)
    return f"{found}.{member}" if found and has_member(found, member) else found


def has_member(full_name, member):
    """Whether a documented class has a documented member of this name."""
    module, _, name = full_name.rpartition(".")
    value = getattr(importlib.import_module(module), name)
    found = inspect.getattr_static(value, member, None)
    kinds = (property, cached_property)
    return bool(inspect.getdoc(found)) and (inspect.isfunction(found) or isinstance(found, kinds))


def link(text, full_name):
    """A reference to a documented object."""
    return f":py:obj:`{text} <{full_name}>`"


def rewrite(app, what, name, obj, options, lines):
    """Turn a docstring's names into links and code; say what a constant is."""
    if not name.startswith(PACKAGE):
        return
    if what == "data":
        lines[:] = describe_constant(obj)
        return
    module, within = name, None
    if what != "module":
        module = next(m for m in reversed(public_modules()) if name.startswith(m + "."))
        path = name.removeprefix(module + ".").split(".")
        within = path[0] if what == "class" or len(path) > 1 else None
    parameters = parameters_of(module, within) | parameters_of_callable(obj)

    def replace(found):
        text = found[1]
        full = None if text in parameters else resolve(text, module, within, what == "module")
        return link(text, full) if full else f"``{text}``"

    def replace_type(found):
        full = resolve(found[1], module, None, False)
        return link(found[1].rpartition(".")[2], full) if full else found[0]

    if what == "property":
        lines[:0] = ["..", ""]  # or napoleon takes what precedes a colon in line one for a type
    section = ""
    for i, line in enumerate(lines):
        underlined = i + 1 < len(lines) and re.fullmatch(r"-{3,}", lines[i + 1])
        section = line if underlined else section
        lines[i] = line = BACKTICKS.sub(replace, line)
        if section in TYPED and line and not line[0].isspace() and not underlined:
            before, colon, types = line.rpartition(" : ")
            lines[i] = before + colon + CLASS.sub(replace_type, types)


def parameters_of_callable(obj):
    """Names of the parameters of a function or a class."""
    try:
        return set(inspect.signature(obj).parameters)
    except (TypeError, ValueError):
        return set()


def parameters_of(module, within):
    """Names of the parameters of the class that a member belongs to."""
    if within is None:
        return set()
    return parameters_of_callable(getattr(importlib.import_module(module), within))


def class_of(value):
    """The full name of a value's class if that is one of ours, or None."""
    return home(type(value).__module__, type(value).__name__)


def describe_constant(value):
    """One line about a constant."""
    if class_of(value) is None:
        return [f"``{value!r}``"]
    return [f"A {link(type(value).__name__, class_of(value))}."]


def skip(app, what, name, obj, skipped, options):
    """Leave out the fields of named tuples, whose docstrings say nothing."""
    return True if (inspect.getdoc(obj) or "").startswith("Alias for field number") else None


class Rst(SphinxDirective):
    """A directive that writes reStructuredText, which autodoc needs."""

    has_content = True  # names, between spaces or line ends

    def parse(self, text, node):
        """Add what the text says to a node."""
        source, _ = self.get_source_info()
        lines = StringList(["```{eval-rst}", *text, "```"], source=source)
        self.state.nested_parse(lines, self.content_offset, node)
        return node


class FrontDoor(Rst):
    """A table of the names that ``import suspension`` gives, in the order of the content."""

    def run(self):
        """Make the table."""
        names, package = " ".join(self.content).split(), importlib.import_module(PACKAGE)
        if sorted(names) != sorted(package.__all__):
            logger.warning("the front door has %s", package.__all__, location=self.get_location())
        text = [".. list-table::", "   :class: front-door", ""]
        for name in names:
            text += [f"   * - {link(name, home(PACKAGE, name))}", f"     - {summary(name)}"]
        return self.parse(text, nodes.Element()).children


def summary(name):
    """The first line of the docstring of a name at the front door."""
    value = getattr(importlib.import_module(PACKAGE), name)
    if class_of(value):
        return describe_constant(value)[0]
    lines = inspect.getdoc(value).splitlines()[:1]
    rewrite(None, "function", home(PACKAGE, name), value, None, lines)
    return lines[0]


class Modules(Rst):
    """A section for each module; ``report.*`` stands for a package and its modules."""

    def run(self):
        """Make the sections."""
        sections = []
        for name in " ".join(self.content).split():
            module = f"{PACKAGE}.{name.removesuffix('.*')}"
            sections.append(self.section(module))
            if name.endswith(".*"):
                inner = [other for other in public_modules() if other.startswith(module + ".")]
                sections += [self.section(other) for other in inner]
        return sections

    def section(self, module):
        """The docstrings of a module, and links to what it has from others."""
        short = nodes.literal(text=module.removeprefix(PACKAGE + "."))
        section = nodes.section("", nodes.title("", "", short), names=[module])
        self.state.document.note_implicit_target(section, section)
        text = [f".. automodule:: {module}", ""]
        namespace = vars(importlib.import_module(module))
        own = public_names(module)
        others = {name: home(module, name) for name in namespace["__all__"] if name not in own}
        if others:
            text += ["Has from other modules: "]
            text += [", ".join(link(name, full) for name, full in others.items()) + ".", ""]
        for name in own:
            kind = kind_of(namespace[name])
            text += [f".. auto{kind}:: {module}.{name}", *OPTIONS[kind], ""]
        return self.parse(text, section)


def kind_of(value):
    """What autodoc calls it; an object of one of our classes is data, even if it can be called."""
    if inspect.isclass(value):
        return "class"
    if callable(value) and not class_of(value):
        return "function"
    return "data"


def setup(app):
    """Connect to Sphinx."""
    app.add_directive("modules", Modules)
    app.add_directive("front-door", FrontDoor)
    app.connect("autodoc-process-docstring", rewrite, priority=400)  # before napoleon
    app.connect("autodoc-skip-member", skip)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
