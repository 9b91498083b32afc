"""The course: its skeletons run and do not reach the goals, the answers here do, and what is wrong is named."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
COURSE = HERE.parent.parent / "launch_scripts" / "course"
EXERCISES = ("trim", "priority", "automaton", "crossing")


def ended(*command):
    return subprocess.run([*map(str, command)], capture_output=True, text=True, check=False)


def graded(exercise, *arguments):
    return ended(sys.executable, COURSE / "check.py", exercise, *arguments)


def rows_of(exercise, grades):
    """Of the table in results.md: a row per figure, then the points. Grades: as given, half way, a good answer."""
    rows = []
    for name, (_, asked) in grades[0]["figures"].items():
        reached = [grade["figures"][name][0] for grade in grades]
        rows.append(" | ".join([name, f"{asked:.4g}", *(f"{one:.4g}" for one in reached)]))
    rows.append(" | ".join(["points", "10", *(str(grade["points"]) for grade in grades)]))
    return [f"| {f'`{exercise}`' if i == 0 else ''} | {row} |".replace("|  |", "| |") for i, row in enumerate(rows)]


class CourseTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def written(self, text):
        file = self.folder / "answer.py"
        file.write_text(text, encoding="utf-8")
        return file

    def test_the_skeletons_run_by_themselves(self):
        for exercise in EXERCISES:
            with self.subTest(exercise=exercise):
                done = ended(sys.executable, COURSE / f"{exercise}.py")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(done.stdout)

    def test_skeletons_get_a_poor_grade_answers_all_points_and_results_has_their_figures(self):
        table = (COURSE / "results.md").read_text(encoding="utf-8")
        for exercise in EXERCISES:
            with self.subTest(exercise=exercise):
                grades = []
                for answer in (COURSE, HERE / "answers" / "half_way", HERE / "answers"):
                    done = graded(exercise, "--answer", answer / f"{exercise}.py", "--json")
                    self.assertIn(done.returncode, (0, 1), done.stderr)
                    grades.append(json.loads(done.stdout))
                    self.assertEqual(grades[-1]["is_reached"], done.returncode == 0)
                self.assertLess(grades[0]["points"], 5)
                self.assertTrue(grades[2]["is_reached"])
                self.assertEqual(grades[2]["points"], 10)
                self.assertIn("\n".join(rows_of(exercise, grades)), table)

    def test_a_figure_that_is_missed_by_little_does_not_get_all_points(self):
        values = 'VALUES = {"right_of_way": True, "contouring_weight": 150, "held_up_contouring_weight": 150}\n'
        done = graded("crossing", "--answer", self.written(values), "--json")
        self.assertEqual(done.returncode, 1, done.stderr)
        grade = json.loads(done.stdout)
        reached, asked = grade["figures"]["mean speed"]
        self.assertGreater(reached, 0.95 * asked)
        self.assertLess(grade["points"], 10)

    def test_what_an_answer_prints_is_no_part_of_its_grade(self):
        prints = 'print("read")\ndef identify(*_):\n    print("asked")\n    return 0.5, 0.0\n'
        done = graded("trim", "--answer", self.written(prints), "--json")
        self.assertEqual(json.loads(done.stdout)["exercise"], "trim")
        self.assertIn("asked", done.stderr)

    def test_an_output_that_cannot_be_written_is_no_fault_of_the_answer(self):
        file = self.written("TRIMS = [(0.0, 0.0)]\n")
        done = graded("automaton", "--answer", file, "--out", file / "below")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertRegex(done.stderr, r"\A[^\n]*below[^\n]*\n\Z")

    def test_runs_are_kept_in_a_new_folder_with_the_figures_that_are_graded(self):
        out = self.folder / "runs"
        done = graded("automaton", "--out", out, "--json")
        self.assertEqual(done.returncode, 1, done.stderr)
        summary = json.loads((out / "answer" / "summary.json").read_text())
        reached, _ = json.loads(done.stdout)["figures"]["mean speed"]
        self.assertEqual(summary["vehicles"][0]["driven_speed_mps"]["mean"], reached)
        self.assertTrue((out / "as_given" / "run.html").is_file())
        replay = ended(Path(os.environ["HLC_BUILD"]) / "bin" / "replay", out / "answer")
        self.assertEqual(replay.returncode, 0, replay.stderr)
        again = graded("automaton", "--out", out)
        self.assertEqual(again.returncode, 2)
        self.assertRegex(again.stderr, "--out = .*runs, must be a new or empty folder")

    def test_a_car_that_stands_gets_no_points_for_its_few_trims(self):
        done = graded("automaton", "--answer", self.written("TRIMS = [(0.0, 0.0)]\n"), "--json")
        self.assertEqual((done.returncode, json.loads(done.stdout)["points"]), (1, 0))
        done = graded("automaton", "--answer", self.written("TRIMS = [(0.0, 0.0)]\n"))
        self.assertRegex(done.stdout, r"(?m)^  trims +reached +1 .* 0 of 6 points, as the car hardly drives$")

    def test_an_output_that_cannot_be_written_is_named(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([sys.executable, COURSE / "check.py", "trim"], stdout=full, stderr=subprocess.PIPE,
                                  text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"\Acheck.py: standard output: cannot be written[^\n]*\n\Z")

    def test_the_table_has_what_was_reached_and_what_is_asked(self):
        done = graded("automaton")
        self.assertRegex(done.stdout, r"(?m)^  trims +reached +12 +asked at most 6 +0 of 6 points$")
        self.assertRegex(done.stdout, r"(?m)^grade: \d of 10 points, not yet$")

    def test_no_line_is_wider_than_a_narrow_terminal(self):
        narrow = dict(os.environ, COLUMNS="60")
        done = subprocess.run([sys.executable, COURSE / "check.py", "automaton"], capture_output=True, text=True,
                              check=False, env=narrow)
        for line in done.stdout.splitlines():
            self.assertTrue(len(line) <= 60 or "/" in line, line)
        self.assertRegex(" ".join(done.stdout.split()), r" trims reached 12 asked at most 6 0 of 6 points ")

    def test_a_recorded_drive_is_graded_as_a_simulated_one(self):
        evaluate = Path(os.environ["HLC_BUILD"]) / "bin" / "evaluate"
        done = ended(evaluate, "--scenario", "lab_red_alone", "--steps", 300, "--keep_runs", "--out",
                     self.folder / "drive")
        self.assertEqual(done.returncode, 0, done.stderr)
        run = self.folder / "drive" / "runs" / "0"
        self.assertEqual(graded("trim", "--run", run).returncode, 1)
        self.assertEqual(graded("trim", "--run", run, "--answer", HERE / "answers" / "trim.py").returncode, 0)

    def test_what_is_wrong_with_an_answer_is_named_in_one_line(self):
        cases = [("trim", "identify = 3\n", "raised TypeError: 'int'"),
                 ("trim", "def identify(*_):\n    return 0.5\n", "identify returned 0.5, must be 2 finite numbers"),
                 ("trim", "def identify(*_):\n    return 1 / 0\n", r"answer.py:2: raised ZeroDivisionError"),
                 ("trim", "def identify(\n", r"answer.py:1: .*, must be Python"),
                 ("trim", "pass\n", "identify is missing"),
                 ("trim", "def identify(*_):\n    raise ValueError('of\\ntwo lines')\n", "ValueError: of two lines"),
                 ("trim", "import numpy\ndef identify(*_):\n    return numpy.ones((2, 2))\n", "must be 2 finite numbers"),
                 ("priority", "rule = 3\n", "rule = 3, must be a function"),
                 ("priority", "def rule(situation):\n    return [99]\n", "the function returned .99., must be"),
                 ("priority", "def rule(_):\n    return no_such_name\n", r"answer.py:2: raised NameError"),
                 ("automaton", "TRIMS = 3\n", "TRIMS = 3, must be a list"),
                 ("automaton", "TRIMS = []\n", r"TRIMS = \[\], must begin with standstill"),
                 ("automaton", "TRIMS = [(0.8, 0.0), (0.0, 0.0)]\n", "must begin with standstill: speed 0"),
                 ("automaton", "TRIMS = [(0, 0), 3]\n", r"TRIMS: entry 2 = 3, must be 2 finite numbers"),
                 ("automaton", "TRIMS = [(0.0, 0.0), (99.0, 0.0)]\n", r"TRIMS: trims\[2\].speed_mps = 99"),
                 ("crossing", "raise SystemExit(0)\n", r"answer.py:1: raised SystemExit"),
                 ("crossing", "VALUES = 3\n", "VALUES = 3, must be a dict"),
                 ("crossing", "VALUES = {'seed': 3}\n", "VALUES: 'seed', must be one of contouring_weight, "),
                 ("crossing", "VALUES = {'right_of_way': 3}\n", "right_of_way")]
        for exercise, text, message in cases:
            with self.subTest(exercise=exercise, text=text):
                done = graded(exercise, "--answer", self.written(text))
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                self.assertRegex(done.stderr, r"\A[^\n]*answer\.py[^\n]*\n\Z")
                self.assertRegex(done.stderr, message)

    def test_bad_arguments_are_named(self):
        for arguments, message in ((("swim",), "swim"), (("trim", "--no_such_flag"), "no_such_flag"),
                                   (("trim", "--answer", "no_file.py"), "no_file.py: is no file"),
                                   (("trim", "--run", "no_folder"), "no_folder: must be a run folder"),
                                   (("crossing", "--run", "."), "--run with crossing, must be with trim")):
            with self.subTest(arguments=arguments):
                done = graded(*arguments)
                self.assertEqual(done.returncode, 2)
                self.assertIn(message, done.stderr)


if __name__ == "__main__":
    unittest.main()
