"""Whole runs: planning alone, or with simulated vehicles in closed loop."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from hlc import _core
from hlc.files import PathLike, as_path, check_is, check_whole, optional_module
from hlc.scenarios import MOST_STEPS, PriorityRule, Scenario, core_rule

if TYPE_CHECKING:
    import pandas

FORK_CHANGES: str = _core.fork_changes
"""One line for each form of a change of a `Fork`."""


@dataclass(frozen=True)
class Fork:
    """A "what if": from that step on something is different; before, the run is the same."""

    from_step: int
    """From 0."""
    changes: Sequence[str]
    """For example ["priorities=3,1", "obstacle=2.4,1.8,0.3,0.1"]; all forms: FORK_CHANGES."""


@dataclass(frozen=True)
class Run:
    """What was planned and driven, with arrays of S steps and V vehicles."""

    scenario: Scenario
    vehicles: tuple[int, ...]
    """Ids, ascending: the second axis of the arrays."""
    trace_sha256: str
    """Hash of all planned and driven poses. Equal hashes: bitwise identical runs; `drive` has that of the programs."""
    step_columns: dict[str, Any] = field(repr=False)
    trajectory_columns: Optional[dict[str, Any]] = field(repr=False)
    exit_code: int
    """0, or that of the programs for a run that ended with a fault."""
    reason: str
    """Of the fault, one line; empty: none."""
    arguments: dict[str, Any] = field(repr=False)
    folder: Optional[Path] = None
    """The run's folder; None: it was not written."""

    @property
    def summary(self) -> dict[str, Any]:
        """The result: summary.json of the run's folder (hlc_bridge/record/OUTPUT.md of the project has its keys)."""
        if self.folder is None:
            raise _core.Error("summary: of a run that was not written, must be one of drive(..., out=FOLDER)")
        file = self.folder / "summary.json"
        try:
            return json.loads(file.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise _core.Error(f"{file}: {error}, must be the summary of this run") from error

    @property
    def planned(self) -> NDArray[np.float64]:
        """(S, V, 3): planned x [m], y [m], heading [rad] at the begin of each step; NaN where a vehicle is gone."""
        return self._shaped("planned_x_m", "planned_y_m", "planned_heading_rad")

    @property
    def driven(self) -> NDArray[np.float64]:
        """(S, V, 3): true x [m], y [m], yaw [rad] then; NaN in a rollout, which has no simulated vehicles."""
        return self._shaped("driven_x_m", "driven_y_m", "driven_yaw_rad")

    @property
    def cost_m2(self) -> NDArray[np.float64]:
        """(S, V): cost of the plan found in each step [m^2], 0 where none was found."""
        return self._shaped("cost_m2")[..., 0]

    @property
    def level(self) -> NDArray[np.float64]:
        """(S, V): computation level: 0 planned first."""
        return self._shaped("level")[..., 0]

    @property
    def trims(self) -> NDArray[np.float64]:
        """(S, V): number of the planned trim at the begin of each step, from 0."""
        return self._shaped("trim")[..., 0]

    @property
    def planned_speed_mps(self) -> NDArray[np.float64]:
        """(S, V): planned speed at the begin of each step [m/s]."""
        trims = self.trims
        speeds = self.scenario.trims[np.nan_to_num(trims).astype(int), 0]
        return np.where(np.isnan(trims), np.nan, speeds)

    @property
    def steps(self) -> pandas.DataFrame:
        """A row per step and vehicle; units are in the names. status: planned, fallback, ...; reason: of a fallback;
        cost_m2, quality and gap_m2 of the plan found; generated and expanded vertices of its search."""
        pandas = optional_module("pandas")
        return pandas.DataFrame(self.step_columns)

    @property
    def trajectories(self) -> pandas.DataFrame:
        """A row per vehicle and tick of 20 ms: true pose (yaw), speed, throttle and steering in -1 ... 1. t_s is 0 at
        the first step; the vehicles have stood before. Guests are vehicles here, too. Empty in a rollout."""
        pandas = optional_module("pandas")
        return pandas.DataFrame(self.trajectory_columns or {})

    def _shaped(self, *columns: str) -> NDArray[np.float64]:
        step = self.step_columns["step"]
        vehicle = np.searchsorted(np.array(self.vehicles), self.step_columns["vehicle"])
        shape = (int(step.max()) + 1 if len(step) else 0, len(self.vehicles), len(columns))
        shaped = np.full(shape, np.nan)
        for i, name in enumerate(columns):
            shaped[step, vehicle, i] = self.step_columns[name]
        return shaped


def rollout(scenario: Scenario, *, steps: Optional[int] = None, priorities: Optional[PriorityRule] = None) -> Run:
    """Plans a whole run with vehicles that follow their plans perfectly: planning and coordination only.

    steps: instead of the scenario's
    priorities: an own rule, called in every step; slower than ours. Its exceptions end this run alone

    The interpreter's lock is released: runs in several threads run at the same time. Raises Error.
    """
    check_whole("steps", steps, 1, MOST_STEPS)
    rule = core_rule(priorities, scenario)
    found = _core.rollout(scenario._core, steps, rule)
    return _run_of(scenario, found, {"steps": steps, "priorities": priorities})


def drive(scenario: Scenario, *, steps: Optional[int] = None, priorities: Optional[PriorityRule] = None,
          noise_seed: Optional[int] = None, forks: Sequence[Fork] = (), out: Optional[PathLike] = None) -> Run:
    """Drives a whole run in closed loop, in logical time: controllers, messages, and simulated vehicles with the lab's
    identified dynamics. The result is that of the programs, bit for bit (`trace_sha256`).

    noise_seed: the vehicles measure with noise; vehicle i has the seed noise_seed + i. None: exactly
    forks: "what if"; see Fork
    out: a new or empty folder for the run's files, as run_lab.sh has them, without logs and messages: the page
        run.html, summary.json, and what the programs need to show, compare, explain and fork the run. Of a run whose
        priorities are a function the programs read none of it
    The rest as for `rollout`, locks and errors, too.
    """
    check_whole("steps", steps, 1, MOST_STEPS)
    check_whole("noise_seed", noise_seed, 0, 10**12)
    check_forks(forks)
    rule = core_rule(priorities, scenario)
    found = _core.drive(scenario._core, steps, rule, noise_seed,
                        [_core.ForkText(one.from_step, list(one.changes)) for one in forks],
                        None if out is None else as_path("out", out))
    return _run_of(scenario, found,
                   {"steps": steps, "priorities": priorities, "noise_seed": noise_seed, "forks": tuple(forks)}, out)


def replay(run: Run, *, forks: Sequence[Fork] = (), steps: Optional[int] = None,
           out: Optional[PathLike] = None) -> Run:
    """Drives a run of `drive` once more: without forks the same, bit for bit, with them a "what if".

    forks: added to those of the run
    steps: drive only so many
    out: as for drive
    """
    check_is("run", run, Run, "one of drive")
    check_forks(forks)
    if run.trajectory_columns is None:
        raise _core.Error("run: is a rollout, must be one of drive")
    arguments = dict(run.arguments)
    arguments["forks"] = (*arguments["forks"], *forks)
    if steps is not None:
        arguments["steps"] = steps
    return drive(run.scenario, **arguments, out=out)


def check_forks(forks: Sequence[Fork]) -> None:
    """Raises Error unless they are forks, whose changes are texts."""
    check_is("forks", forks, (list, tuple), "a list of hlc.Fork")
    for one in forks:
        check_is("forks: entry", one, Fork, "a hlc.Fork")
        check_whole("Fork.from_step", one.from_step, 0, MOST_STEPS)
        check_is("Fork.changes", one.changes, (list, tuple), "a list of texts")
        for text in one.changes:
            check_is("Fork.changes: entry", text, str, "a text")


def _run_of(scenario: Scenario, found: dict[str, Any], arguments: dict[str, Any],
            out: Optional[PathLike] = None) -> Run:
    return Run(scenario=scenario, vehicles=tuple(one.id for one in scenario.vehicles),
               trace_sha256=found["trace_sha256"], step_columns=found["steps"],
               trajectory_columns=found.get("trajectories"), exit_code=found.get("exit_code", 0),
               reason=found.get("reason", ""), arguments=arguments, folder=None if out is None else Path(out).absolute())
