"""Show computed Markdown in a notebook, under a name by which other pages quote it."""

import ast
import inspect

from IPython.display import Markdown, display

__all__ = ["answer", "say", "source"]


def say(*parts, name=None):
    """Show Markdown paragraphs that a computation has filled in.

    With a `name`, other pages of the book can quote them: the metadata is what MyST-NB's
    ``glue()`` writes.
    """
    metadata = {"scrapbook": {"name": name, "mime_prefix": ""}} if name else {}
    display(Markdown("\n\n".join(parts)), metadata=metadata)


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


def source(function):
    """The code of a function as a Markdown block, without its docstring."""
    code = inspect.getsource(function)
    doc = ast.parse(code).body[0].body[0]
    lines = code.splitlines()
    if ast.get_docstring(ast.parse(code).body[0]):
        del lines[doc.lineno - 1 : doc.end_lineno]
    return "\n".join(["```python", *lines, "```"])
