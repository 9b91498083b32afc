#!/usr/bin/env python3
"""Checks runs of this project with CommonRoad's packages. verify.sh calls it."""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

from collisions import check_collisions, check_size
from controls import run_controls
from dynamics import check_dynamics
from goals import check_goals
from lanes import check_lanes
from record import check_driving, check_whole
from run import BadInput, Finding, read_run
from schema import check_schema

EXPORT_TIMEOUT_S = 60


def export(program: Path, folder: Path, xml: Path) -> None:
    """Writes the run as CommonRoad file. Raises BadInput with the program's message."""
    done = subprocess.run(
        [program, "--run", folder, "--out", xml],
        capture_output=True,
        text=True,
        timeout=EXPORT_TIMEOUT_S,
        check=False,
    )
    if done.returncode != 0:
        raise BadInput(done.stderr.strip() or f"{program}: failed with {done.returncode}")


def check_file(xml: Path, folder: Path) -> tuple[list[Finding], list[str]]:
    """All reasons to reject the file, and what the checks have seen."""
    findings, text = check_schema(xml)
    if findings:
        return findings, []  # nothing else could be read with certainty
    lines = [f"schema      {text}"]
    try:
        run = read_run(xml, folder)
    except BadInput:
        raise
    except Exception as error:  # whatever CommonRoad's reader has against it
        return [Finding("reader", f"CommonRoad's reader: {error!r}")], lines
    findings, text = check_whole(run, folder)
    if findings:
        return findings, lines  # missing parts cannot be checked
    lines.append(f"record      {text}")
    findings += check_size(run)
    for name, check in (
        ("driving", check_driving),
        ("dynamics", check_dynamics),
        ("collisions", check_collisions),
        ("lanes", check_lanes),
        ("goals", check_goals),
    ):
        try:
            found, text = check(run)
        except Exception as error:  # what the export does not write, and the packages do not expect
            found, text = [Finding(name, f"cannot be checked: {error!r}")], ""
        findings += found
        lines.append(f"{name:11} {'rejected' if found else text}")
    return findings, lines


def name_of(folder: Path) -> str:
    """Scenario and choices, as far as the run folder contains them."""
    flags = folder / "configuration" / "flags.yaml"
    wanted = {}
    for line in flags.read_text(encoding="utf-8").splitlines() if flags.exists() else []:
        key, _, value = line.partition(": ")
        wanted[key] = value.strip("'\"")
    if "scenario" not in wanted:
        return str(folder)
    choices = [f"{k} {wanted[k]}" for k in ("subgraph", "profile") if wanted.get(k) != "null"]
    return ", ".join([Path(wanted["scenario"]).stem, *choices]) + f" ({folder})"


def verify(program: Path, folder: Path, xml: Path | None) -> bool:
    """`xml` None: the run is exported first."""
    with tempfile.TemporaryDirectory() as place:
        if xml is None:
            xml = Path(place) / "run.xml"
            export(program, folder, xml)
        findings, lines = check_file(xml, folder)
    print(f"{'REJECTED' if findings else 'accepted'}  {name_of(folder)}")
    for line in lines:
        print(f"    {line}")
    for finding in findings:
        print(f"    {finding.check}: {finding.text}")
    sys.stdout.flush()
    return not findings


def verify_controls(program: Path, folder: Path, needs_reanchored: bool) -> bool:
    print(f"negative controls, from {name_of(folder)}", flush=True)
    with tempfile.TemporaryDirectory() as place:
        xml = Path(place) / "run.xml"
        export(program, folder, xml)
        return run_controls(xml, folder, check_file, needs_reanchored)


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__,
        epilog="Exit codes: 0 all accepted, 1 a run rejected or a negative control accepted, "
        "2 invalid input.",
    )
    parser.add_argument("--export", type=Path, required=True, help="the program export_commonroad")
    parser.add_argument(
        "--controls",
        type=Path,
        metavar="RUN",
        help="a run of paper_three_cars that is accepted: must be rejected when it is spoilt",
    )
    parser.add_argument(
        "--controls_reanchored",
        type=Path,
        metavar="RUN",
        help="the same for a run in which plans are re-anchored",
    )
    parser.add_argument(
        "--xml", type=Path, help="a CommonRoad file of the one run, instead of its export"
    )
    parser.add_argument("runs", type=Path, nargs="*", metavar="RUN", help="run folder")
    arguments = parser.parse_args()
    if arguments.xml and len(arguments.runs) != 1:
        parser.error(f"--xml {arguments.xml}: {len(arguments.runs)} run folders, must be one")
    try:
        accepted = [verify(arguments.export, folder, arguments.xml) for folder in arguments.runs]
        if arguments.controls:
            accepted.append(verify_controls(arguments.export, arguments.controls, False))
        if arguments.controls_reanchored:
            accepted.append(verify_controls(arguments.export, arguments.controls_reanchored, True))
    except (BadInput, subprocess.TimeoutExpired, OSError) as error:
        print(f"verify: {error}", file=sys.stderr)
        return 2
    return 0 if all(accepted) else 1


if __name__ == "__main__":
    sys.exit(main())
