#!/usr/bin/env python3
"""Grades the answers to the four exercises of the course (README.md here): what was reached, what is asked, the points.

An exercise has a few figures. Each gives points, evenly from the worst value to the one that is asked; the goal is
reached when all are. Of trim they compare what the answer returns with the trims that were driven; those of the others
are in summary.json of runs in closed loop, driven here with the answer.
"""
import argparse
import contextlib
import csv
import importlib.util
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import textwrap
import traceback
from dataclasses import dataclass

try:
    import hlc
    import numpy as np
except ImportError as missing:
    if not {"-h", "--help", "--version"} & set(sys.argv):  # which need neither
        print(f"check.py: {missing}, must be installed or on PYTHONPATH (vehicle_sim/python/README.md)",
              file=sys.stderr)
        sys.exit(2)

FOLDER = pathlib.Path(__file__).resolve().parent
MOST_POINTS = 10  # of each exercise
STUCK = 6  # exit code of a run that was driven, with cars that were stuck at the end


class Invalid(Exception):
    """One line: file, place, value, and what is allowed."""


@dataclass(frozen=True)
class Figure:
    """points, evenly from the value `worst` (none) to `asked` (all)."""
    name: str
    unit: str
    reached: float
    worst: float
    asked: float
    points: int
    counts: bool = True
    """False: no points, because another figure is too bad for this one to mean anything."""

    @property
    def is_reached(self):
        return self.reached >= self.asked if self.asked > self.worst else self.reached <= self.asked

    @property
    def earned(self):
        """Whole points; not all of them before the goal is reached."""
        if not self.counts:
            return 0
        if self.is_reached:
            return self.points
        share = (self.reached - self.worst) / (self.asked - self.worst)
        return max(0, min(self.points - 1, math.floor(self.points * share))) if math.isfinite(share) else 0

    def line(self):
        at = "at least" if self.asked > self.worst else "at most"
        reached = f"  {self.name:37} reached {self.reached:7.4g} {self.unit:4} "
        note = "" if self.counts else ", as the car hardly drives"
        asked = f"{reached}asked {at} {self.asked:.4g} {self.unit}".ljust(88)
        return fitted(f"{asked}{self.earned} of {self.points} points{note}")


def fitted(line):
    """For a terminal, or for COLUMNS, it goes on in further lines where it is too long, without its columns."""
    if not sys.stdout.isatty() and not os.environ.get("COLUMNS"):
        return line
    columns = max(40, shutil.get_terminal_size().columns)
    if len(line) <= columns:
        return line
    indent = line[:len(line) - len(line.lstrip())]
    return textwrap.fill(" ".join(line.split()), columns, initial_indent=indent, subsequent_indent=indent + "    ",
                         break_long_words=False, break_on_hyphens=False)


def short(value):
    """Its begin, in one line."""
    return " ".join(repr(value).split())[:60]


def answer_in(file, name):
    """What the Python file calls `name`. Importing it must not fail."""
    if not file.is_file():
        raise Invalid(f"{file}: is no file, must be an answer in Python")
    spec = importlib.util.spec_from_file_location("answer", file)
    if spec is None:
        raise Invalid(f"{file}: must be a file in Python, with the ending .py")
    module = importlib.util.module_from_spec(spec)
    sys.modules["answer"] = module  # where dataclasses look for it
    called(file, lambda: spec.loader.exec_module(module))
    if not hasattr(module, name):
        raise Invalid(f"{file}: {name} is missing, must be in the answer")
    return getattr(module, name)


def called(file, function, *arguments):
    """What the answer's function returns. What it raises becomes one line, with the answer's line in it."""
    try:
        with contextlib.redirect_stdout(sys.stderr):  # the grade alone is printed
            return function(*arguments)
    except (Invalid, Failed):
        raise
    except hlc.Error as refused:
        raise Invalid(f"{file}: {refused}") from refused
    except SyntaxError as error:
        raise Invalid(f"{file}:{error.lineno}: {error.msg}, must be Python") from error
    except (Exception, SystemExit) as error:
        lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == str(file)]
        raised = " ".join(f"{type(error).__name__}: {error}".split())
        raise Invalid(f"{file}:{lines[-1] if lines else 1}: raised {raised}") from error


class Failed(Exception):
    """One line: what happened in a run, for which there are no points."""


def driven(scenario, folder, **choices):
    """The content of summary.json of a run in closed loop, which is written to the folder."""
    try:
        run = hlc.drive(scenario, out=folder, **choices)
    except hlc.Error as refused:
        if str(folder) in str(refused):  # a file that cannot be written is no fault of the answer
            raise Invalid(str(refused)) from refused
        raise
    if run.exit_code not in (0, STUCK):
        raise Failed(f"{folder.name}: {run.reason}")
    if run.summary["collisions"] > 0:
        raise Failed(f"{folder.name}: {run.summary['collisions']} collisions")
    return run.summary


