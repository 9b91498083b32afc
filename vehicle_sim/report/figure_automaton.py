"""The paper's Fig. 2: trims and maneuvers of an automaton."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrowPatch, Patch

from . import style

MOST_TRIMS = 16  # drawn as a graph; of more, arrows would cover each other: a matrix per criterion
COLOUR_OF_LABEL = {"J1": style.BLUE, "J2": style.VERMILION, "J3": style.GREEN}
OTHER_COLOURS = (style.PURPLE, style.ORANGE, style.SKY, "#000000")
TRIM_PT = 7.0  # radius of a trim
IN_A_ROW = 3  # matrices


def colours_of(labels: list[str]) -> dict[str, str]:
    """A colour for each criterion, the same in every automaton for the paper's."""
    others = [label for label in labels if label not in COLOUR_OF_LABEL]
    return {label: COLOUR_OF_LABEL.get(label) or OTHER_COLOURS[others.index(label) % len(OTHER_COLOURS)]
            for label in labels}


def symbol(label: str) -> str:
    """A criterion as a symbol: J1 with its index below."""
    return rf"$J_{label[1:]}$" if label[:1] == "J" and label[1:].isdigit() and len(label) == 2 else label


def edges_of(data: dict) -> pd.DataFrame:
    """The maneuvers with an entry for both directions where there are two: from, to, label, is_both."""
    table = pd.DataFrame(data["maneuvers"], columns=["from", "to", "label"])
    known = set(table.itertuples(index=False, name=None))
    table["is_both"] = [(to, start, label) in known for start, to, label in zip(
        table["from"], table["to"], table["label"], strict=True)]
    return table[~table["is_both"] | (table["from"] < table["to"])]


def passes_a_trim(start: np.ndarray, end: np.ndarray, places: np.ndarray) -> bool:
    """True if another trim lies on the straight line between two (all as shares of the axes)."""
    along = end - start
    share = (places - start) @ along / (along @ along)
    gap = np.linalg.norm(places - start - share[:, None] * along, axis=1)
    return bool(((share > 0.01) & (share < 0.99) & (gap < 0.02)).any())


def draw_trims(axes: Axes, data: dict) -> np.ndarray:
    """Trims as circles with their numbers, in the plane of steering and speed. Returns their places."""
    places = np.array([[trim["steering_rad"], trim["speed_mps"]] for trim in data["trims"]])
    is_graph = len(places) <= MOST_TRIMS
    axes.plot(places[:, 0], places[:, 1], marker="o", markersize=2 * TRIM_PT if is_graph else 2.5, color="#ffffff",
              markeredgecolor="#000000", markeredgewidth=0.7, linestyle="none", zorder=3)
    for number, place in enumerate(places):
        axes.annotate(str(number + 1), place, xytext=(0, 0) if is_graph else (0, 4), textcoords="offset points",
                      ha="center", va="center", fontsize=7 if is_graph else 4.2, zorder=4)
    axes.set_xlabel(r"steering angle $\delta$ [rad]")
    axes.set_ylabel("speed $v$ [m/s]")
    axes.margins(0.09)
    return places


def draw_graph(data: dict) -> style.Drawing:
    """All maneuvers as arrows from circle to circle, a double head where both directions exist."""
    labels, colours = data["labels"], colours_of(data["labels"])
    figure = style.new_figure(4.6)
    axes = figure.subplots()
    places = draw_trims(axes, data)
    size = np.ptp(places, axis=0)
    shares = places / np.where(size > 0.0, size, 1.0)
    for edge in edges_of(data).itertuples(index=False):
        start, end, label, is_both = edge
        middle = 0.5 * (len(labels) - 1)
        bend = 0.07 * (labels.index(label) - middle)
        if passes_a_trim(shares[start - 1], shares[end - 1], shares):
            bend += 0.22
        axes.add_patch(FancyArrowPatch(
            places[start - 1], places[end - 1], arrowstyle="<|-|>" if is_both else "-|>", mutation_scale=5.5,
            connectionstyle=f"arc3,rad={bend:.3f}", shrinkA=TRIM_PT + 0.5, shrinkB=TRIM_PT + 0.5, linewidth=0.7,
            color=colours[label], zorder=2))
    entries: list[object] = [style.line_entry(f"optimal for {symbol(label)}", style.Stroke(colours[label]))
                             for label in labels]
    entries.append(Line2D([], [], marker="o", markersize=8, color="#ffffff", markeredgecolor="#000000",
                          linestyle="none", label="trim, with its number"))
    style.legend_below(figure, entries)
    return finished(figure, data)


def draw_matrices(data: dict) -> style.Drawing:
    """Trims in the plane, and for each criterion a matrix of the maneuvers between them."""
    labels, colours, count = data["labels"], colours_of(data["labels"]), len(data["trims"])
    rows = -(-len(labels) // IN_A_ROW)
    columns = min(IN_A_ROW, len(labels))
    matrix_in = (style.WIDTH_IN - 0.5) / max(columns, 2)
    figure = style.new_figure(2.9 + rows * (matrix_in + 0.15))
    grid = figure.add_gridspec(2, 1, height_ratios=[2.6, rows * matrix_in])
    draw_trims(figure.add_subplot(grid[0]), data)
    cells = grid[1].subgridspec(rows, columns)
    for number, label in enumerate(labels):
        axes = figure.add_subplot(cells[number // IN_A_ROW, number % IN_A_ROW])
        own = [one for one in data["maneuvers"] if one["label"] == label]
        matrix = np.zeros((count, count), dtype=bool)
        matrix[[one["from"] - 1 for one in own], [one["to"] - 1 for one in own]] = True
        shown = np.ma.masked_where(~matrix, np.ones((count, count)))
        edges = np.arange(count + 1) + 0.5
        axes.pcolormesh(edges, edges, shown, cmap=ListedColormap([colours[label]]))
        axes.plot([0.5, count + 0.5], [0.5, count + 0.5], color=style.OTHERS, linewidth=0.4)
        axes.set(aspect="equal", xlabel="to trim", ylabel="from trim" if number % IN_A_ROW == 0 else None)
        axes.invert_yaxis()
        axes.set_title(f"optimal for {symbol(label)}: {len(own)} maneuvers", loc="left")
    style.legend_below(figure, [Patch(color=colours[label], label=f"a maneuver, optimal for {symbol(label)}")
                                for label in labels])
    return finished(figure, data)


def finished(figure: Figure, data: dict) -> style.Drawing:
    """The drawing with its data and its counts."""
    data_table = pd.DataFrame(data["maneuvers"], columns=["from", "to", "label"])
    text = f"{len(data['trims'])} trims, {len(data['maneuvers'])} maneuvers without the trims' own"
    figure.suptitle(f"Automaton: {text}", fontsize=8)
    return style.Drawing("automaton", figure, data_table, f"Automaton: {text} (the paper's Fig. 2).")


def draw(data: dict) -> style.Drawing:
    """A graph of few trims, matrices of many."""
    return draw_graph(data) if len(data["trims"]) <= MOST_TRIMS else draw_matrices(data)
