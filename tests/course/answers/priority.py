"""A good answer to exercise 2: who is first where two ways meet plans first.

Who has to wait for another car anyway loses little by planning after it, but a car that has others behind it and has to
make room for them can only stop.
"""
import numpy as np

LEAST_SINE = 0.2  # of directions that meet


def is_before(position_m, direction, other_m, other_direction):
    """How the ways straight on compare, -1: shorter to the point where they meet; of parallel ones, who is ahead."""
    between_m = other_m - position_m
    sine = direction[0] * other_direction[1] - direction[1] * other_direction[0]
    if abs(sine) < LEAST_SINE:
        return np.sign(between_m @ direction)
    own_m = (between_m[0] * other_direction[1] - between_m[1] * other_direction[0]) / sine
    others_m = (between_m[0] * direction[1] - between_m[1] * direction[0]) / sine
    return np.sign(own_m - others_m)


def rule(situation):
    place = {vehicle: i for i, vehicle in enumerate(situation.vehicles)}
    positions_m = situation.poses[:, :2]
    directions = np.column_stack([np.cos(situation.poses[:, 2]), np.sin(situation.poses[:, 2])])

    def behind(vehicle):
        i = place[vehicle]
        return sum(is_before(positions_m[i], directions[i], positions_m[j], directions[j])
                   for j in (place[other] for other in situation.coupled[vehicle]))

    return sorted(situation.vehicles, key=behind)