def mean_over_cars(summaries, key, worst):
    """Of a figure with a mean for every car, over all cars of all runs. worst: of a car that has none."""
    means = [car[key]["mean"] for one in summaries for car in one["vehicles"]]
    return float(np.mean([worst if mean is None else mean for mean in means]))


def stuck(summaries):
    """Cars that had waited for others for 20 s or longer at the end."""
    return sum(len(one["stuck_vehicles"]) for one in summaries)


# 1: a trim from a drive

POSITION_NOISE_M, YAW_NOISE_RAD = 0.002, 0.010  # half widths, of the lab's cameras (vehicle_sim/plant/plant.hpp)
LEAST_PIECES = 8
WHEELBASE_M, REAR_AXLE_TO_CG_M = 0.150, 0.075  # of the automaton `lab`


def pieces_by_trim(drive, begins, trims, step_s):
    """Of each moving trim the pieces of the drive in which a step leads from it to itself, if there are enough.

    drive   (n, 4): t [s], x [m], y [m], yaw [rad]
    begins  (number of the step, which begins at this number times step_s; index of the trim there), in order
    """
    pieces = {}
    for (step, trim), (following, then) in zip(begins, begins[1:]):
        if following == step + 1 and then == trim and trims[trim][0] > 0.0:
            times = drive[:, 0] / step_s - step
            pieces.setdefault(trim, []).append(drive[(times > -1e-6) & (times < 1 + 1e-6)])
    return {trim: found for trim, found in pieces.items() if len(found) >= LEAST_PIECES}


def noisy(drive, seed):
    """As the lab's cameras measure it; the yaw without jumps."""
    most = np.array([0.0, POSITION_NOISE_M, POSITION_NOISE_M, YAW_NOISE_RAD])
    measured = drive + np.random.default_rng(seed).uniform(-most, most, drive.shape)
    measured[:, 3] = np.unwrap(measured[:, 3])
    return measured


def simulated_drive(seed):
    scenario = hlc.load_scenario("lab_red_alone", steps=300)
    run = hlc.drive(scenario, noise_seed=seed)
    drive = np.column_stack([run.trajectory_columns[key] for key in ("t_s", "x_m", "y_m", "yaw_rad")])
    begins = list(enumerate(int(trim) for trim in run.trims[:, 0]))
    return pieces_by_trim(noisy(drive, seed), begins, scenario.trims, scenario.step_s), scenario.trims


def rows_of(file):
    try:
        with file.open(encoding="utf-8", newline="") as text:
            return list(csv.DictReader(text))
    except OSError as error:
        raise Invalid(f"{file}: cannot be read ({error.strerror}), must be of a run folder") from error


def recorded_drive(folder):
    """That of vehicle 1 in a run folder."""
    found = sorted((folder / "configuration" / "scenarios").glob("*.yaml"))
    if len(found) != 1:
        raise Invalid(f"{folder}: must be a run folder, with one file in configuration/scenarios")
    scenario = hlc.load_scenario(found[0])
    if scenario.vehicle_size_m != hlc.load_scenario("lab_red_alone").vehicle_size_m:
        raise Invalid(f"{folder}: a vehicle of {scenario.vehicle_size_m} m, must be a drive of the lab's vehicle")
    try:
        drive = np.array([[1e-9 * float(row["t_ns"]), float(row["x_m"]), float(row["y_m"]), float(row["yaw_rad"])]
                          for row in rows_of(folder / "vehicle_1.csv")])
        begins = [(int(row["step"]), int(row["planned_trim"]) - 1) for row in rows_of(folder / "reports.csv")
                  if row["id"] == "1"]
    except (KeyError, TypeError, ValueError) as error:
        raise Invalid(f"{folder}: {error!r}, must be the rows of a recorded run") from error
    pieces = pieces_by_trim(noisy(drive, 1), begins, scenario.trims, scenario.step_s)
    if not pieces:
        raise Invalid(f"{folder}: no trim is driven for {LEAST_PIECES} steps, must be one; more --steps")
    return pieces, scenario.trims


