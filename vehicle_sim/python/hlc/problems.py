"""Single planning problems."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Optional

import numpy as np
from numpy.typing import NDArray

from hlc import _core
from hlc.files import PathLike, check_whole, find


@dataclass(frozen=True)
class Plan:
    """The plan of one problem of n steps; without a plan its arrays have no rows."""

    status: str
    """optimal, budget (the search stopped early), unproven, fallback (no plan)."""
    reason: str
    """Of a fallback: infeasible, budget."""
    cost_m2: Optional[float]
    lower_bound_m2: Optional[float]
    """No plan costs less."""
    trims: NDArray[np.int64]
    """(n,): trim after each step, from 0 (the programs print them from 1)."""
    labels: list[str]
    """Of each step's maneuver."""
    poses: NDArray[np.float64]
    """(n, 3): x [m], y [m], heading [rad] after each step."""
    generated: int
    """Vertices of the search tree, the root included."""
    expanded: int
    start: NDArray[np.float64] = field(repr=False)
    """(3,): pose at the begin."""
    reference_m: NDArray[np.float64] = field(repr=False)
    """(n, 2): where the vehicle ought to be after each step."""
    obstacles_m: list[list[NDArray[np.float64]]] = field(repr=False)
    """Of each step the polygons (k, 2) that are occupied in it; empty: none at all."""


def plan_problem(problem: PathLike, *, automaton: Optional[PathLike] = None, engine: Optional[str] = None,
                 cost_to_go: Optional[str] = None, max_expansions: Optional[int] = None) -> Plan:
    """Solves one planning problem, with the plan, cost and counts of the program `plan_problem`.

    problem: a file (JSON), or the name of a shipped one, as "parked_car"
    automaton, engine, cost_to_go, max_expansions: instead of the file's

    Raises Error.
    """
    check_whole("max_expansions", max_expansions, 1, 10**12)
    return Plan(**_core.plan_problem(find(problem, "problems", ".json"), automaton, engine, cost_to_go,
                                     max_expansions))
