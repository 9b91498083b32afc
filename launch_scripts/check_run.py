#!/usr/bin/env python3
"""Checks every step of a recorded run against its certificates, and these against what was driven.

It shares no code with the planner and knows no automaton, map or scenario: only areas, lines and poses. A_k(s) is the
area of a vehicle during step s under the plan that is in force as step k ends.

  record      its steps are in order, each once; every report but those on standby has a certificate;
  areas       every area is convex, counter-clockwise, larger than the footprint;
  standstill  the plan has as many areas as maneuvers, then a standstill, which lies in the last one;
  plan        A_k(k) holds A_(k-1)(k); a plan that was kept has the areas that it had, A_k(s) = A_(k-1)(s) for s >= k;
  line        every line touches the own area of its step, and what was known of the other vehicle is beyond it;
  pair        two vehicles share no point from step k+1 on, coupled ones by a line, if not both have kept their plan;
  obstacle    no area from step k+1 on and no driven footprint overlaps an obstacle that stands then (summary.json);
  driven      the driven footprint lies in the area of its step, beyond the others' lines (at most half a second late).
Counted, not rejected: pairs and poses of a vehicle to whose areas nobody has agreed (off its plan, not seen, or new).
"""
import argparse
import collections
import csv
import itertools
import json
import math
import pathlib
import re
import subprocess
import sys

from convex_areas import beyond, outside, overlap, size

TOUCH_M = 1e-6  # a line and the area that it touches; a corner and the lines of the edges
APART_M = 2e-5  # overlap of areas that are apart: a standstill may lie 2 um outside the last area of its plan
# How far the area of another vehicle may reach over the line. A missing one may be seen beside its standstill; and what
# it can reach begins where it is seen, which is behind its plan if its commands arrived late.
DEPTH_M = {"running": APART_M, "new": APART_M, "reachable": APART_M, "missing": 1e-2}
SAME_M, DRIVEN_M = 1e-7, 1e-4  # corners of an area in two records; a footprint outside its area
LATE_M, LATE_NS = 0.035, 500_000_000  # of a late car: those of the lab start so late; in real time commands are lost
BEFORE_STEPS = 3  # a vehicle that is off its plan is seen so at the latest so many steps later


class Unreadable(Exception):
    """One line: what cannot be read, and why."""


class Certificate:
    """Of the plan of a vehicle that is in force as step k ends."""
    def __init__(self, row):
        self.step, self.id = int(row["step"]), int(row["id"])
        self.length_m, self.width_m = number(row["length_m"]), number(row["width_m"])
        self.is_agreed = {"0": False, "1": True}[row["is_agreed"]]
        self.areas = [corners(text) for text in row["areas"].split(";") if text]
        self.standstill = corners(row["standstill"])  # from step `end` on; empty: none
        self.end = self.step + len(self.areas)
        self.separations = []  # (other, known, lines); a line is (n_x, n_y, offset)
        for text in filter(None, row["separations"].split(";")):
            other, known, lines = text.split(":")
            lines = [(math.cos(direction), math.sin(direction), offset) for direction, offset in corners(lines)]
            if known not in DEPTH_M:
                raise ValueError(f"{known}, must be one of {', '.join(DEPTH_M)}")
            self.separations.append((int(other), known, lines))

    def during(self, step):
        return self.areas[step - self.step] if step < self.end else self.standstill

    def footprint(self, x, y, yaw):
        c, s, a, b = math.cos(yaw), math.sin(yaw), self.length_m / 2, self.width_m / 2
        return [(x + c * u - s * v, y + s * u + c * v) for u in (a, -a) for v in (b, -b)]


def number(text):
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"{text}, must be a finite number")
    return value


def mm(length_m):
    return f"{1e3 * length_m:.6g} mm"


def corners(text):
    values = [number(one) for one in text.split(" ")] if text else []
    return list(zip(values[::2], values[1::2], strict=True))


def rows_of(file, make):
    made, reader = [], None
    try:
        text = file.read_text(encoding="utf-8")
        reader = csv.DictReader(text[:text.rfind("\n") + 1].splitlines(keepends=True), strict=True)  # whole lines
        for row in reader:
            if None in row or None in row.values():
                raise ValueError("another number of columns than the heading")
            made.append(make(row))
    except (OSError, ValueError, KeyError, csv.Error) as error:
        raise Unreadable(f"{file}:{reader.line_num if reader else 0}: {type(error).__name__}: {error}") from error
    return made


