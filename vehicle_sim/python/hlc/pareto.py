"""Pareto fronts of maneuvers between two trims."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Callable, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from hlc import _core
from hlc.files import PathLike, check_whole, find

criteria: list[str] = _core.criteria
"""Names of our criteria."""

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class Cost:
    """An own running cost l(x, u) of a criterion J, the integral of l over the maneuver; J is minimised.

    x: (5,): x [m], y [m], heading [rad], speed [m/s], steering [rad], from the origin on
    u: (2,): acceleration [m/s^2], steering rate [rad/s]

    Called some 10 000 times for a front: far slower than ours. A wrong gradient ends without an optimum.
    """

    value: Callable[[Vector, Vector], float]
    """l(x, u)"""
    gradient: Callable[[Vector, Vector], tuple[Sequence[float], Sequence[float]]]
    """(dl/dx of 5 numbers, dl/du of 2)"""
    depends_on_pose: bool = False
    """l depends on x, y or the heading."""
    name: str = "own cost"
    """For plots."""


@dataclass(frozen=True)
class Front:
    """Points of a Pareto front of P maneuvers and K criteria, of two from the optimum of the second to the first's."""

    criteria: tuple[str, ...]
    objectives: NDArray[np.float64]
    """(P, K): J_1 ... J_K"""
    end: NDArray[np.float64]
    """(P, 3): where the maneuvers end: x [m], y [m], heading [rad] in the frame of the start."""
    is_dominated: NDArray[np.bool_]
    """(P,): another point of the front is better in all."""
    knee: int
    """Index of the point farthest from the line between the ends."""


def pareto_front(configuration: PathLike, from_trim: tuple[float, float], to_trim: tuple[float, float], *,
                 criteria: Sequence[Union[str, Cost]] = ("J1", "J2"), points: int = 31,
                 duration_s: Optional[float] = None) -> Front:
    """Optimal maneuvers between two trims for several criteria, by the epsilon-constraint method.

    configuration: of an automaton: a file, or the name of a shipped one, as "paper"; gives vehicle, limits, step
    from_trim, to_trim: speed [m/s] and steering [rad]
    criteria: names of ours (`hlc.criteria`), or own ones (Cost); two give an evenly spaced front
    points: number of points; with K > 2 criteria per bounded criterion
    duration_s: of every maneuver, instead of the configuration's step

    Raises Error; what a function of a Cost raises passes unchanged.
    """
    check_whole("points", points, 2, 1000)
    if len(criteria) < 2 or len({id(one) if isinstance(one, Cost) else one for one in criteria}) < len(criteria):
        raise _core.Error(f"criteria = {list(criteria)!r}, must be at least two different ones")
    if duration_s is not None and not (math.isfinite(duration_s) and 1e-3 <= duration_s <= 100):
        raise _core.Error(f"duration_s = {duration_s}, must be 0.001 ... 100")
    found = _core.pareto_front(find(configuration, "automata", ".yaml"), from_trim, to_trim, list(criteria), points,
                               duration_s)
    names = tuple(one.name if isinstance(one, Cost) else one for one in criteria)
    return Front(criteria=names, **found)
