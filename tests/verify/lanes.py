"""Does the planned footprint stay on the lanes where the vehicle may drive?

These are, by planner/road/route.hpp: the lanes of the vehicle's route and their neighbours of
the same direction; for a lane without such neighbours the one that merges with it or forks off it,
with that lane's neighbours. Derived independently here, from the map of
CommonRoad's reader.
"""

import numpy as np
import shapely
from commonroad.scenario.lanelet import Lanelet, LaneletNetwork
from run import Finding, Run, footprints

SAME_PLACE_M = 0.005
# Between neighbours of the lab's own map there are seams of up to 0.2 mm. They are closed from both
# sides; with mitred corners this leaves the outer edges where they are.
SEAM_M = 1e-4


def neighbours(network: LaneletNetwork, lanelet: Lanelet) -> list[Lanelet]:
    ids = []
    if lanelet.adj_left is not None and lanelet.adj_left_same_direction:
        ids.append(lanelet.adj_left)
    if lanelet.adj_right is not None and lanelet.adj_right_same_direction:
        ids.append(lanelet.adj_right)
    return [network.find_lanelet_by_id(i) for i in ids]


def with_neighbours(network: LaneletNetwork, lanelet: Lanelet) -> dict[int, Lanelet]:
    found = {lanelet.lanelet_id: lanelet}
    new = [lanelet]
    while new:
        new = [n for one in new for n in neighbours(network, one) if n.lanelet_id not in found]
        found.update({n.lanelet_id: n for n in new})
    return found


def is_same(a: np.ndarray, b: np.ndarray) -> bool:
    return float(np.linalg.norm(a - b)) <= SAME_PLACE_M


def merges_or_forks(lanelet: Lanelet, other: Lanelet) -> bool:
    """True if they end together and begin beside each other, or the other way round."""
    for joint, apart in ((-1, 0), (0, -1)):
        together = is_same(lanelet.left_vertices[joint], other.left_vertices[joint]) and is_same(
            lanelet.right_vertices[joint], other.right_vertices[joint]
        )
        beside = is_same(lanelet.left_vertices[apart], other.right_vertices[apart]) or is_same(
            lanelet.right_vertices[apart], other.left_vertices[apart]
        )
        if together and beside:
            return True
    return False


def drivable(network: LaneletNetwork, route: list[int]) -> dict[int, Lanelet]:
    found: dict[int, Lanelet] = {}
    for lanelet in (network.find_lanelet_by_id(i) for i in route):
        beside = with_neighbours(network, lanelet)
        if len(beside) == 1:
            for other in network.lanelets:
                if merges_or_forks(lanelet, other):
                    beside |= with_neighbours(network, other)
        found |= beside
    return found


def area_of(lanelets: dict[int, Lanelet]) -> shapely.Geometry:
    area = shapely.union_all([lanelet.polygon.shapely_object for lanelet in lanelets.values()])
    return area.buffer(SEAM_M, join_style="mitre").buffer(-SEAM_M, join_style="mitre")


def check_lanes(run: Run) -> tuple[list[Finding], str]:
    configuration, map_name = run.configuration, str(run.scenario.scenario_id)
    if not configuration.route_of:
        return [], "the scenario has none"
    findings = []
    least_m = np.inf
    for vehicle, obstacle in sorted(run.planned.items()):
        route_name = configuration.route_of[vehicle]
        route = configuration.routes[route_name].get(map_name)
        if route is None:
            text = f"vehicle {vehicle}: route {route_name} has no lanes on map {map_name}"
            findings.append(Finding("lanes", text))
            continue
        area = area_of(drivable(run.scenario.lanelet_network, route))
        shapely.prepare(area)
        rectangles = shapely.polygons(footprints(obstacle))
        inside = shapely.covers(area, rectangles)
        least_m = min(least_m, float(shapely.distance(area.boundary, rectangles).min()))
        if not inside.all():
            first = int(np.argmin(inside))
            out_mm2 = 1e6 * shapely.area(shapely.difference(rectangles[~inside], area)).max()
            text = f"vehicle {vehicle} leaves its lanes at {first * run.scenario.dt:.2f} s"
            findings.append(Finding("lanes", f"{text}, by {out_mm2:.1f} mm^2 at most"))
    return findings, f"planned footprints inside, {1e3 * least_m:.2f} mm from an edge at the least"