def grade_trim(answer, given):
    identify = answer_in(answer, "identify")
    drives = [recorded_drive(given.run)] if given.run else [simulated_drive(seed) for seed in (1, 2, 3)]
    errors = []
    for pieces, trims in drives:
        for trim, found in sorted(pieces.items()):
            returned = called(answer, identify, [one.copy() for one in found], WHEELBASE_M, REAR_AXLE_TO_CG_M)
            errors.append(np.abs(numbers_in(answer, "identify returned", returned, 2) - trims[trim]))
    speed_mps, steering_rad = np.max(errors, axis=0)
    return [Figure("largest error of the speed", "m/s", speed_mps, 0.10, 0.02, 4),
            Figure("largest error of the steering", "rad", steering_rad, 0.30, 0.025, 6)]


def numbers_in(file, name, value, length):
    try:
        numbers = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        numbers = np.array([])
    if numbers.shape != (length,) or not np.isfinite(numbers).all():
        raise Invalid(f"{file}: {name} {short(value)}, must be {length} finite numbers")
    return numbers


# 2: a priority rule

WITHOUT_RIGHT_OF_WAY = {"right_of_way": False, "contouring_weight": 150}


def grade_priority(answer, given):
    """Six cars on the lab's roads, without right of way: what keeps them apart are their priorities alone."""
    rule = answer_in(answer, "rule")
    if not callable(rule):
        raise Invalid(f"{answer}: rule = {short(rule)}, must be a function")
    runs = []
    for seed in range(1, 7):
        crowd = hlc.load_scenario("lab_cars", cars=6, seed=seed, steps=200, values=WITHOUT_RIGHT_OF_WAY)
        folder = given.out / f"draw_{seed}"
        runs.append(called(answer, lambda crowd=crowd, folder=folder: driven(crowd, folder, priorities=rule)))
    return [Figure("cars that are stuck at the end", "", stuck(runs), 12, 0, 3),
            Figure("mean speed", "m/s", mean_over_cars(runs, "driven_speed_mps", 0.0), 0.60, 0.78, 2),
            Figure("mean cost of a plan", "m^2", mean_over_cars(runs, "plan_cost_m2", 10.0), 0.20, 0.10, 5)]


# 3: an automaton with fewer trims

def red_car_with(trims, answer, folder):
    """Alone, with these trims and the rest of the automaton `paper`, which is written to the folder."""
    text = (hlc.data_folder() / "automata" / "paper.yaml").read_text(encoding="utf-8")
    rows = "".join(f"  - {{speed_mps: {speed!r}, steering_rad: {steering!r}}}\n" for speed, steering in trims)
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / "trims.yaml"
    file.write_text(text[:text.index("trims:")] + "trims:\n" + rows + "step_s: 0.2\nintervals: 20\ncriteria: [J2]\n"
                    "subgraphs:\n  - {name: B, label: J2, trims: all}\n", encoding="utf-8")
    try:
        return hlc.load_scenario("paper_red_alone", values={"automaton": str(file.absolute())})
    except hlc.Error as refused:  # without the file that the answer has become here
        raise Invalid(f"{answer}: TRIMS: {str(refused).partition(': ')[2]}") from refused


def grade_automaton(answer, given):
    trims = answer_in(answer, "TRIMS")
    if not isinstance(trims, (list, tuple)):
        raise Invalid(f"{answer}: TRIMS = {short(trims)}, must be a list of (speed [m/s], steering [rad])")
    if not trims or numbers_in(answer, "TRIMS: entry 1 =", trims[0], 2)[0] != 0.0:
        raise Invalid(f"{answer}: TRIMS = {short(trims)}, must begin with standstill: speed 0")
    trims = [tuple(numbers_in(answer, f"TRIMS: entry {i} =", one, 2).tolist()) for i, one in enumerate(trims, 1)]
    papers = hlc.load_scenario("paper_red_alone")
    given_run = [driven(papers, given.out / "as_given")]
    own = [driven(red_car_with(trims, answer, given.out), given.out / "answer")]
    asked_mps, speed_mps = (mean_over_cars(runs, "driven_speed_mps", 0.0) for runs in (given_run, own))
    asked_mm, distance_mm = (mean_over_cars(runs, "driven_error_mm", 1000.0) for runs in (given_run, own))
    speed = Figure("mean speed", "m/s", speed_mps, 0.40, 0.99 * asked_mps, 1)
    drives = speed.reached > speed.worst  # who stands keeps to the lane with one trim
    return [Figure("trims", "", len(trims), len(papers.trims), 6, 6, drives),
            Figure("mean distance from the lane", "mm", distance_mm, 40.0, asked_mm, 3, drives), speed]


# 4: ten cars through a crossing

KEYS = ("contouring_weight", "coordination", "coupling", "held_up_contouring_weight", "horizon_steps", "priorities",
        "reference_rule", "right_of_way", "right_of_way_order", "rounds")
GIVEN_VALUES = {"right_of_way": False, "contouring_weight": 0, "held_up_contouring_weight": 0}


