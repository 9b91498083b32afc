"""Negative controls: a good run, spoilt in one way each, must be rejected for that reason.

The file is spoilt, not the checks: each control goes through all that a run goes through.
"""

import copy
import math
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from dynamics import check_vehicle, measured_before
from lxml import etree
from run import DRIVEN_IDS, PLANNED_IDS, BadInput, Finding, Run, read_run

Element = etree._Element


def motion(root: Element, ids: int, vehicle: int) -> list[Element]:
    obstacle = root.find(f"dynamicObstacle[@id='{ids + vehicle}']")
    return [obstacle.find("initialState"), *obstacle.iterfind("trajectory/state")]


def get(state: Element, path: str) -> float:
    return float(state.findtext(path))


def put(state: Element, path: str, value: float) -> None:
    state.find(path).text = f"{value:.9f}"


def scale(states: list[Element], path: str, factor: float) -> None:
    for state in states:
        if state.find(path) is not None:
            put(state, path, factor * get(state, path))


X, Y = "position/point/x", "position/point/y"


def shift(states: list[Element], dx_m: float, dy_m: float) -> None:
    for state in states:
        put(state, X, get(state, X) + dx_m)
        put(state, Y, get(state, Y) + dy_m)


def jump(root: Element, length_m: float, sample: int) -> None:
    """The first vehicle's plan goes on that far ahead of itself."""
    states = motion(root, PLANNED_IDS, 1)[sample:]
    heading = get(states[0], "orientation/exact")
    shift(states, length_m * math.cos(heading), length_m * math.sin(heading))


class Reanchored(NamedTuple):
    """A re-anchored plan."""

    vehicle: int
    sample: int  # just after
    measured: int  # sample at which the car was seen
    time_s: float


def first_reanchored(run: Run) -> Reanchored | None:
    for vehicle in sorted(run.planned):
        for sample in check_vehicle(run, vehicle).reanchored:
            h = run.scenario.dt
            return Reanchored(vehicle, sample, measured_before(sample, h), sample * h)
    return None


def turn_about_car(root: Element, plan: Reanchored, angle_rad: float) -> None:
    """The plan still meets the car, but points elsewhere."""
    car = motion(root, DRIVEN_IDS, plan.vehicle)[plan.measured]
    x_m, y_m = get(car, X), get(car, Y)
    cos, sin = math.cos(angle_rad), math.sin(angle_rad)
    for state in motion(root, PLANNED_IDS, plan.vehicle)[plan.sample :]:
        dx, dy = get(state, X) - x_m, get(state, Y) - y_m
        put(state, X, x_m + cos * dx - sin * dy)
        put(state, Y, y_m + sin * dx + cos * dy)
        put(state, "orientation/exact", get(state, "orientation/exact") + angle_rad)


def to_rear_axle(root: Element, rear_axle_to_cg_m: float) -> None:
    for state in motion(root, PLANNED_IDS, 1):
        heading = get(state, "orientation/exact")
        dx, dy = -rear_axle_to_cg_m * math.cos(heading), -rear_axle_to_cg_m * math.sin(heading)
        shift([state], dx, dy)


def into_another(root: Element, ids: int) -> None:
    """The second vehicle's whole motion moved so that in mid-run it is beside the first one by half
    a width."""
    first, second = motion(root, ids, 1), motion(root, ids, 2)
    middle = len(first) // 2
    dx = get(first[middle], X) - get(second[middle], X)
    dy = get(first[middle], Y) - get(second[middle], Y)
    shift(second, dx, dy + 0.05)


