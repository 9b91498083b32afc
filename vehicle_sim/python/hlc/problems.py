"""Planning problems of one vehicle, and joint ones of several."""

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


@dataclass(frozen=True)
class JointPlan:
    """Plans of several vehicles that do not meet, and what planning one after the other costs."""

    status: str
    """optimal; budget: the best ones found; fallback (no plans)."""
    reason: str
    """Of a fallback: infeasible, budget."""
    cost_m2: Optional[float]
    """Of all plans together."""
    lower_bound_m2: Optional[float]
    """No joint plan costs less."""
    alone_m2: Optional[float]
    """What the vehicles' plans cost without each other; None: one has none."""
    constant_order_m2: Optional[float]
    """What plans cost that are made in the file's order, each around those before it; None: one finds none."""
    best_order_m2: Optional[float]
    """The same in the best of all orders."""
    plans: list[Plan]
    """In the order of the file; empty without a plan. `generated`, `expanded`, `status` and `lower_bound_m2` are those
    of the vehicle's last search alone."""
    nodes: int
    """Of the constraint tree, that were taken."""
    expanded: int
    """Vertices in all searches after that for the best order."""


def plan_joint_problem(problem: PathLike, *, automaton: Optional[PathLike] = None, engine: Optional[str] = None,
                       cost_to_go: Optional[str] = None, max_expansions: Optional[int] = None) -> JointPlan:
    """Solves a joint problem of 1 to 8 vehicles exactly, with the plans, costs and counts of the program `plan_problem`.

    problem: a file (JSON), or the name of a shipped one, as "two_at_a_crossing"
    automaton, engine, cost_to_go: instead of the file's
    max_expansions: of all searches together; None: 20 000 000

    Raises Error.
    """
    check_whole("max_expansions", max_expansions, 1, 10**12)
    found = _core.plan_joint_problem(find(problem, "problems", ".json"), automaton, engine, cost_to_go, max_expansions)
    return JointPlan(**{**found, "plans": [Plan(**one) for one in found["plans"]]})
