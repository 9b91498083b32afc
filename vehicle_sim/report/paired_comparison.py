"""The effect of each value of a setting, against the setting's first one, in pairs of runs.

A pair are two runs of the same scenario, subgraph and start (hence seed) with all other settings equal. Of every
grouping the last setting's values are compared, for each combination of the others'. Differences are those of the pairs
in which both drove a lap; each start counts once, as the mean of its differences.

The test is Wilcoxon's signed-rank test over the starts: it needs no normal distribution, which the numbers of vertices
do not have, and weighs the differences' sizes, as a sign test does not. A family of claims are all comparisons of one
setting in one quantity within the sweep; p are corrected within it by Holm's method.
"""

import numpy as np
import pandas as pd

from report.columns import SETTING
from report.groupings import Axes, columns_of, groupings_of, groups_of
from report.inference import (LEVEL, TEST_WORDS, Interval, holm, interval_of_mean, means_of_starts, p_text,
                              power_text, signed_rank_p)
from report.markdown import table
from report.paper import Quantity
from report.paper_distance import distances_of
from report.results import LAP, Sweep

QUANTITIES = (
    Quantity("error [mm]", "error_mean_mm", 2),
    Quantity("lap [s]", "lap_s", 3),
    Quantity("max. generated", "generated_max", 0),
)
FACTOR_DECIMALS = 3
FACTOR = "log_factor"  # sqrt(D), the logarithm of the factor between our cells and the paper's
WORDS = (
    "## What a setting does, pair by pair\n\nEach value against the setting's first one, in pairs of runs from the "
    "same start with all else equal: means of the differences, of the pairs in which both drove a lap and no car was "
    "stuck, "
    "with 95 % intervals (each alone), where each start counts once. " + TEST_WORDS +
    "A family are all comparisons of one setting in one "
    "quantity of this sweep: "
)


def paired_data(sweep: Sweep) -> pd.DataFrame:
    """A row per comparison and quantity; empty if no setting has several values."""
    factors = np.sqrt(distances_of(sweep.runs, ["combination", "start"])).rename(FACTOR).reset_index()
    settings = sweep.runs.groupby("combination")[columns_of(tuple(sweep.settings))].first().reset_index()
    factors = factors.merge(settings, on="combination")  # of all runs of a combination from one start
    rows = [row for axes in groupings_of(sweep) if axes for row in _rows(sweep, axes, factors)]
    return with_families(pd.DataFrame(rows), ["setting", "quantity"]) if rows else pd.DataFrame()


def with_families(data: pd.DataFrame, family: list[str]) -> pd.DataFrame:
    """@param data: rows with `p`; @param family: the columns that rows of one family share. Adds its number of tests,
    the corrected p and whether it holds."""
    groups = data.groupby(family, sort=False).p
    corrected = groups.transform(holm)
    return data.assign(family=groups.transform("count"), p_corrected=corrected, holds=(corrected <= LEVEL).astype(int))


def difference(values: pd.Series, starts: pd.Series, decimals: int) -> dict[str, float]:
    """Mean, interval and p of differences. Those that are 0 with these decimals are ties: 64 starts could prove that
    the last digit of a sum differs."""
    by_start = means_of_starts(values, starts)
    interval = interval_of_mean(by_start)
    return {"starts": interval.count, "mean": interval.mean, "half_width": interval.half_width,
            "p": signed_rank_p(by_start.round(decimals))}


def pairs_of(runs: pd.DataFrame, sweep: Sweep, setting: str, keys: list[str]) -> pd.DataFrame:
    """Each run with another value than the setting's first, beside the run with the first one and all else equal, which
    a sample of combinations may not contain; columns of the two with `_second` and `_first`."""
    column = SETTING + setting
    same = columns_of(tuple(name for name in sweep.settings if name != setting)) + keys
    is_first = runs[column] == sweep.settings[setting][0]
    return runs[~is_first].merge(runs[is_first], on=same, suffixes=("_second", "_first"))


