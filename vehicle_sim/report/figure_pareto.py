"""The paper's Fig. 1: the Pareto front of a maneuver."""

from collections.abc import Callable

import numpy as np
import pandas as pd
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from . import style

LABELS = {"J1": r"$J_1 = -\int \|s\|^2\,\mathrm{d}t$ [m$^2$ s]",
          "J2": r"$J_2 = \int \|u\|^2\,\mathrm{d}t$ [m$^2$/s$^3$ + rad$^2$/s]"}
SYMBOLS = {"J1": "$J_1$", "J2": "$J_2$"}


def colours_of(count: int) -> list[tuple[float, ...]]:
    """Along the front, from the optimum of the second criterion to that of the first; without the palest yellow."""
    return [colormaps["viridis"](0.92 * (1.0 - index / max(count - 1, 1))) for index in range(count)]


def draw_front(axes: Axes, data: dict, colours: list) -> None:
    """The front, its knee, and the weighted sums."""
    first, second = data["criteria"]
    values = np.array([point["objectives"] for point in data["points"]])
    sums = np.array(data["weighted_sums"]).reshape(-1, 2)
    axes.scatter(values[:, 1], values[:, 0], s=14, c=colours, zorder=3)
    axes.plot(sums[:, 1], sums[:, 0], marker="x", markersize=3.5, color=style.MARK, markeredgewidth=0.7,
              linestyle="none", zorder=4)
    knee = values[data["knee"]]
    axes.plot([knee[1]], [knee[0]], marker="o", markersize=9, color="none", markeredgecolor="#000000",
              markeredgewidth=0.9, linestyle="none", zorder=5)
    axes.set(xlabel=LABELS.get(second, second), ylabel=LABELS.get(first, first))
    axes.set_title("Pareto front", loc="left")


def draw_lines(axes: Axes, data: dict, colours: list,
               values: Callable[[dict], tuple[np.ndarray, np.ndarray]]) -> None:
    """A line per point of the front; the ends thick, so that curves that leave the family have a name."""
    last = len(colours) - 1
    for index, (point, colour) in enumerate(zip(data["points"], colours, strict=True)):
        x, y = values(point)
        axes.plot(x, y, color=colour, linewidth=1.9 if index in (0, last) else 0.7,
                  linestyle="solid" if point["is_converged"] else (0, (2, 1.5)),
                  zorder=3 if index in (0, last) else 2)


def state_over_time(column: int) -> Callable[[dict], tuple[np.ndarray, np.ndarray]]:
    """A column of the states over time."""
    def values(point: dict) -> tuple[np.ndarray, np.ndarray]:
        """Times and states."""
        states = np.array(point["states"])
        return np.linspace(0.0, point["duration_s"], len(states)), states[:, column]
    return values


def input_over_time(column: int) -> Callable[[dict], tuple[np.ndarray, np.ndarray]]:
    """A column of the inputs over time: constant on each interval."""
    def values(point: dict) -> tuple[np.ndarray, np.ndarray]:
        """Begins and ends of the intervals, and the inputs there."""
        inputs = np.array(point["inputs"])[:, column]
        times = np.linspace(0.0, point["duration_s"], len(inputs) + 1)
        return np.repeat(times, 2)[1:-1], np.repeat(inputs, 2)
    return values


def draw(data: dict) -> style.Drawing:
    """Front, positions, orientations, inputs, speeds."""
    colours = colours_of(len(data["points"]))
    figure = style.new_figure(4.9)
    panels = figure.subplots(2, 3).ravel()
    draw_front(panels[0], data, colours)
    draw_lines(panels[1], data, colours, lambda point: tuple(np.array(point["states"])[:, :2].T))
    panels[1].set_aspect("equal", adjustable="datalim")
    panels[1].set_xlabel("$s_x$ [m]")
    panels[1].set_ylabel("$s_y$ [m]")
    panels[1].set_title("positions", loc="left")
    for axes, title, label, values in (
            (panels[2], "orientations", r"$\psi$ [rad]", state_over_time(2)),
            (panels[3], "accelerations", "$u_v$ [m/s$^2$]", input_over_time(0)),
            (panels[4], "steering rates", r"$u_\delta$ [rad/s]", input_over_time(1)),
            (panels[5], "speeds", "$v$ [m/s]", state_over_time(3))):
        draw_lines(axes, data, colours, values)
        axes.set(xlabel="time $t$ [s]", ylabel=label)
        axes.set_title(title, loc="left")
    figure.suptitle(title_of(data), fontsize=8)
    style.legend_below(figure, entries_of(data, colours))
    return style.Drawing("pareto", figure, table_of(data), f"{title_of(data)} (the paper's Fig. 1).")


def title_of(data: dict) -> str:
    """From where to where, in which time."""
    (speed, steering), (to_speed, to_steering), (least, largest) = data["from"], data["to"], data["duration_s"]
    duration = f"{least:g}" if least == largest else f"{least:g} to {largest:g}"
    return (f"Pareto-optimal maneuvers from ({speed:g} m/s, {steering:g} rad) to ({to_speed:g} m/s, "
            f"{to_steering:g} rad) in {duration} s")


def entries_of(data: dict, colours: list) -> list[object]:
    """Legend."""
    first, second = (SYMBOLS.get(name, name) for name in data["criteria"])
    middle = colours[len(colours) // 2]
    entries: list[object] = [Line2D([], [], color=colours[0], linewidth=1.9, label=f"optimum of {second}"),
                             Line2D([], [], color=middle, linewidth=0.7, label="between them"),
                             Line2D([], [], color=colours[-1], linewidth=1.9, label=f"optimum of {first}"),
                             Line2D([], [], marker="o", markersize=8, color="none", markeredgecolor="#000000",
                                    linestyle="none", label="knee"),
                             Line2D([], [], marker="x", markersize=4, color=style.MARK, linestyle="none",
                                    label="weighted sums")]
    if not all(point["is_converged"] for point in data["points"]):
        entries.append(Line2D([], [], color=middle, linewidth=0.8, linestyle=(0, (2, 1.5)), label="not converged"))
    return entries


def table_of(data: dict) -> pd.DataFrame:
    """The front and the weighted sums."""
    first, second = data["criteria"]
    front = pd.DataFrame([[*point["objectives"], point["duration_s"], "front"] for point in data["points"]],
                         columns=[first, second, "duration_s", "method"])
    sums = pd.DataFrame([[*one, np.nan, "weighted sums"] for one in data["weighted_sums"]], columns=front.columns)
    return pd.concat([front, sums]) if len(sums) else front
