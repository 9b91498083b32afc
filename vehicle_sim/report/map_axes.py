"""Axes with a map: lanes, routes, speed zones, obstacles, goals, cars."""

from collections.abc import Sequence

import matplotlib.patheffects as effects
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon, Rectangle
from matplotlib.ticker import MaxNLocator

from . import style

ID_PLACES = (0.5, 0.35, 0.65, 0.2, 0.8)  # of a lanelet, as shares of its length, the best first
ID_ROOM_IN = 0.14
HALO = [effects.withStroke(linewidth=1.6, foreground="#ffffff")]


def closed(points_m: Sequence[Sequence[float]], is_closed: bool) -> np.ndarray:
    """The points of a path as an array, the first again at the end of a closed one."""
    points = np.asarray(points_m, dtype=float).reshape(-1, 2)
    return np.vstack([points, points[:1]]) if is_closed else points


def path_points(vehicle: dict) -> np.ndarray:
    """The path of a car of places.json."""
    return closed(vehicle["path"]["points_m"], vehicle["path"]["is_closed"])


def extent_of(place: dict) -> tuple[float, float, float, float]:
    """x from, x to, y from, y to of lanes, paths, goals, obstacles and cars' middles, with a margin for whole cars."""
    margin = 0.75 * place["footprint"]["length_m"]
    pieces = [np.asarray(lane[side]) for lane in place["lanelets"] for side in ("left_m", "right_m")]
    pieces += [path_points(car) for car in place["vehicles"]]
    pieces += [np.array([[car["start"]["x_m"], car["start"]["y_m"]]]) for car in place["vehicles"]]
    pieces += [np.asarray(one["corners_m"]) for one in place.get("obstacles", [])]
    pieces += [np.asarray(car["goal_m"]) for car in place["vehicles"] if "goal_m" in car]
    points = np.vstack(pieces)
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    return float(low[0]), float(high[0]), float(low[1]), float(high[1])


def draw_lanes(axes: Axes, place: dict) -> None:
    """Lanes in grey with their borders."""
    for lane in place["lanelets"]:
        left, right = np.asarray(lane["left_m"]), np.asarray(lane["right_m"])
        axes.add_patch(Polygon(np.vstack([left, right[::-1]]), facecolor=style.LANE, edgecolor="none", zorder=0.5))
        for border in (left, right):
            axes.plot(border[:, 0], border[:, 1], color=style.LANE_BORDER, linewidth=0.4, zorder=0.6)


def draw_zones(axes: Axes, place: dict) -> list[float]:
    """The speed zones of all policies, hatched, each once, with their limits. Returns the limits."""
    seen: dict[tuple[float, ...], float] = {}
    for zones in place["zones"].values():
        for zone in zones:
            seen[zone["min_x_m"], zone["min_y_m"], zone["max_x_m"], zone["max_y_m"]] = zone["max_speed_mps"]
    for (x, y, to_x, to_y), limit in seen.items():
        axes.add_patch(Rectangle((x, y), to_x - x, to_y - y, facecolor="none", edgecolor=style.PURPLE, hatch="////",
                                 linewidth=0.8, alpha=0.55, zorder=0.9))
        axes.text(x, to_y, rf" $v \leq {limit:g}$ m/s", color=style.PURPLE, fontsize=6.5, va="bottom",
                  path_effects=HALO, zorder=6)
    return sorted(seen.values())


def draw_obstacles(axes: Axes, place: dict) -> bool:
    """What stands in the way for good, with its name. Returns whether there is any."""
    obstacles = place.get("obstacles", [])
    for one in obstacles:
        corners = np.asarray(one["corners_m"])
        axes.add_patch(Polygon(corners, facecolor=style.MARK, edgecolor="#000000", linewidth=0.5, alpha=0.75, zorder=3))
        axes.text(*corners.mean(axis=0), one["name"], fontsize=5, ha="center", va="center", zorder=3.6, clip_on=True,
                  path_effects=HALO)
    return bool(obstacles)


