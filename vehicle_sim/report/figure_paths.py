"""The paper's Fig. 4: the driven paths of the first car."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.patches import Patch, Rectangle

from . import lateral, map_axes, style
from .series import Group, Run

HALF_ZOOM_M = 0.45
GRID_M = 0.02


def where_they_differ(path: lateral.Path, drives: list[np.ndarray]) -> tuple[np.ndarray, float]:
    """Place [m] and size [m] of the largest distance of two drives at equal arc length of their first lap.

    Of one drive, of its largest distance from the path.
    """
    offsets = [path.offsets(drive) for drive in drives]
    place, largest = drives[0][0], 0.0
    if len(drives) == 1:
        farthest = int(np.argmax(np.abs(offsets[0][1])))
        return drives[0][farthest], float(abs(offsets[0][1][farthest]))
    for i, (s, side) in enumerate(offsets):
        for j in range(i):
            other_s, other_side = offsets[j]
            end = min(s.max(), other_s.max(), path.total_m)
            grid = np.arange(0.0, end, GRID_M)
            if len(grid) == 0:
                continue
            # Arc lengths of a car that stands do not grow.
            apart = np.abs(np.interp(grid, *growing(s, side)) - np.interp(grid, *growing(other_s, other_side)))
            k = int(np.argmax(apart))
            if apart[k] > largest:
                largest = float(apart[k])
                place = 0.5 * (drives[i][np.argmax(s >= grid[k])] + drives[j][np.argmax(other_s >= grid[k])])
    return place, largest


def growing(s: np.ndarray, side: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The samples at which the arc length is larger than at all before."""
    keep = np.concatenate([[True], s[1:] > np.maximum.accumulate(s)[:-1]])
    return s[keep], side[keep]


def draw_drives(axes: Axes, group: Group, looks: dict[int, style.Stroke]) -> None:
    """The other starts thin below the scenario's own."""
    first = group.first["id"]
    for run in group.runs:
        for other in group.other_starts(run):
            drive = group.drive_of(other, first)
            axes.plot(drive["x_m"], drive["y_m"], color=looks[run.number].colour, linewidth=0.4, alpha=0.35, zorder=2)
    for run in group.runs:
        drive = group.drive_of(run, first)
        look = looks[run.number]
        axes.plot(drive["x_m"], drive["y_m"], **look.line(), linewidth=1.2, zorder=3 + look.rank)


def draw(group: Group) -> style.Drawing | None:
    """The whole drive, and enlarged where the runs of the scenario's own start differ most."""
    first = group.first
    runs = [run for run in group.runs if len(group.drive_of(run, first["id"]))]
    if not runs:
        return None
    looks = {run.number: style.stroke(rank) for rank, run in enumerate(runs)}
    figure = style.new_figure(4.15, "compressed")
    whole, zoom = figure.subplots(1, 2)
    path = map_axes.path_points(first)
    drives = [group.drive_of(run, first["id"])[["x_m", "y_m"]].to_numpy() for run in runs]
    place, largest = where_they_differ(lateral.Path(path), drives)
    map_axes.finish(whole, map_axes.extent_of(group.place))
    map_axes.finish(zoom, (place[0] - HALF_ZOOM_M, place[0] + HALF_ZOOM_M,
                           place[1] - HALF_ZOOM_M, place[1] + HALF_ZOOM_M))
    for axes in (whole, zoom):
        map_axes.draw_lanes(axes, group.place)
        axes.plot(path[:, 0], path[:, 1], color="#000000", linewidth=0.6, zorder=2.5)
        draw_drives(axes, group, looks)
        for run in runs:
            if group.ends_stuck(run, first["id"]):
                end = group.drive_of(run, first["id"]).iloc[-1]
                map_axes.mark_gridlock(axes, end["x_m"], end["y_m"], looks[run.number].colour)
    whole.add_patch(Rectangle(place - HALF_ZOOM_M, 2 * HALF_ZOOM_M, 2 * HALF_ZOOM_M, fill=False, edgecolor=style.MARK,
                              linewidth=0.8, zorder=6))
    whole.set_title("whole drive")
    centre = "centre of the lane" if group.place["lanelets"] else "reference path"
    zoom.set_title(f"box enlarged: they differ most, by {1e3 * largest:.0f} mm" if len(runs) > 1 else
                   f"box enlarged: {1e3 * largest:.0f} mm off the {centre}")
    entries: list[object] = [style.line_entry(centre, style.Stroke("#000000"), 0.6)]
    entries += [style.line_entry(run.label, looks[run.number]) for run in runs]
    others = max(len(group.other_starts(run)) for run in runs)
    if others:
        entries.append(style.line_entry(f"thin: {others} other starts each", style.Stroke(style.OTHERS), 0.5))
    if group.place["lanelets"]:
        entries.append(Patch(facecolor=style.LANE, edgecolor=style.LANE_BORDER, linewidth=0.4, label="lane"))
    style.legend_below(figure, entries)
    return style.Drawing(f"paths_{group.scenario}_{group.profile}", figure, table_of(group, runs),
                         f"Driven paths of car {first['id']} ({first['name']}) (the paper's Fig. 4).")


def table_of(group: Group, runs: list[Run]) -> pd.DataFrame:
    """The positions that are drawn."""
    tables = []
    for run in runs:
        for one in [run, *group.other_starts(run)]:
            drive = group.drive_of(one, group.first["id"])[["time_s", "x_m", "y_m"]]
            tables.append(drive.assign(planned_on=run.label, start=one.start))
    return pd.concat(tables)[["planned_on", "start", "time_s", "x_m", "y_m"]]
