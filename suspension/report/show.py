"""Show computed Markdown and figures in a notebook, under a name by which other pages quote them.

The name is written into the metadata of an output where MyST-NB's ``glue()`` writes it too, so that
the built book finds it there.
"""

import ast
import inspect

import matplotlib.pyplot as plt
from IPython.display import Markdown, display

from suspension.figures.layout import narrow, svg
from suspension.report.rows import SYMBOLS

__all__ = ["answer", "listing", "say", "show_figure"]

UNITS = {name: unit for name, (_, unit, _) in SYMBOLS.items()} | {
    "x0": "m",
    "distance": "m",
    "w0": "[m, m/s, rad, rad/s]",
    "tfinal": "s",
    "dts": "s",
    "two_dts": "s",
}


def say(*parts, name=None):
    """Show Markdown paragraphs that a computation has filled in; what is empty is left out.

    With a `name`, other pages of the book can quote them.
    """
    text = "\n\n".join(filter(None, parts))
    if text:
        display(Markdown(text), metadata=_named(name) if name else {})


def _named(name):
    return {"scrapbook": {"name": name, "mime_prefix": ""}}


def show_figure(name, caption, figure=None):
    """Show a figure and its caption below it, and close it.

    In the built page the two become a numbered figure that is linked to by its name.

    Parameters
    ----------
    name : str
        Label of the figure, ``"fig-fit"``.
    caption : suspension.report.words.Caption
        Markdown of the caption, one paragraph, and the text for those who cannot see the figure.
    figure : matplotlib.figure.Figure, optional
        The current figure if not given.
    """
    figure = plt.gcf() if figure is None else figure
    wide = {"image/svg+xml": svg(figure), "text/plain": caption.alt}
    display(
        wide,
        raw=True,
        metadata=_named(name) | {"alt": caption.alt, "narrow": svg(narrow(figure))},
    )
    plt.close(figure)
    say(caption.text, name=f"caption-{name}")


def answer(item, *parts):
    """Show the answer to one asked item; other pages quote ``1(ii)`` as ``answer-1-ii``.

    Parameters
    ----------
    item : str
        The problem's own number, ``"1(ii)"``.
    *parts : str
        Markdown paragraphs; the first follows the item's number.
    """
    name = "answer-" + item.replace("(", "-").replace(")", "")
    say(f"**Answer {item}.** {parts[0]}", *parts[1:], name=name)


def listing(imports, parameters, *functions):
    """A script that runs by itself, as a Markdown block: paste it into an empty file.

    Parameters
    ----------
    imports : str
        Its first lines.
    parameters : dict
        Numbers, or tuples of them, that the functions use by name. Twelve digits of each: machines
        differ in the last.
    *functions : callable
        Their code follows, without docstrings; the last one is called, without arguments.
    """
    numbers = [f"{name} = {_value(value)}{_unit(name)}" for name, value in parameters.items()]
    code = [_source(function) for function in functions]
    call = f"{functions[-1].__name__}()"
    parts = [imports.strip() + "\n\n" + "\n".join(numbers), *code, call]
    return "```python\n" + "\n\n\n".join(parts) + "\n```"


def _value(value):
    if isinstance(value, tuple):
        return f"({', '.join(map(_value, value))}{',' * (len(value) == 1)})"
    return f"{value:.12g}"


def _unit(name):
    return f"  # {UNITS[name]}" if name in UNITS else ""


def _source(function):
    code = inspect.getsource(function)
    body = ast.parse(code).body[0]
    lines = code.splitlines()
    if ast.get_docstring(body):
        doc = body.body[0]
        del lines[doc.lineno - 1 : doc.end_lineno]
    return "\n".join(lines)
