"""Tests that documents name exist, and every claim of planner/SAFETY.md names a header and a test."""
import re
import unittest

from markdown import ROOT, Document, documents

SAFETY = ROOT / "planner/SAFETY.md"
_NAME = re.compile(r"([A-Z]\w+)\.([A-Z]\w+)")


def tests() -> set[str]:
    """Suite.Name of every GoogleTest."""
    return {f"{suite}.{name}" for file in (ROOT / "tests").rglob("*_test.cpp")
            for suite, name in re.findall(r"^TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\)", file.read_text(), re.MULTILINE)}


def unknown_tests(document: Document, known: set[str]) -> list[str]:
    """Inline code of the form Suite.Name that is no test; names of files begin otherwise, or end like files."""
    return [f"{document.name}:{code.line}: `{code.text}`: no such test" for code in document.codes
            if _NAME.fullmatch(code.text) and code.text not in known and not (ROOT / code.text).exists()]


def claims(text: str) -> list[list[str]]:
    """The cells of the numbered rows."""
    return [[cell.strip() for cell in line.strip().strip("|").split("|")]
            for line in text.splitlines() if re.match(r"\| \d+ \|", line)]


class NamedTests(unittest.TestCase):
    def test_every_one_exists(self):
        known = tests()
        self.assertGreater(len(known), 1000)
        found = [one for path in documents() for one in unknown_tests(Document(path), known)]
        self.assertEqual(found, [])
        self.assertGreater(sum(code.text in known for code in Document(SAFETY).codes), 30)

    def test_one_that_does_not_exist_is_found(self):
        self.assertEqual(len(unknown_tests(Document(SAFETY), set())), sum(_NAME.fullmatch(one.text) is not None
                                                                         for one in Document(SAFETY).codes))

    def test_every_claim_names_a_header_a_test_and_its_limit(self):
        rows = claims(SAFETY.read_text(encoding="utf-8"))
        self.assertEqual([row[0] for row in rows], [str(number) for number in range(1, len(rows) + 1)])
        for number, _, argued, tested, limit in rows:
            with self.subTest(claim=number):
                self.assertRegex(argued, r"`[\w/]+\.hpp`")
                self.assertRegex(tested, rf"`{_NAME.pattern}`")
                self.assertTrue(limit)


if __name__ == "__main__":
    unittest.main()
