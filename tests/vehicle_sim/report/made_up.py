"""Made-up runs for the tests, and seeds that are printed."""

import csv
import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd

from report import columns
from report.results import NO_POLICY, Campaign, Sweep, with_outcome

ORIGIN = {"command": "evaluate", "revision": "0", "compiler": "GCC", "processor": "none"}


def seeds(count: int) -> Iterator[tuple[int, np.random.Generator]]:
    """The generators of a property test."""
    for seed in range(1, count + 1):
        print(f"seed {seed}")
        yield seed, np.random.default_rng(seed)


def run(start: int = 0, **values: object) -> dict[str, object]:
    """A run with a lap; other values by name."""
    row: dict[str, object] = {"run": 0, "scenario": "s", "profile": "default", "subgraph": "A", "policy": NO_POLICY,
                              "start": start, "failure": "", "share.A": 1.0}
    row |= {name: 1.0 for name in columns.OPTIONAL + columns.REQUIRED + columns.MEASURED}
    zones = {"above_limit_share": np.nan, "clearly_above_limit_share": np.nan, "above_limit_max_mps": np.nan}
    return row | zones | {"stuck_vehicles": 0, "lap_s": 15.0, "error_mean_mm": 20.0} | values


def frame(runs: list[dict[str, object]]) -> pd.DataFrame:
    """With numbers of runs and outcomes."""
    return with_outcome(pd.DataFrame(runs).assign(run=range(len(runs))))


def campaign(runs: list[dict[str, object]]) -> Campaign:
    """Of one car, `red`, that is stuck if any is."""
    rows = frame(runs)
    cars = rows[["run", "start", *columns.IDENTITY]].assign(vehicle=1, name="red", is_stuck=rows.stuck_vehicles > 0)
    return Campaign(ORIGIN, rows, cars)


def sweep(settings: dict[str, list[str]], runs: list[dict[str, object]], **plan: object) -> Sweep:
    """@param runs: with a column `set.<name>` for each setting"""
    rows = frame(runs)
    names = [columns.SETTING + name for name in settings]
    combinations = rows[names].drop_duplicates().assign(combination=lambda found: range(len(found)))
    rows = rows.merge(combinations, on=names)
    categories = {columns.SETTING + name: values for name, values in settings.items()}
    categories |= {name: list(rows[name].unique()) for name in ("scenario", "subgraph")}
    for name, values in categories.items():
        rows[name] = pd.Categorical(rows[name], categories=values, ordered=True)
    plan = {"file": "made_up.yaml", "tables": [], "offered_trims": {}, "moving_trims": [], "automata": 1} | plan
    return Sweep(origin=ORIGIN, scenarios=categories["scenario"], subgraphs=categories["subgraph"],
                 starts=rows.start.nunique(), combinations=len(combinations), settings=settings, runs=rows, **plan)


CAR = {"run": 0, "scenario": "s", "profile": "default", "subgraph": "A", "policy": NO_POLICY, "start": 0, "vehicle": 1,
       "name": "red", "is_stuck": "false"} | {name: 1 for name in columns.CAR_NUMBERS}


def write_csv(path: Path, rows: list[dict[str, object]]) -> None:
    """As evaluate does: absent values are empty."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows({name: "" if value != value else value for name, value in row.items()} for row in rows)


def write_campaign(folder: Path, runs: list[dict[str, object]] | None = None,
                   changes: dict[str, object] | None = None) -> None:
    """A folder as evaluate writes it. @param changes: of the plan"""
    runs = [run()] if runs is None else runs
    plan = {"runs": len(runs), "starts": 9, "subgraphs": ["A"], "profiles": ["default"]} | (changes or {})
    (folder / "campaign.json").write_text(json.dumps({"kind": "campaign", "origin": ORIGIN, "campaign": plan}))
    write_csv(folder / "runs.csv", [row | {"run": i} for i, row in enumerate(runs)])
    write_csv(folder / "cars.csv", [CAR | {"run": i} for i, _ in enumerate(runs)])


def write_sweep(folder: Path, **changes: object) -> None:
    """Of one setting with two values and two starts. @param changes: of the plan"""
    plan = {"file": "rules.yaml", "scenarios": ["s"], "subgraphs": ["A"], "starts": 2, "combinations": 2, "automata": 1,
            "settings": [{"name": "search", "values": ["2022", "best_first"]}], "tables": [["search"]],
            "trims": {"offered": {"A": [1, 2]}, "moving": [2]}} | changes
    (folder / "campaign.json").write_text(json.dumps({"kind": "sweep", "origin": ORIGIN, "sweep": plan}))
    rows = [run(start, **{"combination": i, "set.search": value})
            for i, value in enumerate(["2022", "best_first"]) for start in (0, 1)]
    write_csv(folder / "runs.csv", [row | {"run": i} for i, row in enumerate(rows)])
