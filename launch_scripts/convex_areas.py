"""Convex areas: lists of corners (x, y) in metres, counter-clockwise, and lines n_x x + n_y y = offset."""
import math


def beyond(area, line):
    """Of the corners, the least and the largest distance on the far side of the line [m]."""
    distances = [line[0] * x + line[1] * y - line[2] for x, y in area]
    return min(distances), max(distances)


def edges(area):  # (n_x, n_y, offset) of each, n pointing outwards
    found = []
    for (ax, ay), (bx, by) in zip(area, area[1:] + area[:1]):
        if (length := math.hypot(bx - ax, by - ay)) > 1e-9:  # of a shorter one the direction is rounding
            n = ((by - ay) / length, (ax - bx) / length)
            found.append((*n, n[0] * ax + n[1] * ay))
    return found


def overlap(a, b):
    """How far one must move to be apart, over the normals of all edges [m]; < 0: they are, by so much at least."""
    gap = max(min(p[i] for p in one) - max(p[i] for p in other) for one, other in ((a, b), (b, a)) for i in (0, 1))
    if gap > 0:  # along an axis: most pairs
        return -gap
    return min(-beyond(other, line)[0] for one, other in ((a, b), (b, a)) for line in edges(one))


def outside(outer, inner):  # how far `inner` reaches out of the convex `outer` [m]
    return max(beyond(inner, line)[1] for line in edges(outer))


def size(area):  # [m^2], > 0 counter-clockwise
    return sum(ax * by - bx * ay for (ax, ay), (bx, by) in zip(area, area[1:] + area[:1])) / 2
