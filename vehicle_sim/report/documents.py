"""python -m report.documents: drives the commands of documents, and makes their tables of the rows."""

import argparse
import shlex
import subprocess
import sys
from functools import partial
from pathlib import Path

from report.document import commands, filled, unfounded
from report.errors import InputError
from report.files import replace
from report.flags import BAD_INPUT, INTERRUPTED, Parser
from report.page_table import page_table

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "launch_scripts"
DOCUMENTS = [ROOT / "vehicle_sim" / name for name in ("EVALUATION.md", "RECONFIGURATION.md")]
SLOW_DOCUMENTS = [ROOT / "planner/coordination/priorities/README.md"]  # half an hour
NOT_FOUNDED, NO_PACKAGES = 1, 3


def _parse() -> argparse.Namespace:
    parser = Parser(
        prog="documents.sh",
        description="Makes the tables of documents again: drives each command `build/release/bin/... --out runs/NAME` in\n"
                    "them, replaces each table by that of the rows, and names figures in the words that are in no table.",
        epilog="Examples:\n  documents.sh\n  documents.sh vehicle_sim/RECONFIGURATION.md --out runs/new_tables\n"
               "Exit codes: 0 done, 1 a figure in the words is in no table, or a command failed, 2 invalid input\n"
               "or not writable, 3 Python's packages cannot be installed, 130 interrupted.")
    parser.add_argument("documents", metavar="DOCUMENT", nargs="*", type=Path, default=DOCUMENTS,
                        help="Markdown; default: EVALUATION.md and RECONFIGURATION.md of vehicle_sim (10 minutes)")
    parser.add_argument("--out", metavar="DIR", type=Path, default=ROOT / "runs" / "documents",
                        help="in place of runs/; must not exist (default: runs/documents)")
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--resume", action="store_true", help="DIR exists: go on in it, and keep what is complete")
    how.add_argument("--check", action="store_true", help="only name figures in the words that are in no table")
    parser.add_argument("--version", action="store_true", help="print the version, and exit")
    if "--version" in sys.argv:
        sys.exit(subprocess.call([SCRIPTS / "version.sh", parser.prog]))
    return parser.parse_args()


def _drive(command: list[str], out: Path) -> None:
    """@raises InputError for a command that fails"""
    print(shlex.join(command), file=sys.stderr)
    place = command.index("--out") + 1
    command = [*command[:place], str(out / Path(command[place]).relative_to("runs")), *command[place + 1:]]
    if not (ROOT / command[0]).exists():
        raise InputError(f"{command[0]}: no such program, must be built first: launch_scripts/build.sh")
    code = subprocess.run(command, cwd=ROOT, stdout=subprocess.DEVNULL, check=False).returncode
    if code not in (0, 1):  # 1: runs that do not count, which the tables have
        raise InputError(f"{shlex.join(command)}: exit code {code}, must be 0 or 1")


def _update(documents: list[Path], out: Path, may_exist: bool) -> None:
    for document in documents:
        filled(document, lambda _: "")  # before anything is driven
    if out.exists() and not may_exist:
        raise InputError(f"{out}: exists, must be new, or --resume be given")
    for command in [one for document in documents for one in commands(document)]:
        _drive(command, out)
    texts = {document: filled(document, partial(page_table, out)) for document in documents}
    for document, text in texts.items():
        replace(document.resolve(), lambda file, text=text: file.write_bytes(text.encode("utf-8")))


def main() -> int:
    """@return the exit code"""
    flags = _parse()
    try:
        if not flags.check:
            # The commands make their pages with it: a missing package is noticed before anything is driven.
            environment = [ROOT / "build/report_environment", ROOT / "vehicle_sim/report/requirements.txt"]
            if subprocess.call([SCRIPTS / "python_environment.sh", *environment]) != 0:
                return NO_PACKAGES
            _update(flags.documents, flags.out.resolve(), flags.resume)
        findings = [one for document in flags.documents for one in unfounded(document)]
    except InputError as error:
        print(f"documents.sh: {error}", file=sys.stderr)
        return BAD_INPUT
    except OSError as error:
        print(f"documents.sh: {error.filename}: {error.strerror}, must be writable", file=sys.stderr)
        return BAD_INPUT
    except KeyboardInterrupt:
        print("documents.sh: interrupted, go on with --resume", file=sys.stderr)
        return INTERRUPTED
    print("\n".join(findings or ["Every figure in the words is in a table, or stated."]))
    return NOT_FOUNDED if findings else 0


if __name__ == "__main__":
    sys.exit(main())
