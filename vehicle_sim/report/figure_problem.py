"""A planning problem and its plan."""

import math

import numpy as np
import pandas as pd
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon

from . import map_axes, style

MOST_STEPS = 8  # with a small map of their own; of more, as many, evenly chosen
GREY = (0.33, 0.33, 0.33)  # what stands


def step_colours(steps: int) -> list[tuple[float, ...]]:
    """One for each step, from the first on."""
    return [colormaps["viridis"](0.92 * index / max(steps - 1, 1)) for index in range(steps)]


def obstacles_of(data: dict) -> list[dict]:
    """Each obstacle once: its polygon of each step, and whether it stands. Numbered from 1.

    Steps list obstacles in the same order; of several vehicles the same ones count once.
    """
    seen: dict[str, dict] = {}
    for vehicle in data["vehicles"]:
        count = max((len(areas) for areas in vehicle["obstacles"]), default=0)
        for index in range(count):
            areas = [step[index] if index < len(step) else [] for step in vehicle["obstacles"]]
            stands = all(area == areas[0] for area in areas)
            seen.setdefault(str(areas), {"areas": areas, "stands": stands})
    return [{"number": number + 1, **obstacle} for number, obstacle in enumerate(seen.values())]


def footprint(data: dict, pose: list[float]) -> np.ndarray:
    """Corners of the car without margin."""
    half = 0.5 * data["footprint"]["length_m"], 0.5 * data["footprint"]["width_m"]
    corners = np.array([[-half[0], -half[1]], [half[0], -half[1]], [half[0], half[1]], [-half[0], half[1]]])
    turn = np.array([[math.cos(pose[2]), math.sin(pose[2])], [-math.sin(pose[2]), math.cos(pose[2])]])
    return corners @ turn + pose[:2]


def add_area(axes: Axes, area: list, colour: tuple[float, ...], zorder: float, hatch: str = "") -> None:
    """A polygon with an outline and a pale fill, hatched by a second one: a hatch is as pale as its own fill."""
    if not len(area):
        return
    axes.add_patch(Polygon(np.asarray(area), facecolor=(*colour[:3], 0.18), edgecolor=colour, linewidth=0.8,
                           zorder=zorder))
    if hatch:
        axes.add_patch(Polygon(np.asarray(area), facecolor="none", edgecolor=colour, linewidth=0.0, hatch=hatch,
                               zorder=zorder))


def add_boundary(axes: Axes, data: dict) -> None:
    """Segments that no plan crosses."""
    for vehicle in data["vehicles"]:
        for segment in vehicle["boundary"]:
            axes.plot(*np.asarray(segment).T, color="#000000", linewidth=0.8, zorder=1)


def add_obstacle(axes: Axes, obstacle: dict, steps: list[int], colours: list, with_number: bool) -> None:
    """Of these steps; one that stands is grey and drawn once. Its number stands where it is first."""
    for step in steps[:1] if obstacle["stands"] else steps:
        area = obstacle["areas"][step] if step < len(obstacle["areas"]) else []
        add_area(axes, area, GREY if obstacle["stands"] else colours[step], zorder=2, hatch="////")
    first = next((area for area in obstacle["areas"] if len(area)), [])
    if with_number and len(first):
        axes.text(*np.mean(first, axis=0), f"O{obstacle['number']}", fontsize=7, fontweight="bold", ha="center",
                  va="center", path_effects=map_axes.HALO, zorder=8)


def draw_plan(axes: Axes, data: dict, colours: list) -> None:
    """Swept areas, footprints, positions and references of all steps."""
    for index, vehicle in enumerate(data["vehicles"]):
        start = vehicle["start"]
        axes.add_patch(Polygon(footprint(data, start), facecolor="#ffffff", edgecolor="#000000", linewidth=0.9,
                               zorder=4))
        for step, area in enumerate(vehicle["swept"]):
            add_area(axes, area, colours[step], zorder=3)
        poses = np.array(vehicle["poses"]).reshape(-1, 3)
        axes.plot(poses[:, 0], poses[:, 1], marker="o", markersize=2.6, color="#000000", linestyle="none", zorder=6)
        reference = np.array(vehicle["reference"]).reshape(-1, 2)
        axes.plot(reference[:, 0], reference[:, 1], marker="o", markersize=4.6, color="none",
                  markeredgecolor=style.VERMILION, markeredgewidth=0.8, linestyle="none", zorder=5)
        if len(data["vehicles"]) > 1:
            axes.text(start[0], start[1], str(index + 1), fontsize=7, fontweight="bold", ha="center", va="center",
                      path_effects=map_axes.HALO, zorder=8)


def draw_step(axes: Axes, data: dict, obstacles: list[dict], step: int, colours: list) -> None:
    """Only what is occupied in one step: none of these areas may meet another."""
    add_boundary(axes, data)
    for obstacle in obstacles:
        add_obstacle(axes, obstacle, [step], colours, False)
    for vehicle in data["vehicles"]:
        if step < len(vehicle["swept"]):
            add_area(axes, vehicle["swept"][step], colours[step], zorder=3)
            axes.plot(*vehicle["poses"][step][:2], marker="o", markersize=1.8, color="#000000", zorder=6)
    axes.set_title(f"step {step + 1}", fontsize=7, pad=2)
    axes.set(xticks=[], yticks=[])


