"""Links, anchors and file names in the documents lead somewhere."""
import pathlib
import re
import tempfile
import unittest

from markdown import ROOT, Document, documents

TOPS = sorted(entry.name for entry in ROOT.iterdir()
              if entry.is_dir() and entry.name not in ("build", "runs") and not entry.name.startswith("."))
# Files that a reader is to write, or that were renamed.
NO_FILES = {"planner/coordination/priorities/most_coupled.cpp": "the example of CONTRIBUTING.md"}
HISTORY = "CHANGELOG.md"  # names what is gone


def dead_links(document: Document) -> list[str]:
    """One line for each link to a file or heading that is not there; those to other hosts are not followed."""
    found = []
    for link in document.links:
        name, _, anchor = link.text.partition("#")
        if re.match(r"[a-z]+:", name):
            continue
        target = document.path if not name else document.path.parent / name
        place = f"{document.name}:{link.line}: {link.text}"
        if not target.exists():
            found.append(f"{place}: no such file, must be one from the document's folder")
        elif anchor and (target.suffix != ".md" or anchor not in Document(target.resolve()).anchors):
            found.append(f"{place}: no heading #{anchor} there")
    return found


def missing_files(document: Document) -> list[str]:
    """Inline code that is a path from the root: a folder, a file, or a header without its extension."""
    pattern = re.compile(rf"(?:{'|'.join(TOPS)})(?:/[\w.-]+)+/?")
    return [f"{document.name}:{code.line}: `{code.text}`: no such file or folder" for code in document.codes
            if pattern.fullmatch(code.text) and code.text not in NO_FILES
            and not any((ROOT / (code.text + end)).exists() for end in ("", ".hpp", ".cpp", ".py"))]


class Links(unittest.TestCase):
    def document(self, text: str) -> Document:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name) / "page.md"
        path.write_text(text, encoding="utf-8")
        return Document(path)

    def test_every_link_leads_to_a_file_and_a_heading(self):
        all_documents = documents()
        self.assertGreater(len(all_documents), 50)
        self.assertEqual([one for path in all_documents for one in dead_links(Document(path))], [])

    def test_every_path_in_code_exists(self):
        found = [one for path in documents() if path.name != HISTORY for one in missing_files(Document(path))]
        self.assertEqual(found, [])

    def test_dead_ones_are_found(self):
        page = self.document("# One *two*, `three_3`\n\n[a](#one-two-three_3) [b](page.md#one)\n[c](gone.md) "
                             "`[d](none.md)`\n\n    [e](none.md)\n\n`planner/gone.hpp` `planner/search`\n")
        self.assertEqual([one.split(": ")[:2] for one in dead_links(page)],
                         [["page.md:3", "page.md#one"], ["page.md:4", "gone.md"]])
        self.assertEqual(missing_files(page), ["page.md:8: `planner/gone.hpp`: no such file or folder"])

    def test_equal_headings_are_numbered(self):
        self.assertEqual(self.document("# A b\n## A b\n```\n# no heading\n```\n").anchors, {"a-b", "a-b-1"})


if __name__ == "__main__":
    unittest.main()
