"""The commands of the READMEs run as they stand, in their order, in a copy of the project.

Every line of a block of code that calls a program is run, or in NOT_RUN with the reason. Some do less than they would:
the flags of SHORTER replace theirs or are appended. A block of the language `output` shows lines that the commands before
it print: no figure in it can go stale.
"""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(__file__).resolve().parent
ROOT = FOLDER.parents[2]
BUILD = pathlib.Path(os.environ.get("HLC_BUILD", ROOT / "build/release"))
sys.path[:0] = [str(FOLDER.parent), str(ROOT / "launch_scripts")]

import command_lines  # noqa: E402
import program_help  # noqa: E402
from markdown import Block, Document  # noqa: E402

DOCUMENTS = ["README.md", "launch_scripts/RUNS.md", "planner/YOUR_CAR.md",
             *sorted(str(file.relative_to(ROOT)) for top in ("launch_scripts", "planner", "vehicle_sim", "hlc_bridge")
                     for file in [*(ROOT / top).glob("README.md"), *(ROOT / top).glob("*/README.md")])]
OTHERS = {"apt", "cmake", "cpack", "export", "ffmpeg", "kill", "ninja", "pip", "python3", "sbatch"}  # programs that are not ours

# Beginnings of lines that are not run, and why.
NOT_RUN = {
    "./launch_scripts/run_lab.sh  ": "builds; its run is the one of the picture below it",
    "./launch_scripts/run_tests.sh": "runs this test",
    "launch_scripts/run_tests.sh hlc_bridge/dds --unit --preset fast_dds_3": "downloads another Fast DDS, which no test needs",
    "launch_scripts/run_lab.sh --preset fast_dds_3": "likewise",
    "launch_scripts/setup.sh": "the machine that builds has had it",
    "launch_scripts/build.sh": "the programs are those that it has built",
    "./launch_scripts/run_lab.sh --map ../shared": "the lab's own map is no part of the project",
    "./launch_scripts/run_lab.sh --commonroad FILE.xml": "CommonRoadRun of tests/integration has files",
    "run_lab.sh --commonroad FILE.xml": "likewise",
    "import_commonroad --commonroad FILE.xml": "likewise",
    "build/release/bin/automaton_request": "two terminals; Reconfiguration of tests/integration",
    "automaton_request": "likewise",
    "vehicle_sim/report/documents.sh": "ten minutes; tests/vehicle_sim/report checks the tables",
    "sbatch": "needs Slurm; evaluate --shard is tested in tests/vehicle_sim/apps",
    "build/release/bin/evaluate --merge runs/town": "likewise",
    "tests/verify/verify.sh": "verify_runs does",
    "launch_scripts/vehicle.sh --vehicle_ids": "two terminals; Scripts and KilledProcess of tests/integration",
    "build/release/bin/lab_control": "likewise",
    "build/release/bin/summarize --run runs/by_hand": "likewise",
    "kill -9": "KilledProcess of tests/integration",
    "cmake --install": "tests/install",
    "cpack": "tests/install",
    "apt install": "tests/install",
    "hlc-": "tests/install",
    "cmake --preset release && ninja": "the programs are those that it has built",
    "launch_scripts/python_environment.sh": "this test runs in what it makes",
    "export PATH": "this test runs so",
    "python3 -m venv": "the package of the build folder is used, not one that is compiled again",
    "pip install": "likewise",
    "build/release/bin/evaluate --sweep": "minutes to hours; tests/vehicle_sim/campaign drives sweeps",
    "python3 -c": "tests/verify reads recordings by the same package",
    "view": "runs until it is stopped; View of tests/integration",
    "launch_scripts/run_lab.sh --security security": "SecuredRun of tests/integration",
    "launch_scripts/run_lab.sh --scenario passenger_cars_in_town --view": "a browser; View of tests/integration",
    "build/release/bin/choose_trims runs/<your run>": "a drive of the user's own",
}
# Beginnings of lines that do less here. run_lab.sh builds nothing, and drives 20 steps where it keeps no folder.
SHORTER = {
    "build/release/bin/evaluate": {"--starts": "1"},
    "build/release/bin/compare_priorities": {"--cars": "5", "--draws": "1"},
    "build/release/bin/draw_run runs/my_run --video run.mp4": {"--rate": "5"},
    "build/release/bin/fault_simulator": {"--runs": "5"},
}
# Exit codes other than 0, as the documents state.
EXIT_CODES = {
    "build/release/bin/compare ": 1,  # the two runs differ
    "python3 launch_scripts/course/check.py": 1,  # of a skeleton: not yet
}
LONGEST_S = 600  # a command: so much only if it hangs
NEEDED = {"draw_run": ("chromium", "ffmpeg"), "ffmpeg": ("chromium", "ffmpeg")}  # without which the tests of the program itself are skipped, too


def lines_of_block(block: Block) -> list[tuple[int, str]]:
    """Number and text of the lines that call programs."""
    if block.language not in command_lines.SHELLS:
        return []
    ours = set(program_help.programs()) | {"hlc-rollout", "hlc-run-lab"}
    return [(block.line + i, line) for i, line in enumerate(command_lines.joined(block.lines))
            for words in command_lines.split(line)[:1]
            if words[0] in ours | OTHERS or re.fullmatch(r"(\./)?[\w/]+\.(sh|py)|build/release/bin/\w+", words[0])]


