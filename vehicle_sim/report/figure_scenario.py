"""The paper's Fig. 3: lanes, routes, and cars at the start."""

import copy
import math

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.gridspec import SubplotSpec
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from . import map_axes, style
from .series import Group

LONG_ROAD = 10.0  # longer by this than wide: divided into strips, one below the other
MOST_STRIPS = 8
IN_A_ROW = 7  # small maps
MOST_ROUTES = 6  # in one map; more are drawn one by one below it
BETWEEN_ARROWS_IN = 0.9


def routes_of(place: dict) -> list[list[int]]:
    """Indices of the cars that share a route."""
    routes: dict[bytes, list[int]] = {}
    for index, car in enumerate(place["vehicles"]):
        routes.setdefault(map_axes.path_points(car).tobytes(), []).append(index)
    return list(routes.values())


def turned(place: dict) -> dict:
    """The place turned clockwise by a right angle, so that a road along y lies along the paper."""
    place = copy.deepcopy(place)
    turn = lambda points: [[y, -x] for x, y in points]  # noqa: E731
    for lane in place["lanelets"]:
        lane["left_m"], lane["right_m"] = turn(lane["left_m"]), turn(lane["right_m"])
    for car in place["vehicles"]:
        car["path"]["points_m"] = turn(car["path"]["points_m"])
        start = car["start"]
        start["x_m"], start["y_m"], start["yaw_rad"] = start["y_m"], -start["x_m"], start["yaw_rad"] - 0.5 * math.pi
        if "goal_m" in car:
            car["goal_m"] = turn(car["goal_m"])
    for zones in place["zones"].values():
        for zone in zones:
            x, to_x = zone["min_x_m"], zone["max_x_m"]
            zone["min_x_m"], zone["max_x_m"] = zone["min_y_m"], zone["max_y_m"]
            zone["min_y_m"], zone["max_y_m"] = -to_x, -x
    for one in place.get("obstacles", []):
        one["corners_m"] = turn(one["corners_m"])
    return place


def strips_of(extent: tuple[float, float, float, float]) -> list[tuple[float, float, float, float]]:
    """The extent, or the pieces of a long road."""
    width, height = extent[1] - extent[0], extent[3] - extent[2]
    if width < LONG_ROAD * height:
        return [extent]
    count = min(MOST_STRIPS, max(2, math.ceil(width / height / LONG_ROAD)))
    edges = np.linspace(extent[0], extent[1], count + 1)
    return [(float(a), float(b), extent[2], extent[3]) for a, b in zip(edges, edges[1:], strict=False)]


def draw_route(axes: Axes, points: np.ndarray, look: style.Stroke, inch_per_m: float, width: float = 1.4) -> None:
    """A route with few arrow heads, at least BETWEEN_ARROWS_IN apart on paper."""
    axes.plot(points[:, 0], points[:, 1], **look.line(), linewidth=width, zorder=2)
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    gap_m = BETWEEN_ARROWS_IN / inch_per_m
    for s in np.arange(0.5 * gap_m, along[-1], gap_m):
        ahead = s + 0.01 * gap_m
        at = [np.interp([s, ahead], along, points[:, axis]) for axis in (0, 1)]
        degrees = math.degrees(math.atan2(at[1][1] - at[1][0], at[0][1] - at[0][0]))
        axes.plot([at[0][0]], [at[1][0]], marker=(3, 0, degrees - 90.0), markersize=4.0 + width, color=look.colour,
                  markeredgecolor="#ffffff", markeredgewidth=0.3, linestyle="none", zorder=3)


def draw_cars(axes: Axes, place: dict, looks: list[style.Stroke], inch_per_m: float) -> None:
    """Cars and their goals, with the cars' ids beside them, or on them where they are large enough."""
    is_large = place["footprint"]["width_m"] * inch_per_m > 0.12
    for car, look in zip(place["vehicles"], looks, strict=True):
        map_axes.draw_goal(axes, car, look.colour)
        map_axes.draw_car(axes, place, car, look.colour)
        start = car["start"]
        side = 0.0 if is_large else 0.5 * place["footprint"]["width_m"] + 0.07 / inch_per_m
        axes.text(start["x_m"] - side * math.sin(start["yaw_rad"]), start["y_m"] + side * math.cos(start["yaw_rad"]),
                  str(car["id"]), fontsize=6.5, fontweight="bold", ha="center", va="center", zorder=5, clip_on=True,
                  path_effects=map_axes.HALO)


def draw_map(axes: Axes, place: dict, looks: list[style.Stroke], extent: tuple, inch_per_m: float,
             with_routes: bool) -> None:
    """One map or one strip of a road."""
    map_axes.draw_lanes(axes, place)
    map_axes.draw_zones(axes, place)
    map_axes.draw_obstacles(axes, place)
    map_axes.draw_lanelet_ids(axes, place, inch_per_m)
    if with_routes:
        for rank, route in enumerate(routes_of(place)):
            wide = 1.4 + 1.0 * (min(3, len(routes_of(place)) - 1 - rank))  # the first lie below the others
            points = map_axes.path_points(place["vehicles"][route[0]])
            draw_route(axes, points, looks[route[0]] if len(route) == 1 else style.Stroke(style.MARK), inch_per_m, wide)
    draw_cars(axes, place, looks, inch_per_m)
    map_axes.finish(axes, extent)


