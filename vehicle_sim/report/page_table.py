"""One table of the page report.md, found by its address.

    FOLDER > HEADING > HEADING [number N] [where COLUMN = VALUE or VALUE and COLUMN = VALUE]

Names with " where ", " and ", " or " or " =" cannot be named. Headings are those above the table, from outside to inside; some may be left out. N counts the tables from 1 on. A column
of which one value remains stays; the rows keep their order.
"""

import re
from pathlib import Path

from report.errors import InputError
from report.files import read_text
from report.markdown import table

ADDRESS = re.compile(r"(?P<path>.+?)(?: number (?P<number>\d+))?(?: where (?P<where>.+))?")
NAME = re.compile(r"\w[\w.-]*")
CELL = re.compile(r"(?<!\\)\|")


def page_table(runs: Path, address: str) -> str:
    """The table as Markdown. @param runs: the folder with FOLDER. @raises InputError for one that is not there."""
    parts = ADDRESS.fullmatch(address)
    folder, *headings = (one.strip() for one in parts["path"].split(" > "))
    if not NAME.fullmatch(folder):
        raise InputError(f"table {address}: {folder}, must be the name of a folder")
    page = runs / folder / "report.md"
    lines = read_text(page, "a page that --report made").split("\n")
    found, number = _tables(lines, headings), int(parts["number"] or 1)
    if not 1 <= number <= len(found):
        raise InputError(f"table {address}, {page} has {len(found)} below such headings")
    titles, *rows = ([cell.strip().replace("\\|", "|") for cell in CELL.split(line)[1:-1]] for line in found[number - 1])
    rows = rows[1:]  # without that of dashes
    if any(len(row) != len(titles) for row in rows):
        raise InputError(f"table {address}, {page}: rows of {len(titles)} cells, must all have as many")
    for condition in (parts["where"] or "").split(" and ") if parts["where"] else []:
        column, _, values = condition.partition(" =")
        if column not in titles:
            raise InputError(f"table {address}: column {column}, must be one of {', '.join(titles)}")
        rows = [row for row in rows if row[titles.index(column)] in values.strip().split(" or ")]
        if not rows:
            raise InputError(f"table {address}: no row with {condition}")
    return table(titles, rows).rstrip("\n") + "\n"


def _tables(lines: list[str], headings: list[str]) -> list[list[str]]:
    """All tables below these headings."""
    above: dict[int, str] = {}
    tables, is_open = [], False
    for line in lines:
        if heading := re.fullmatch(r"(#+) (.+)", line):
            level = len(heading[1])
            above = {depth: text for depth, text in above.items() if depth < level} | {level: heading[2]}
        is_row = line.startswith("|")
        if is_row and not is_open and _is_below(list(above.values()), headings):
            tables.append([])
        if is_row and tables and _is_below(list(above.values()), headings):
            tables[-1].append(line)
        is_open = is_row
    return tables


def _is_below(above: list[str], headings: list[str]) -> bool:
    """Whether they occur among those above, in this order."""
    rest = iter(above)
    return all(heading in rest for heading in headings)