def report(row):
    if (status := row["status"]) not in ("standby", "planned", "fallback", "minimal_risk_stop"):
        raise ValueError(f"status = {status}, must be standby, planned, fallback or minimal_risk_stop")
    named = re.findall(r"(?:[^;\\]|\\.)+", row["plan"])  # TRIM:LABEL;TRIM:LABEL, \; and \\ within labels
    return {"key": (int(row["step"]), int(row["id"])), "status": status, "maneuvers": len(named),
            "pose": [number(row[f"planned_{name}"]) for name in ("x_m", "y_m", "heading_rad")],
            "is_new": status == "planned", "coupled": {int(one) for one in row["coupled"].split(";") if one}}


def pose(row):
    return (int(row["t_ns"]), *(number(row[name]) for name in ("x_m", "y_m", "yaw_rad")), int(row["command_create_ns"]))


class Check:
    def __init__(self, run):
        self.violations, self.counts = [], collections.Counter()
        try:
            facts = json.loads((run / "run.json").read_text(encoding="utf-8"))
            self.period, vehicles = int(facts["period_ns"]), [int(one) for one in facts["vehicle_ids"]]
            self.out_since, self.late_m = {}, LATE_M if facts["simulated_time"] else math.inf
            if self.period <= 0:
                raise ValueError(f"period_ns = {self.period}, must be > 0")
            self.obstacles = self.standing(run / "summary.json", int(facts["first_step"] or 0))
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise Unreadable(f"{run / 'run.json'}: {type(error).__name__}: {error}") from error
        files = [(vehicle, run / f"vehicle_{vehicle}.csv") for vehicle in vehicles]
        self.drives = [(one, *sample) for one, file in files if file.exists() for sample in rows_of(file, pose)]
        # Of a report that arrived twice the last one counts, as in the summary.
        self.reports = {one["key"]: one for one in rows_of(run / "reports.csv", report)}
        self.late = {key: math.dist(at[:2], self.reports[key]["pose"][:2])  # from the planned pose, as the step begins
                     for one, time, *at in reversed(self.drives) if (key := (time // self.period, one)) in self.reports}
        self.certificates, last, self.against, self.kept = {}, {}, collections.defaultdict(list), set()
        for one in rows_of(run / "certificates.csv", Certificate):
            if one.step <= last.get(one.id, -1):
                self.reject("record", one.step, one.id, f"stands after step {last[one.id]}", "in order, each step once")
            last[one.id] = max(last.get(one.id, -1), one.step)
            self.certificates[one.step, one.id] = one
        self.horizon = max((len(ls) for one in self.certificates.values() for _, _, ls in one.separations), default=0)

    def standing(self, file, first_step):  # (from step, name, area) of each obstacle
        if not file.exists():
            return self.counts.update(["runs without summary.json, obstacles unknown"]) or []
        try:
            listed = json.loads(file.read_text(encoding="utf-8"))["obstacles"]
            found = [(first_step + int(one["from_step"]), one["name"],
                      [tuple(map(float, corner)) for corner in one["corners_m"]]) for one in listed]
            if any(not math.isfinite(size(area)) or size(area) <= 0 for _, _, area in found):
                raise ValueError("obstacles: corners_m, must be convex and counter-clockwise")
            return found
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise Unreadable(f"{file}: {type(error).__name__}: {error}") from error

    def clear(self, step, vehicle, area, what, *file):
        for since, name, obstacle in self.obstacles:
            if step >= since and (depth := overlap(area, obstacle)) > APART_M:
                text = f"{what} overlaps {name or 'an obstacle'} by {mm(depth)}"
                self.reject("obstacle", step, vehicle, text, f"<= {mm(APART_M)}", *file)

    def reject(self, check, step, vehicle, what, allowed, file="certificates.csv"):
        self.violations.append(f"{file}: vehicle {vehicle}, step {step}: {check}: {what}, must be {allowed}")

    def check(self):
        for key in sorted(self.certificates.keys() | self.reports.keys()):
            status = self.reports[key]["status"] if key in self.reports else "not reported"
            if (key in self.certificates) == (status in ("standby", "not reported")):
                self.reject("record", *key, f"{status}, certificate: {key in self.certificates}", "one if it plans")
        sound = [key for key in sorted(self.certificates) if key in self.reports and self.areas(self.certificates[key])]
        self.certificates = {key: self.certificates[key] for key in sound}
        self.counts["steps of a vehicle"] = len(sound)
        for one in self.certificates.values():
            self.plan(one)
            for step in range(one.step + 1, max(one.end, one.step + 1) + 1) if one.is_agreed else ():
                self.clear(one.step, one.id, one.during(step), f"the area during step {step}")
            for separation in one.separations:
                self.lines(one, *separation)
        for _, ones in itertools.groupby(self.certificates.values(), lambda one: one.step):
            for a, b in itertools.combinations(ones, 2):
                self.pair(a, b)
        for sample in self.drives:
            self.pose(*sample)

    def areas(self, one):
        if not one.standstill:
            return self.reject("standstill", one.step, one.id, "none", "an area")
        before, least = len(self.violations), one.length_m * one.width_m
        for step, area in enumerate(one.areas + [one.standstill], one.step):
            if len(area) < 3 or size(area) < least:
                self.reject("areas", one.step, one.id, f"{size(area):.6f} m2 during step {step}", f">= {least:.6f} m2")
            elif (out := outside(area, area)) > TOUCH_M:
                self.reject("areas", one.step, one.id, f"{mm(out)} from convex during step {step}", "convex")
        is_sound, named = len(self.violations) == before, self.reports[one.step, one.id]["maneuvers"]
        if is_sound and one.is_agreed and len(one.areas) != named and (one.areas or named != 1):
            self.reject("standstill", one.step, one.id, f"{len(one.areas)} areas before it", f"{named}, as maneuvers")
        elif is_sound and one.is_agreed and one.areas and (out := outside(one.areas[-1], one.standstill)) > APART_M:
            self.reject("standstill", one.step, one.id, f"{mm(out)} outside the last area", f"<= {mm(APART_M)}")
        return is_sound

    def plan(self, one):
        planned = one.footprint(*self.reports[one.step, one.id]["pose"])
        if (out := outside(one.during(one.step), planned)) > DRIVEN_M and one.is_agreed:
            self.reject("plan", one.step, one.id, f"planned pose {mm(out)} outside its area", f"<= {mm(DRIVEN_M)}")
        before = self.certificates.get((one.step - 1, one.id))
        if before is None or not (before.is_agreed and one.is_agreed):
            return self.counts.update(["plans that continue none that was agreed"])
        is_new = self.reports[one.step, one.id]["is_new"]
        self.kept |= set() if is_new else {(one.step, one.id)}
        for step in range(one.step, one.step + 1 if is_new else max(before.end, one.end) + 1):  # to the standstills
            now, then = one.during(step), before.during(step)
            if (out := max(outside(now, then), 0 if is_new else outside(then, now))) > SAME_M:
                self.reject("plan", one.step, one.id, f"the area during step {step} is not that of the step before, by "
                            f"{mm(out)}", f"<= {mm(SAME_M)}")

    def lines(self, one, other, known, lines):
        if len(lines) != self.horizon:
            self.reject("line", one.step, one.id, f"{len(lines)} lines to vehicle {other}", f"{self.horizon}")
        its = self.certificates.get((one.step, other))
        is_known = its is not None and (its.is_agreed if known in ("reachable", "missing") else
                                        (known == "new") == self.reports[its.step, its.id]["is_new"])
        depth = DEPTH_M[known] + (self.late.get((one.step, other), 0) if known == "missing" else 0)
        if is_known or known in ("reachable", "missing"):
            self.against[one.step + 1, other] += lines[:1]
        for step, line in enumerate(lines, one.step + 1):
            if abs(gap := beyond(one.during(step), line)[1]) > TOUCH_M:
                self.reject("line", one.step, one.id, f"the area during step {step} ends {mm(gap)} beyond the line to "
                            f"vehicle {other} ({known})", f"0, up to {mm(TOUCH_M)}")
            if is_known and (gap := -beyond(its.during(step), line)[0]) > depth:
                what = f"vehicle {other} ({known}) is {mm(gap)} on this side of it during step {step}"
                self.reject("line", one.step, one.id, what, f"<= {mm(depth)}")

    def pair(self, a, b):
        if {(a.step, a.id), (b.step, b.id)} <= self.kept:  # also if they were not coupled then, and now are
            return self.counts.update(["pairs of kept plans, apart since the step before"])
        both = ((a, b), (b, a))
        lines = [(DEPTH_M[known], one, its, found) for one, its in both for other, known, found in one.separations
                 if other == its.id]
        is_coupled = any(its.id in self.reports[one.step, one.id]["coupled"] for one, its in both)
        for index, step in enumerate(range(a.step + 1, max(a.end, b.end, a.step + 1) + 1)):
            is_proven = any(
                beyond(one.during(step), line)[1] <= APART_M and -beyond(its.during(step), line)[0] <= most
                for most, one, its, found in lines for line in found[:index + 1][-1:])  # after the horizon its last one
            depth = None if is_proven else overlap(a.during(step), b.during(step))
            if is_proven or (depth <= APART_M and not (is_coupled and index < self.horizon)):
                self.counts["pairs apart by a line" if is_proven else "pairs apart, not coupled or standing"] += 1
            elif not (a.is_agreed and b.is_agreed):
                self.counts["pairs not proven, nobody has agreed"] += 1
            else:
                self.reject("pair", a.step, a.id, f"no line between it and vehicle {b.id} during step {step}, overlap "
                            f"{mm(depth)}", f"<= {mm(APART_M)}, by a line if coupled")

    def pose(self, vehicle, time, x, y, yaw, create):
        step = time // self.period
        keys = [(k, vehicle) for k in (create // self.period, step - 1, step) if k <= step]
        if not (plans := [self.certificates[key] for key in keys if key in self.certificates]):
            return self.counts.update(["driven poses without a plan"])
        driven = plans[0].footprint(x, y, yaw)
        self.clear(step, vehicle, driven, f"the footprint at {time / 1e9:.2f} s", f"vehicle_{vehicle}.csv")
        out = min(outside(one.during(step), driven) for one in plans)
        out = max([out] + [-beyond(driven, line)[0] for line in self.against[step, vehicle]])
        near = [self.certificates.get((k, vehicle)) for k in range(step - 1, step + BEFORE_STEPS + 1)]
        first, last = self.out_since.get(vehicle, (time, time))
        first = first if out > DRIVEN_M and time - last < LATE_NS / 5 else time
        self.out_since[vehicle] = first, time
        if out <= DRIVEN_M:
            self.counts["driven poses in their areas"] += 1
        elif out <= self.late_m and time - first < LATE_NS:
            self.counts["driven poses of a late car"] += 1
        elif any(one is not None and not one.is_agreed for one in near):
            self.counts["driven poses not proven, nobody has agreed"] += 1
        else:
            what = f"{mm(out)} outside its area or on the other side of a line at {time / 1e9:.2f} s"
            self.reject("driven", step, vehicle, what, f"<= {mm(DRIVEN_M)}", f"vehicle_{vehicle}.csv")


class Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"{self.prog}: {message} (see --help)\n")


def main():
    parser = Parser(
        prog="check_run.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
        epilog="Examples:\n  check_run.py runs/my_run\n  check_run.py runs/my_run runs/other_run\n"
               "Exit codes: 0 accepted, 1 rejected, 2 invalid flags or files.")
    parser.add_argument("runs", metavar="RUN", nargs="+", type=pathlib.Path, help="run folder")
    parser.add_argument("--version", action="store_true", help="print the version, and exit")
    if "--version" in sys.argv:
        return subprocess.call([pathlib.Path(__file__).resolve().parent / "version.sh", "check_run.py"])
    code = 0
    for run in parser.parse_args().runs:
        try:
            (check := Check(run)).check()
            print(*(f"{run}/{line}\n" for line in check.violations), sep="", end="")
            counts = ", ".join(f"{count} {what}" for what, count in sorted(check.counts.items()))
            print(f"{run}: {'rejected' if check.violations else 'accepted'}; {counts}")
            code = max(code, 1 if check.violations else 0)
        except Unreadable as error:
            print(f"check_run.py: {error}", file=sys.stderr)
            code = 2
    return code


if __name__ == "__main__":
    sys.exit(main())
