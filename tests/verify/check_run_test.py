#!/usr/bin/env python3
"""launch_scripts/check_run.py accepts recorded runs and rejects every manipulation of one.

Drives every shipped scenario in one process (evaluate --keep_runs) and a few runs with faults (fault_simulator --out).
Of the record of paper_three_cars every seed manipulates one row: an area is moved by 3 mm into a neighbour, a
standstill removed, two steps of a vehicle swapped; of one of obstacle_field an obstacle is put in a car's way.
HLC_TEST_LONG tries 1000 seeds instead of 60 and drives whole scenarios.
"""
import argparse
import collections
import csv
import importlib.util
import json
import math
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "launch_scripts" / "check_run.py"
SCENARIOS = ROOT / "launch_scripts" / "scenarios"
PERIOD_NS = 200_000_000
FIRST_SEED = 1
STEPS = "40"
SCENARIO_STEPS = "10"  # of the others
FLAGS = {"lab_cars": ["--cars", "20"], "town": ["--cars", "20"], "reconfiguration": ["--policies", "zone,mixed"]}
# Runs that were rejected for what the system does not promise; see only_what_is_stated.
BESIDE_STANDSTILL = "20314"  # vehicle 3 is missing, and seen beside where its plan was to end
LATE_COMMAND = "20534"  # vehicle 6 is missing in step 5021, behind its plan, and catches up
COUPLED_LATE = "30128"  # vehicles 1 and 4 are coupled while both keep plans that are older than that
MOVE_M = 0.003


