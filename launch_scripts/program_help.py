"""Programs and scripts of the project, and what their --help holds. Used by programs_page.py and tests/documents."""
import dataclasses
import functools
import os
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]
BIN = os.environ.get("HLC_BIN", "build/release/bin/")
# Scripts outside launch_scripts that users call.
OTHER_SCRIPTS = ("launch_scripts/course/check.py", "tests/fuzz/run.sh", "tests/verify/verify.sh",
                 "vehicle_sim/report/documents.sh", "vehicle_sim/report/draw.sh", "vehicle_sim/report/report.sh")
PARTS_OF_TESTS = {"command_recorder", "write_commonroad_samples"}  # programs without a --help
_FLAG = re.compile(r"--[A-Za-z_][\w-]*")


@dataclasses.dataclass(frozen=True)
class Help:
    """Of a program or script."""
    text: str
    sentence: str  # what it is for
    flags: frozenset  # with their dashes
    examples: tuple


@functools.cache
def programs(folder: str = "") -> dict[str, str]:
    """Name and CMakeLists.txt of every program below the folder, those that measure in tests/ too."""
    found: dict[str, str] = {}
    tops = [folder] if folder else ["hlc_bridge", "planner", "tests", "vehicle_sim"]
    for file in sorted(file for top in tops for file in (ROOT / top).rglob("CMakeLists.txt")):
        for name in re.findall(r"^\s*(?:hlc_add_program|add_run_program)\((\w+)", file.read_text(), re.MULTILINE):
            if name not in PARTS_OF_TESTS:
                found[name] = str(file.relative_to(ROOT))
    return found


def scripts() -> list[str]:
    """Paths from the root; those that are modules or parts of others are not executable."""
    own = [file for file in (ROOT / "launch_scripts").iterdir() if file.is_file() and os.access(file, os.X_OK)]
    return sorted(str(file.relative_to(ROOT)) for file in own) + list(OTHER_SCRIPTS)


def _flags(text: str) -> frozenset:
    """Of the lines that begin with one; behind two blanks is the description, which may name flags of others."""
    starts = [re.split(r"\s{2,}", line.strip())[0] for line in text.splitlines() if re.match(r"\s+-", line)]
    usage = re.search(r"^usage:.*?(?=\n\S|\n\n|\Z)", text, re.MULTILINE | re.DOTALL)
    return frozenset(_FLAG.findall("\n".join(starts + [usage.group() if usage else ""]))) | {"--help", "--version"}


def _sentence(text: str) -> str:
    """The first one outside the usage, in one line."""
    text = re.sub(r"^usage:.*\n(?:\s{3,}.*\n)*\n?", "", text, flags=re.IGNORECASE)
    paragraph = re.split(r"\n\n|\n\s|\nUsage:", text)[0]
    return re.split(r"(?<=\w\.|\)\.)\s(?=[A-Z])", " ".join(paragraph.split()))[0]


@functools.cache
def read(command: str, bin_folder: str = BIN) -> Help:
    """@param command  path of a script from the root, or name of a program in `bin_folder`, perhaps with a subcommand"""
    path, *subcommand = command.split()
    path = path if "/" in path else os.path.join(bin_folder, path)
    if not (ROOT / path).is_file():
        raise RuntimeError(f"{path}: is missing, all programs must be built (launch_scripts/build.sh)")
    done = subprocess.run([str(ROOT / path), *subcommand, "--help"], env={**os.environ, "COLUMNS": "100"}, cwd=ROOT,
                          check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{path} --help: exit code {done.returncode}, must be 0: {' '.join(done.stdout.split())[:200]}")
    head, _, tail = done.stdout.partition("\nExamples:\n")
    examples = tuple(line.strip() for line in tail.splitlines() if line.startswith("  "))
    return Help(text=done.stdout, sentence=_sentence(done.stdout), flags=_flags(head), examples=examples)
