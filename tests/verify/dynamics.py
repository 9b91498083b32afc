"""Is the planned motion one of the vehicle? By CommonRoad's kinematic single-track model.

Every state is integrated to the next by vehicle_dynamics_ks_cog, with the inputs that lead from one
speed and steering to the next. The model cuts inputs off at the vehicle's limits, so that a motion
beyond them does not fit either. What the integration gives must be the next state within TOLERANCE,
which holds for a control step of 0.2 s and is scaled with the length of the step: once from each
10 ms to the next, once over whole control steps.

A controller may re-anchor its plan to the pose of the car (planner/controller/plan_in_force.hpp).
Such a jump is not driven; it is accepted only if the car, evaluated independently, shows the
same (`is_reanchored`).
"""

import math
from dataclasses import dataclass, field

from run import Configuration, Finding, Run, State, states, turn
from vehiclemodels.utils.vehicle_dynamics_ks_cog import vehicle_dynamics_ks_cog
from vehiclemodels.vehicle_parameters import VehicleParameters

POSITION_M = 0.5e-3
SPEED_MPS = 5e-3
HEADING_RAD = 1e-3
STEERING_RAD = 1e-3
TOLERANCE_STEP_S = 0.2
# Share of the safety margin beyond which a controller re-anchors its plan.
REANCHOR_SHARE = 0.5
# The lab's identified model of its vehicles (mid_level_controller/src/VehicleModel.cxx): the course
# is yaw + SLIP_GAIN delta + SLIP_OFFSET, and in steady state
# curvature = YAW_RATE_GAIN delta / (PATH_SPEED_GAIN (1 + PATH_SPEED_STEERING delta^2)),
# where |delta - STEERING_OFFSET| <= 1.
PATH_SPEED_GAIN = 1.004582
PATH_SPEED_STEERING = -0.142938
SLIP_GAIN_RAD = 0.195236
YAW_RATE_GAIN_PER_M = 3.560576
STEERING_OFFSET = 0.032208
SLIP_OFFSET_RAD = -0.012863
# A controller sees a car's state this long after it was measured (the lab's contract).
MEASUREMENT_AGE_S = 0.06


@dataclass
class Error:
    """How far a state is from where the model leads, largest so far."""

    position_m: float = 0.0
    speed_mps: float = 0.0
    heading_rad: float = 0.0
    steering_rad: float = 0.0

    def add(self, other: "Error") -> None:
        self.position_m = max(self.position_m, other.position_m)
        self.speed_mps = max(self.speed_mps, other.speed_mps)
        self.heading_rad = max(self.heading_rad, other.heading_rad)
        self.steering_rad = max(self.steering_rad, other.steering_rad)

    def beyond(self, duration_s: float) -> list[str]:
        """What exceeds the tolerance of a step of that length."""
        scale = duration_s / TOLERANCE_STEP_S
        return [
            f"{name} {1e3 * value:.3g} {unit}, must be <= {1e3 * scale * allowed:.3g}"
            for name, value, unit, allowed in (
                ("position", self.position_m, "mm", POSITION_M),
                ("speed", self.speed_mps, "mm/s", SPEED_MPS),
                ("heading", self.heading_rad, "mrad", HEADING_RAD),
                ("steering", self.steering_rad, "mrad", STEERING_RAD),
            )
            if not value <= scale * allowed
        ]

    def __str__(self) -> str:
        return (
            f"{1e3 * self.position_m:.1e} mm, {1e3 * self.speed_mps:.1e} mm/s, "
            f"{1e3 * self.heading_rad:.1e} mrad"
        )


def integrated(x: State, u: tuple[float, float], h: float, p: VehicleParameters) -> State:
    """One step of the classical Runge-Kutta method."""

    def f(state: list[float]) -> list[float]:
        return vehicle_dynamics_ks_cog(state, u, p)

    k1 = f(list(x))
    k2 = f([a + 0.5 * h * b for a, b in zip(x, k1)])
    k3 = f([a + 0.5 * h * b for a, b in zip(x, k2)])
    k4 = f([a + h * b for a, b in zip(x, k3)])
    return State(*(a + h / 6 * (b + 2 * c + 2 * d + e) for a, b, c, d, e in zip(x, k1, k2, k3, k4)))


def input_between(x: State, y: State, h: float) -> tuple[float, float]:
    """Steering rate and acceleration that lead from x to y."""
    return (y.steering_rad - x.steering_rad) / h, (y.speed_mps - x.speed_mps) / h


def error_of(model: State, y: State) -> Error:
    return Error(
        math.hypot(model.x_m - y.x_m, model.y_m - y.y_m),
        abs(model.speed_mps - y.speed_mps),
        abs(turn(model.heading_rad, y.heading_rad)),
        abs(model.steering_rad - y.steering_rad),
    )


def moved(q: State, old: State, new: State) -> tuple[float, float]:
    """Where the rigid motion that takes pose `old` to pose `new` takes the position of q."""
    angle = turn(old.heading_rad, new.heading_rad)
    dx, dy = q.x_m - old.x_m, q.y_m - old.y_m
    return (
        new.x_m + math.cos(angle) * dx - math.sin(angle) * dy,
        new.y_m + math.sin(angle) * dx + math.cos(angle) * dy,
    )