def grade_crossing(answer, given):
    values = answer_in(answer, "VALUES")
    if not isinstance(values, dict):
        raise Invalid(f"{answer}: VALUES = {short(values)}, must be a dict of scenario keys")
    for key in values:
        if key not in KEYS:
            raise Invalid(f"{answer}: VALUES: {key!r}, must be one of {', '.join(KEYS)}")
    runs = []
    for seed in (4, 5, 6):
        ten = called(answer, lambda seed=seed: hlc.load_scenario("lab_cars", cars=10, seed=seed, steps=600,
                                                                 values=GIVEN_VALUES | values))
        runs.append(called(answer, lambda ten=ten, seed=seed: driven(ten, given.out / f"draw_{seed}")))
    return [Figure("cars that are stuck at the end", "", stuck(runs), 20, 0, 4),
            Figure("mean speed", "m/s", mean_over_cars(runs, "driven_speed_mps", 0.0), 0.30, 0.70, 4),
            Figure("longest wait", "s", max(one["longest_wait_s"] for one in runs), 30, 8, 2)]


EXERCISES = {"trim": grade_trim, "priority": grade_priority, "automaton": grade_automaton, "crossing": grade_crossing}


class Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"{self.prog}: {message} (see --help)\n")


def arguments():
    parser = Parser(
        prog="check.py", allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Grades the answer to an exercise of the course: what was reached, what is asked, the points.",
        epilog="Examples:\n  check.py trim\n  check.py priority --answer my_rule.py --json\n"
               "Exit codes: 0 the goal is reached, 1 not yet, 2 invalid input")
    parser.add_argument("exercise", choices=EXERCISES, metavar="EXERCISE", help="one of " + ", ".join(EXERCISES))
    parser.add_argument("--answer", type=pathlib.Path, metavar="FILE",
                        help="the answer, in Python (default: the file EXERCISE.py beside this program)")
    parser.add_argument("--run", type=pathlib.Path, metavar="DIR",
                        help="of `trim`: the drive of vehicle 1 in this run folder (default: three simulated drives)")
    parser.add_argument("--out", type=pathlib.Path, metavar="DIR",
                        help="a new or empty folder for the runs: a folder each, with run.html and summary.json "
                             "(default: they are not kept; `trim` has none)")
    parser.add_argument("--json", action="store_true", help="print the figures as JSON")
    parser.add_argument("--version", action="store_true", help="print the version, and exit")
    if "--version" in sys.argv:
        sys.exit(subprocess.call([FOLDER.parent / "version.sh", "check.py"]))
    given = parser.parse_args()
    if given.run and given.exercise != "trim":
        parser.error(f"--run with {given.exercise}, must be with trim")
    if given.out and given.exercise == "trim":
        parser.error("--out with trim, must be with another exercise")
    return given


def graded(answer, given):
    if given.out:
        if given.out.exists() and not (given.out.is_dir() and not any(given.out.iterdir())):
            raise Invalid(f"--out = {given.out}, must be a new or empty folder")
        return EXERCISES[given.exercise](answer, given)
    with tempfile.TemporaryDirectory() as folder:
        given.out = pathlib.Path(folder)
        return EXERCISES[given.exercise](answer, given)


def main():
    given = arguments()
    answer = (given.answer or FOLDER / f"{given.exercise}.py").absolute()
    figures, failure = [], ""
    try:
        figures = graded(answer, given)
    except Failed as failed:
        failure = str(failed)
    except (Invalid, hlc.Error, OSError) as refused:
        print(f"check.py: {refused}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("check.py: interrupted; the same command begins from the start, --out needs a new or empty folder",
              file=sys.stderr)
        return 130
    is_reached = not failure and all(one.is_reached for one in figures)
    earned = sum(one.earned for one in figures)
    if given.json:
        print(json.dumps({"exercise": given.exercise, "points": earned, "of": MOST_POINTS, "is_reached": is_reached,
                          "failure": failure,
                          "figures": {one.name: [float(one.reached), float(one.asked)] for one in figures}}))
    else:
        lines = [fitted(f"  no points, because of {failure}")] if failure else [one.line() for one in figures]
        print(fitted(f"{given.exercise}: {answer}"), *lines, sep="\n")
        print(f"grade: {earned} of {MOST_POINTS} points, " + ("the goal is reached" if is_reached else "not yet"))
    return 0 if is_reached else 1


def exit_code():
    try:
        code = main()
        sys.stdout.flush()
        return code
    except BrokenPipeError:  # who reads needs no more
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 2
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        print(f"check.py: standard output: cannot be written ({error.strerror})", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(exit_code())
