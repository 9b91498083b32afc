#!/usr/bin/env python3
"""Writes PROGRAMS.md beside this script: what each program and script is for, from its --help."""
import argparse
import pathlib
import subprocess
import sys

import program_help

PAGE = pathlib.Path(__file__).resolve().parent / "PROGRAMS.md"
HEAD = """# Programs

Made by `launch_scripts/programs_page.py` of the `--help` of each, which has all flags. Programs are in
`build/release/bin` after `launch_scripts/build.sh --programs`; where they are installed their names begin with `hlc-`
and have dashes (`hlc-plan-problem`).
"""
SECTIONS = (("Processes of a run, and programs for its records", "hlc_bridge"),
            ("Whole runs in one process", "vehicle_sim"),
            ("Planning, automata, maps and scenarios", "planner"),
            ("Measurements and endurance, built with the tests", "tests"))


def row(command: str) -> str:
    """Of the table."""
    page = program_help.read(command)
    if not page.sentence or len(page.examples) < 2:
        raise ValueError(f"{command} --help: no sentence on what it is for, or less than two examples")
    cells = [f"`{command}`", page.sentence, "<br>".join(f"`{one}`" for one in page.examples[:2])]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def page() -> str:
    """@raises RuntimeError, OSError, ValueError for a program whose help cannot be read"""
    text = HEAD
    groups = [(title, sorted(program_help.programs(folder))) for title, folder in SECTIONS]
    for title, commands in [("Scripts", program_help.scripts()), *groups]:
        lines = [row(command) for command in commands]
        text += "\n".join(["", f"## {title}", "", "| | what for | for example |", "|---|---|---|", *lines, ""])
    return text


class Parser(argparse.ArgumentParser):
    """An error is one line."""

    def error(self, message: str) -> None:
        self.exit(2, f"{self.prog}: {message} (see --help)\n")


def main() -> int:
    """@return the exit code"""
    parser = Parser(
        prog="programs_page.py", description=__doc__, allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="Examples:\n  programs_page.py\n  programs_page.py --check\n"
               "Exit codes: 0 written, or as it would be written, 1 out of date (--check), 2 invalid input,\n"
               "or programs are missing.")
    parser.add_argument("--check", action="store_true", help="writes nothing")
    parser.add_argument("--version", action="store_true", help="print the version, and exit")
    if "--version" in sys.argv:
        return subprocess.call([PAGE.parent / "version.sh", parser.prog])
    flags = parser.parse_args()
    try:
        text = page()
    except (OSError, RuntimeError, ValueError) as error:
        print(f"programs_page.py: {error}", file=sys.stderr)
        return 2
    if not flags.check:
        try:
            PAGE.write_text(text, encoding="utf-8")
        except OSError as error:
            print(f"programs_page.py: {error}", file=sys.stderr)
            return 2
    elif not PAGE.exists() or PAGE.read_text(encoding="utf-8") != text:
        print(f"{PAGE.name} is out of date: launch_scripts/programs_page.py writes it", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
