"""Distance of runs to the cells of the paper's Table 2 that do not depend on the machine.

    D = 1/n sum_i l_i^2,   l_i = ln(ours_i / paper_i), at most ln 10 in size

so that twice as much and half as much count the same, whatever the unit; ours is the mean over the runs. exp(sqrt(D))
is the typical factor between our cells and the paper's. Runs of which one has no lap have no distance: an assumed one
would measure the laps, not the cells.
"""

import numpy as np
import pandas as pd

from report.paper import compared_cells
from report.results import LAP

MOST = np.log(10.0)


def cells_of(runs: pd.DataFrame, by: list[str]) -> pd.DataFrame:
    """A row per group of the columns `by` and cell: ours (NaN if one of the group's runs in it has no lap), paper,
    log_ratio. Cells without runs of their scenario and subgraph are left out."""
    cells = compared_cells()
    order = {cell: i for i, cell in enumerate(cells.drop(columns="paper").itertuples(index=False, name=None))}
    quantities = list(cells.quantity.unique())
    texts = runs.assign(scenario=runs.scenario.astype(object), subgraph=runs.subgraph.astype(object))
    long = texts.melt([*by, "scenario", "subgraph", "outcome"], quantities, "quantity", "ours")
    long = long.merge(cells, on=["scenario", "subgraph", "quantity"]).assign(has_lap=lambda row: row.outcome == LAP)
    means = long.groupby([*by, "scenario", "subgraph", "quantity"], observed=True).agg(
        ours=("ours", "mean"), paper=("paper", "first"), all_laps=("has_lap", "all")).reset_index()
    means["ours"] = means.ours.where(means.all_laps)
    # An error of 0 has no logarithm: it is as far off as a cell can be.
    ratio = np.log(means.ours.where(means.ours > 0.0, np.exp(-MOST) * means.paper) / means.paper)
    means["log_ratio"] = ratio.clip(-MOST, MOST).where(means.all_laps)
    means["order"] = [order[key] for key in zip(means.scenario, means.subgraph, means.quantity)]
    return means.sort_values([*by, "order"], kind="stable", ignore_index=True).drop(columns=["order", "all_laps"])


def distances_of(runs: pd.DataFrame, by: list[str]) -> pd.Series:
    """D of each group, NaN if one of its runs has no lap; empty if the paper has no cell for the runs."""
    cells = cells_of(runs, by)
    squares = cells.log_ratio.pow(2).groupby([cells[name] for name in by])
    return squares.sum(min_count=1).div(squares.size()).where(squares.count() == squares.size())


def factor(distance: float | pd.Series) -> float | pd.Series:
    """exp(sqrt(D))"""
    return np.exp(np.sqrt(distance))
