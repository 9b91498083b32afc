"""Which combination of settings comes nearest to the paper's Table 2.

The nearest is chosen by the distance over the first half of the starts (rounded up), which is therefore biased; the
other half, which had no part in the choice, measures how near it really is. Combinations that lack a lap from some
start that chooses are left out; one that lacks a lap from a held-out start has no distance there.
"""

import numpy as np
import pandas as pd

from report.columns import SETTING
from report.groupings import MOST_VALUES
from report.inference import interval_of_mean
from report.markdown import number, table
from report.paper_distance import cells_of, distances_of, factor
from report.results import Sweep

MOST_SHOWN = 10


def judged_combinations(sweep: Sweep) -> pd.DataFrame | None:
    """By combination, the nearest first and those left out last: settings, `starts_without_lap`, `choosing` and
    `held_out` (D; NaN without such starts), `may_be_as_near` to the first. None if the paper has no cell for the runs.
    """
    choosing = choosing_runs(sweep)
    chosen_by = distances_of(sweep.runs[choosing], ["combination"])
    if chosen_by.empty:
        return None
    by_start = np.sqrt(distances_of(sweep.runs, ["combination", "start"])).unstack("start")
    settings = [SETTING + name for name in sweep.settings]
    judged = sweep.runs.groupby("combination")[settings].first()
    judged["starts_without_lap"] = by_start.isna().sum(axis=1)
    judged["choosing"] = chosen_by
    judged["held_out"] = np.nan
    judged["may_be_as_near"] = chosen_by.notna()
    judged = judged.sort_values("choosing", kind="stable")
    if choosing.all() or judged.choosing.isna().all():
        return judged
    judged["held_out"] = distances_of(sweep.runs[~choosing], ["combination"]).where(chosen_by.notna())
    held_out = by_start.loc[:, sorted(sweep.runs.start[~choosing].unique())]
    differences = held_out - held_out.loc[judged.index[0]]
    judged["may_be_as_near"] = [not np.isnan(one.choosing) and not _is_above_zero(differences.loc[combination].dropna())
                                for combination, one in judged.iterrows()]
    return judged


def choosing_runs(sweep: Sweep) -> pd.Series:
    """True for the runs of the first half of the starts."""
    return sweep.runs.start < (sweep.starts + 1) // 2


def _is_above_zero(values: pd.Series) -> bool:
    """False for a single value, too: it has no interval, and rules nothing out."""
    interval = interval_of_mean(values)
    return interval.mean - interval.half_width > 0.0


def comparison_markdown(sweep: Sweep) -> str:
    """The nearest combinations, the chosen one's cells, and what each value of a setting allows."""
    judged = judged_combinations(sweep)
    if judged is None:
        return ""
    ranked = judged.dropna(subset="choosing")
    left_out = judged[judged.choosing.isna()].starts_without_lap
    each = f" (each from {left_out.min()} to {left_out.max()} of {sweep.starts} starts)" if len(left_out) else ""
    text = (
        "## Next to the paper's Table 2\n\nFactor = exp(sqrt(D)), D = mean over the cells of (ln ours / paper)², each "
        f"at most (ln 10)²; ours is the mean over the starts. By so much a typical cell is off.\n\n**{len(left_out)} "
        f"of {len(judged)} combinations are left out**{each}: from some start that chooses a run failed, a car was "
        f"stuck, or there was no lap, so that they have no mean over these starts.\n\n")
    if ranked.empty:
        return text
    first_held_out = (sweep.starts + 1) // 2
    best = ranked.iloc[0]
    measured = ("with a single start nothing is held out to measure its distance" if np.isnan(best.held_out) else
                f"its distance is measured on the starts {first_held_out} to {sweep.starts - 1}, which had no part in "
                f"the choice")
    text += (
        f"The nearest of {len(ranked)} combinations is chosen by the starts 0 to {first_held_out - 1}; {measured}.\n\n"
        f"**The chosen combination is off by a factor of {_factor(best.held_out)} over the held-out starts** "
        f"({_factor(best.choosing)} over those that chose it).\n\n")
    text += _nearest(sweep, ranked) + "The chosen one's cells, the ratio that of the held-out starts:\n\n"
    text += _cells(sweep, ranked.index[0])
    text += (
        f"{ranked.may_be_as_near.sum()} of {len(ranked)} combinations may be as near: the 95 % interval of the "
        f"difference of sqrt(D) to the chosen one, start by start over the held-out starts, does not lie above 0 (each "
        f"interval alone, not corrected for their number). What each value of a setting allows:\n\n")
    return text + _values(sweep, judged)


def _factor(distance: float) -> str:
    return number(factor(distance), 3)


def _nearest(sweep: Sweep, ranked: pd.DataFrame) -> str:
    rows = [[i + 1, *(one[SETTING + name] for name in sweep.settings), _factor(one.choosing), _factor(one.held_out)]
            for i, (_, one) in enumerate(ranked.head(MOST_SHOWN).iterrows())]
    return table(["", *sweep.settings, "factor, choosing starts", "factor, held-out starts"], rows)


def _cells(sweep: Sweep, combination: int) -> str:
    is_chosen = sweep.runs.combination == combination
    choosing = choosing_runs(sweep)
    cells = cells_of(sweep.runs[is_chosen & choosing], ["combination"])
    held_out = cells_of(sweep.runs[is_chosen & ~choosing], ["combination"]).ours.reindex(cells.index)
    rows = [[one.scenario, one.subgraph, one.quantity, number(one.paper, 1), number(one.ours, 1), number(other, 1),
             number(other / one.paper, 2)] for one, other in zip(cells.itertuples(), held_out)]
    return table(["scenario", "subgraph", "quantity", "paper", "choosing starts", "held-out starts", "ratio"], rows)


def _values(sweep: Sweep, judged: pd.DataFrame) -> str:
    rows = []
    for name, values in sweep.settings.items():
        for value in values if len(values) <= MOST_VALUES else []:
            having = judged[judged[SETTING + name] == value]
            ranked = having.dropna(subset="choosing")
            cells = ["-"] * 4
            if len(ranked):
                cells = [_factor(ranked.choosing.iloc[0]), _factor(ranked.held_out.iloc[0]),
                         number(factor(ranked.choosing).median(), 3),
                         ranked.may_be_as_near.sum()]
            rows.append([name, value, len(having), len(having) - len(ranked), *cells])
    return table(["setting", "value", "combinations", "left out", "nearest: factor, choosing starts",
                  "the same, held-out starts", "median factor, choosing starts", "may be as near"], rows)
