"""A run as CommonRoad's reader sees it, and vehicle and routes of its configuration."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import yaml
from commonroad.common.file_reader import CommonRoadFileReader
from commonroad.scenario.obstacle import DynamicObstacle
from commonroad.scenario.scenario import Scenario
from vehiclemodels.vehicle_parameters import VehicleParameters

PLANNED_IDS = 2_000_000  # + vehicle id (hlc_bridge/record/commonroad_file.hpp)
DRIVEN_IDS = 3_000_000


class BadInput(Exception):
    """One line: the fault of a file and the bound."""


class Finding(NamedTuple):
    """A reason to reject a run."""

    check: str
    text: str


class State(NamedTuple):
    """State of the kinematic single-track model in the order of vehicle_dynamics_ks_cog."""

    x_m: float
    y_m: float
    steering_rad: float
    speed_mps: float
    heading_rad: float


@dataclass(frozen=True)
class Configuration:
    """What the run was driven with, from its own folder."""

    vehicle: VehicleParameters
    safety_margin_m: float
    routes: dict[str, dict[str, list[int]]]  # route, map (benchmarkID), lanelets
    route_of: dict[int, str]  # vehicle id; empty: no lanes
    samples_per_step: int  # 10 ms samples in a control step
    name_of: dict[int, str]  # vehicle id, in scenarios that name their vehicles
    map_file: Path | None  # None: no lanes


@dataclass(frozen=True)
class Run:
    scenario: Scenario
    configuration: Configuration
    planned: dict[int, DynamicObstacle]  # by vehicle id
    driven: dict[int, DynamicObstacle]


def load_yaml(file: Path) -> Any:
    try:
        return yaml.safe_load(file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f"{file}: cannot be read, must be a run folder's file") from error
    except yaml.YAMLError as error:
        raise BadInput(f"{file}: no YAML, must be a run folder's file") from error


def vehicle_parameters(vehicle: dict[str, float], limits: dict[str, float]) -> VehicleParameters:
    """Our vehicle in the package's terms.

    The package cuts inputs off where a state has reached its bound. A stop ends exactly there, and
    so may the last stage of an integration step, hence the bounds are moved outwards by what the
    file's rounding hides.
    """
    rounding = 1e-6
    p = VehicleParameters()
    p.l, p.w = vehicle["length_m"], vehicle["width_m"]
    p.b = vehicle["rear_axle_to_cg_m"]
    p.a = vehicle["wheelbase_m"] - p.b
    p.steering.max = limits["steering_max_rad"] + rounding
    p.steering.min = -p.steering.max
    p.steering.v_max = limits["steering_rate_radps"] + rounding
    p.steering.v_min = -p.steering.v_max
    p.longitudinal.v_min = limits["speed_min_mps"] - rounding
    p.longitudinal.v_max = limits["speed_max_mps"] + rounding
    p.longitudinal.v_switch = p.longitudinal.v_max  # no engine's power limit
    p.longitudinal.a_max = limits["acceleration_mps2"] + rounding
    return p


def read_configuration(folder: Path, time_step_s: float) -> Configuration:
    """Raises BadInput."""
    files = sorted((folder / "configuration").rglob("*.yaml"))
    scenarios = [f for f in files if "automaton" in (load_yaml(f) or {})]
    if len(scenarios) != 1:
        raise BadInput(f"{folder}: {len(scenarios)} scenarios in configuration/, must be one")
    scenario = load_yaml(scenarios[0])
    automaton_file = scenarios[0].parent / scenario["automaton"]
    automaton = load_yaml(automaton_file)
    try:
        vehicle = automaton["vehicle"]
        return Configuration(
            vehicle=vehicle_parameters(vehicle, automaton["limits"]),
            safety_margin_m=vehicle["safety_margin_m"],
            routes={route["name"]: route["lanelets"] for route in scenario.get("routes", [])},
            route_of={v["id"]: v["route"] for v in scenario.get("vehicles", [])},
            samples_per_step=round(automaton["step_s"] / time_step_s),
            name_of={v["id"]: v.get("name", "") for v in scenario.get("vehicles", [])},
            map_file=scenarios[0].parent / scenario["map"] if "map" in scenario else None,
        )
    except (KeyError, TypeError) as error:
        raise BadInput(f"{automaton_file}: {error} is missing, must be an automaton") from error


def read_run(xml: Path, folder: Path) -> Run:
    """Raises BadInput; whatever CommonRoad's reader raises."""
    scenario, _ = CommonRoadFileReader(str(xml)).open()
    planned, driven = {}, {}
    for obstacle in scenario.dynamic_obstacles:
        kind, vehicle = divmod(obstacle.obstacle_id, 1_000_000)
        motions = {PLANNED_IDS: planned, DRIVEN_IDS: driven}.get(kind * 1_000_000)
        if motions is None:
            raise ValueError(f"element {obstacle.obstacle_id} is neither a plan nor a drive")
        motions[vehicle] = obstacle
    return Run(scenario, read_configuration(folder, scenario.dt), planned, driven)


def states(obstacle: DynamicObstacle) -> list[State]:
    """The motion; an initial state has no steering in CommonRoad, so it gets that of the next."""
    trajectory = obstacle.prediction.trajectory.state_list
    all_states = [obstacle.initial_state, *trajectory]
    return [
        State(
            s.position[0],
            s.position[1],
            getattr(s, "steering_angle", getattr(trajectory[0], "steering_angle", 0.0)),
            s.velocity,
            s.orientation,
        )
        for s in all_states
    ]


def footprints(obstacle: DynamicObstacle) -> np.ndarray:
    """Corners [sample, corner, xy] of the vehicle's rectangle."""
    shape = obstacle.obstacle_shape
    motion = np.array([(s.x_m, s.y_m, s.heading_rad) for s in states(obstacle)])
    ahead = np.array([0.5, 0.5, -0.5, -0.5]) * shape.length
    aside = np.array([-0.5, 0.5, 0.5, -0.5]) * shape.width
    cos, sin = np.cos(motion[:, 2:]), np.sin(motion[:, 2:])
    x = motion[:, 0:1] + cos * ahead - sin * aside
    y = motion[:, 1:2] + sin * ahead + cos * aside
    return np.stack([x, y], axis=2)


def turn(from_rad: float, to_rad: float) -> float:
    """The angle between two headings, in (-pi, pi]."""
    return math.remainder(to_rad - from_rad, 2.0 * math.pi)
