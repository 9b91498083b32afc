"""Does a vehicle touch another one, or an obstacle? By CommonRoad's collision checker.

Planned and driven motions apart.
"""

from itertools import combinations, product

from commonroad.scenario.obstacle import DynamicObstacle
from commonroad_dc import pycrcc
from commonroad_dc.collision.collision_detection.pycrcc_collision_dispatch import (
    create_collision_object,
)
from commonroad_dc.collision.trajectory_queries.trajectory_queries import (
    trajectory_preprocess_obb_sum,
)
from run import Finding, Run, states


def swept(obstacle: DynamicObstacle) -> pycrcc.TimeVariantCollisionObject:
    """The vehicle's own rectangle, and between two samples a box around both."""
    shape = obstacle.obstacle_shape
    boxes = pycrcc.TimeVariantCollisionObject(0)
    for s in states(obstacle):
        boxes.append_obstacle(
            pycrcc.RectOBB(0.5 * shape.length, 0.5 * shape.width, s.heading_rad, s.x_m, s.y_m)
        )
    hulls, is_broken = trajectory_preprocess_obb_sum(boxes)
    if is_broken:
        raise RuntimeError(f"element {obstacle.obstacle_id}: the collision checker makes no boxes")
    return hulls


def first_touch(
    a: pycrcc.TimeVariantCollisionObject, b: pycrcc.TimeVariantCollisionObject
) -> int | None:
    if not a.collide(b):
        return None
    for i in range(min(a.time_end_idx(), b.time_end_idx()) + 1):
        if a.obstacle_at_time(i).collide(b.obstacle_at_time(i)):
            return i
    return 0


def first_touch_of_obstacle(
    boxes: pycrcc.TimeVariantCollisionObject, shape: pycrcc.CollisionObject
) -> int | None:
    for i in range(boxes.time_start_idx(), boxes.time_end_idx() + 1):
        if boxes.obstacle_at_time(i).collide(shape):
            return i
    return None


def check_collisions(run: Run) -> tuple[list[Finding], str]:
    findings = []
    pairs = 0
    standing = {o.obstacle_id: create_collision_object(o) for o in run.scenario.static_obstacles}
    for kind, obstacles in (("planned", run.planned), ("driven", run.driven)):
        boxes = {vehicle: swept(obstacle) for vehicle, obstacle in obstacles.items()}
        for a, b in combinations(sorted(boxes), 2):
            pairs += 1
            i = first_touch(boxes[a], boxes[b])
            if i is not None:
                text = f"vehicles {a} and {b}, {kind}, touch at {i * run.scenario.dt:.2f} s"
                findings.append(Finding("collision", text))
        for vehicle, obstacle in product(sorted(boxes), sorted(standing)):
            i = first_touch_of_obstacle(boxes[vehicle], standing[obstacle])
            if i is not None:
                text = f"vehicle {vehicle}, {kind}, touches obstacle {obstacle}"
                findings.append(Finding("collision", f"{text} at {i * run.scenario.dt:.2f} s"))
    seen = f"none in {pairs} pairs (planned and driven)" if pairs else "one vehicle alone"
    return findings, f"{seen}, {len(standing)} obstacles" if standing else seen


def check_size(run: Run) -> list[Finding]:
    """The file's rectangles are those of the configuration."""
    p = run.configuration.vehicle
    return [
        Finding("size", f"element {o.obstacle_id}: {s.length} x {s.width} m, must be {p.l} x {p.w}")
        for o in [*run.planned.values(), *run.driven.values()]
        if (s := o.obstacle_shape).length != p.l or s.width != p.w
    ]
