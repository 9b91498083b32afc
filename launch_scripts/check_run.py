#!/usr/bin/env python3
"""Checks every step of a recorded run against its certificates, and these against what was driven.

It shares no code with the planner and knows no automaton, map or scenario: only areas, lines and poses. With A_k(s) the
area of a vehicle during step s under the plan that is in force as step k ends, it holds for every vehicle that

  record      its steps are in order, each once; each step that it planned or kept a plan has a certificate, and no other;
  areas       every area is convex, counter-clockwise, larger than its footprint;
  standstill  the plan has as many areas as maneuvers and ends in a standstill, which lies in the last of them;
  plan        A_k(k) holds A_(k-1)(k); a plan that was kept has the areas that it had, A_k(s) = A_(k-1)(s) for s >= k;
  line        every line touches the own area of its step from outside, and what was known of the other is beyond it;
  pair        two coupled vehicles are on different sides of a line in each step from k+1 on; two others share no point;
  driven      the driven footprint lies in the area of its step, of the plan whose command the vehicle follows.

Not proven, but counted: pairs and poses of a vehicle to whose areas nobody has agreed (it was off its plan or not seen,
or its controller has just begun).
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys

TOUCH_M = 1e-6  # a line and the area that it touches; the record has nine decimals
APART_M = 2e-5  # overlap of areas that are apart: a standstill may lie 2 um outside the last area of its plan
SAME_M = 1e-7  # corners of an area in two records
DRIVEN_M = 1e-4  # a driven footprint outside its area
BEFORE_STEPS = 3  # a vehicle that is off its plan is seen so at the latest so many steps later
KNOWN = ("running", "new", "reachable", "missing")
STATUSES = ("standby", "planned", "fallback", "minimal_risk_stop")


class Unreadable(Exception):
    """One line: file, line, what must hold."""


class Certificate:
    """Of the plan of a vehicle that is in force as step k ends."""

    def __init__(self, row):
        self.step, self.id = int(row["step"]), int(row["id"])
        self.length_m, self.width_m = number(row["length_m"]), number(row["width_m"])
        self.is_agreed = {"0": False, "1": True}[row["is_agreed"]]
        self.areas = [corners(text) for text in row["areas"].split(";")] if row["areas"] else []
        self.standstill = corners(row["standstill"]) if row["standstill"] else None
        self.separations = []  # (other, known, lines); a line is (n_x, n_y, offset)
        for text in row["separations"].split(";") if row["separations"] else []:
            other, known, lines = text.split(":")
            if known not in KNOWN:
                raise ValueError(f"{known}, must be one of {', '.join(KNOWN)}")
            self.separations.append((int(other), known, [
                (math.cos(direction), math.sin(direction), offset) for direction, offset in corners(lines)]))

    def during(self, step):
        """The area of a step >= k; None: there is none."""
        return self.areas[step - self.step] if step - self.step < len(self.areas) else self.standstill

    @property
    def end(self):
        """The first step in which it stands."""
        return self.step + len(self.areas)


def number(text):
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"{text}, must be a finite number")
    return value


def corners(text):
    values = [number(one) for one in text.split(" ")] if text else []
    if len(values) % 2:
        raise ValueError(f"{len(values)} numbers, must be pairs")
    return list(zip(values[::2], values[1::2]))


def rows_of(file, make):
    """make(row) of every row; an incomplete last line is left out, as the writer may have been killed."""
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise Unreadable(f"{file}: cannot be read: {error}") from error
    reader = csv.DictReader(text[:text.rfind("\n") + 1].splitlines(keepends=True), strict=True)
    made = []
    try:
        for row in reader:
            if None in row or None in row.values():
                raise ValueError("another number of columns than the heading")
            made.append(make(row))
    except (ValueError, KeyError, csv.Error) as error:
        raise Unreadable(f"{file}:{reader.line_num}: {type(error).__name__}: {error}") from error
    return made


def farthest(area, line):
    return max(line[0] * x + line[1] * y for x, y in area)


def nearest(area, line):
    return min(line[0] * x + line[1] * y for x, y in area)


def edges(area):
    """(n_x, n_y, offset) of every edge, n pointing outwards."""
    found = []
    for (ax, ay), (bx, by) in zip(area, area[1:] + area[:1]):
        length = math.hypot(bx - ax, by - ay)
        if length > 0:
            n = ((by - ay) / length, (ax - bx) / length)
            found.append((*n, n[0] * ax + n[1] * ay))
    return found


def overlap(a, b):
    """How far one must move to be apart, over the normals of all edges [m]; < 0: they are apart."""
    return min(min(offset - nearest(other, (nx, ny)) for nx, ny, offset in edges(one)) for one, other in ((a, b), (b, a)))


def outside(outer, inner):
    """How far `inner` reaches out of the convex `outer` [m]."""
    return max(farthest(inner, line) - line[2] for line in edges(outer))


def size(area):
    """[m^2], > 0 counter-clockwise."""
    return sum(ax * by - bx * ay for (ax, ay), (bx, by) in zip(area, area[1:] + area[:1])) / 2


def footprint(x, y, yaw, length, width):
    c, s = math.cos(yaw), math.sin(yaw)
    return [(x + c * u - s * v, y + s * u + c * v)
            for u, v in ((length / 2, width / 2), (-length / 2, width / 2), (-length / 2, -width / 2), (length / 2, -width / 2))]


class Check:
    def __init__(self, run):
        self.run, self.violations, self.counts = run, [], {}
        try:
            facts = json.loads((run / "run.json").read_text(encoding="utf-8"))
            self.period, vehicles = int(facts["period_ns"]), [int(one) for one in facts["vehicle_ids"]]
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise Unreadable(f"{run / 'run.json'}: {type(error).__name__}: {error}") from error
        if self.period <= 0:
            raise Unreadable(f"{run / 'run.json'}: period_ns = {self.period}, must be > 0")
        self.certificates, self.reports, self.last_step = {}, {}, {}
        rows = rows_of(run / "certificates.csv", Certificate)
        reports = rows_of(run / "reports.csv", lambda row: {
            "key": (int(row["step"]), int(row["id"])), "is_new": row["status"] == "planned",
            "status": STATUSES[STATUSES.index(row["status"])], "maneuvers": maneuvers(row["plan"]),
            "coupled": {int(one) for one in row["coupled"].split(";") if one}})
        self.drives = {vehicle: rows_of(run / f"vehicle_{vehicle}.csv", driven) for vehicle in vehicles
                       if (run / f"vehicle_{vehicle}.csv").exists()}
        for report in reports:
            if report["key"] in self.reports:
                self.reject("reports.csv", *report["key"][::-1], "record", "this step twice", "once")
            self.reports[report["key"]] = report
        for one in rows:
            self.take(one)

    def reject(self, file, vehicle, step, check, what, allowed):
        self.violations.append(f"{file}: vehicle {vehicle}, step {step}: {check}: {what}, must be {allowed}")

    def count(self, what, by=1):
        self.counts[what] = self.counts.get(what, 0) + by

    def take(self, one):
        key, last = (one.step, one.id), self.last_step.get(one.id, -1)
        if one.step <= last:
            self.reject("certificates.csv", one.id, one.step, "record", f"after step {last}", "before it, and once")
        self.last_step[one.id] = max(last, one.step)
        self.certificates[key] = one

    def check(self):
        for key, report in self.reports.items():
            if (report["status"] != "standby") != (key in self.certificates):
                self.reject("certificates.csv", key[1], key[0], "record", f"a report {report['status']}, certificate: "
                            f"{key in self.certificates}", "a certificate for every status but standby")
        for key in sorted(self.certificates.keys() - self.reports.keys()):
            self.reject("reports.csv", key[1], key[0], "record", "a certificate without a report", "with one")
        # What is no polygon cannot be compared with anything.
        sound = [key for key in sorted(self.certificates) if key in self.reports and self.areas(self.certificates[key])]
        self.certificates = {key: self.certificates[key] for key in sound}
        by_step = {}
        for one in self.certificates.values():
            self.count("steps of a vehicle")
            by_step.setdefault(one.step, []).append(one)
            self.plan(one)
            for other, known, lines in one.separations:
                self.lines(one, other, known, lines)
        for ones in by_step.values():
            for i, a in enumerate(ones):
                for b in ones[i + 1:]:
                    self.pair(a, b)
        for vehicle, drive in self.drives.items():
            for pose in drive:
                self.pose(vehicle, *pose)

    def areas(self, one):
        if one.standstill is None:
            self.reject("certificates.csv", one.id, one.step, "standstill", "none", "an area")
            return False
        count = len(self.violations)
        for step, area in enumerate(one.areas + [one.standstill], one.step):
            least = one.length_m * one.width_m
            if len(area) < 3 or size(area) < least:
                self.reject("certificates.csv", one.id, one.step, "areas", f"{size(area):.6f} m2 with {len(area)} corners "
                            f"during step {step}", f">= {least:.6f} m2 (the footprint), counter-clockwise")
            elif (out := outside(area, area)) > TOUCH_M:
                self.reject("certificates.csv", one.id, one.step, "areas", f"a corner {1e3 * out:.3f} mm outside the line "
                            f"of an edge during step {step}", "convex")
        if one.is_agreed:
            named = self.reports[one.step, one.id]["maneuvers"]
            if len(one.areas) != named and (one.areas or named != 1):
                self.reject("certificates.csv", one.id, one.step, "standstill", f"{len(one.areas)} areas before it",
                            f"{named}, one for each maneuver")
            elif one.areas and len(self.violations) == count and (out := outside(one.areas[-1], one.standstill)) > APART_M:
                self.reject("certificates.csv", one.id, one.step, "standstill", f"{1e3 * out:.3f} mm outside the last area",
                            f"<= {1e3 * APART_M} mm")
        return len(self.violations) == count

    def plan(self, one):
        before = self.certificates.get((one.step - 1, one.id))
        if before is None or not (before.is_agreed and one.is_agreed):
            self.count("plans that continue none that was agreed")
            return
        is_new = self.reports[one.step, one.id]["is_new"]
        for step in range(one.step, one.step + 1 if is_new else max(before.end, one.end) + 1):
            out = outside(one.during(step), before.during(step))
            if not is_new:
                out = max(out, outside(before.during(step), one.during(step)))
            if out > SAME_M:
                self.reject("certificates.csv", one.id, one.step, "plan", f"the area during step {step} differs by "
                            f"{1e3 * out:.4f} mm from that of the step before", f"<= {1e3 * SAME_M} mm")

    def lines(self, one, other, known, lines):
        its = self.certificates.get((one.step, other))
        is_its_plan = its is not None and (
            its.is_agreed if known in ("reachable", "missing") else
            (known == "new") == self.reports[its.step, its.id]["is_new"])
        for step, line in enumerate(lines, one.step + 1):
            gap = farthest(one.during(step), line) - line[2]
            if abs(gap) > TOUCH_M:
                self.reject("certificates.csv", one.id, one.step, "line", f"the area during step {step} ends {1e3 * gap:.4f} mm "
                            f"beyond the line to vehicle {other} ({known})", f"0, up to {1e3 * TOUCH_M} mm")
            if is_its_plan and (gap := nearest(its.during(step), line) - line[2]) < -APART_M:
                self.reject("certificates.csv", one.id, one.step, "line", f"vehicle {other} ({known}) is {-1e3 * gap:.4f} mm "
                            f"on this side of the line during step {step}", f"<= {1e3 * APART_M} mm")

    def pair(self, a, b):
        lines = [(one, two, found) for one, two in ((a, b), (b, a)) for other, _, found in one.separations if other == two.id]
        is_coupled = any(two.id in self.reports[one.step, one.id]["coupled"] for one, two in ((a, b), (b, a)))
        # Whatever lasts longer ends in standstills, which lie in the areas before.
        for step in range(a.step + 1, max(a.end, b.end, a.step + 2)):
            one, two = a.during(step), b.during(step)
            if any(step - a.step <= len(found) and nearest(its.during(step), found[step - a.step - 1]) >=
                   found[step - a.step - 1][2] - APART_M for _, its, found in lines):
                self.count("pairs apart by a line")
            elif not is_coupled and overlap(one, two) <= APART_M:
                self.count("pairs apart that are not coupled")
            elif not (a.is_agreed and b.is_agreed):
                self.count("pairs not proven, of a vehicle to whose areas nobody has agreed")
            else:
                self.reject("certificates.csv", a.id, a.step, "pair", f"no line is between it and vehicle {b.id} during step "
                            f"{step}, overlap {1e3 * overlap(one, two):.4f} mm", f"<= {1e3 * APART_M} mm, with a line")

    def pose(self, vehicle, time, x, y, yaw, create):
        step, followed = time // self.period, create // self.period
        plans = [self.certificates.get((k, vehicle)) for k in dict.fromkeys((followed, step - 1, step)) if k <= step]
        plans = [one for one in plans if one is not None]
        if not plans:
            return self.count("driven poses without a plan")
        body = footprint(x, y, yaw, plans[0].length_m, plans[0].width_m)
        out = min(outside(one.during(step), body) for one in plans)
        if out <= DRIVEN_M:
            return self.count("driven poses in their areas")
        near = [self.certificates.get((k, vehicle)) for k in range(step - 1, step + BEFORE_STEPS + 1)]
        if any(one is not None and not one.is_agreed for one in near):
            return self.count("driven poses not proven, of a vehicle to whose areas nobody has agreed")
        return self.reject(f"vehicle_{vehicle}.csv", vehicle, step, "driven", f"{1e3 * out:.3f} mm outside its area at "
                           f"{time / 1e9:.2f} s", f"<= {1e3 * DRIVEN_M} mm")


def maneuvers(text):
    """Their number in "TRIM:LABEL;TRIM:LABEL", where a backslash comes before ; and \\ of a label."""
    bare = text.replace("\\\\", "").replace("\\;", "")
    return bare.count(";") + 1 if text else 0


def driven(row):
    return (int(row["t_ns"]), number(row["x_m"]), number(row["y_m"]), number(row["yaw_rad"]), int(row["command_create_ns"]))


def main():
    parser = argparse.ArgumentParser(
        prog="check_run.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False,
        epilog="Exit codes: 0 accepted, 1 rejected, 2 invalid flags or files.")
    parser.add_argument("runs", metavar="RUN", nargs="+", type=pathlib.Path, help="run folder")
    parser.add_argument("--version", action="store_true", help="print the version, and exit")
    if sys.argv[1:] == ["--version"]:
        return subprocess.call([pathlib.Path(__file__).resolve().parent / "version.sh", "check_run.py"])
    code = 0
    for run in parser.parse_args().runs:
        try:
            check = Check(run)
            check.check()
        except Unreadable as error:
            print(f"check_run.py: {error}", file=sys.stderr)
            code = 2
            continue
        for line in check.violations:
            print(f"{run}/{line}")
        counts = ", ".join(f"{number} {what}" for what, number in sorted(check.counts.items()))
        print(f"{run}: {'rejected' if check.violations else 'accepted'}; {counts}")
        code = max(code, 1 if check.violations else 0)
    return code


if __name__ == "__main__":
    sys.exit(main())
