"""Exercise 1: find speed and steering of a trim from a drive.

A trim is constant speed and steering, so that a car in it drives along a circle. From its speed v [m/s] and steering
d [rad] follow the slip b [rad] of the course at the centre of gravity and the yaw rate w [rad/s] (the kinematic
single-track model):

    tan b = lr / L tan d,    w = v / L cos b tan d,

with the wheelbase L [m] and the way lr [m] from the rear axle to the centre of gravity. What was measured has noise: up
to 2 mm in position, 0.010 rad in yaw. The three simulated drives have many pieces of each trim; a piece is 0.2 s long.
"""
import math

import numpy as np


def identify(pieces, wheelbase_m, rear_axle_to_cg_m):
    """(speed [m/s], steering [rad]) of the trim that the car has in all of these pieces of a drive.

    pieces: arrays (n, 4) of rows t [s], x [m], y [m] of the centre of gravity, yaw [rad]. The yaw has no jumps of
        2 pi; the course differs from it by the slip
    """
    # As given: straight ahead, from the first to the last position of the first piece. All pieces know more.
    first, last = pieces[0][0], pieces[0][-1]
    return math.dist(first[1:3], last[1:3]) / (last[0] - first[0]), 0.0


if __name__ == "__main__":
    half_circle = np.linspace(0.0, math.pi, 50)
    example = np.column_stack([half_circle, np.sin(half_circle), 1 - np.cos(half_circle), half_circle])
    speed_mps, steering_rad = identify([example], 0.150, 0.075)
    print(f"a circle of 1 m radius at 1 m/s: {speed_mps:.3f} m/s, {steering_rad:.3f} rad")
