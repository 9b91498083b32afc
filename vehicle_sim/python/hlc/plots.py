"""Figures, with matplotlib. Each function draws into the given axes, or new ones, and returns them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Mapping, Optional, Union

import numpy as np

from hlc._core import Error
from hlc.files import check_is, optional_module
from hlc.pareto import Front
from hlc.problems import Plan
from hlc.runs import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LINES = ("-", "--", ":", "-.")


def _axes(axes: Optional[Axes]) -> Axes:
    if axes is not None:
        return axes
    return optional_module("matplotlib.pyplot").subplots()[1]


def _named(runs: Union[Run, Mapping[str, Run]]) -> dict[str, Run]:
    named = {"": runs} if isinstance(runs, Run) else runs
    check_is("runs", named, Mapping, "a run, or runs by name")
    if not named:
        raise Error("runs: none, must be one at least")
    for name, run in named.items():
        check_is(f"runs: {name}", run, Run, "a run")
    return dict(named)


def plot_paths(runs: Union[Run, Mapping[str, Run]], axes: Optional[Axes] = None) -> Axes:
    """Paths of the vehicles over their routes; several runs by name, each with its own kind of line. A vehicle whose name
    is a colour has that one."""
    named = _named(runs)
    axes = _axes(axes)
    is_color_like = optional_module("matplotlib.colors").is_color_like
    for line, (name, run) in zip(LINES * len(named), named.items()):
        vehicles = run.scenario.vehicles
        poses = run.planned if np.isnan(run.driven).all() else run.driven
        for i, vehicle in enumerate(vehicles):
            if line == LINES[0]:
                route = np.vstack([vehicle.route_m, vehicle.route_m[:1]]) if vehicle.is_closed else vehicle.route_m
                axes.plot(*route.T, color="0.85", linewidth=4, zorder=0)
            colour = vehicle.name if is_color_like(vehicle.name) else f"C{i}"
            axes.plot(poses[:, i, 0], poses[:, i, 1], line, color=colour, label=f"{vehicle.name} {name}".strip())
        for area in run.scenario.obstacles_m:
            axes.fill(*area.T, color="0.4")
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.legend()
    return axes


def plot_ways(runs: Union[Run, Mapping[str, Run]], axes: Optional[Axes] = None) -> Axes:
    """Planned way [m] of all vehicles together over time: steeper is faster, and what ends higher has made detours, if
    all have arrived. Several runs by name, each with its own kind of line."""
    named = _named(runs)
    axes = _axes(axes)
    for line, (name, run) in zip(LINES * len(named), named.items()):
        way = np.linalg.norm(np.diff(run.planned[..., :2], axis=0), axis=2)
        t = run.scenario.step_s * np.arange(len(way) + 1)
        axes.plot(t, np.concatenate([[0.0], np.cumsum(np.nansum(way, axis=1))]), line, label=name)
    axes.set_title("steeper is faster")
    axes.set_xlabel("t [s]")
    axes.set_ylabel("way of all vehicles [m]")
    if len(named) > 1:
        axes.legend()
    return axes


def plot_front(front: Front, axes: Optional[Axes] = None) -> Axes:
    """A front of two criteria, with its knee."""
    axes = _axes(axes)
    axes.plot(*front.objectives[:, :2].T, ".-")
    axes.plot(*front.objectives[front.knee, :2], "o", label="knee")
    axes.set_xlabel(front.criteria[0])
    axes.set_ylabel(front.criteria[1])
    axes.legend()
    return axes


def plot_plan(plan: Plan, axes: Optional[Axes] = None) -> Axes:
    """Reference points, obstacles of all steps, and the plan."""
    axes = _axes(axes)
    for step in plan.obstacles_m:
        for area in step:
            axes.fill(*area.T, color="0.5", alpha=0.3, linewidth=0)
    axes.plot(*plan.reference_m.T, "x", color="0.4", label="reference")
    axes.plot(*np.vstack([plan.start, plan.poses])[:, :2].T, "o-", label=f"plan, {plan.status}")
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.legend()
    return axes
