"""On which subgraph cars planned over time, of the cars that changed it."""

from dataclasses import dataclass

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from . import style
from .series import Group, Run

MOST_ROWS = 24  # of one figure; more are divided among several
BAND = 0.30  # height of the band in a car's row of height 1; the speed is drawn above
ROW_IN = 0.36
LIMITED = ", at most "  # in names of subgraphs: then a limit of speed


@dataclass(frozen=True)
class Row:
    """A car of a run."""

    run: Run
    vehicle: int
    name: str
    stretches: pd.DataFrame  # planned_on, from_s, to_s


def stretches_of(steps: pd.DataFrame, step_s: float) -> pd.DataFrame:
    """Stretches of steps on the same subgraph. Steps before the first plan have none."""
    steps = steps[steps["planned_on"] != ""]
    changes = (steps["planned_on"] != steps["planned_on"].shift()) | (steps["step"].diff() > 1)
    grouped = steps.groupby(changes.cumsum())
    return pd.DataFrame({"planned_on": grouped["planned_on"].first(), "from_s": grouped["time_s"].first(),
                         "to_s": grouped["time_s"].last() + step_s}).reset_index(drop=True)


def rows_of(group: Group) -> tuple[list[Row], list[str]]:
    """The cars that changed their subgraph, and the labels of the runs in which none did."""
    rows, constant = [], []
    for run in group.runs:
        own = []
        for vehicle, name in group.cars:
            stretches = stretches_of(group.steps_of(run, vehicle), group.place["step_s"])
            if stretches["planned_on"].nunique() > 1:
                own.append(Row(run, vehicle, name, stretches))
        rows += own
        if not own:
            constant.append(run.label)
    return rows, constant


