"""Environments for learners: a learner chooses the trims of the cars instead of the planner."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from hlc import _core
from hlc.files import check_is, check_whole
from hlc.scenarios import MOST_SEED, MOST_STEPS, Scenario


class StepResult(NamedTuple):
    """Of E environments with C cars each."""

    observations: NDArray[np.float32]
    """(E, C, F): see Environments."""
    rewards: NDArray[np.float32]
    """(E, C) [m^2]"""
    terminated: NDArray[np.bool_]
    """(E, C): the car met another one or an obstacle, or left its lanes."""
    truncated: NDArray[np.bool_]
    """(E,): the episode's steps are over, or a route ended."""
    permitted: NDArray[np.bool_]
    """(E, C, A): actions that the next step can take as they are."""
    final_observations: NDArray[np.float32]
    """(E, C, F): where an episode ended in this step its last observations, else `observations`."""


class Environments:
    """E independent copies of a scenario, stepped together in one call of compiled code.

    In each control step the learner chooses for every car which trim comes next (0 ... A - 1, a trim of
    `Scenario.trims`); the car follows the maneuver of the scenario's subgraph that leads there perfectly. A trim without
    an edge from the present one brakes as hard as possible: `permitted` has which ones have one.

    Reward: minus the squared distance [m^2] from the point of the route that is one step at the reference speed ahead of
    the car's place, the planner's cost of a step; one less in the step in which the car is terminated.

    An episode ends with the first terminated car, or after `episode_steps`; the next one begins at once, so that the
    observations are its first ones; the last ones of the episode that ended are the final observations. Cars start
    standing, at random places of their routes.

    Observation, F = 10 + 5 (C - 1) numbers in the car's frame (x forward, y left): speed [m/s], steering [rad]; x and y
    [m] of its route 0.2, 0.4, 0.8 and 1.6 m ahead; of each other car x, y [m], cosine and sine of its relative heading,
    speed [m/s].
    """

    def __init__(self, scenario: Scenario, num_environments: int, *, episode_steps: int = 150,
                 random_starts: bool = True) -> None:
        """random_starts: False: the scenario's. Raises Error if the scenario has guests."""
        check_whole("num_environments", num_environments, 1, 1_000_000)
        check_whole("episode_steps", episode_steps, 1, MOST_STEPS)
        check_is("scenario", scenario, Scenario, "one of load_scenario")
        self._core = _core.Environments(scenario._core, num_environments, episode_steps, random_starts)
        self.num_environments: int = num_environments
        self.num_cars: int = self._core.num_cars
        self.num_actions: int = self._core.num_actions
        self.num_features: int = self._core.num_features

    def reset(self, seed: int = 1) -> StepResult:
        """Begins new episodes everywhere; the same seed and actions give the same results. To be called first."""
        check_whole("seed", seed, 0, MOST_SEED)
        return StepResult(*self._core.reset(seed))

    def step(self, actions: NDArray[np.int64]) -> StepResult:
        """actions: (E, C). The interpreter's lock is released: two objects in two threads use two cores. Raises Error
        for an action that is no trim."""
        return StepResult(*self._core.step(actions))

    @property
    def poses(self) -> NDArray[np.float64]:
        """(E, C, 3): x [m], y [m], heading [rad]."""
        return self._core.poses


class Discrete:
    """Stands for gymnasium.spaces.Discrete where gymnasium is not installed: actions 0 ... n - 1."""

    def __init__(self, n: int) -> None:
        self.n = n
        self._random = np.random.default_rng()

    def seed(self, seed: Optional[int] = None) -> None:
        self._random = np.random.default_rng(seed)

    def sample(self, mask: Optional[NDArray[Any]] = None) -> int:
        """A random action, of those that the mask permits."""
        if mask is None:
            return int(self._random.integers(self.n))
        return int(self._random.choice(np.flatnonzero(mask)))

    def contains(self, action: Any) -> bool:
        return 0 <= int(action) < self.n