def _rows(sweep: Sweep, axes: Axes, factors: pd.DataFrame) -> list[dict]:
    *others, setting = axes
    column = f"{SETTING}{setting}_second"
    heading = {"setting": setting, "against": sweep.settings[setting][0], "with": tuple(others)}
    pairs = pairs_of(sweep.runs, sweep, setting, ["scenario", "subgraph", "start"])
    rows = []
    keys = [column, "scenario", "subgraph"]
    for (*within, value, scenario, subgraph), group in groups_of(pairs, tuple(others), keys):
        both = group[(group.outcome_first == LAP) & (group.outcome_second == LAP)]
        for one in QUANTITIES:
            rows.append(heading | {
                "within": tuple(within), "value": value, "scenario": scenario, "subgraph": subgraph,
                "quantity": one.key, "pairs": len(group), "laps_second": (group.outcome_second == LAP).sum(),
                "laps_first": (group.outcome_first == LAP).sum(), "pairs_with_laps": len(both),
                **difference(both[one.key + "_second"] - both[one.key + "_first"], both.start, one.decimals)})
    factor_pairs = pairs_of(factors, sweep, setting, ["start"])
    for (*within, value), group in groups_of(factor_pairs, tuple(others), [column]):
        change = (group[FACTOR + "_second"] - group[FACTOR + "_first"]).dropna()
        rows.append(heading | {"within": tuple(within), "value": value, "quantity": FACTOR, "pairs": len(group),
                               "pairs_with_laps": len(change), **difference(change, group.start, FACTOR_DECIMALS)})
    return rows


def paired_markdown(data: pd.DataFrame) -> str:
    """@param data: of paired_data"""
    if data.empty:
        return ""
    families = data.drop_duplicates(["setting", "quantity"])
    counts = families[families.quantity != FACTOR].groupby("setting", sort=False).family.max()
    text = WORDS + "; ".join(f"{name} {count} each" for name, count in counts.items()) + ".\n\n"
    of_family = data.groupby(["setting", "quantity"], sort=False)
    starts = of_family.starts.max().groupby("setting", sort=False).min()
    text += power_text({name: (int(starts[name]), int(count)) for name, count in counts.items()})
    keys = ["setting", "with", "within", "value", "scenario", "subgraph"]
    rows = []
    for _, group in data[data.quantity != FACTOR].groupby(keys, sort=False):
        one = group.iloc[0]
        cells = [_cell(row, quantity.decimals) for row, quantity in zip(group.itertuples(), QUANTITIES)]
        rows.append([one.setting, one.value, one.against, ", ".join(one.within), f"{one.scenario}, {one.subgraph}",
                     one.pairs, f"{one.laps_second:.0f}, {one.laps_first:.0f}", *cells])
    titles = ["setting", "value", "against", "with"]
    text += table([*titles, "scenario, subgraph", "pairs", "laps of both", *(one.name for one in QUANTITIES)], rows)
    factors = data[data.quantity == FACTOR]
    if factors.empty:
        return text
    return text + (
        "The same of the factors by which the runs of one start are off the paper's Table 2, as their ratio: below 1, "
        "the value comes nearer. Pairs of which a run has no lap are left out.\n\n" + table(
            [*titles, "pairs, of them left out", "factor, ratio"],
            [[one.setting, one.value, one.against, ", ".join(one.within),
              f"{one.pairs}, {one.pairs - one.pairs_with_laps}", _ratio(one)] for one in factors.itertuples()]))


def _cell(row: tuple, decimals: int) -> str:
    interval = Interval(row.mean, row.half_width, row.starts)
    return "-" if np.isnan(row.mean) else f"{interval.text(decimals)}; {p_text(row.p_corrected, interval)}"


def _ratio(row: tuple) -> str:
    if np.isnan(row.mean):
        return "-"
    low, high = np.exp(row.mean - row.half_width), np.exp(row.mean + row.half_width)
    bounds = "" if np.isnan(row.half_width) else f" [{low:.3f} … {high:.3f}]"
    p = p_text(row.p_corrected, Interval(row.mean, row.half_width, row.starts))
    return f"{np.exp(row.mean):.3f}{bounds}; {p}"