def looks_of(names: list[str]) -> dict[str, dict[str, object]]:
    """Fill of each subgraph: one colour for a name with and without limit, hatched with."""
    bases: list[str] = []
    looks = {}
    for name in names:
        base = name.split(LIMITED)[0]
        if base not in bases:
            bases.append(base)
        rank = bases.index(base)
        colour = style.COLOURS[rank % len(style.COLOURS)]
        hatch = ("", "....", "xxxx")[rank // len(style.COLOURS) % 3] + ("//////" if LIMITED in name else "")
        looks[name] = {"facecolor": colour, "hatch": hatch, "edgecolor": "#ffffff", "linewidth": 0.0}
    return looks


def draw_row(axes: Axes, group: Group, row: Row, at: float, top_mps: float, looks: dict) -> None:
    """Band of the subgraphs, speed above it, zones shaded."""
    drive = group.drive_of(row.run, row.vehicle)
    times, limits = drive["time_s"].to_numpy(), drive["zone_limit_mps"].to_numpy()
    scale = (1.0 - BAND - 0.12) / top_mps
    base = at + BAND + 0.04
    edges = np.flatnonzero(np.diff(np.nan_to_num(limits, nan=-1.0))) + 1
    for piece in np.split(np.arange(len(times)), edges):
        if len(piece) and not np.isnan(limits[piece[0]]):
            start, end = times[piece[0]], times[piece[-1]]
            axes.add_patch(Rectangle((start, base), end - start, 0.92 - BAND, color=style.ZONE, linewidth=0, zorder=1))
            axes.plot([start, end], [base + scale * limits[piece[0]]] * 2, color=style.MARK, linewidth=0.7,
                      dashes=(3, 1.5), zorder=2)
    axes.plot(times, base + scale * drive["speed_mps"].abs(), color="#000000", linewidth=0.7, zorder=3)
    for stretch in row.stretches.itertuples():
        axes.add_patch(Rectangle((stretch.from_s, at), stretch.to_s - stretch.from_s, BAND, zorder=3,
                                 **looks[stretch.planned_on]))
    if group.ends_stuck(row.run, row.vehicle):
        axes.text(times[-1], base + 0.05, "gridlock ", ha="right", va="bottom", fontsize=6.5, fontweight="bold",
                  color=style.VERMILION, zorder=5)


def pages_of(rows: list[Row]) -> list[list[Row]]:
    """The rows by figure: runs stay together where they fit."""
    pages: list[list[Row]] = []
    for number in dict.fromkeys(row.run.number for row in rows):
        own = [row for row in rows if row.run.number == number]
        if not pages or len(pages[-1]) + len(own) > MOST_ROWS:
            pages.append([])
        pages[-1] += own
    return pages


def draw(group: Group) -> list[style.Drawing]:
    """Only cars that changed; none: no figure."""
    rows, constant = rows_of(group)
    looks = looks_of(sorted({name for row in rows for name in row.stretches["planned_on"]}))
    drawings = []
    for page, own in enumerate(pages_of(rows)):
        drawing = draw_page(group, own, looks)
        drawing.name = f"subgraphs_{group.scenario}_{group.profile}" + (f"_{page + 1}" if page else "")
        if constant:
            drawing.caption += f" Without any change: {', '.join(constant)}."
        drawings.append(drawing)
    return drawings


def draw_page(group: Group, rows: list[Row], looks: dict) -> style.Drawing:
    """One figure: a panel per run, in it a row per car."""
    runs = list(dict.fromkeys(row.run for row in rows))
    counts = [sum(row.run == run for row in rows) for run in runs]
    used = [name for name in looks if any((row.stretches["planned_on"] == name).any() for row in rows)]
    figure = style.new_figure(0.9 + ROW_IN * len(rows) + 0.3 * len(runs) + 0.09 * len(used))
    panels = figure.subplots(len(runs), 1, sharex=True, squeeze=False, gridspec_kw={"height_ratios": counts})[:, 0]
    numbers = [run.number for run in runs]
    drives = group.drives[group.drives["run"].isin(numbers)]
    top_mps = max(0.1, 1.08 * drives["speed_mps"].abs().max())
    for axes, run, count in zip(panels, runs, counts, strict=True):
        own = [row for row in rows if row.run == run]
        for rank, row in enumerate(own):
            draw_row(axes, group, row, count - 1.0 - rank, top_mps, looks)
        axes.set_ylim(-0.08, count)
        axes.set_yticks([count - 0.5 - rank for rank in range(count)], [f"{row.vehicle}: {row.name}" for row in own])
        axes.tick_params(axis="y", length=0)
        axes.grid(False, axis="y")
        left_out = len(group.cars) - count
        axes.set_title(run.label + (f" ({left_out} cars without a change left out)" if left_out else ""), loc="left",
                       pad=3)
        speed = axes.secondary_yaxis("right")
        base = [count - 1.0 - rank + BAND + 0.04 for rank in range(count)]
        scale = 1.0 - BAND - 0.12
        speed.set_yticks([place + part for place in base for part in (0.0, scale)],
                         [text for _ in base for text in ("0", f"{top_mps:.1f}")], fontsize=4.5)
    panels[0].set_xlim(0.0, drives["time_s"].max())
    panels[-1].set_xlabel("time [s]")
    figure.supylabel("car", fontsize=8)
    figure.text(0.998, 0.5, "speed [m/s]", rotation=90, ha="right", va="center", fontsize=8)
    figure.get_layout_engine().set(rect=(0.0, 0.0, 0.975, 1.0))
    style.legend_below(figure, entries_of(used, looks, bool(drives["zone_limit_mps"].notna().any())))
    data = pd.concat(row.stretches.assign(run=row.run.label, vehicle=row.vehicle, name=row.name) for row in rows)
    return style.Drawing("", figure, data[["run", "vehicle", "name", "planned_on", "from_s", "to_s"]],
                         "Subgraphs that cars planned on (bands) and their speeds (lines), scenario's own start.")


def entries_of(used: list[str], looks: dict, has_zones: bool) -> list[object]:
    """Legend: subgraphs, speed, zones."""
    entries: list[object] = [Patch(label=name, **looks[name]) for name in used]
    entries.append(Line2D([], [], color="#000000", linewidth=0.8, label="speed"))
    if has_zones:
        entries.append(Patch(facecolor=style.ZONE, label="in a speed zone"))
        entries.append(style.line_entry("its limit", style.Stroke(style.MARK, (0, (3, 1.5))), 0.8))
    return entries
