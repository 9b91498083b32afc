"""Documents whose tables are made of rows."""

import os
import tempfile
import unittest
from pathlib import Path

from report.document import commands, figures, filled, unfounded
from report.documents import DOCUMENTS, SLOW_DOCUMENTS
from report.errors import InputError
from report.page_table import page_table

PAGE = """# Sweep

## By search

| search | lap [s] |
| --- | --- |
| 2022 | 15.97 |
| best\\|first | 16.02 |

words

| search | pairs |
| --- | --- |
|  | 64 |
| 2022 | 12 |

# Figures

## By search

| search | other |
| --- | --- |
| 2022 | 1 |
"""


class Documents(unittest.TestCase):
    """In a folder of their own."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def document(self, text: str) -> Path:
        path = self.folder / "DOCUMENT.md"
        path.write_text(text, encoding="utf-8")
        return path

    def page(self) -> Path:
        (self.folder / "rules").mkdir()
        (self.folder / "rules" / "report.md").write_text(PAGE, encoding="utf-8")
        return self.folder

    def findings(self, text: str) -> list[str]:
        return [one.split(".md:")[1] for one in unfounded(self.document(text))]


class PageTable(Documents):
    """A table by its address."""

    def test_finds_tables_below_headings_by_number_and_rows_by_values(self) -> None:
        runs = self.page()
        titles = "| search | {} |\n| --- | --- |\n"
        self.assertEqual(page_table(runs, "rules > Sweep > By search where search = 2022"),
                         titles.format("lap [s]") + "| 2022 | 15.97 |\n")
        self.assertEqual(page_table(runs, "rules > By search where search = best|first or none and lap [s] = 16.02"),
                         titles.format("lap [s]") + "| best\\|first | 16.02 |\n")
        self.assertEqual(page_table(runs, "rules > By search number 2 where search ="),
                         titles.format("pairs") + "|  | 64 |\n")
        self.assertEqual(page_table(runs, "rules > Figures > By search"), titles.format("other") + "| 2022 | 1 |\n")

    def test_names_what_is_not_there(self) -> None:
        runs = self.page()
        (runs / "short").mkdir()
        (runs / "short" / "report.md").write_text("## By search\n\n| a | b |\n| --- | --- |\n| 1 |\n", encoding="utf-8")
        for address, message in {"none > By search": "must be a page that --report made",
                                 "../rules > By search": "[.][.]/rules, must be the name of a folder",
                                 "short > By search": "rows of 2 cells, must all have as many",
                                 "rules > By lap": "has 0 below such headings",
                                 "rules > Sweep number 4": "has 2 below such headings",
                                 "rules > By search where laps = 1": "column laps, must be one of search, lap [s]",
                                 "rules > By search where search = 2023": "no row with search = 2023"}.items():
            with self.subTest(address=address), self.assertRaisesRegex(InputError, message.replace("search, lap [s]", r"search, lap \[s\]")):
                page_table(runs, address)


class Figures(unittest.TestCase):
    """Numbers in a text."""

    def test_are_whole_numbers_with_their_decimals(self) -> None:
        self.assertEqual(figures("from 15.97 s [15.80 … 16.14], -6.9 %, J2, 3 of 16."),
                         {"15.97", "15.80", "16.14", "6.9", "3", "16"})

    def test_thousands_may_be_grouped(self) -> None:
        self.assertEqual(figures("159 114 vertices, trims 5 7 10, 12 000.5"), {"159114", "5", "7", "10", "12000.5"})


class Document(Documents):
    """Commands, tables and words."""

    TEXT = ("# Page\n\n    build/release/bin/evaluate --a --out runs/a --report  # twice\n\n## One\n\nA lap of 15.97 s.\n\n"
            "<!-- table rules > By search where search = 2022 -->\nold\n<!-- end of table -->\n\n"
            "    build/release/bin/evaluate --a --out runs/a --report\n    build/release/bin/plan_problem p.yaml\n")

    def test_commands_with_an_output_are_those_that_make_rows_each_once(self) -> None:
        self.assertEqual(commands(self.document(self.TEXT)),
                         [["build/release/bin/evaluate", "--a", "--out", "runs/a", "--report"]])

    def test_a_command_with_an_output_elsewhere_is_refused_at_its_line(self) -> None:
        for arguments in ("--out /tmp/a", "--report --out", "--out 'runs/a", "--out=runs/a", "--out runs/../a",
                          "--out runs/a/b", "--out runs/.."):
            with self.subTest(arguments=arguments), self.assertRaisesRegex(InputError, "DOCUMENT.md:2: .* must be build/release/bin/NAME"):
                commands(self.document(f"\n    build/release/bin/evaluate {arguments}\n"))

    def test_tables_are_replaced_and_all_else_stays(self) -> None:
        text = filled(self.document(self.TEXT), lambda address: f"<{address}>\n")
        self.assertEqual(text, self.TEXT.replace("old\n", "<rules > By search where search = 2022>\n"))

    def test_a_table_that_cannot_be_made_is_named_with_its_line(self) -> None:
        def fails(address: str) -> str:
            raise InputError(f"no {address}")

        with self.assertRaisesRegex(InputError, r"DOCUMENT.md:9: no rules"):
            filled(self.document(self.TEXT), fails)
        with self.assertRaisesRegex(InputError, "must be followed by <!-- end of table -->"):
            filled(self.document(self.TEXT.replace("<!-- end of table -->", "")), lambda address: "")

    def test_a_damaged_comment_is_refused_at_its_line(self) -> None:
        whole = "<!-- table a -->\n| 1 |\n<!-- end of table -->\n"
        for damaged, message in {whole.replace("a -->", "a ->"): ":1: <!-- table a ->, must be <!-- table FOLDER",
                                 whole.replace("<!-- end of", "<!--end of"): ":3: <!--end of table -->, must be <!-- end",
                                 whole + "<!-- end of table -->": ":4: <!-- end of table -->, must be <!-- table",
                                 whole.replace("| 1 |", "<!-- table b -->"): ":2: <!-- table b -->, must be <!-- end",
                                 "words": ": no table, must have one between"}.items():
            for function in (unfounded, lambda document: filled(document, lambda address: "")):
                with self.subTest(damaged=damaged), self.assertRaisesRegex(InputError, "DOCUMENT.md" + message):
                    function(self.document(damaged))

    def test_what_is_no_regular_file_is_refused(self) -> None:
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        for path in (pipe, Path("/dev/null"), self.folder):
            with self.subTest(path=path), self.assertRaisesRegex(InputError, "cannot be read, must be a document"):
                unfounded(path)

    def test_line_ends_stay_as_they_are(self) -> None:
        text = "a\r\nb\x0cc\u2028d\n<!-- table a -->\nold\n<!-- end of table -->\nno line end"
        path = self.folder / "DOCUMENT.md"
        path.write_bytes(text.encode())
        self.assertEqual(filled(path, lambda address: "new\n"), text.replace("old", "new"))

    def test_a_figure_in_the_words_has_to_be_in_a_table_of_its_section(self) -> None:
        table = "<!-- table a -->\n| 15.97 |\n<!-- end of table -->\n"
        self.assertEqual(self.findings(f"## One\n15.97 s\n{table}## Two\n15.97 s, `16.1`, [page](16.3), Table 2\n"), [])
        self.assertEqual(self.findings(f"## One\n15.98 s\n{table}"),
                         ["2: 15.98, must be in a table of its section, or be stated"])
        self.assertEqual(self.findings(f"## One\n{table}## Two\n15.97 s\n{table.replace('15.97', '16.02')}"),
                         ["6: 15.97, must be in a table of its section, or be stated"])

    def test_a_stated_figure_is_of_its_section_and_used(self) -> None:
        table = "<!-- table a -->\n| none |\n<!-- end of table -->\n"
        self.assertEqual(self.findings(f"## One\n0.8 m/s\n<!-- stated: 0.8; m/s, not 2 -->\n## Two\n0.8 m/s\n{table}"),
                         ["5: 0.8, must be in a table of its section, or be stated"])
        self.assertEqual(self.findings(f"## One\n<!-- stated: 0.8 -->\n## Two\n{table}"),
                         ["1: 0.8 is stated, must be in the section's words"])

    def test_figures_in_the_words_of_our_documents_are_in_their_tables(self) -> None:
        for document in DOCUMENTS + SLOW_DOCUMENTS:
            with self.subTest(document=document.name):
                self.assertEqual(unfounded(document), [])


if __name__ == "__main__":
    unittest.main()
