"""What evaluate and compare_priorities write into a folder: campaign.json, runs.csv and more."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from report import columns
from report.errors import InputError
from report.files import read_text
from report.priorities import Priorities, read_priorities
from report.rows import Rows

NO_POLICY = "none"
# Every run has one of these outcomes. Means are over the first alone.
LAP, NO_LAP, STUCK, FAILED = OUTCOMES = ("lap", "no_lap", "stuck", "failed")


@dataclass(frozen=True)
class Campaign:
    """Runs of scenarios, with a row for each run and for each of its cars."""

    origin: dict[str, str]
    runs: pd.DataFrame
    cars: pd.DataFrame


@dataclass(frozen=True)
class Sweep:
    """Runs of combinations of settings."""

    origin: dict[str, str]
    file: str
    scenarios: list[str]
    subgraphs: list[str]
    starts: int
    combinations: int
    automata: int
    settings: dict[str, list[str]]  # values by name
    tables: list[tuple[str, ...]]
    offered_trims: dict[str, list[int]]  # by subgraph of the automaton
    moving_trims: list[int]
    runs: pd.DataFrame


def with_outcome(runs: pd.DataFrame) -> pd.DataFrame:
    """The runs with their outcome, each the first of these that applies:

    `failed`: it does not count; `stuck`: some car was stuck at its end; `no_lap`: the car of highest priority drove
    no lap; `lap`.
    """
    conditions = [runs.failure != "", runs.stuck_vehicles > 0, runs.lap_s.isna() | runs.error_mean_mm.isna()]
    return runs.assign(outcome=np.select(conditions, [FAILED, STUCK, NO_LAP], LAP))


def with_lap(runs: pd.DataFrame) -> pd.DataFrame:
    """The runs that means are over."""
    return runs[runs.outcome == LAP]


def read_folder(folder: Path) -> Campaign | Sweep | Priorities:
    """@raises InputError for a folder that neither program wrote, and for rows of another format."""
    path = folder / "campaign.json"
    try:
        record = json.loads(read_text(path, "written by evaluate or compare_priorities"))
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path}: {type(error).__name__}, must be JSON as evaluate wrote it") from None
    kind = _field(record, "kind", str, path)
    origin = _field(record, "origin", dict, path)
    for key in ("command", "revision", "compiler", "processor"):
        _field(origin, key, str, f"{path}: origin")
    if kind == "campaign":
        return _read_campaign(folder, origin, _field(record, "campaign", dict, path))
    if kind == "sweep":
        return _read_sweep(folder, origin, _field(record, "sweep", dict, path))
    if kind == "priorities":
        return read_priorities(folder, origin, _priorities_plan(_field(record, "priorities", dict, path), path))
    raise InputError(f'{path}: kind = "{kind}", must be campaign, sweep or priorities')


def _priorities_plan(plan: dict[str, Any], path: Path) -> dict[str, Any]:
    place = f"{path}: priorities"
    kinds = {"scenario": str, "profile": str, "subgraph": str, "steps": int, "step_s": float, "horizon_steps": int,
             "max_levels": int, "runs": int}
    lists = {"strategies": str, "cars": int, "draws": int}
    return {name: _field(plan, name, kind, place) for name, kind in kinds.items()} \
        | {name: _list(plan, name, kind, place) for name, kind in lists.items()}


def _field(record: Any, key: str, kind: type, place: Path | str) -> Any:
    names = {str: "a text", dict: "an object", list: "a list", int: "an integer", float: "a number with a point"}
    value = record.get(key) if isinstance(record, dict) else None
    if not isinstance(value, kind) or isinstance(value, bool):
        raise InputError(f"{place}: {key} = {json.dumps(value)}, must be {names[kind]}")
    return value


def _list(record: Any, key: str, kind: type, place: str) -> list:
    values = _field(record, key, list, place)
    for i, _ in enumerate(values):
        _field(dict(enumerate(values)), i, kind, f"{place}: {key}")
    return values


def _read_runs(rows: Rows, measured: tuple[str, ...]) -> pd.DataFrame:
    runs = {"run": rows.integers("run"), "start": rows.integers("start"), "failure": rows.texts("failure")}
    runs |= {name: rows.texts(name) for name in columns.IDENTITY}
    counts = runs["failure"] == ""
    runs |= {name: rows.numbers(name) for name in columns.OPTIONAL + tuple(rows.names(columns.SHARE))}
    runs |= {name: rows.numbers(name, needed=counts) for name in columns.REQUIRED + measured}
    if len(rows) == 0:
        rows.fail("no rows", "with a row per run")
    if runs["run"].duplicated().any():
        rows.fail(f"run {runs['run'][runs['run'].duplicated()].iloc[0]} twice", "with a row per run")
    return with_outcome(pd.DataFrame(runs))


def _read_campaign(folder: Path, origin: dict[str, str], plan: dict[str, Any]) -> Campaign:
    """Every run of the plan has one row, and no other run has."""
    place = f"{folder / 'campaign.json'}: campaign"
    planned, starts = _field(plan, "runs", int, place), _field(plan, "starts", int, place)
    rows = Rows(folder / "runs.csv")
    runs = _read_runs(rows, columns.MEASURED)
    different = len(runs.drop_duplicates([*columns.IDENTITY, "start"]))
    if len(runs) != planned or different != planned:
        rows.fail(f"{len(runs)} rows, {different} different ones", f"{planned}, as campaign.json has it")
    if runs.start.max() >= starts:
        rows.fail(f"start {runs.start.max()}", f"in 0 ... {starts - 1}, as campaign.json has it")
    for name in ("subgraphs", "profiles"):
        allowed = _list(plan, name, str, place)
        fixed = runs[runs.policy == NO_POLICY] if name == "subgraphs" else runs
        for value in sorted(set(fixed[name[:-1]]) - set(allowed) if allowed else []):
            rows.fail(f'{name[:-1]} "{value}"', f"one of {', '.join(allowed)}, as campaign.json has it")
    cars = _read_cars(folder)
    if missing := set(runs.run[runs.outcome != FAILED]) - set(cars.run):
        raise InputError(f"{folder / 'cars.csv'}: no car of run {min(missing)}, must have a row per run and car")
    return Campaign(origin, runs, cars)


def _read_cars(folder: Path) -> pd.DataFrame:
    rows = Rows(folder / "cars.csv")
    cars = {name: rows.integers(name) for name in ("run", "start", "vehicle")}
    cars |= {name: rows.texts(name) for name in columns.IDENTITY + ("name",)}
    cars |= {name: rows.numbers(name) for name in columns.CAR_NUMBERS}
    cars["is_stuck"] = rows.texts("is_stuck", allowed=("true", "false")) == "true"
    return pd.DataFrame(cars)


def _read_sweep(folder: Path, origin: dict[str, str], plan: dict[str, Any]) -> Sweep:
    place = f"{folder / 'campaign.json'}: sweep"
    settings = {_field(one, "name", str, f"{place}: settings"): _list(one, "values", str, f"{place}: settings")
                for one in _list(plan, "settings", dict, place)}
    tables = [tuple(_list({"tables": one}, "tables", str, place)) for one in _list(plan, "tables", list, place)]
    for name in (name for table in tables for name in table if name not in settings):
        raise InputError(f'{place}: tables = "{name}", must be one of {", ".join(settings)}')
    for value in (one for one in settings.get("trims", []) if not one.replace(" ", "").isdecimal()):
        raise InputError(f'{place}: settings: trims = "{value}", must be numbers separated by blanks')
    trims = _field(plan, "trims", dict, place)
    offered = _field(trims, "offered", dict, f"{place}: trims")
    sweep = Sweep(
        origin=origin, file=_field(plan, "file", str, place), scenarios=_list(plan, "scenarios", str, place),
        subgraphs=_list(plan, "subgraphs", str, place), starts=_field(plan, "starts", int, place),
        combinations=_field(plan, "combinations", int, place), automata=_field(plan, "automata", int, place),
        settings=settings, tables=tables,
        offered_trims={name: _list(offered, name, int, f"{place}: trims: offered") for name in offered},
        moving_trims=_list(trims, "moving", int, f"{place}: trims"), runs=pd.DataFrame())
    return Sweep(**{**vars(sweep), "runs": _sweep_runs(folder, sweep)})


def _sweep_runs(folder: Path, sweep: Sweep) -> pd.DataFrame:
    """Settings, scenarios and subgraphs are categories in the order of the plan."""
    rows = Rows(folder / "runs.csv")
    runs = _read_runs(rows, ()).assign(combination=rows.integers("combination"))
    categories = {columns.SETTING + name: values for name, values in sweep.settings.items()}
    categories |= {"scenario": sweep.scenarios, "subgraph": sweep.subgraphs}
    for name, values in categories.items():
        runs[name] = pd.Categorical(rows.texts(name, allowed=values), categories=values, ordered=True)
    expected = sweep.combinations * len(sweep.scenarios) * len(sweep.subgraphs) * sweep.starts
    different = len(runs.drop_duplicates(["combination", "scenario", "subgraph", "start"]))
    if len(runs) != expected or different != expected:
        rows.fail(f"{len(runs)} rows, {different} different ones",
                  f"{expected}: {sweep.combinations} combinations, {len(sweep.scenarios)} scenarios, "
                  f"{len(sweep.subgraphs)} subgraphs, {sweep.starts} starts")
    return runs
