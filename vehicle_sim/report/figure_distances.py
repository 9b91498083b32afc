"""Distances between the driven footprints over time."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from . import style
from .series import Group, Run

SHOWN_M = 0.6
MOST_PAIRS = 8  # with a colour of their own: the closest ones
LONGEST_GAP_S = 0.05  # of two ticks; beyond, the pair was farther apart than the series go


def with_gaps(pair: pd.DataFrame) -> pd.DataFrame:
    """The rows of a pair with a row of NaN where it was out of sight, so that lines break there."""
    breaks = np.flatnonzero(np.diff(pair["time_s"]) > LONGEST_GAP_S) + 1
    pieces = np.split(pair[["time_s", "distance_m"]].to_numpy(), breaks)
    rows = [row for piece in pieces for row in (piece, [[np.nan, np.nan]])]
    return pd.DataFrame(np.vstack(rows[:-1]), columns=["time_s", "distance_m"])


def looks_of_pairs(near: pd.DataFrame) -> dict[str, style.Stroke]:
    """Of the pairs that are shown, the closest first; all but the closest MOST_PAIRS in grey."""
    closest = near.groupby("pair")["distance_m"].min().sort_values(kind="stable").index
    return {pair: style.stroke(rank) if rank < MOST_PAIRS else style.Stroke(style.OTHERS)
            for rank, pair in enumerate(closest)}


def draw(group: Group) -> style.Drawing | None:
    """One panel per subgraph and policy. None: no two cars came closer than SHOWN_M."""
    numbers = [run.number for run in group.runs]
    all_rows = group.distances[group.distances["run"].isin(numbers)]
    near = all_rows[all_rows["distance_m"] < SHOWN_M]
    if near.empty:
        return None
    looks = looks_of_pairs(near)
    columns = 1 if len(group.runs) == 1 else 2
    rows = -(-len(group.runs) // columns)
    figure = style.new_figure(1.1 + rows * min(1.5, 8.0 / rows))
    panels = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel()
    for axes, run in zip(panels, group.runs, strict=False):
        draw_pairs(axes, all_rows[all_rows["run"] == run.number], looks, run)
        axes.axhline(0.0, color="#000000", linewidth=1.2)
        axes.axhline(near["kept_m"].iloc[0], color=style.MARK, linewidth=0.8, dashes=(5, 2))
    for axes in panels[len(group.runs):]:
        axes.remove()
    panels[0].set_ylim(-0.02, SHOWN_M)
    panels[0].set_xlim(0.0, group.drives[group.drives["run"].isin(numbers)]["time_s"].max())
    for number, axes in enumerate(panels[:len(group.runs)]):
        if number >= len(group.runs) - columns:
            axes.set_xlabel("time [s]")
            axes.tick_params(labelbottom=True)
    figure.supylabel("distance of footprints [m]", fontsize=8)
    style.legend_below(figure, entries_of(looks, near["kept_m"].iloc[0]))
    labels = {run.number: run.label for run in group.runs}
    data = all_rows.assign(planned_on=all_rows["run"].map(labels))[["planned_on", "pair", "time_s", "distance_m"]]
    return style.Drawing(f"distances_{group.scenario}_{group.profile}", figure, data[data["distance_m"] < SHOWN_M],
                         f"Distance between driven cars where it is below {SHOWN_M} m, scenario's own start.")


def draw_pairs(axes: Axes, rows: pd.DataFrame, looks: dict[str, style.Stroke], run: Run) -> None:
    """The lines of one run, the closest pairs on top."""
    least = rows["distance_m"].min() if len(rows) else np.inf
    axes.set_title(f"{run.label}: " + (f"at least {1e3 * least:.0f} mm" if least < SHOWN_M else
                                       f"never below {SHOWN_M} m"), loc="left", pad=3)
    for rank, (name, look) in enumerate(reversed(looks.items())):
        pair = rows[rows["pair"] == name]
        if len(pair):
            line = with_gaps(pair)
            is_close = rank >= len(looks) - MOST_PAIRS
            axes.plot(line["time_s"], line["distance_m"], **look.line(), linewidth=1.0 if is_close else 0.4,
                      zorder=2 + 0.01 * rank)


def entries_of(looks: dict[str, style.Stroke], kept_m: float) -> list[object]:
    """Legend: the pairs with colours of their own, the others in one entry, the bounds."""
    entries: list[object] = [style.line_entry(pair, look) for pair, look in list(looks.items())[:MOST_PAIRS]]
    if len(looks) > MOST_PAIRS:
        entries.append(style.line_entry(f"{len(looks) - MOST_PAIRS} other pairs", style.Stroke(style.OTHERS)))
    entries.append(style.line_entry("contact", style.Stroke("#000000"), 1.2))
    entries.append(style.line_entry(f"safety margins of both ({1e3 * kept_m:.0f} mm)",
                                    style.Stroke(style.MARK, (0, (5, 2))), 0.8))
    return entries