def yaw_minus_heading(steering_rad: float, p: VehicleParameters) -> float:
    """Of a car of the lab on the course of the kinematic model with this steering angle."""
    slip_rad = math.atan(p.b / (p.a + p.b) * math.tan(steering_rad))
    c = PATH_SPEED_GAIN * math.cos(slip_rad) * math.tan(steering_rad) / (p.a + p.b)
    root = math.sqrt(YAW_RATE_GAIN_PER_M**2 - 4 * c * c * PATH_SPEED_STEERING)
    delta = 2 * c / (YAW_RATE_GAIN_PER_M + root)
    delta = min(max(delta, STEERING_OFFSET - 1), STEERING_OFFSET + 1)
    return slip_rad - SLIP_GAIN_RAD * delta - SLIP_OFFSET_RAD


def measured_before(i: int, time_step_s: float) -> int:
    """The sample at which a car was seen whose plan is re-anchored just before sample i."""
    return i - 1 - round(MEASUREMENT_AGE_S / time_step_s)


def is_reanchored(
    planned: list[State],
    driven: list[State],
    i: int,
    old: State,
    time_step_s: float,
    configuration: Configuration,
) -> bool:
    """Is sample i, where the plan before leads to `old`, the begin of a re-anchored plan?

    So it is just after the begin of a control step, if the car was off the old plan by more than a
    controller suffers when it was measured, and if the motion of the plan takes the planned
    position and heading of that time to where the car was and pointed. Speed and steering go on.
    """
    begin = i - 1
    measured = measured_before(i, time_step_s)
    if begin % configuration.samples_per_step != 0 or not 0 <= measured < len(driven):
        return False
    error = error_of(old, planned[i])
    error.position_m = error.heading_rad = 0.0
    car = (driven[measured].x_m, driven[measured].y_m)
    off_m = math.dist(car, (planned[measured].x_m, planned[measured].y_m))
    heading_rad = planned[measured].heading_rad + turn(old.heading_rad, planned[i].heading_rad)
    yaw_rad = heading_rad + yaw_minus_heading(
        planned[measured].steering_rad, configuration.vehicle
    )
    return (
        not error.beyond(time_step_s)
        and abs(turn(yaw_rad, driven[measured].heading_rad)) <= HEADING_RAD
        and off_m > REANCHOR_SHARE * configuration.safety_margin_m
        and math.dist(car, moved(planned[measured], old, planned[i])) <= POSITION_M
    )


def bounds(planned: list[State], p: VehicleParameters) -> str:
    """The first state outside the vehicle's bounds, or nothing."""
    for i, s in enumerate(planned):
        if not p.longitudinal.v_min <= s.speed_mps <= p.longitudinal.v_max:
            return f"sample {i}: speed {s.speed_mps} m/s"
        if not p.steering.min <= s.steering_rad <= p.steering.max:
            return f"sample {i}: steering {s.steering_rad} rad"
    return ""


@dataclass
class Course:
    """What the motion of one vehicle came to."""

    findings: list[Finding]
    largest: Error  # of the steps that are not re-anchored
    reanchored: list[int] = field(default_factory=list)  # samples just after


def check_vehicle(run: Run, vehicle: int) -> Course:
    planned, driven = states(run.planned[vehicle]), states(run.driven[vehicle])
    p, h = run.configuration.vehicle, run.scenario.dt
    per_step = run.configuration.samples_per_step
    course = Course([], Error())
    broken = {1: 0, per_step: 0}  # steps of 10 ms, control steps
    window = planned[0]  # integrated from the begin of the control step on

    def reject(length: int, i: int, error: Error) -> None:
        broken[length] += 1
        if broken[length] == 1:
            what = "; ".join(error.beyond(length * h))
            text = f"vehicle {vehicle}, step of {length * h:.2f} s to {i * h:.2f} s: {what}"
            course.findings.append(Finding("dynamics", text))

    if outside := bounds(planned, p):
        course.findings.append(Finding("dynamics", f"vehicle {vehicle}, {outside}: out of bounds"))
    for i in range(1, len(planned)):
        u = input_between(planned[i - 1], planned[i], h)
        model = integrated(planned[i - 1], u, h, p)
        window = integrated(window, u, h, p)
        error = error_of(model, planned[i])
        if not error.beyond(h):
            course.largest.add(error)
        elif is_reanchored(planned, driven, i, model, h, run.configuration):
            course.reanchored.append(i)
            window = planned[i]
        else:
            reject(1, i, error)
        if i % per_step == 0:
            error = error_of(window, planned[i])
            if error.beyond(per_step * h):
                reject(per_step, i, error)
            window = planned[i]
    for length, count in broken.items():
        if count > 1:
            text = f"vehicle {vehicle}: {count} steps of {length * h:.2f} s are rejected"
            course.findings.append(Finding("dynamics", text))
    return course


def check_dynamics(run: Run) -> tuple[list[Finding], str]:
    findings: list[Finding] = []
    largest = Error()
    reanchored = 0
    for vehicle in sorted(run.planned):
        course = check_vehicle(run, vehicle)
        findings += course.findings
        largest.add(course.largest)
        reanchored += len(course.reanchored)
    text = f"largest error of a step of 10 ms {largest}"
    if reanchored > 0:
        text += f"; plans re-anchored to the car: {reanchored}"
    return findings, text