def draw(place: dict, with_poses: bool = False) -> style.Drawing:
    """The map; a road that is long as strips; more than MOST_ROUTES routes one by one below it.

    with_poses: the legend has the cars' start poses, a sheet to place them by.
    """
    extent = map_axes.extent_of(place)
    is_turned = extent[3] - extent[2] > LONG_ROAD * (extent[1] - extent[0])
    shown = turned(place) if is_turned else place
    strips = strips_of(map_axes.extent_of(shown))
    looks = style.strokes_of_cars([car["name"] for car in shown["vehicles"]])
    routes = routes_of(shown)
    thumbnails = len(routes) if len(routes) > MOST_ROUTES else 0
    width_m, height_m = strips[0][1] - strips[0][0], strips[0][3] - strips[0][2]
    inch_per_m = min(6.3 / width_m, (4.6 if thumbnails else 5.4) / height_m)
    rows = -(-thumbnails // IN_A_ROW)
    map_in = len(strips) * (height_m * inch_per_m + 0.45)
    thumb_in = rows * (0.95 * height_m / width_m + 0.2) if rows else 0.0
    figure = style.new_figure(map_in + thumb_in + 0.3 + 0.16 * -(-len(looks) // (2 if with_poses else 4)))
    grid = figure.add_gridspec(2 if rows else 1, 1, height_ratios=[map_in, thumb_in] if rows else [1.0])
    maps = grid[0].subgridspec(len(strips), 1).subplots(squeeze=False)[:, 0]
    for axes, strip in zip(maps, strips, strict=True):
        draw_map(axes, shown, looks, strip, inch_per_m, not thumbnails)
        if is_turned:
            axes.set(xlabel="$y$ [m]", ylabel="$x$ [m]")
            axes.yaxis.set_major_formatter(lambda value, _: f"{-value:g}")
        if axes is not maps[-1]:
            axes.set_xlabel("")
    if rows:
        draw_thumbnails(figure, grid[1], shown, looks, routes)
    style.legend_below(figure, entries_of(shown, looks, bool(thumbnails), place if with_poses else None))
    caption = "Lanes with their ids, routes, and cars at the start with white fronts (the paper's Fig. 3)."
    return style.Drawing(f"scenario_{place['scenario']}", figure, table_of(place), caption)


def draw_thumbnails(figure: Figure, grid: SubplotSpec, place: dict, looks: list[style.Stroke],
                    routes: list[list[int]]) -> None:
    """A small map for each route, with the ids of its cars."""
    extent = map_axes.extent_of(place)
    cells = grid.subgridspec(-(-len(routes) // IN_A_ROW), IN_A_ROW)
    inch_per_m = 0.95 / (extent[1] - extent[0])
    for number, route in enumerate(routes):
        axes = figure.add_subplot(cells[number // IN_A_ROW, number % IN_A_ROW])
        map_axes.draw_lanes(axes, place)
        car = place["vehicles"][route[0]]
        draw_route(axes, map_axes.path_points(car), looks[route[0]], inch_per_m, 1.2)
        axes.plot([car["start"]["x_m"]], [car["start"]["y_m"]], marker="o", markersize=3, color=looks[route[0]].colour,
                  markeredgecolor="#000000", markeredgewidth=0.4)
        map_axes.finish(axes, extent, labels=False)
        axes.set(xticks=[], yticks=[])
        axes.set_title(", ".join(str(place["vehicles"][index]["id"]) for index in route), pad=2, fontsize=7)


def pose_text(car: dict) -> str:
    """Where a car stands at the start."""
    start = car["start"]
    return (f", $x$ {start['x_m']:.2f} m, $y$ {start['y_m']:.2f} m, "
            rf"$\psi$ {start['yaw_rad']:.2f} rad ({math.degrees(start['yaw_rad']):.0f}°)")


def entries_of(place: dict, looks: list[style.Stroke], has_thumbnails: bool, poses_of: dict | None) -> list[object]:
    """Legend: a line per car, then lanes, zones, obstacles and goals. poses_of: the place whose poses are named."""
    entries: list[object] = []
    for index, (car, look) in enumerate(zip(place["vehicles"], looks, strict=True)):
        pose = pose_text(poses_of["vehicles"][index]) if poses_of else ""
        entries.append(Line2D([], [], label=f"{car['id']}: {car['name']}{pose}", **look.line(), linewidth=1.4))
    shared = [route for route in routes_of(place) if len(route) > 1]
    if shared and not has_thumbnails:
        entries.append(Line2D([], [], color=style.MARK, linewidth=1.4, label="route of several cars"))
    if place["lanelets"]:
        entries.append(Patch(facecolor=style.LANE, edgecolor=style.LANE_BORDER, linewidth=0.4, label="lane, with id"))
    if place["zones"]:
        entries.append(Patch(facecolor="none", edgecolor=style.PURPLE, hatch="////", label="speed zone of a policy"))
    if place.get("obstacles"):
        entries.append(Patch(facecolor=style.MARK, edgecolor="#000000", linewidth=0.5, alpha=0.75, label="obstacle"))
    if any("goal_m" in car for car in place["vehicles"]):
        entries.append(Patch(facecolor="none", edgecolor=style.MARK, linestyle="--", linewidth=0.9,
                             label="goal of a car, in its colour"))
    return entries


def table_of(place: dict) -> pd.DataFrame:
    """Start poses of the cars."""
    return pd.DataFrame([{"vehicle": car["id"], "name": car["name"], **car["start"],
                          "route_length_m": car["path"]["length_m"]} for car in place["vehicles"]])


def draw_group(group: Group) -> style.Drawing:
    """The scenario of a group."""
    return draw(group.place)
