"""Priority strategies over the number of cars."""

from collections.abc import Iterator

import numpy as np
import pandas as pd

from . import style
from .priorities import Priorities


def _draw(data: pd.DataFrame, name: str, column: str, label: str, caption: str, above: str = "") -> style.Drawing:
    """A line per strategy. @param above: the column up to which a band reaches; empty: none"""
    figure = style.new_figure(3.4)
    axes = figure.subplots()
    entries = []
    for rank, (strategy, rows) in enumerate(data.groupby("strategy", sort=False)):
        look = style.stroke(rank)
        axes.plot(rows.cars, rows[column], marker="o", markersize=2.4, **look.line())
        if above:
            axes.fill_between(rows.cars, rows[column], rows[above], color=look.colour, alpha=0.08, linewidth=0.0)
            axes.plot(rows.cars, rows[above], linewidth=0.5, **look.line())
        entries.append(style.line_entry(strategy, look))
    axes.set_xlabel("cars")
    axes.set_xticks(sorted(data.cars.unique()))
    axes.set_ylabel(label)
    if above:
        axes.set_yscale("log")
    else:
        axes.set_ylim(bottom=0.0)
    columns = ["cars", "strategy", column] + ([above] if above else [])
    drawing = style.Drawing(name, figure, data[columns].reset_index(drop=True), caption)
    style.legend_below(figure, entries)
    return drawing


def drawings_of(results: Priorities, data: pd.DataFrame) -> Iterator[style.Drawing]:
    """Every figure that has something to show."""
    step_ms = 1e3 * results.plan["step_s"]
    time = _draw(data, "priorities_planning_time", "step_median_ms", "step of all cars [ms]",
                 f"Processor time of a step of all cars: median, and up to what 99 % of the steps take; the line at "
                 f"the top is the length of a step, {step_ms:g} ms.", above="step_p99_ms")
    time.figure.axes[0].axhline(step_ms, color=style.MARK, linewidth=0.8, dashes=(5, 2))
    yield time
    yield _draw(data, "priorities_levels", "levels_mean", "computation levels, mean",
                "Computation levels of a step, mean: cars of one level plan at the same time.")
    bounded = data[np.isfinite(data.excess_percent)]
    if not bounded.empty:
        yield _draw(bounded.assign(cost_per_bound=1.0 + bounded.excess_percent / 100.0), "priorities_cost",
                    "cost_per_bound", "cost / bound of the joint optimum",
                    "Costs of all new plans of coupled cars against the bound of the joint optimum: at most so many "
                    "times what the best plans together would have cost.")
    yield _draw(data.assign(standing_percent=100.0 * data.standing_runs / data.runs), "priorities_standing",
                "standing_percent", "runs with a car that stood [%]",
                "Runs in which a car stood for three horizons.")
