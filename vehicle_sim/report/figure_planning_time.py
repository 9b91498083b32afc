"""Distribution of the planning times."""

import numpy as np
import pandas as pd
from matplotlib.lines import Line2D

from . import style
from .series import Group

QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)


def exceedance(times_ms: np.ndarray) -> pd.DataFrame:
    """For each time [ms], the share [%] of the plans that took at least as long.

    Equal times have one row, with the largest share.
    """
    times, first = np.unique(np.sort(times_ms), return_index=True)
    return pd.DataFrame({"planning_ms": times, "share_percent": 100.0 * (1.0 - first / max(len(times_ms), 1))})


def draw(group: Group) -> style.Drawing | None:
    """On the left quantiles of the plans of all cars, on the right how many took at least so long."""
    times = {run: group.steps[group.steps["run"] == run.number]["planning_ms"].dropna().to_numpy()
             for run in group.runs}
    runs = [run for run in group.runs if len(times[run])]
    if not runs:
        return None
    figure = style.new_figure(max(2.6, 1.0 + 0.22 * len(runs)) + 0.6)
    boxes, tail = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.0, 1.15]})
    tables = []
    step_ms = 1e3 * group.place["step_s"]
    for rank, run in enumerate(runs):
        look, low_to_high = style.stroke(rank), np.quantile(times[run], QUANTILES)
        boxes.plot(low_to_high[[0, 4]], [rank, rank], color=look.colour, linewidth=1.0)
        boxes.plot(low_to_high[[1, 3]], [rank, rank], color=look.colour, linewidth=5.0, solid_capstyle="butt")
        boxes.plot([low_to_high[2]], [rank], marker="o", markersize=3.6, color="#ffffff", markeredgecolor="#000000",
                   markeredgewidth=0.6, linestyle="none", zorder=4)
        boxes.plot([times[run].max()], [rank], marker="|", markersize=8, color=look.colour, linestyle="none")
        curve = exceedance(times[run])
        tail.step(curve["planning_ms"], curve["share_percent"], where="pre", **look.line())
        tables.append(curve.assign(planned_on=run.label))
    for axes in (boxes, tail):
        axes.set_xscale("log")
        axes.axvline(step_ms, color=style.MARK, linewidth=0.8, dashes=(5, 2))
        axes.set_xlabel("planning time of a car's step [ms]")
    boxes.set_yticks(range(len(runs)), [run.label for run in runs])
    boxes.set_ylim(len(runs) - 0.4, -0.6)
    boxes.set_title("quantiles", loc="left")
    tail.set_title("how many took at least so long", loc="left")
    tail.set_yscale("log")
    tail.set_ylabel("share of the plans [%]")
    entries = [style.line_entry(run.label, style.stroke(rank)) for rank, run in enumerate(runs)]
    entries.append(style.line_entry(f"length of a step ({step_ms:g} ms)", style.Stroke(style.MARK, (0, (5, 2))), 0.8))
    entries += [style.line_entry("5 % to 95 %", style.Stroke(style.MARK), 1.0),
                style.line_entry("quartiles", style.Stroke(style.MARK), 5.0),
                Line2D([], [], marker="o", markersize=3.6, color="#ffffff", markeredgecolor="#000000",
                       markeredgewidth=0.6, linestyle="none", label="median"),
                Line2D([], [], marker="|", markersize=8, color=style.MARK, linestyle="none", label="longest")]
    style.legend_below(figure, entries)
    data = pd.concat(tables)[["planned_on", "planning_ms", "share_percent"]]
    return style.Drawing(f"planning_time_{group.scenario}_{group.profile}", figure, data,
                         "Processor time of the searches of all cars, scenario's own start.")
