"""Half way to exercise 1: the mean over all pieces of what their ends show."""
import math

import numpy as np


def ends(piece, wheelbase_m, rear_axle_to_cg_m):
    first, last = piece[0], piece[-1]
    duration_s, turn_rad = last[0] - first[0], last[3] - first[3]
    chord_m = math.dist(first[1:3], last[1:3])
    speed_mps = chord_m / duration_s * (turn_rad / 2 / math.sin(turn_rad / 2) if turn_rad else 1.0)
    # tan d = w L / (v cos b), with tan b = lr / L tan d
    without_slip = turn_rad / duration_s * wheelbase_m / speed_mps
    tangent = without_slip
    for _ in range(5):
        tangent = without_slip * math.hypot(1, rear_axle_to_cg_m / wheelbase_m * tangent)
    return speed_mps, math.atan(tangent)


def identify(pieces, wheelbase_m, rear_axle_to_cg_m):
    return tuple(np.mean([ends(one, wheelbase_m, rear_axle_to_cg_m) for one in pieces], axis=0))