def draw_goal(axes: Axes, car: dict, colour: str) -> None:
    """The region that a car drives to, if it has one."""
    if "goal_m" not in car:
        return
    for fill, alpha in ((colour, 0.2), ("none", 1.0)):
        axes.add_patch(Polygon(np.asarray(car["goal_m"]), facecolor=fill, edgecolor=colour, linestyle="--",
                               linewidth=0.9, alpha=alpha, zorder=1.5))


def draw_car(axes: Axes, place: dict, car: dict, colour: str) -> None:
    """The footprint of a car at its start, its front white."""
    length, width = place["footprint"]["length_m"], place["footprint"]["width_m"]
    start = car["start"]
    turn = np.array([[np.cos(start["yaw_rad"]), np.sin(start["yaw_rad"])],
                     [-np.sin(start["yaw_rad"]), np.cos(start["yaw_rad"])]])
    for rear, front, fill in ((-0.5, 0.5, colour), (0.25, 0.5, "#ffffff")):
        corners = np.array([[rear * length, -0.5 * width], [front * length, -0.5 * width],
                            [front * length, 0.5 * width], [rear * length, 0.5 * width]])
        axes.add_patch(Polygon(corners @ turn + [start["x_m"], start["y_m"]], facecolor=fill, edgecolor="#000000",
                               linewidth=0.5, zorder=4))


def draw_lanelet_ids(axes: Axes, place: dict, inch_per_m: float) -> None:
    """The ids of the lanelets that are long enough for them on paper.

    Lanes that part, join or cross lie on each other: each id stands where it is farthest from those before it.
    """
    taken = np.empty((0, 2))
    for lane in place["lanelets"]:
        middle = 0.5 * (np.asarray(lane["left_m"]) + np.asarray(lane["right_m"]))
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(middle, axis=0), axis=1))])
        if along[-1] * inch_per_m < 0.16:
            continue
        places = np.array([[np.interp(share * along[-1], along, middle[:, axis]) for axis in (0, 1)]
                           for share in ID_PLACES])
        room = np.array([np.min(np.linalg.norm(taken - one, axis=1), initial=2 * ID_ROOM_IN / inch_per_m)
                         for one in places])
        enough = np.flatnonzero(room * inch_per_m >= ID_ROOM_IN)
        at = places[enough[0] if len(enough) else int(np.argmax(room))]
        taken = np.vstack([taken, at])
        axes.text(*at, str(lane["id"]), fontsize=4.5, color="#555555", ha="center", va="center", zorder=3.5,
                  clip_on=True, path_effects=HALO)


def finish(axes: Axes, extent: tuple[float, float, float, float], labels: bool = True) -> None:
    """Equal scales, the extent, labels with units."""
    axes.set_aspect("equal")
    axes.set_xlim(extent[0], extent[1])
    axes.set_ylim(extent[2], extent[3])
    if extent[1] - extent[0] > 8.0 * (extent[3] - extent[2]):
        axes.yaxis.set_major_locator(MaxNLocator(1))
    axes.grid(False)
    if labels:
        axes.set_xlabel("$x$ [m]")
        axes.set_ylabel("$y$ [m]")


def mark_gridlock(axes: Axes, x: float, y: float, colour: str) -> None:
    """A cross with the word where a car stands in gridlock as the run ends; words of cars nearby above each other."""
    near = 0.1 * (axes.get_xlim()[1] - axes.get_xlim()[0])
    level = sum(np.hypot(text.xy[0] - x, text.xy[1] - y) < near for text in axes.texts
                if text.get_text() == "gridlock")
    axes.plot([x], [y], marker="X", markersize=6, color=colour, markeredgecolor="#ffffff", markeredgewidth=0.6,
              linestyle="none", zorder=7)
    axes.annotate("gridlock", (x, y), xytext=(5, 5 + 9 * level), textcoords="offset points", fontsize=7, color=colour,
                  fontweight="bold", path_effects=HALO, zorder=8, annotation_clip=True)
