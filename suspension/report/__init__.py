"""The report's words: every computed sentence, table and caption, as Markdown.

`words` writes numbers and lists, `rows` makes tables, `show` displays them in a notebook; the other
modules hold the sentences, one module for each part of the book or for what several parts share
(`stability`, `verdicts`). A sentence is a function of numbers, fits, runs or robots that returns
Markdown, with a branch for every case.
"""

from suspension.report.rows import table
from suspension.report.show import answer, listing, say, show_figure

__all__ = ["answer", "listing", "say", "show_figure", "table"]
