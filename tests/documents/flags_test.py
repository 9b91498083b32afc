"""Commands in the documents name programs that there are, and flags that these know."""
import pathlib
import re
import tempfile
import unittest

from command_lines import Call, calls
from markdown import ROOT, Document, documents

import program_help

HISTORY = "CHANGELOG.md"  # names former programs and flags
FOREIGN = {"apt", "cmake", "cpack", "ctest", "ffmpeg", "git", "jupyter", "ninja", "npm", "pip", "python3", "sbatch",
           "valgrind"}
FOREIGN_FLAGS = {"--gtest_filter"}
SCENARIOS = {file.stem for file in (ROOT / "launch_scripts/scenarios").glob("*.yaml")}
PROGRAMS = program_help.programs()
SCRIPTS = {pathlib.Path(one).name: one for one in program_help.scripts()}
INSTALLED = {"hlc-" + name.replace("_", "-"): name for name in PROGRAMS} | {
    "hlc-run-lab": SCRIPTS["run_lab.sh"], "hlc-vehicle": SCRIPTS["vehicle.sh"]}
TESTS = {name for file in (ROOT / "tests").rglob("CMakeLists.txt")
         for name in re.findall(r"hlc_add_test\((\w+)", file.read_text())}


class Unknown(Exception):
    """One line: which program there is not."""


def command_of(call: Call) -> str | None:
    """For program_help.read; None if it is no program of ours.
    @raises Unknown if it is called like one, but there is none"""
    first = call.words[0].removeprefix("./")
    folder, _, name = first.rpartition("/")
    if re.fullmatch(r"build/\w+/bin|FOLDER", folder) and re.fullmatch(r"\w+", name):
        if name in PROGRAMS:
            return with_subcommand(name, call)
        if name not in TESTS:
            raise Unknown(f"{first}: no such program")
        return None
    if re.fullmatch(r"[\w/]+\.(sh|py)", first) and (call.flags or folder):
        if not folder and name in SCRIPTS:
            return SCRIPTS[name]
        if not (ROOT / first).is_file():
            raise Unknown(f"{first}: no such script")
        return first if first in SCRIPTS.values() else None
    if first.startswith("hlc-") and first != "hlc-":
        if first not in INSTALLED:
            raise Unknown(f"{first}: no such program in an installed tree")
        return INSTALLED[first]
    if first in PROGRAMS:
        return with_subcommand(first, call)
    if call.flags and re.fullmatch(r"[a-z_][\w-]*", first) and first not in FOREIGN | SCENARIOS:
        raise Unknown(f"{first}: no such program")
    return None


def with_subcommand(program: str, call: Call) -> str:
    has_one = program == "soak" and call.words[1:] and not call.words[1].startswith("-")
    return f"{program} {call.words[1]}" if has_one else program


def unknown(document: Document) -> list[str]:
    """One line for each program or flag that there is not."""
    found = []
    for call in calls(document):
        try:
            if call.words[0].startswith("--"):
                known, of = ALL_FLAGS | FOREIGN_FLAGS, "any program"
                flags = [call.words[0].partition("=")[0], *call.flags]
            elif (command := command_of(call)) is not None:
                known, of, flags = help_of(command).flags, command, call.flags
            else:
                continue
        except Unknown as error:
            found.append(f"{call.place}: {error}")
            continue
        found += [f"{call.place}: {flag}: no flag of {of}" for flag in flags if flag not in known]
    return found


def help_of(command: str) -> program_help.Help:
    return program_help.read(command)


def all_flags() -> frozenset:
    own = [name for name in PROGRAMS if name not in program_help.programs("tests")]
    return frozenset().union(*(help_of(one).flags for one in [*own, *SCRIPTS.values()]))


class Flags(unittest.TestCase):
    def findings(self, text: str) -> list[str]:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "page.md"
            path.write_text(text, encoding="utf-8")
            return unknown(Document(path))

    def test_every_command_is_known_with_its_flags(self):
        found = [one for path in documents() if path.name != HISTORY for one in unknown(Document(path))]
        self.assertEqual(found, [])

    def test_commands_are_read(self):
        words = [call.words[0] for path in documents() for call in calls(Document(path))]
        self.assertGreater(sum(word in PROGRAMS or word.startswith("build/release/bin/") for word in words), 100)

    def test_unknown_ones_are_found(self):
        for text, finding in (
                ("    build/release/bin/rollout --cars 2 --stpes 3\n", "page.md:1: --stpes: no flag of rollout"),
                ("a\n\n```\nA=1 build/release/bin/roll --steps 3\n```\n",
                 "page.md:4: build/release/bin/roll: no such program"),
                ("`hlc-rollout --step 3`", "page.md:1: --step: no flag of rollout"),
                ("`hlc-roll`", "page.md:1: hlc-roll: no such program in an installed tree"),
                ("`roll --steps 3`", "page.md:1: roll: no such program"),
                ("`launch_scripts/run.sh`", "page.md:1: launch_scripts/run.sh: no such script"),
                ("`run_lab.sh --car 3`", "page.md:1: --car: no flag of launch_scripts/run_lab.sh"),
                ("`--scenery`", "page.md:1: --scenery: no flag of any program"),
                ("    sbatch --wrap 'build/release/bin/evaluate --start 3'\n",
                 "page.md:1: --start: no flag of evaluate"),
                ("    x && \\\n    build/release/bin/replay --fro 3  # --no\n", "page.md:1: --fro: no flag of replay")):
            with self.subTest(text=text):
                self.assertEqual(self.findings(text), [finding])

    def test_known_ones_are_not(self):
        self.assertEqual(self.findings("    build/release/bin/rollout --steps=3 | ctest --x  # rollout -y\n"), [])
        self.assertEqual(self.findings("`--cars 3`, `rollout --cars=3`"), [])


ALL_FLAGS = all_flags()

if __name__ == "__main__":
    unittest.main()
