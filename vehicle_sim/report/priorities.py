"""What compare_priorities writes, and its table: what the order of planning changes."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from report import markdown
from report.rows import Rows

CELL = ["cars", "strategy"]
CLOSED_M2 = 1e-9  # JointGap::kRounding_m2
ANY_EXCESS_PERCENT = 1e4  # where the bound is hardly more than rounding


@dataclass(frozen=True)
class Priorities:
    """Runs of strategies, each with its steps and the joint gaps of its coupled cars."""

    origin: dict[str, str]
    plan: dict[str, object]
    runs: pd.DataFrame
    steps: pd.DataFrame
    gaps: pd.DataFrame


def read_priorities(folder: Path, origin: dict[str, str], plan: dict[str, object]) -> Priorities:
    """Every run of the plan has one row and all its steps. @raises InputError"""
    rows = Rows(folder / "runs.csv")
    runs = {name: rows.integers(name) for name in ("run", "cars", "draw", "steps", "planned", "vehicle_steps",
                                                   "compared_steps", "worse_steps")}
    runs["strategy"] = rows.texts("strategy", allowed=plan["strategies"])
    runs |= {name: rows.numbers(name, needed=runs["run"] >= 0) for name in ("driven_m", "cost_m2", "optimal_order_m2")}
    runs["stands"] = rows.numbers("deadlock_step").notna()
    runs = pd.DataFrame(runs)
    different = len(runs.drop_duplicates(CELL + ["draw"]))
    if len(runs) != plan["runs"] or different != plan["runs"] or (runs.run != runs.index).any():
        rows.fail(f"{len(runs)} rows, {different} different ones", f"{plan['runs']} by number, as campaign.json has it")
    for name, allowed in {"cars": plan["cars"], "draw": plan["draws"], "steps": [plan["steps"]]}.items():
        if not runs[name].isin(allowed).all():
            rows.fail(f"{name} = {runs[name][~runs[name].isin(allowed)].iloc[0]}",
                      f"one of {', '.join(map(str, allowed))}, as campaign.json has it")
    rows = Rows(folder / "steps.csv")
    steps = pd.DataFrame({name: rows.integers(name) for name in ("run", "step", "levels")}
                         | {"step_ms": rows.numbers("step_ms", needed=pd.Series(True, index=range(len(rows))))})
    if not steps.groupby("run").step.count().reindex(runs.run, fill_value=0).eq(runs.steps).all():
        rows.fail(f"{len(steps)} rows", f"{runs.steps.sum()}: every step of every run of runs.csv")
    if steps.duplicated(["run", "step"]).any():
        rows.fail("a step twice", "with a row per run and step")
    if not steps.run.isin(runs.run).all():
        rows.fail(f"run {steps.run[~steps.run.isin(runs.run)].iloc[0]}", "a run of runs.csv")
    rows = Rows(folder / "gaps.csv")
    gaps = pd.DataFrame({"run": rows.integers("run"), "vehicles": rows.integers("vehicles")}
                        | {name: rows.numbers(name, needed=pd.Series(True, index=range(len(rows))))
                           for name in ("cost_m2", "bound_m2")})
    if (gaps.bound_m2 < 0.0).any():
        rows.fail(f"bound_m2 = {gaps.bound_m2.min()}", ">= 0")
    if not gaps.run.isin(runs.run).all():
        rows.fail(f"run {gaps.run[~gaps.run.isin(runs.run)].iloc[0]}", "a run of runs.csv")
    of_cell = runs[["run", *CELL]]
    return Priorities(origin, plan, runs, steps.merge(of_cell, on="run"), gaps.merge(of_cell, on="run"))


def excess_percent(cost_m2: pd.Series, bound_m2: pd.Series) -> pd.Series:
    """JointGap::excess [%]: infinite above a bound of 0."""
    with np.errstate(divide="ignore", invalid="ignore"):
        excess = 100.0 * (cost_m2 / bound_m2 - 1.0)
    return excess.where(bound_m2 > 0.0, np.inf).where(cost_m2 > bound_m2 + CLOSED_M2, 0.0)


def nearest_rank(values: pd.Series, share: float) -> float:
    """The smallest value that this share of all does not exceed; NaN of none."""
    ordered = np.sort(values.to_numpy(dtype=float))
    return float(ordered[int(np.ceil(share * len(ordered))) - 1]) if len(ordered) else np.nan


def priorities_data(results: Priorities) -> pd.DataFrame:
    """A row per number of cars and strategy, in the order of the plan."""
    step_s, table = results.plan["step_s"], []
    for (cars, strategy), runs in results.runs.groupby(CELL):
        steps = results.steps[results.steps.run.isin(runs.run)]
        gaps = results.gaps[results.gaps.run.isin(runs.run)]
        excess = excess_percent(gaps.cost_m2, gaps.bound_m2)
        total = excess_percent(pd.Series([gaps.cost_m2.sum()]), pd.Series([gaps.bound_m2.sum()]))[0]
        driven_steps = (runs.vehicle_steps - runs.vehicle_steps // runs.steps).sum()
        table.append({
            "cars": cars, "strategy": strategy, "runs": len(runs), "step_mean_ms": steps.step_ms.mean(),
            "step_median_ms": steps.step_ms.median(), "step_p99_ms": nearest_rank(steps.step_ms, 0.99),
            "levels_mean": steps.levels.mean(), "levels_max": steps.levels.max(),
            "speed_mps": runs.driven_m.sum() / driven_steps / step_s if driven_steps else np.nan,
            "standing_runs": int(runs.stands.sum()), "compared_steps": runs.compared_steps.sum(),
            "cost_ratio": runs.cost_m2.sum() / runs.optimal_order_m2.sum() if runs.compared_steps.sum() else np.nan,
            "worse_steps": runs.worse_steps.sum(), "cases": len(gaps),
            "excess_percent": total if len(gaps) else np.nan, "excess_median_percent": nearest_rank(excess, 0.5),
            "excess_p99_percent": nearest_rank(excess, 0.99),
            "proven_percent": 100.0 * (excess == 0.0).mean() if len(gaps) else np.nan})
    data = pd.DataFrame(table)
    order = {name: place for place, name in enumerate(results.plan["strategies"])}
    return data.sort_values(CELL, key=lambda column: column.map(order) if column.name == "strategy" else column,
                            ignore_index=True)


def _excess(percent: float) -> str:
    return "any amount" if percent >= ANY_EXCESS_PERCENT else markdown.number(percent, 1)


def priorities_markdown(results: Priorities, data: pd.DataFrame) -> str:
    """The page's text."""
    plan = results.plan
    levels = f", at most {plan['max_levels']} levels" if plan["max_levels"] else ""
    text = (f"# Priorities: {plan['scenario']}\n\n{plan['steps']} steps of {plan['step_s']:g} s, horizon "
            f"{plan['horizon_steps']}, subgraph {plan['subgraph']}, profile {plan['profile']}, {len(plan['draws'])} "
            f"draws of the cars{levels}.\n\n")
    titles = ["cars", "strategy", "step of all cars [ms]: mean", "median", "p99", "levels, mean", "largest",
              "speed [m/s]", "runs with a car that stood", "cost / optimal order (steps)",
              "steps with fewer plans", "above the joint optimum, at most [%]: in all", "median", "p99",
              "proven to be it [%] (cases)"]
    rows = [[one.cars, f"`{one.strategy}`", markdown.number(one.step_mean_ms, 2),
             markdown.number(one.step_median_ms, 2), markdown.number(one.step_p99_ms, 2),
             markdown.number(one.levels_mean, 1), one.levels_max, markdown.number(one.speed_mps, 3),
             f"{one.standing_runs} of {one.runs}",
             f"{one.cost_ratio:.4f} ({one.compared_steps})" if one.compared_steps else "-", one.worse_steps,
             _excess(one.excess_percent), _excess(one.excess_median_percent), _excess(one.excess_p99_percent),
             f"{markdown.number(one.proven_percent, 1)} ({one.cases})"] for one in data.itertuples()]
    return text + markdown.table(titles, rows) + (
        "A step: processor time of planning and coordination of all cars, one after the other in one process. A car "
        "that stood: for three horizons, also one that has arrived. The optimal order: of the same steps from the same "
        "situations, where no more than 5 cars are coupled and as many found a plan. The joint optimum: the sum of the "
        "costs is compared with the sum of the bounds (planner/coordination/joint_gap.hpp), a case is a step of cars "
        "that are coupled with each other.\n\n")
