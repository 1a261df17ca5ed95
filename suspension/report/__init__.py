"""The report's words: sentences and tables made from numbers, as Markdown."""

from suspension.report.rows import (
    error_rows,
    flight_row,
    lost_speeds,
    matrix_rows,
    mode_rows,
    stability_rows,
    table,
    verdict,
)
from suspension.report.show import answer, say, source
from suspension.report.words import confidence, join, ranges

__all__ = [
    "answer",
    "confidence",
    "error_rows",
    "flight_row",
    "join",
    "lost_speeds",
    "matrix_rows",
    "mode_rows",
    "ranges",
    "say",
    "source",
    "stability_rows",
    "table",
    "verdict",
]