def load_checker():
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(SCRIPT.parent))
    spec = importlib.util.spec_from_file_location("check_run", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def read(file):
    with open(file, encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def write(file, rows):
    with open(file, "w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def reach(area, direction, of):
    """The least or the largest coordinate of an area along a direction; `of` is min or max."""
    numbers = [float(one) for one in area.split(" ")]
    n = (math.cos(direction), math.sin(direction))
    return of(n[0] * x + n[1] * y for x, y in zip(numbers[::2], numbers[1::2]))


def moved(area, direction, distance=MOVE_M):
    numbers = [float(one) for one in area.split(" ")]
    step = (distance * math.cos(direction), distance * math.sin(direction))
    return " ".join(repr(value + step[i % 2]) for i, value in enumerate(numbers))


def move_area(rows, pick):
    """An area of a later step, by 3 mm along the normal of the line to a neighbour."""
    row = pick.choice([one for one in rows if one["separations"] and one["areas"]])
    areas = row["areas"].split(";")
    other, _, lines = pick.choice(row["separations"].split(";")).split(":")
    index = pick.randrange(1, len(areas)) if len(areas) > 1 else 0
    direction = float(lines.split(" ")[2 * max(0, index - 1)])
    areas[index] = moved(areas[index], direction)
    row["areas"] = ";".join(areas)
    return f"vehicle {row['id']}, step {row['step']}: area {index} moved towards vehicle {other}"


def push_through(rows, pick):
    """An area with all its lines, until it is 3 mm over the line that a neighbour has drawn."""
    row = pick.choice([one for one in rows if ":new:" in one["separations"] and one["areas"].count(";") > 1])
    areas = row["areas"].split(";")
    index = pick.randrange(1, len(areas))
    separations = [one.split(":") for one in row["separations"].split(";")]
    other, _, lines = pick.choice([one for one in separations if one[1] == "new"])
    direction, offset = (float(one) for one in lines.split(" ")[2 * (index - 1):2 * index])
    its = next(one for one in rows if one["id"] == other and one["step"] == row["step"])
    its_areas = [*its["areas"].split(";"), its["standstill"]] if its["areas"] else [its["standstill"]]
    distance = reach(its_areas[min(index, len(its_areas) - 1)], direction, min) - offset + MOVE_M
    areas[index] = moved(areas[index], direction, distance)
    for separation in separations:
        numbers = separation[2].split(" ")
        numbers[2 * index - 1] = repr(reach(areas[index], float(numbers[2 * index - 2]), max))
        separation[2] = " ".join(numbers)
    row["areas"], row["separations"] = ";".join(areas), ";".join(":".join(one) for one in separations)
    return f"vehicle {row['id']}, step {row['step']}: area {index} moved by {distance:.3f} m into vehicle {other}"


def remove_standstill(rows, pick):
    """Without a trace, or so that the plan ends in its last area."""
    row = pick.choice([one for one in rows if one["areas"]])
    areas = row["areas"].split(";")
    row["standstill"] = ""
    if pick.random() < 0.5:
        row["standstill"] = areas.pop()
        row["areas"] = ";".join(areas)
    return f"vehicle {row['id']}, step {row['step']}: no standstill after {len(areas)} areas"


def swap_steps(rows, pick):
    """Of one vehicle: two rows, or what they contain."""
    while True:
        a, b = pick.sample(rows, 2)
        if a["id"] == b["id"] and a["areas"] != b["areas"]:
            break
    what = f"vehicle {a['id']}: steps {a['step']} and {b['step']} swapped"
    if pick.random() < 0.5:
        i, j = rows.index(a), rows.index(b)
        rows[i], rows[j] = b, a
        return what + " in the file"
    a["step"], b["step"] = b["step"], a["step"]
    rows.sort(key=lambda row: (int(row["step"]), int(row["id"])))
    return what


def add_certificate(rows, pick):
    """A step twice."""
    row = dict(pick.choice(rows))
    rows.insert(pick.randrange(len(rows)), row)
    return f"vehicle {row['id']}, step {row['step']}: twice"


def leave_out(rows, pick):
    row = rows.pop(pick.randrange(len(rows)))
    return f"vehicle {row['id']}, step {row['step']}: left out"


def turn_line(rows, pick):
    """A line that no longer separates, or does not touch."""
    row = pick.choice([one for one in rows if one["separations"]])
    separations = row["separations"].split(";")
    index = pick.randrange(len(separations))
    other, known, lines = separations[index].split(":")
    numbers = lines.split(" ")
    at = 2 * pick.randrange(len(numbers) // 2)
    numbers[at] = repr(float(numbers[at]) + pick.choice((-1, 1)) * pick.uniform(0.05, 3.0))
    separations[index] = f"{other}:{known}:{' '.join(numbers)}"
    row["separations"] = ";".join(separations)
    return f"vehicle {row['id']}, step {row['step']}: line {at // 2} to vehicle {other} turned"


MANIPULATIONS = (move_area, remove_standstill, swap_steps)
FURTHER = (add_certificate, leave_out, turn_line, push_through)


class Test:
    def __init__(self, binaries, work):
        self.binaries, self.work, self.failures = binaries, work, []
        self.checker = load_checker()

    def expect(self, is_good, what):
        if not is_good:
            self.failures.append(what)
            print(f"FAILED: {what}")

    def drive(self, program, *flags):
        command = [self.binaries / program, "--scenario_folder", SCENARIOS, *flags]
        subprocess.run(command, cwd=self.work, check=True, stdout=subprocess.DEVNULL)

    def drive_scenarios(self, steps):
        """Every shipped one; returns the folders of the runs."""
        names = sorted(file.stem for file in SCENARIOS.glob("*.yaml"))
        plain = ",".join(name for name in names if name not in FLAGS)
        for out, name, *flags in (["plain", plain], *([name, name, *FLAGS[name]] for name in FLAGS)):
            self.drive("evaluate", "--scenario", name, *flags, *steps, "--keep_runs", "--out", out)
        return sorted(run for out in ("plain", *FLAGS) for run in (self.work / out / "runs").iterdir())

    def drive_with_faults(self):
        self.drive("fault_simulator", "--runs", "1", "--seed", "1", "--out", "faults")
        self.drive("fault_simulator", "--two_rounds", "--runs", "1", "--seed", "4", "--out", "faults")
        for seed in (BESIDE_STANDSTILL, LATE_COMMAND, COUPLED_LATE):
            self.drive("fault_simulator", "--replay", seed, "--out", "faults")
        return sorted((self.work / "faults").iterdir())

    def program(self, code, *arguments, prints=""):
        command = [sys.executable, SCRIPT, *map(str, arguments)]
        ended = subprocess.run(command, capture_output=True, text=True, check=False)
        is_good = ended.returncode == code and prints in ended.stdout + ended.stderr
        what = f"{command[1:]}: code {ended.returncode}, must be {code} with '{prints}'"
        self.expect(is_good, f"{what}\n{ended.stdout[:2000]}")

    def is_rejected(self, run):
        """Ends at the first violation."""
        class Rejected(Exception):
            pass

        class Check(self.checker.Check):
            def reject(self, *_, **__):
                raise Rejected

        try:
            Check(run).check()
        except Rejected:
            return True
        return False

    def manipulate(self, run, seeds, manipulations):
        copy = self.work / "copy"
        shutil.copytree(run, copy)
        rejected = collections.Counter()
        for seed in range(FIRST_SEED, FIRST_SEED + seeds):
            pick = random.Random(seed)
            rows = read(run / "certificates.csv")
            manipulation = manipulations[seed % len(manipulations)]
            what = manipulation(rows, pick)
            write(copy / "certificates.csv", rows)
            is_rejected = self.is_rejected(copy)
            rejected[manipulation.__name__] += is_rejected
            self.expect(is_rejected, f"seed {seed}: {what}: accepted, must be rejected")
        shutil.rmtree(copy)
        last = FIRST_SEED + seeds - 1
        print(f"seeds {FIRST_SEED} to {last}: {sum(rejected.values())} of {seeds} rejected, {dict(rejected)}")

    def driven_elsewhere(self, run):
        copy = self.work / "copy"
        shutil.copytree(run, copy)
        rows = read(copy / "vehicle_1.csv")
        rows[-50]["y_m"] = repr(float(rows[-50]["y_m"]) + 0.05)
        write(copy / "vehicle_1.csv", rows)
        self.program(1, copy, prints="vehicle_1.csv: vehicle 1, step")
        shutil.rmtree(copy)

    def only_what_is_stated(self, faults):
        """Without the reason for which a missing vehicle is allowed to be beyond a line, these runs are rejected."""
        run, file = faults / BESIDE_STANDSTILL, "certificates.csv"
        rows = read(run / file)
        for row in rows:
            separations = [one for one in row["separations"].split(";") if not one.startswith("3:missing:")]
            row["separations"] = ";".join(separations if row["id"] == "6" else row["separations"].split(";"))
        write(run / file, rows)
        self.program(1, run, prints="no line between it and vehicle 6 during step")
        run, file = faults / LATE_COMMAND, "vehicle_6.csv"
        planned = next(row for row in read(run / "reports.csv") if (row["step"], row["id"]) == ("5021", "6"))
        rows = read(run / file)
        at = next(row for row in rows if int(row["t_ns"]) >= 5021 * PERIOD_NS)
        at.update({name: planned[f"planned_{name}"] for name in ("x_m", "y_m")})
        write(run / file, rows)
        self.program(1, run, prints="vehicle 6 (missing) is")

    def obstacles(self):
        """A run among obstacles is accepted, and not if one stands where a car is, or drives later."""
        self.drive("evaluate", "--scenario", "obstacle_field", "--steps", STEPS, "--keep_runs", "--out", "obstacles")
        run = self.work / "obstacles" / "runs" / "0"
        self.program(0, run, prints="runs without summary.json, obstacles unknown")
        subprocess.run([self.binaries / "summarize", "--run", run], check=True, stdout=subprocess.DEVNULL)
        self.program(0, run, prints="accepted")
        summary = json.loads((run / "summary.json").read_text(encoding="utf-8"))
        certificate = next(one for one in read(run / "certificates.csv") if one["areas"].count(";") > 4)
        numbers = [float(one) for one in certificate["areas"].split(";")[-1].split(" ")]
        summary["obstacles"][0]["corners_m"] = list(zip(numbers[::2], numbers[1::2]))
        self.put_summary(run, summary)
        self.program(1, run, prints=f"vehicle {certificate['id']}, step {certificate['step']}: obstacle: the area")
        self.program(1, run, prints=f"csv: vehicle {certificate['id']}, step")
        summary["obstacles"][0]["from_step"] = int(STEPS)
        self.put_summary(run, summary)
        self.program(0, run, prints="accepted")  # it is put there when all have passed
        summary["obstacles"][0]["corners_m"].reverse()
        self.put_summary(run, summary)
        self.program(2, run, prints="counter-clockwise")

    def put_summary(self, run, summary):
        (run / "summary.json").write_text(json.dumps(summary), encoding="utf-8")

    def files(self, run):
        copy = self.work / "copy"
        shutil.copytree(run, copy)
        text = (copy / "certificates.csv").read_text(encoding="utf-8")
        (copy / "certificates.csv").write_text(text.replace("running", "walking", 1), encoding="utf-8")
        self.program(2, copy, prints="certificates.csv:")
        (copy / "certificates.csv").write_text(text + "1,1,0.22", encoding="utf-8")
        self.program(0, copy, prints="accepted")
        (copy / "certificates.csv").unlink()
        self.program(2, copy, prints="certificates.csv")
        self.program(2, self.work / "nowhere", prints="run.json")
        self.program(2, "--fast", run, prints="--fast")
        self.program(0, "--help", prints="Exit codes")
        shutil.rmtree(copy)


def main():
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build" / "release" / "bin", help="the programs")
    binaries = parser.parse_args().bin.resolve()
    is_long = "HLC_TEST_LONG" in os.environ
    with tempfile.TemporaryDirectory() as work:
        test = Test(binaries, pathlib.Path(work))
        test.drive("evaluate", "--scenario", "paper_three_cars", "--steps", STEPS, "--keep_runs", "--out", "campaign")
        run = test.work / "campaign" / "runs" / "0"
        scenarios = test.drive_scenarios([] if is_long else ["--steps", SCENARIO_STEPS])
        test.program(0, run, *scenarios, *test.drive_with_faults(), prints="accepted")
        test.only_what_is_stated(test.work / "faults")
        test.driven_elsewhere(run)
        test.files(run)
        test.obstacles()
        test.manipulate(run, 1000 if is_long else 60, MANIPULATIONS)
        test.manipulate(run, 100 if is_long else 12, FURTHER)
    print(f"{len(test.failures)} failed")
    return 1 if test.failures else 0


if __name__ == "__main__":
    sys.exit(main())
