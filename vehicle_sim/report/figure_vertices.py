"""Vertices of each step's search over time."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from . import style
from .series import Group, Run

MOST_CARS = 4  # of which each has a line of its own; of more, all are grey, with median and largest
KINDS = ("generated", "expanded")


def table_of(group: Group, run: Run) -> pd.DataFrame:
    """A row per step and car; NaN where a car did not search, so that lines break there."""
    steps = group.steps[group.steps["run"] == run.number]
    table = steps[["vehicle", "name", "time_s", *KINDS]].assign(planned_on=run.label)
    for kind in KINDS:
        table[kind] = table[kind].where(steps["searched"] & (table[kind] > 0)).astype(float)
    return table[["planned_on", "vehicle", "name", "time_s", *KINDS]]


def draw_cars(axes: Axes, table: pd.DataFrame, kind: str, looks: dict[int, style.Stroke]) -> None:
    """A line per car, or all in grey with median and largest."""
    for vehicle, own in table.groupby("vehicle"):
        many = len(looks) > MOST_CARS
        look = style.Stroke(style.OTHERS) if many else looks[vehicle]
        axes.plot(own["time_s"], own[kind], color=look.colour, linewidth=0.4 if many else 0.8, zorder=2)
    if len(looks) > MOST_CARS:
        by_time = table.groupby("time_s")[kind]
        axes.plot(by_time.max().index, by_time.max(), color=style.VERMILION, linewidth=0.9, zorder=3)
        axes.plot(by_time.median().index, by_time.median(), color=style.BLUE, linewidth=0.9, zorder=4)


def draw(group: Group) -> style.Drawing | None:
    """A row per subgraph and policy: generated on the left, expanded on the right, one scale for all."""
    tables = {run: table_of(group, run) for run in group.runs}
    runs = [run for run in group.runs if tables[run][list(KINDS)].notna().any(axis=None)]
    if not runs:
        return None
    cars = group.cars
    looks = dict(zip((number for number, _ in cars), style.strokes_of_cars([name for _, name in cars]), strict=True))
    figure = style.new_figure(1.0 + len(runs) * min(1.2, 8.0 / len(runs)))
    panels = figure.subplots(len(runs), 2, sharex=True, sharey=True, squeeze=False)
    for row, run in zip(panels, runs, strict=True):
        for axes, kind in zip(row, KINDS, strict=True):
            draw_cars(axes, tables[run], kind, looks)
            axes.set_title(f"{run.label}: {kind}", loc="left", pad=3)
    panels[0, 0].set_yscale("log")
    data = pd.concat(tables[run] for run in runs)
    panels[0, 0].set_ylim(0.8, 2.0 * np.nanmax(data[list(KINDS)].to_numpy()))
    panels[0, 0].set_xlim(0.0, data["time_s"].max())
    for axes in panels[-1]:
        axes.set_xlabel("time [s]")
    figure.supylabel("vertices in a step", fontsize=8)
    if len(cars) > MOST_CARS:
        entries = [style.line_entry("largest tree of a car", style.Stroke(style.VERMILION)),
                   style.line_entry("median of the cars", style.Stroke(style.BLUE)),
                   style.line_entry(f"each of the {len(cars)} cars", style.Stroke(style.OTHERS), 0.6)]
    else:
        entries = [style.line_entry(f"car {number}: {name}", looks[number]) for number, name in cars]
    style.legend_below(figure, entries)
    return style.Drawing(f"vertices_{group.scenario}_{group.profile}", figure, data,
                         "Vertices of each step's search, scenario's own start; gaps: a car did not search.")