def lines_of(document: Document) -> list[tuple[int, str]]:
    return [line for block in document.blocks for line in lines_of_block(block)]


def reason_not_to_run(line: str) -> str | None:
    if "--simulated_time=false" in line:
        return "in real time, which other tests beside it would disturb: the tests of the label real_time"
    return next((why for begin, why in NOT_RUN.items() if (line + "  ").startswith(begin)), None)


def shortened(line: str) -> str:
    """The command without its comment, with the flags of SHORTER instead of its own."""
    line = command_lines.without_comment(line)
    flags = next((dict(flags) for begin, flags in SHORTER.items() if line.startswith(begin)), {})
    if "run_lab.sh" in line.split()[0]:
        flags |= {"--no_build": "", "--startup_timeout_s": "120"} | ({} if " --out " in line or "--steps" in line else {"--steps": "20"})
    command, *rest = line.split(" && ")
    for flag, value in flags.items():
        command, count = re.subn(rf"{flag}[ =]\S+", f"{flag} {value}", command)
        command += "" if count else f" {flag} {value}".rstrip()
    return " && ".join([command, *rest])


def ended(command: str, folder: pathlib.Path, path: str) -> tuple[int, str]:
    """Exit code and output of a command that ends, with all that it started."""
    with subprocess.Popen(["bash", "-c", command], cwd=folder, env=os.environ | {"PATH": path}, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          start_new_session=True) as process:
        try:
            printed = process.communicate(timeout=LONGEST_S)[0]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            printed = process.communicate()[0] + f"\nended after {LONGEST_S} s"
        return process.returncode, printed


class Commands(unittest.TestCase):
    def copy(self) -> pathlib.Path:
        folder = tempfile.TemporaryDirectory(prefix="hlc_documents_")
        self.addCleanup(folder.cleanup)
        copy = pathlib.Path(folder.name)
        listed = subprocess.run(["git", "ls-files", "-z", ":!tests", ":!*.[ch]pp"], cwd=ROOT, check=True,
                                stdout=subprocess.PIPE, text=True)  # nothing is compiled
        for name in filter(None, listed.stdout.split("\0")):
            (copy / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, copy / name)
        (copy / "build/release").mkdir(parents=True)
        (copy / "runs").mkdir()
        (copy / "build/release/bin").symlink_to(BUILD / "bin")
        (copy / "build/report_environment").symlink_to(ROOT / "build/report_environment")
        return copy

    def run_document(self, name: str) -> pathlib.Path:
        copy = self.copy()
        path = f"{pathlib.Path(sys.executable).parent}:{copy}/build/release/bin:{os.environ['PATH']}"
        printed: list[str] = []  # since the last block that shows some of it
        for block in Document(ROOT / name).blocks:
            for number, line in lines_of_block(block):
                with self.subTest(line=f"{name}:{number}"):
                    printed += self.run_line(line, copy, path).splitlines()
            if block.language == "output":
                with self.subTest(output=f"{name}:{block.line}"):
                    self.assertEqual([line for line in block.lines if line not in [*printed, "", "..."]], [], "\n".join(printed))
                printed = []
        return copy

    def run_line(self, line: str, copy: pathlib.Path, path: str) -> str:
        """@return what it printed; nothing where it is not run"""
        needed = NEEDED.get(pathlib.Path(line.split()[0]).name, ())
        if reason_not_to_run(line) or not all(map(shutil.which, needed)):
            return ""
        command = shortened(line).replace("/tmp/", f"{copy}/")
        code, printed = ended(command, copy, path)
        expected = next((code for begin, code in EXIT_CODES.items() if line.startswith(begin)), 0)
        self.assertEqual(code, expected, f"{command}\n{printed[-3000:]}")
        return printed


class MainDocument(Commands):
    def test_commands_run_and_drive_the_run_in_the_picture(self):
        copy = self.run_document("README.md")
        shown = re.search(r"trace_sha256 of the run in the picture: (\w+)", (ROOT / "README.md").read_text())[1]
        driven = json.loads((copy / "runs/my_run/summary.json").read_text())["trace_sha256"]
        self.assertEqual(driven, shown, "the picture of README.md shows another run: its commands are in the README")

    def test_picture_is_small(self):
        self.assertLess((ROOT / "launch_scripts/pictures/first_run.gif").stat().st_size, 600_000)

    def test_every_reason_not_to_run_a_line_is_needed(self):
        lines = [line for name in DOCUMENTS for _, line in lines_of(Document(ROOT / name))]
        for begin in NOT_RUN:
            self.assertTrue(any((line + "  ").startswith(begin) for line in lines), begin)


class OtherDocuments(Commands):
    """A test for each is added below."""


def _test_of(name: str):
    return lambda self: self.run_document(name)


for _name in DOCUMENTS[1:]:
    if lines_of(Document(ROOT / _name)):
        setattr(OtherDocuments, "test_" + re.sub(r"\W", "_", _name.removesuffix(".md")), _test_of(_name))

if __name__ == "__main__":
    unittest.main()
