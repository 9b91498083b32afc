from pathlib import Path
from typing import Any, Callable, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from hlc.files import PathLike

fork_changes: str
criteria: list[str]

class Error(ValueError): ...

class ForkText:
    def __init__(self, from_step: int, changes: Sequence[str]) -> None: ...

class ScenarioChoices:
    file: PathLike
    profile: str
    engine: Optional[str]
    priorities: Optional[str]
    subgraph: Optional[str]
    policy: Optional[str]
    map_file: Optional[PathLike]
    steps: Optional[int]
    cars: Optional[int]
    seed: Optional[int]
    routes: Optional[str]

class Scenario:
    @property
    def name(self) -> str: ...
    @property
    def file(self) -> Path: ...
    @property
    def steps(self) -> int: ...
    @property
    def horizon_steps(self) -> int: ...
    @property
    def step_s(self) -> float: ...
    @property
    def reference_speed_mps(self) -> float: ...
    @property
    def subgraph(self) -> str: ...
    @property
    def priorities(self) -> str: ...
    @property
    def engine(self) -> str: ...
    @property
    def vehicle_size_m(self) -> tuple[float, float]: ...
    @property
    def trims(self) -> NDArray[np.float64]: ...
    @property
    def obstacles_m(self) -> list[NDArray[np.float64]]: ...
    @property
    def _vehicles(self) -> list[dict[str, Any]]: ...

def load_scenario(choices: ScenarioChoices, values: dict[str, Any]) -> Scenario: ...
def rollout(
    scenario: Scenario, steps: Optional[int], priorities: Optional[Callable[..., Sequence[int]]]
) -> dict[str, Any]: ...
def drive(
    scenario: Scenario,
    steps: Optional[int],
    priorities: Optional[Callable[..., Sequence[int]]],
    noise_seed: Optional[int],
    forks: Sequence[ForkText],
    out: Optional[Path],
) -> dict[str, Any]: ...

class AutomatonFile:
    step_s: float
    trims: NDArray[np.float64]
    maneuvers: list[dict[str, Any]]
    subgraphs: dict[str, list[str]]
    def save(self, path: PathLike) -> None: ...

def load_automaton(path: PathLike, subgraph: Optional[str]) -> AutomatonFile: ...
def plan_problem(
    path: PathLike,
    automaton: Optional[PathLike],
    engine: Optional[str],
    cost_to_go: Optional[str],
    max_expansions: Optional[int],
) -> dict[str, Any]: ...
def plan_joint_problem(
    path: PathLike,
    automaton: Optional[PathLike],
    engine: Optional[str],
    cost_to_go: Optional[str],
    max_expansions: Optional[int],
) -> dict[str, Any]: ...
def pareto_front(
    configuration: PathLike,
    from_trim: tuple[float, float],
    to_trim: tuple[float, float],
    criteria: list[Any],
    points: int,
    duration_s: Optional[float],
) -> dict[str, Any]: ...

class Environments:
    def __init__(self, scenario: Scenario, num_environments: int, episode_steps: int, random_starts: bool) -> None: ...
    num_environments: int
    num_cars: int
    num_actions: int
    num_features: int
    @property
    def poses(self) -> NDArray[np.float64]: ...
    def reset(self, seed: int) -> tuple[NDArray[Any], ...]: ...
    def step(self, actions: NDArray[np.int64]) -> tuple[NDArray[Any], ...]: ...
