"""Command lines in the code of documents: which program, which flags."""
import dataclasses
import re
import shlex

from markdown import Document

SHELLS = ("", "sh", "bash")  # languages of blocks
_SEPARATORS = {"&&", "||", "|", ";", "&", "(", ")", "$("}


@dataclasses.dataclass(frozen=True)
class Call:
    """Of one program."""
    place: str  # file and line
    words: tuple  # the program and its arguments

    @property
    def flags(self) -> list[str]:
        """With their dashes, without values."""
        return [word.partition("=")[0] for word in self.words[1:] if re.match(r"--[A-Za-z_]", word)]


def without_comment(line: str) -> str:
    """A comment begins with a number sign and a blank; it may have apostrophes."""
    return re.sub(r"(^|\s+)#(\s.*)?$", "", line)


def split(line: str) -> list[list[str]]:
    """The words of each simple command of a line of the shell; none for what is no such line."""
    lexer = shlex.shlex(without_comment(line), posix=True, punctuation_chars="();<>|&")
    lexer.whitespace_split, lexer.commenters = True, ""
    try:
        words = list(lexer)
    except ValueError:  # a quotation that goes on, or an apostrophe in a sentence
        return []
    commands: list[list[str]] = [[]]
    for word in words:
        if word in _SEPARATORS:
            commands.append([])
        else:
            commands[-1].append(word)
    return [command for command in map(_call, commands) if command]


def _call(words: list[str]) -> list[str]:
    """Without what stands before a program's name: values of the environment, other programs that start it."""
    while words and (re.match(r"[A-Z_]+=", words[0]) or words[0] in ("nice", "sudo", "exec")):
        words = words[3:] if words[:2] == ["nice", "-n"] else words[1:]
    return words


def calls(document: Document) -> list[Call]:
    """Of all lines of code blocks and of inline code; what follows `--wrap` of sbatch is a call, too."""
    lines = [(block.line + i, line) for block in document.blocks if block.language in SHELLS
             for i, line in enumerate(joined(block.lines))]
    lines += [(code.line, code.text) for code in document.codes]
    found = []
    for number, line in lines:
        for words in split(line):
            if words[0] == "sbatch" and "--wrap" in words:
                wrapped = words[words.index("--wrap") + 1]
                found += [Call(f"{document.name}:{number}", tuple(inner)) for inner in split(wrapped)]
            found.append(Call(f"{document.name}:{number}", tuple(words)))
    return found


def joined(lines: tuple) -> list[str]:
    """Lines that end with a backslash and the next one as one, and an empty one in its place."""
    whole: list[str] = []
    begun = None  # index of the line that goes on
    for line in lines:
        if begun is None:
            whole.append(line)
        else:
            whole[begun] += line
            whole.append("")
        begun = (begun if begun is not None else len(whole) - 1) if line.endswith("\\") else None
        if line.endswith("\\"):
            whole[begun] = whole[begun][:-1]
    return whole
