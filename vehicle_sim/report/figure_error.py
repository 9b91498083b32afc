"""Distance of the planned positions to the lane's centre over arc length."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.patches import Patch

from . import style
from .series import Group, Run

BIN_M = 0.2  # a step at 1 m/s
BAND = (0.05, 0.95)


def own_line(group: Group, run: Run) -> pd.DataFrame:
    """Arc length from the start [m] and error [mm] of the first car."""
    steps = group.steps_of(run, group.first["id"])
    s = steps["arc_length_m"].to_numpy()
    return pd.DataFrame({"arc_length_m": s - (s[0] if len(s) else 0.0), "error_mm": steps["error_mm"].to_numpy()})


def spread(group: Group, run: Run) -> pd.DataFrame:
    """Error at the same place of the route over the other starts, by bins of BIN_M of one lap.

    arc_length_m counts from the place of the scenario's own start, so that places are the same as in own_line. Of a
    start, the mean in a bin counts, however long it stood there. Empty without other starts or on an open path.
    """
    path, own_s = group.first["path"], group.first["start_s_m"]
    pieces = []
    for other in group.other_starts(run):
        steps = group.steps_of(other, group.first["id"])
        place = np.mod(steps["arc_length_m"].to_numpy() - own_s, path["length_m"])
        pieces.append(pd.DataFrame({"start": other.start, "bin": np.floor(place / BIN_M).astype(int),
                                    "error_mm": steps["error_mm"].to_numpy()}))
    if not pieces or not path["is_closed"]:
        return pd.DataFrame(columns=["arc_length_m", "low_mm", "median_mm", "high_mm", "starts"])
    means = pd.concat(pieces).groupby(["bin", "start"])["error_mm"].mean().groupby("bin")
    table = pd.DataFrame({"low_mm": means.quantile(BAND[0]), "median_mm": means.median(),
                          "high_mm": means.quantile(BAND[1]), "starts": means.size()}).reset_index()
    table.insert(0, "arc_length_m", (table.pop("bin") + 0.5) * BIN_M)
    return table


def draw_band(axes: Axes, band: pd.DataFrame, lap_m: float, until_m: float, colour: str) -> None:
    """The band of one lap, again for each lap of the own line."""
    for lap in range(int(until_m // lap_m) + 1):
        x = band["arc_length_m"] + lap * lap_m
        axes.fill_between(x, band["low_mm"], band["high_mm"], color=colour, alpha=0.22, linewidth=0, zorder=1.5)
        axes.plot(x, band["median_mm"], color=colour, linewidth=0.6, alpha=0.6, zorder=1.6)


def draw(group: Group) -> style.Drawing | None:
    """One panel per subgraph and policy, with the same axes."""
    first = group.first
    lines = {run: own_line(group, run) for run in group.runs}
    runs = [run for run in group.runs if len(lines[run])]
    if not runs:
        return None
    until = max(lines[run]["arc_length_m"].max() for run in runs)
    figure = style.new_figure(1.1 + len(runs) * min(1.15, 8.0 / len(runs)))
    panels = figure.subplots(len(runs), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    panels[0].set_xlim(0.0, 1.02 * until)
    tables, bands = [], 0
    for axes, (rank, run) in zip(panels, enumerate(runs), strict=True):
        colour, line, band = style.stroke(rank).colour, lines[run], spread(group, run)
        bands += len(band) > 0
        if len(band):
            draw_band(axes, band, first["path"]["length_m"], until, colour)
        axes.plot(line["arc_length_m"], line["error_mm"], color=colour, linewidth=1.0, zorder=3)
        if first["path"]["is_closed"]:
            for lap in range(1, int(until // first["path"]["length_m"]) + 1):
                axes.axvline(lap * first["path"]["length_m"], color=style.MARK, linewidth=0.7, dashes=(5, 2))
        mark_gridlock(axes, group, run, line, colour)
        tables += [line.assign(planned_on=run.label, what="own start"),
                   band.assign(planned_on=run.label, what="other starts")]
    panels[0].set_ylim(bottom=0.0)
    centre = "lane's centre" if group.place["lanelets"] else "reference path"
    panels[-1].set_xlabel(f"arc length along the {centre}, from the start [m]")
    figure.supylabel(f"distance to the {centre} [mm]", fontsize=8)
    style.legend_below(figure, entries_of(group, bands > 0))
    data = pd.concat([table for table in tables if len(table)])
    data = data[["planned_on", "what", *[name for name in data.columns if name not in ("planned_on", "what")]]]
    return style.Drawing(f"error_{group.scenario}_{group.profile}", figure, data,
                         f"Reference error of car {first['id']} ({first['name']}): distance of its planned "
                         f"positions to the {centre}.")


def mark_gridlock(axes: Axes, group: Group, run: Run, line: pd.DataFrame, colour: str) -> None:
    """The panel's title; the word where the own line ends in gridlock, and how many other starts do."""
    others = group.other_starts(run)
    stuck = sum(group.ends_stuck(other, group.first["id"]) for other in others)
    axes.set_title(run.label + (f" (gridlock in {stuck} of {len(others)} other starts)" if stuck else ""), loc="left",
                   pad=3)
    if not group.ends_stuck(run, group.first["id"]):
        return
    x, y = line.iloc[-1]
    axes.plot([x], [y], marker="X", markersize=6, color=colour, markeredgecolor="#ffffff", zorder=5, clip_on=False)
    is_right = x > 0.8 * axes.get_xlim()[1]
    axes.annotate("gridlock", (x, y), xytext=(-6 if is_right else 6, 5), textcoords="offset points", color=colour,
                  fontsize=7, fontweight="bold", ha="right" if is_right else "left", zorder=6)


def entries_of(group: Group, has_bands: bool) -> list[object]:
    """Legend, without the colours, which the panels' titles name."""
    entries: list[object] = [style.line_entry("scenario's own start", style.Stroke(style.MARK))]
    if has_bands:
        others = max(len(group.other_starts(run)) for run in group.runs)
        entries += [Patch(color=style.MARK, alpha=0.22, linewidth=0,
                          label=f"{others} other starts at the same place: 5 % to 95 %"),
                    style.line_entry("their median", style.Stroke("#9a9a9a"), 0.6)]
    if group.first["path"]["is_closed"]:
        entries.append(style.line_entry("one lap", style.Stroke(style.MARK, (0, (5, 2))), 0.7))
    return entries
