"""Documents as GitHub reads them: headings and their anchors, links, code. Every part with its line, from 1."""
import dataclasses
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


def documents() -> list[pathlib.Path]:
    """All of the project."""
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.md"],
                            cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    return [ROOT / name for name in listed.stdout.split() if (ROOT / name).is_file()]


@dataclasses.dataclass(frozen=True)
class Part:
    line: int
    text: str


@dataclasses.dataclass(frozen=True)
class Block:
    """Of code."""
    line: int  # of the first line of code
    language: str  # behind the fence; "" for indented code
    lines: tuple


class Document:
    """One file, taken apart."""

    def __init__(self, path: pathlib.Path):
        self.path = path
        self.name = str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else path.name
        self.blocks: list[Block] = []
        self._prose = self._without_blocks(path.read_text(encoding="utf-8").splitlines())
        self.codes: list[Part] = []
        blanked = re.sub(r"(?<!`)(`+)(?!`)((?:[^\n]|\n(?!\n))+?)(?<!`)\1(?!`)", self._take_code, self._prose)
        self.links = [Part(self._line(blanked, one.start()), one.group(1))
                      for one in re.finditer(r"\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)", blanked)]
        self.anchors = self._anchors()

    def _without_blocks(self, lines: list[str]) -> str:
        """Takes the blocks of code out and leaves empty lines, so that the others keep their numbers."""
        prose, i = [], 0
        while i < len(lines):
            fence = re.match(r"\s*(```+|~~~+)\s*(\w*)", lines[i])
            is_indented = lines[i].startswith("    ") and lines[i].strip() and (i == 0 or not lines[i - 1].strip())
            if not fence and not is_indented:
                prose.append(lines[i])
                i += 1
                continue
            first, indent = (i + 1, len(lines[i]) - len(lines[i].lstrip())) if fence else (i, 4)
            end = first
            while end < len(lines) and (not lines[end].strip().startswith(fence.group(1)) if fence
                                        else lines[end].startswith("    ") or not lines[end].strip()):
                end += 1
            self.blocks.append(Block(first + 1, fence.group(2) if fence else "",
                                     tuple(line[indent:] for line in lines[first:end])))
            next_line = end + 1 if fence else end
            prose += [""] * (next_line - i)
            i = next_line
        return re.sub(r"<!--.*?-->", lambda one: re.sub(r"[^\n]", " ", one.group()), "\n".join(prose), flags=re.DOTALL)

    @staticmethod
    def _line(text: str, position: int) -> int:
        return text.count("\n", 0, position) + 1

    def _take_code(self, match: re.Match) -> str:
        self.codes.append(Part(self._line(self._prose, match.start()), " ".join(match.group(2).split())))
        return re.sub(r"[^\n]", "x", match.group())

    def _anchors(self) -> set[str]:
        found: dict[str, int] = {}
        anchors = set()
        for heading in re.findall(r"^#{1,6}\s+(.*?)\s*#*\s*$", self._prose, re.MULTILINE):
            text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
            anchor = re.sub(r"[^\w\- ]", "", text.replace("*", "")).replace(" ", "-")
            anchors.add(anchor + (f"-{found[anchor]}" if anchor in found else ""))
            found[anchor] = found.get(anchor, 0) + 1
        return anchors