def extent_of(data: dict, obstacles: list[dict]) -> tuple[float, float, float, float]:
    """Around cars, plans, references and obstacles, and the boundary near them."""
    pieces = [np.asarray(vehicle["reference"]).reshape(-1, 2) for vehicle in data["vehicles"]]
    pieces += [footprint(data, vehicle["start"]) for vehicle in data["vehicles"]]
    pieces += [np.asarray(area) for vehicle in data["vehicles"] for area in vehicle["swept"]]
    pieces += [np.asarray(area) for obstacle in obstacles for area in obstacle["areas"] if len(area)]
    points = np.vstack(pieces)
    margin = 0.08 * max(np.ptp(points, axis=0)) + 0.5 * data["footprint"]["width_m"]
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    return float(low[0]), float(high[0]), float(low[1]), float(high[1])


def draw(data: dict) -> style.Drawing:
    """The whole plan, and below it the areas of single steps."""
    steps = data["horizon_steps"]
    colours, obstacles = step_colours(steps), obstacles_of(data)
    extent = extent_of(data, obstacles)
    shape = (extent[3] - extent[2]) / (extent[1] - extent[0])
    chosen = sorted({round(index) for index in np.linspace(0, steps - 1, min(steps, MOST_STEPS))})
    columns = min(4, len(chosen)) if shape < 1.6 else min(8, len(chosen))
    rows = -(-len(chosen) // columns)
    whole_in = min(4.4, max(1.2, 5.8 * shape)) + 0.5
    small_in = rows * (min(2.4, (style.WIDTH_IN / columns - 0.1) * shape) + 0.2)
    figure = style.new_figure(whole_in + small_in + 1.0, "constrained")
    grid = figure.add_gridspec(2, 1, height_ratios=[whole_in, small_in])
    axes = figure.add_subplot(grid[0])
    add_boundary(axes, data)
    for obstacle in obstacles:
        add_obstacle(axes, obstacle, list(range(steps)), colours, True)
    draw_plan(axes, data, colours)
    map_axes.finish(axes, extent)
    bar = ScalarMappable(BoundaryNorm(np.arange(steps + 1) + 0.5, steps), ListedColormap(colours))
    every = -(-steps // 16)
    figure.colorbar(bar, ax=axes, label="step", ticks=range(1, steps + 1, every), shrink=0.9, pad=0.01)
    cells = grid[1].subgridspec(rows, columns)
    for number, step in enumerate(chosen):
        small = figure.add_subplot(cells[number // columns, number % columns])
        draw_step(small, data, obstacles, step, colours)
        map_axes.finish(small, extent, labels=False)
    figure.suptitle(title_of(data), fontsize=8)
    style.legend_below(figure, entries_of(data, obstacles))
    return style.Drawing("problem", figure, table_of(data), f"{title_of(data)}.")


def title_of(data: dict) -> str:
    """What was asked for, and the answer."""
    cars = len(data["vehicles"])
    asked = (f"Joint planning problem: {cars} cars, " if cars > 1 else "Planning problem: ") + \
        f"{data['horizon_steps']} steps of {data['step_s']:g} s, subgraph {data['subgraph']}"
    has_plan = any(vehicle["poses"] for vehicle in data["vehicles"])
    answer = f"{data['status']}, cost {data['cost_m2']:.4g} m$^2$" if has_plan else f"no plan ({data['reason']})"
    return f"{asked}; {answer}"


def entries_of(data: dict, obstacles: list[dict]) -> list[object]:
    """Legend."""
    entries: list[object] = [Patch(facecolor="#ffffff", edgecolor="#000000", label="car at the start")]
    if any(vehicle["poses"] for vehicle in data["vehicles"]):
        entries += [Patch(facecolor=(*colormaps["viridis"](0.4)[:3], 0.18), edgecolor=colormaps["viridis"](0.4),
                          label="swept by the car in a step, with margin"),
                    Line2D([], [], marker="o", markersize=2.6, color="#000000", linestyle="none",
                           label="planned position after a step")]
    entries.append(Line2D([], [], marker="o", markersize=4.6, color="none", markeredgecolor=style.VERMILION,
                          linestyle="none", label="its reference point"))
    if any(not obstacle["stands"] for obstacle in obstacles):
        entries.append(Patch(facecolor="none", edgecolor=colormaps["viridis"](0.4), hatch="////",
                             label="obstacle O… in a step"))
    if any(obstacle["stands"] for obstacle in obstacles):
        entries.append(Patch(facecolor="none", edgecolor=GREY, hatch="////", label="obstacle O… that stands"))
    if any(vehicle["boundary"] for vehicle in data["vehicles"]):
        entries.append(Line2D([], [], color="#000000", linewidth=0.8, label="boundary"))
    return entries


def table_of(data: dict) -> pd.DataFrame:
    """Reference and planned pose of each car and step."""
    rows = []
    for number, vehicle in enumerate(data["vehicles"]):
        for step, reference in enumerate(vehicle["reference"]):
            pose = vehicle["poses"][step] if vehicle["poses"] else [None] * 3
            rows.append([number + 1, step + 1, *reference, *pose])
    return pd.DataFrame(rows, columns=["vehicle", "step", "reference_x_m", "reference_y_m", "x_m", "y_m", "psi_rad"])