class Box:
    """Stands for gymnasium.spaces.Box where gymnasium is not installed: any numbers of that shape."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.shape = shape
        self.dtype = np.dtype(np.float32)

    def contains(self, observation: Any) -> bool:
        return bool(np.shape(observation) == self.shape and np.all(np.isfinite(observation)))


def _spaces(num_actions: int, num_features: int) -> tuple[Any, Any]:
    try:
        from gymnasium import spaces  # type: ignore
    except ImportError:
        return Box((num_features,)), Discrete(num_actions)
    return spaces.Box(-np.inf, np.inf, (num_features,), np.float32), spaces.Discrete(num_actions)


class ParallelEnv:
    """One environment in the shape of PettingZoo's parallel interface; it needs neither PettingZoo nor gymnasium.

    Agents are the scenario's vehicles, by name. Actions, observations and rewards are those of `Environments`; infos
    have `action_mask` (A,) int8. When the episode ends, for any car, it ends for all.
    """

    metadata: dict[str, Any] = {"name": "hlc", "is_parallelizable": True, "render_modes": []}
    render_mode: Optional[str] = None

    def __init__(self, scenario: Scenario, *, episode_steps: int = 150, random_starts: bool = True) -> None:
        self._all = Environments(scenario, 1, episode_steps=episode_steps, random_starts=random_starts)
        self.possible_agents: list[str] = [one.name for one in scenario.vehicles]
        self.agents: list[str] = []
        spaces = [_spaces(self._all.num_actions, self._all.num_features) for _ in self.possible_agents]
        self.observation_spaces: dict[str, Any] = {a: s[0] for a, s in zip(self.possible_agents, spaces)}
        self.action_spaces: dict[str, Any] = {a: s[1] for a, s in zip(self.possible_agents, spaces)}
        self._seed = 0

    def observation_space(self, agent: str) -> Any:
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Any:
        return self.action_spaces[agent]

    @property
    def unwrapped(self) -> ParallelEnv:
        return self

    @property
    def num_agents(self) -> int:
        return len(self.agents)

    @property
    def max_num_agents(self) -> int:
        return len(self.possible_agents)

    def reset(self, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None
              ) -> tuple[dict[str, NDArray[np.float32]], dict[str, dict[str, Any]]]:
        """(observations, infos) of a new episode; without a seed another one than before."""
        self._seed = self._seed + 1 if seed is None else seed
        self.agents = list(self.possible_agents)
        result = self._all.reset(self._seed)
        return self._by_agent(result.observations[0]), self._infos(result)

    def step(self, actions: dict[str, int]) -> tuple[dict[str, Any], ...]:
        """(observations, rewards, terminations, truncations, infos), each by agent. At the end of an episode the
        observations are its last ones; the action masks are of no use then."""
        if not self.agents:
            raise _core.Error("step: the episode is over, must be reset")
        missing = [agent for agent in self.agents if agent not in actions]
        if missing:
            raise _core.Error(f"actions: none of {', '.join(missing)}, must be of all agents")
        result = self._all.step(np.array([[int(actions[agent]) for agent in self.agents]]))
        is_terminated = bool(result.terminated.any())
        is_truncated = bool(result.truncated[0])
        answer = (self._by_agent(result.final_observations[0]), self._by_agent(result.rewards[0].astype(float)),
                  {agent: is_terminated for agent in self.agents}, {agent: is_truncated for agent in self.agents},
                  self._infos(result))
        if is_terminated or is_truncated:
            self.agents = []
        return answer

    def render(self) -> None:
        """Draws nothing."""

    def close(self) -> None:
        """Has nothing to close."""

    def _by_agent(self, rows: Any) -> dict[str, Any]:
        return dict(zip(self.possible_agents, rows))

    def _infos(self, result: StepResult) -> dict[str, dict[str, Any]]:
        return self._by_agent([{"action_mask": mask.astype(np.int8)} for mask in result.permitted[0]])
