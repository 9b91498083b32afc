"""Is it the whole run, of all cars, and did they drive what was planned?

Nothing is concluded from less than a whole run: what is not there cannot be rejected.
"""

import json
import math
from pathlib import Path

from commonroad.scenario.obstacle import DynamicObstacle
from run import BadInput, Finding, Run, State, states

# A car follows its plan within a few millimetres; where that asks for more than the car gives (A),
# within some 5 cm. A car's width beside it, it is on another way.
OFF_PLAN_M = 0.1
# Between two samples of 10 ms a car moves by its speed. Its motion is linear between two
# ticks of 20 ms, in which A changes its speed by up to 0.5 m/s.
STEP_M = 5e-3


def read_facts(folder: Path) -> tuple[list[int], float]:
    """Vehicle ids, and the time [s] from the first step to the last. Raises BadInput."""
    file = folder / "run.json"
    try:
        facts = json.loads(file.read_text(encoding="utf-8"))
        return list(facts["vehicle_ids"]), 1e-9 * (facts["steps"] - 1) * facts["period_ns"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise BadInput(f"{file}: {error!r}, must be a run folder's file") from error


def check_whole(run: Run, folder: Path) -> tuple[list[Finding], str]:
    """Plan and drive of every car, over the whole run."""
    vehicles, duration_s = read_facts(folder)
    findings = []
    for kind, motions in (("plan", run.planned), ("drive", run.driven)):
        for vehicle in sorted(set(vehicles) | set(motions)):
            if vehicle not in motions:
                findings.append(Finding("record", f"vehicle {vehicle}: no {kind}"))
            elif vehicle not in vehicles:
                text = f"vehicle {vehicle}: a {kind}, but run.json does not name it"
                findings.append(Finding("record", text))
            elif (at := first_wrong_time(motions[vehicle])) is not None:
                text = f"vehicle {vehicle}: state {at} of the {kind} is of another time"
                findings.append(Finding("record", text))
            elif (length_s := length_of(motions[vehicle], run)) < duration_s - 0.5 * run.scenario.dt:
                text = f"vehicle {vehicle}: {kind} of {length_s:.2f} s, the run has {duration_s:.2f} s"
                findings.append(Finding("record", text))
    return findings, f"{len(vehicles)} cars, {duration_s:.1f} s planned and driven"


def first_wrong_time(obstacle: DynamicObstacle) -> int | None:
    """The first state whose time step is not its place: all checks take the one for the other."""
    all_states = [obstacle.initial_state, *obstacle.prediction.trajectory.state_list]
    return next((i for i, s in enumerate(all_states) if s.time_step != i), None)


def length_of(obstacle: DynamicObstacle, run: Run) -> float:
    return (len(states(obstacle)) - 1) * run.scenario.dt


def distance(a: State, b: State) -> float:
    return math.hypot(a.x_m - b.x_m, a.y_m - b.y_m)


def check_driving(run: Run) -> tuple[list[Finding], str]:
    """The driven motion is one motion, and that of the plan."""
    findings = []
    farthest_m = 0.0
    h = run.scenario.dt
    for vehicle in sorted(run.driven):
        driven, planned = states(run.driven[vehicle]), states(run.planned[vehicle])
        for i, (was, now) in enumerate(zip(driven, driven[1:]), start=1):
            way_m = 0.5 * h * abs(was.speed_mps + now.speed_mps)
            if abs(distance(was, now) - way_m) > STEP_M:
                text = (
                    f"vehicle {vehicle}, {i * h:.2f} s: {1e3 * distance(was, now):.1f} mm driven in "
                    f"{h:.2f} s, expected from its speed: {1e3 * way_m:.1f}"
                )
                findings.append(Finding("driving", text))
                break
        off_m = [distance(a, b) for a, b in zip(driven, planned)]
        farthest_m = max(farthest_m, *off_m)
        if max(off_m) > OFF_PLAN_M:
            i = off_m.index(max(off_m))
            text = (
                f"vehicle {vehicle}, {i * h:.2f} s: {1e3 * off_m[i]:.1f} mm off its plan, "
                f"must be <= {1e3 * OFF_PLAN_M:.0f}"
            )
            findings.append(Finding("driving", text))
    return findings, f"at most {1e3 * farthest_m:.1f} mm off the plan"
