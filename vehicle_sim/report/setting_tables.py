"""Results of a sweep by the values of settings: means over the starts with a lap, with 95 % intervals."""

import pandas as pd

from report.groupings import groupings_of, groups_of, settings_text
from report.inference import interval_over_starts
from report.markdown import number, table
from report.paper import Quantity
from report.results import FAILED, OUTCOMES, Sweep, with_lap

QUANTITIES = (
    Quantity("error, planned [mm]", "error_mean_mm", 1),
    Quantity("error, driven [mm]", "driven_error_mean_mm", 1),
    Quantity("lap [s]", "lap_s", 2),
    Quantity("max. generated", "generated_max", 0),
)


def setting_data(sweep: Sweep) -> pd.DataFrame:
    """A row per grouping, scenario, group, subgraph and quantity, in this order; `values` as a tuple."""
    rows = []
    for scenario, of_scenario in sweep.runs.groupby("scenario", observed=True):
        for axes in groupings_of(sweep):
            for (*values, subgraph), runs in groups_of(of_scenario, axes, ["subgraph"]):
                counts = runs.outcome.value_counts()
                heading = {"scenario": scenario, "settings": axes, "values": tuple(values), "subgraph": subgraph,
                           "combinations": runs.combination.nunique(), "runs": len(runs)}
                heading |= {outcome: counts.get(outcome, 0) for outcome in OUTCOMES}
                heading["most_in_a_step"] = runs.generated_sum_max[runs.outcome != FAILED].max()
                laps = with_lap(runs)
                for one in QUANTITIES:
                    interval = interval_over_starts(one.values(laps), laps.start)
                    rows.append(heading | {"quantity": one.key, "mean": interval.mean,
                                           "half_width": interval.half_width, "cell": interval.text(one.decimals)})
    return pd.DataFrame(rows)


def setting_markdown(data: pd.DataFrame) -> str:
    """@param data: of setting_data"""
    text = ("## Results by setting\n\nOf the runs with a lap and without a stuck car; ± is the 95 % interval of the "
            "mean, where each start counts once, as the mean over its combinations. Most in a step: the most vertices "
            "that all cars generated in one, of all runs that count, also those without a lap.\n\n")
    for (scenario, axes), of_table in data.groupby(["scenario", "settings"], sort=False):
        rows = [[*group.iloc[0]["values"], group.iloc[0].subgraph, group.iloc[0].combinations,
                 " / ".join(str(group.iloc[0][outcome]) for outcome in OUTCOMES), *group.cell,
                 number(group.iloc[0].most_in_a_step, 0)]
                for _, group in of_table.groupby(["values", "subgraph"], sort=False)]
        text += f"### {scenario}, by {settings_text(axes)}\n\n" + table(
            [*axes, "subgraph", "combinations", "runs: lap / no lap / stuck / failed",
             *(one.name for one in QUANTITIES), "most in a step"], rows)
    return text