def put_obstacle(root: Element) -> None:
    """5 cm square, where the first vehicle is in mid-run."""
    plan = motion(root, PLANNED_IDS, 1)
    x_m, y_m = get(plan[len(plan) // 2], X), get(plan[len(plan) // 2], Y)
    corners = "".join(
        f"<point><x>{x_m + dx:.9f}</x><y>{y_m + dy:.9f}</y></point>"
        for dx, dy in ((-0.025, -0.025), (0.025, -0.025), (0.025, 0.025), (-0.025, 0.025))
    )
    obstacle = etree.fromstring(
        f"<staticObstacle id='9000001'><type>unknown</type><shape><polygon>{corners}</polygon>"
        "</shape><initialState><position><point><x>0.000000000</x><y>0.000000000</y></point>"
        "</position><orientation><exact>0.000000000</exact></orientation><time><exact>0</exact>"
        "</time></initialState></staticObstacle>"
    )
    root.find("dynamicObstacle").addprevious(obstacle)


def without(root: Element, ids: int) -> None:
    root.remove(root.find(f"dynamicObstacle[@id='{ids + 2}']"))


def cut_plan(root: Element) -> None:
    for state in motion(root, PLANNED_IDS, 1)[300:]:
        state.getparent().remove(state)


def slow_down(root: Element) -> None:
    for state in motion(root, PLANNED_IDS, 2) + motion(root, DRIVEN_IDS, 2):
        time = state.find("time/exact")
        time.text = str(3 * int(time.text))


def renumber_drive(root: Element) -> None:
    root.find(f"dynamicObstacle[@id='{DRIVEN_IDS + 2}']").set("id", str(DRIVEN_IDS + 9))


def repeat_id(root: Element) -> None:
    problems = root.findall("planningProblem")
    problems[1].set("id", problems[0].get("id"))


def without_orientation(root: Element) -> None:
    state = motion(root, DRIVEN_IDS, 1)[7]
    state.remove(state.find("orientation"))


def round_to_millimetres(root: Element) -> None:
    for state in motion(root, PLANNED_IDS, 1):
        state.find(X).text = f"{get(state, X):.3f}"


def make_narrower(root: Element) -> None:
    obstacle = root.find(f"dynamicObstacle[@id='{PLANNED_IDS + 1}']")
    put(obstacle, "shape/rectangle/width", 0.1)


class Control(NamedTuple):
    name: str
    reason: str  # the check that must reject it
    mentions: tuple[str, ...]  # what its findings must name
    spoil: Callable[[Element], None]


BOTH_STEPS = ("step of 0.01 s", "step of 0.20 s")


def controls(rear_axle_to_cg_m: float) -> list[Control]:
    def planned(root: Element) -> list[Element]:
        return motion(root, PLANNED_IDS, 1)

    # 1301 is just after the begin of a control step, where a plan may be re-anchored.
    def with_planned(path: str, factor: float) -> Callable[[Element], None]:
        return lambda root: scale(planned(root), path, factor)

    return [
        Control("3 mm jump", "dynamics", ("position",), lambda r: jump(r, 0.003, 1310)),
        Control("3 mm jump at a step", "dynamics", ("position",), lambda r: jump(r, 0.003, 1301)),
        Control("12 mm jump at a step", "dynamics", ("position",), lambda r: jump(r, 0.012, 1301)),
        Control(
            "steering x 1.2",
            "dynamics",
            ("heading", *BOTH_STEPS),
            with_planned("steeringAngle/exact", 1.2),
        ),
        Control(
            "speed x 1.05",
            "dynamics",
            BOTH_STEPS,  # of A, at the limits of speed, not of position
            with_planned("velocity/exact", 1.05),
        ),
        Control(
            "rear axle instead of centre of gravity",
            "dynamics",
            ("position", *BOTH_STEPS),
            lambda r: to_rear_axle(r, rear_axle_to_cg_m),
        ),
        Control(
            "a plan moved into another",
            "collision",
            ("planned",),
            lambda r: into_another(r, PLANNED_IDS),
        ),
        Control(
            "a driven car moved into another",
            "collision",
            ("driven",),
            lambda r: into_another(r, DRIVEN_IDS),
        ),
        Control(
            "an obstacle in the way",
            "collision",
            ("vehicle 1, planned, touches obstacle", "vehicle 1, driven, touches obstacle"),
            put_obstacle,
        ),
        Control(
            "a plan moved 0.2 m aside",
            "lanes",
            ("vehicle 1",),
            lambda r: shift(planned(r), 0.2, 0.0),
        ),
        Control(
            "one driven sample 50 mm aside",
            "driving",
            ("expected from its speed",),
            lambda r: shift(motion(r, DRIVEN_IDS, 2)[777:778], 0.05, 0.0),
        ),
        Control(
            "a driven car 0.3 m beside its plan",
            "driving",
            ("off its plan",),
            lambda r: shift(motion(r, DRIVEN_IDS, 2), 0.0, 0.3),
        ),
        Control("no plan of a car", "record", ("no plan",), lambda r: without(r, PLANNED_IDS)),
        Control("no drive of a car", "record", ("no drive",), lambda r: without(r, DRIVEN_IDS)),
        Control("a plan of 3 s", "record", ("plan of",), cut_plan),
        Control("a drive of another car", "record", ("does not name it",), renumber_drive),
        Control("a car in thrice the time", "record", ("of another time",), slow_down),
        Control("a narrower car", "size", ("element",), make_narrower),
        Control("an id twice", "schema", ("Duplicate",), repeat_id),
        Control("a state without orientation", "schema", ("orientation",), without_orientation),
        Control("positions in millimetres", "decimals", ("9 decimals",), round_to_millimetres),
    ]


def controls_of_reanchored_plans(plan: Reanchored) -> list[Control]:
    """The allowance for such plans must not hide an error that the driven motion does not show."""

    def states(root: Element) -> list[Element]:
        return motion(root, PLANNED_IDS, plan.vehicle)[plan.sample :]

    place = (f"vehicle {plan.vehicle}, step of 0.01 s to {plan.time_s:.2f} s",)
    return [
        Control(
            "a re-anchored plan, 3 mm beside the car",
            "dynamics",
            place,
            lambda r: shift(states(r), 0.003, 0.0),
        ),
        Control(
            "a re-anchored plan, turned by 5 mrad against the car",
            "dynamics",
            place,
            lambda r: turn_about_car(r, plan, 0.005),
        ),
    ]


def holds(control: Control, findings: list[Finding]) -> bool:
    """Rejected for the right reason, and the findings name what they should."""
    texts = [f.text for f in findings if f.check == control.reason]
    return bool(texts) and all(any(word in text for text in texts) for word in control.mentions)


def run_controls(
    xml: Path,
    folder: Path,
    check_file: Callable[[Path, Path], tuple[list[Finding], list[str]]],
    needs_reanchored: bool,
) -> bool:
    """Prints each control with the reasons for which it was rejected. True if all were, rightly.

    Raises BadInput if the run has no re-anchored plan, but needs one.
    """
    good = etree.parse(xml).getroot()
    run = read_run(xml, folder)
    all_controls = controls(run.configuration.vehicle.b)
    if plan := first_reanchored(run):
        all_controls += controls_of_reanchored_plans(plan)
    elif needs_reanchored:
        raise BadInput(f"{folder}: no re-anchored plan, must be a run with such plans")
    all_hold = True
    for control in all_controls:
        root = copy.deepcopy(good)
        control.spoil(root)
        with tempfile.TemporaryDirectory() as place:
            spoilt = Path(place) / "spoilt.xml"
            etree.ElementTree(root).write(spoilt, xml_declaration=True, encoding="UTF-8")
            findings, _ = check_file(spoilt, folder)
        right = holds(control, findings)
        all_hold = all_hold and right
        print(f"{'rejected' if right else 'NOT REJECTED for ' + control.reason}  {control.name}")
        for finding in findings:
            print(f"    {finding.check}: {finding.text}", flush=True)
    return all_hold
