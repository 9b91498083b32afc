"""Does a vehicle touch another one? By CommonRoad's collision checker, planned and driven apart."""

from itertools import combinations

from commonroad.scenario.obstacle import DynamicObstacle
from commonroad_dc import pycrcc
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


def check_collisions(run: Run) -> tuple[list[Finding], str]:
    findings = []
    pairs = 0
    for kind, obstacles in (("planned", run.planned), ("driven", run.driven)):
        boxes = {vehicle: swept(obstacle) for vehicle, obstacle in obstacles.items()}
        for a, b in combinations(sorted(boxes), 2):
            pairs += 1
            i = first_touch(boxes[a], boxes[b])
            if i is not None:
                text = f"vehicles {a} and {b}, {kind}, touch at {i * run.scenario.dt:.2f} s"
                findings.append(Finding("collision", text))
    return findings, f"none in {pairs} pairs (planned and driven)" if pairs else "one vehicle alone"


def check_size(run: Run) -> list[Finding]:
    """The file's rectangles are those of the configuration."""
    p = run.configuration.vehicle
    return [
        Finding("size", f"element {o.obstacle_id}: {s.length} x {s.width} m, must be {p.l} x {p.w}")
        for o in [*run.planned.values(), *run.driven.values()]
        if (s := o.obstacle_shape).length != p.l or s.width != p.w
    ]
