"""Is a subgraph more accurate than the one that the sweep names before it, and when?

For every group of settings: in how many combinations (and scenarios) in which both drive a lap from every start the
mean error of the second is smaller, the median of second / first, and the mean of second - first over the pairs of runs
with the same settings and start in which both drive a lap. A family of claims are the comparisons of two subgraphs in
all groups of the sweep; interval, test and correction are those of paired_comparison.
"""

import pandas as pd

from report.groupings import Axes, columns_of, groupings_of, groups_of, settings_text
from report.inference import TEST_WORDS, Interval, p_text, power_text
from report.markdown import table
from report.paired_comparison import difference, with_families
from report.results import LAP, Sweep

WORDS = (
    "## Which subgraph is more accurate\n\nOf the combinations with which both drive a lap from every start, in how "
    "many the second subgraph has the smaller mean error, and the median of the second's error / the first's; then the "
    "difference second - first, start by start with all else equal, where both drive a lap, with the 95 % interval of "
    "its mean (each alone), where each start counts once. " + TEST_WORDS +
    "A family are all comparisons of two subgraphs in this sweep: "
)


def accuracy_data(sweep: Sweep) -> pd.DataFrame:
    """A row per group and two neighbours in the sweep's list of subgraphs; empty with a single subgraph."""
    runs = sweep.runs.assign(has_lap=sweep.runs.outcome == LAP)
    by_subgraph = {name: of_subgraph for name, of_subgraph in runs.groupby("subgraph", observed=True)}
    # The order of a grouping's settings makes no other group, and would count a claim twice.
    groupings = {frozenset(axes): axes for axes in reversed(groupings_of(sweep))}
    rows = []
    for axes in reversed(groupings.values()):
        for first, second in zip(sweep.subgraphs, sweep.subgraphs[1:]):
            keys = [*columns_of(tuple(sweep.settings)), "combination", "scenario", "start"]
            pairs = by_subgraph[second].merge(by_subgraph[first], on=keys, suffixes=("_second", "_first"))
            rows += [_row(axes, values, first, second, group) for values, group in groups_of(pairs, axes)]
    return with_families(pd.DataFrame(rows), ["first", "second"]) if rows else pd.DataFrame()


def _row(axes: Axes, values: tuple, first: str, second: str, pairs: pd.DataFrame) -> dict:
    by_combination = pairs.groupby(["combination", "scenario"], observed=True)
    have_laps = by_combination.has_lap_first.all() & by_combination.has_lap_second.all()
    ratios = (by_combination.error_mean_mm_second.mean() / by_combination.error_mean_mm_first.mean())[have_laps]
    both = pairs[pairs.has_lap_first & pairs.has_lap_second]
    return {"settings": axes, "values": values, "first": first, "second": second, "compared": len(ratios),
            "more_accurate": (ratios < 1.0).sum(), "median_ratio": ratios.median(),
            **difference(both.error_mean_mm_second - both.error_mean_mm_first, both.start, 2)}


def accuracy_markdown(data: pd.DataFrame) -> str:
    """@param data: of accuracy_data"""
    if data.empty:
        return ""
    families = data.drop_duplicates(["first", "second"])
    names = [f"{one.second} against {one.first}" for one in families.itertuples()]
    sizes = dict(zip(names, families.family))
    counts = "; ".join(f"{name} {count}" for name, count in sizes.items())
    starts = data.groupby(["first", "second"], sort=False).starts.max()
    weakest = {name: (int(count), int(sizes[name])) for name, count in zip(names, starts)}
    rows = [[settings_text(axes), ", ".join(values), *(_cell(one) for one in group.itertuples())]
            for (axes, values), group in data.groupby(["settings", "values"], sort=False)]
    return f"{WORDS}{counts}.\n\n" + power_text(weakest) + table(["setting", "value", *names], rows)


def _cell(row: tuple) -> str:
    if row.compared == 0 and row.starts == 0:
        return "-"
    ratio = f", {row.median_ratio:.2f}" if row.compared else ""
    interval = Interval(row.mean, row.half_width, row.starts)
    return f"{row.more_accurate} of {row.compared}{ratio}; {interval.text(2)} mm; {p_text(row.p_corrected, interval)}"
