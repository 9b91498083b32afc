"""Markdown: tables, and numbers as texts."""

import math
from collections.abc import Iterable


def number(value: float, decimals: int) -> str:
    """A number with this many decimals, "-" for NaN."""
    return "-" if math.isnan(value) else f"{value:.{decimals}f}"


def cell(text: object) -> str:
    """A text that cannot end its cell."""
    return str(text).replace("|", "\\|").replace("\n", " ")


def table(titles: Iterable[object], rows: Iterable[Iterable[object]]) -> str:
    """A table and the empty line below it."""
    lines = [[cell(title) for title in titles]]
    lines += [["---"] * len(lines[0])] + [[cell(value) for value in row] for row in rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n\n"
