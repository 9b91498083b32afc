"""Priority strategies over the number of cars."""

from collections.abc import Iterator

import numpy as np
import pandas as pd

from . import style
from .priorities import Priorities


def _draw(data: pd.DataFrame, name: str, column: str, label: str, caption: str, bottom: float = 0.0, above: str = "",
          step_ms: float = 0.0) -> style.Drawing:
    """A line per strategy.

    above: the column up to which a band reaches, on a logarithmic axis with the length of a step; empty: none.
    """
    figure = style.new_figure(3.4)
    axes = figure.subplots()
    entries = []
    for rank, (strategy, rows) in enumerate(data.groupby("strategy", sort=False)):
        look = style.stroke(rank)
        axes.plot(rows.cars, rows[column], marker="o", markersize=2.4, **look.line())
        if above:
            axes.fill_between(rows.cars, rows[column], rows[above], color=look.colour, alpha=0.05, linewidth=0.0)
            axes.plot(rows.cars, rows[above], linewidth=0.5, **look.line())
        entries.append(style.line_entry(strategy, look))
    axes.set_xlabel("cars")
    axes.set_xticks(sorted(data.cars.unique()))
    axes.set_ylabel(label)
    if above:
        axes.set_yscale("log")
        mark = style.Stroke(style.MARK, (0, (5, 2)))
        axes.axhline(step_ms, linewidth=0.8, **mark.line())
        entries.append(style.line_entry(f"length of a step ({step_ms:g} ms)", mark, 0.8))
    else:
        axes.set_ylim(bottom=bottom)
    columns = ["cars", "strategy", column] + ([above] if above else [])
    drawing = style.Drawing(name, figure, data[columns].reset_index(drop=True), caption)
    style.legend_below(figure, entries)
    return drawing


def drawings_of(results: Priorities, data: pd.DataFrame) -> Iterator[style.Drawing]:
    """Every figure that has something to show."""
    step_ms = 1e3 * results.plan["step_s"]
    yield _draw(data, "priorities_planning_time", "step_median_ms", "step of all cars [ms]",
                "Processor time of a step of all cars: median, and up to what 99 % of the steps take (thin lines).",
                above="step_p99_ms", step_ms=step_ms)
    yield _draw(data, "priorities_levels", "levels_mean", "computation levels, mean",
                "Computation levels of a step, mean: cars of one level plan at the same time.")
    bounded = data[np.isfinite(data.excess_percent)]
    if not bounded.empty:
        yield _draw(bounded.assign(cost_per_bound=1.0 + bounded.excess_percent / 100.0), "priorities_cost",
                    "cost_per_bound", "cost / bound of the joint optimum",
                    "Costs of all new plans of coupled cars against the bound of the joint optimum: at most so many "
                    "times what the best plans together would have cost.", bottom=1.0)
    yield _draw(data.assign(standing_percent=100.0 * data.standing_runs / data.runs), "priorities_standing",
                "standing_percent", "runs with a car that stood [%]",
                "Runs in which a car stood for three horizons.")
