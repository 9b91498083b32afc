"""Scenarios: which cars drive where, by which rules."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Mapping, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from hlc import _core
from hlc.files import PathLike, check_is, check_whole, find

MOST_STEPS = 100_000
MOST_SEED = 1_000_000_000


@dataclass(frozen=True)
class Vehicle:
    """A vehicle of a scenario."""

    id: int
    name: str
    start: NDArray[np.float64]
    """(3,): x [m], y [m], heading [rad]; it stands there at the start."""
    route_m: NDArray[np.float64]
    """(n, 2): points of the centre line of its route [m]."""
    is_closed: bool
    """The route's last point is followed by its first one."""


@dataclass(frozen=True)
class Situation:
    """What every car knows when the priorities of a step are assigned: the same for all.

    Arrays have an entry per vehicle, in the order of `vehicles`.
    """

    vehicles: tuple[int, ...]
    """Ids, ascending."""
    coupled: dict[int, tuple[int, ...]]
    """Of each vehicle those that it could meet within the horizon; it must regard their plans, or they its."""
    poses: NDArray[np.float64]
    """(V, 3): x [m], y [m], heading [rad], where the new plans begin."""
    speeds_mps: NDArray[np.float64]
    """(V,): speed there."""
    standing_steps: NDArray[np.int64]
    """(V,): number of steps for which the vehicle has stood."""


PriorityRule = Callable[[Situation], Sequence[int]]
"""Own priorities: ids in the order in which the vehicles plan. Those left out follow, smaller ids first."""


class Scenario:
    """A scenario that was read and checked; see `load_scenario`. Never changes: several threads may drive it."""

    def __init__(self, core: _core.Scenario) -> None:
        self._core = core

    @property
    def name(self) -> str:
        return self._core.name

    @property
    def steps(self) -> int:
        """Control steps of a run."""
        return self._core.steps

    @property
    def step_s(self) -> float:
        """Duration of a control step [s]."""
        return self._core.step_s

    @property
    def horizon_steps(self) -> int:
        """Steps that are planned ahead."""
        return self._core.horizon_steps

    @property
    def reference_speed_mps(self) -> float:
        return self._core.reference_speed_mps

    @property
    def priorities(self) -> str:
        """Name of the priority strategy."""
        return self._core.priorities

    @property
    def subgraph(self) -> str:
        """Name of the automaton's subgraph that is planned on."""
        return self._core.subgraph

    @property
    def engine(self) -> str:
        """Name of the search engine."""
        return self._core.engine

    @property
    def vehicles(self) -> list[Vehicle]:
        """By id."""
        return [Vehicle(**one) for one in self._core._vehicles]

    @property
    def trims(self) -> NDArray[np.float64]:
        """(T, 2): speed [m/s] and steering [rad] of the automaton's trims. Index 0 is trim 1 of the files."""
        return self._core.trims

    @property
    def obstacles_m(self) -> list[NDArray[np.float64]]:
        """Corners (n, 2) [m] of each obstacle."""
        return self._core.obstacles_m

    @property
    def vehicle_size_m(self) -> tuple[float, float]:
        """Length and width of every vehicle [m]."""
        return self._core.vehicle_size_m

    def __repr__(self) -> str:
        return f"<hlc.Scenario {self.name}: {len(self._core._vehicles)} vehicles, {self.steps} steps of {self.step_s} s>"


def load_scenario(scenario: PathLike, *, values: Optional[Mapping[str, Any]] = None, profile: str = "default",
                  priorities: Optional[str] = None, subgraph: Optional[str] = None, policy: Optional[str] = None,
                  engine: Optional[str] = None, steps: Optional[int] = None, cars: Optional[int] = None,
                  seed: Optional[int] = None, routes: Optional[str] = None) -> Scenario:
    """Reads and checks a scenario, and builds the part of its automaton that it needs (seconds).

    scenario: a file, or the name of a shipped one (`scenario_names`)
    values: other values for keys of the file, as {"horizon_steps": 6, "draw": {"cars": 5}}: a dict in it changes single
        keys, any other value replaces the file's, None removes the key. launch_scripts/scenarios/README.md has all keys
    The rest are the programs' flags of these names. priorities: name of one of our strategies; an own one is an
    argument of `drive` and `rollout`.

    Raises Error.
    """
    if callable(priorities):
        raise _core.Error(f"priorities = {priorities!r}, must be the name of one of our strategies; an own one is an "
                          "argument of drive and rollout")
    names = {"profile": profile, "priorities": priorities, "subgraph": subgraph, "policy": policy, "engine": engine,
             "routes": routes}
    for name, value in names.items():
        if value is not None:
            check_is(name, value, str, "a name")
    if values is not None:
        check_is("values", values, Mapping, "a dict of scenario keys")
    check_whole("steps", steps, 1, MOST_STEPS)
    check_whole("cars", cars, 1, 255)
    check_whole("seed", seed, 0, MOST_SEED)
    choices = _core.ScenarioChoices()
    choices.file = find(scenario, "scenarios", ".yaml")
    choices.profile = profile
    choices.priorities = priorities
    choices.subgraph = subgraph
    choices.policy = policy
    choices.engine = engine
    choices.steps = steps
    choices.cars = cars
    choices.seed = seed
    choices.routes = routes
    return Scenario(_core.load_scenario(choices, dict(values or {})))


def core_rule(rule: Optional[PriorityRule], scenario: Scenario) -> Optional[Callable[..., Sequence[int]]]:
    """The rule as _core calls it: with arrays and lists."""
    check_is("scenario", scenario, Scenario, "one of load_scenario")
    if rule is None:
        return None
    if not callable(rule):
        raise _core.Error(f"priorities = {rule!r}, must be a function; our strategies by name: load_scenario")
    speeds_mps = scenario.trims[:, 0]

    def called(ids: NDArray[np.int64], coupled: list[list[int]], poses: NDArray[np.float64], trims: NDArray[np.int64],
               standing_steps: NDArray[np.int64]) -> Sequence[int]:
        vehicles = tuple(int(one) for one in ids)
        return rule(Situation(vehicles=vehicles, coupled={v: tuple(c) for v, c in zip(vehicles, coupled)}, poses=poses,
                              speeds_mps=speeds_mps[trims], standing_steps=standing_steps))

    return called
