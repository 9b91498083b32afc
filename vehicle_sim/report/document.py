"""A document whose tables are made of rows: its commands, its tables, and the figures in its words.

    build/release/bin/evaluate ... --out runs/rules --report      a command (indented by four) that makes rows
    <!-- table rules > by search where subgraph = A or B -->     that table of runs/rules/report.md (`page_table`)
    | ... |
    <!-- end of table -->
    <!-- stated: 0.8, 31; a speed -->                            figures in this section's words that are not from rows

Every figure in the words of a section (##) has to be in a table of the section as the words have it, digit by digit; of a
section without tables, in any table of the document. Code and targets of links are no words.
"""

import re
import shlex
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from report.errors import InputError
from report.files import read_text

PROGRAM = "    build/release/bin/"
COMMAND, FOLDER = re.compile(r"build/release/bin/\w+"), re.compile(r"runs/\w[\w.-]*")
BEGIN, END = re.compile(r"<!-- table (.+) -->"), "<!-- end of table -->"
ABOUT_TABLES = re.compile(r"<!--\s*(?:end of )?table\b")
STATED = re.compile(r"<!-- stated: ([^;]*).* -->")
NO_WORDS = re.compile(r"`[^`]*`|\]\([^)]*\)|<!--.*?-->|https?://\S+|(?:Tables?|Figs?\.|Figures?) \d+(?: and \d+)?")
FIGURE = re.compile(r"(?<![\w.])\d(?:[\d ]*\d)?(?:\.\d+)?(?![\w])")


@dataclass
class Section:
    """From a heading ## to the next one."""

    words: list[tuple[int, str]]  # number of the line, text
    tables: str = ""
    stated: str = ""


def figures(text: str) -> set[str]:
    """The numbers of a text; those of a group as 12 000 are one."""
    return {re.sub(r"(?<=\d) (?=\d{3}(?!\d))", "", number) for number in _numbers(text)}


def _numbers(text: str) -> list[str]:
    """A blank joins digits only where thousands are grouped."""
    numbers = []
    for match in FIGURE.finditer(text):
        grouped = re.fullmatch(r"\d{1,3}( \d{3})+(\.\d+)?", match[0])
        numbers += [match[0]] if grouped else match[0].split(" ")
    return numbers


def commands(document: Path) -> list[list[str]]:
    """Program and arguments of those with --out runs/NAME, in their order, each once. @raises InputError"""
    found: dict[tuple[str, ...], None] = {}
    for number, line in enumerate(_lines(document), 1):
        if not line.startswith(PROGRAM) or " --out" not in line:
            continue
        try:
            words = shlex.split(line, comments=True)
            if not COMMAND.fullmatch(words[0]) or not FOLDER.fullmatch(words[words.index("--out") + 1]):
                raise ValueError
        except (ValueError, IndexError):
            raise InputError(f"{document}:{number}: {line.strip()}, must be {PROGRAM.strip()}NAME ... --out runs/NAME") \
                from None
        found[tuple(words)] = None
    return [list(one) for one in found]


def filled(document: Path, table_of: Callable[[str], str]) -> str:
    """The document with each table replaced by what table_of makes of its address; all else stays.

    @raises InputError for a damaged comment, and what table_of raises, at its line."""
    text, in_table = [], False
    for number, line in enumerate(_checked_lines(document), 1):
        if line == END:
            in_table = False
        if not in_table:
            text.append(line)
        if begins := BEGIN.fullmatch(line):
            in_table = True
            try:
                text.append(table_of(begins[1]).rstrip("\n"))
            except InputError as error:
                raise InputError(f"{document}:{number}: {error}") from None
    return "\n".join(text)


def unfounded(document: Path) -> list[str]:
    """One line for each figure in the words that is neither in a table nor stated, and for each that is stated and in no
    words."""
    sections = _sections(document)
    everywhere = figures("\n".join(one.tables for one in sections))
    findings = []
    for one in sections:
        allowed, stated = figures(one.tables) or everywhere, figures(one.stated)
        used = set()
        for number, text in one.words:
            for figure in sorted(figures(NO_WORDS.sub(" ", text))):
                used.add(figure)
                if figure not in allowed | stated:
                    findings.append(f"{document}:{number}: {figure}, must be in a table of its section, or be stated")
        findings += [f"{document}:{one.words[0][0]}: {figure} is stated, must be in the section's words"
                     for figure in sorted(stated - used)]
    return findings


def _sections(document: Path) -> list[Section]:
    sections, in_table = [Section([])], False
    for number, line in enumerate(_checked_lines(document), 1):
        if line.startswith("## "):
            sections.append(Section([]))
        here = sections[-1]
        stated = STATED.search(line)
        if BEGIN.fullmatch(line) or line == END:
            in_table = line != END
        elif in_table:
            here.tables += line + "\n"
        elif stated:
            here.stated += stated[1] + "\n"
        elif not line.startswith("    "):
            here.words.append((number, line))
    return sections


def _checked_lines(document: Path) -> list[str]:
    """@raises InputError for a document without tables, and for a comment that would be none of ours by mistake"""
    lines, begun = _lines(document), 0
    for number, line in enumerate(lines, 1):
        if BEGIN.fullmatch(line) and not begun:
            begun = number
        elif line == END and begun:
            begun = 0
        elif ABOUT_TABLES.search(line):
            expected = END if begun else "<!-- table FOLDER > HEADING -->"
            raise InputError(f"{document}:{number}: {line}, must be {expected}")
    if begun:
        raise InputError(f"{document}:{begun}: {lines[begun - 1]}, must be followed by {END}")
    if END not in lines:
        raise InputError(f"{document}: no table, must have one between <!-- table FOLDER > HEADING --> and {END}")
    return lines


def _lines(document: Path) -> list[str]:
    return read_text(document, "a document").split("\n")
