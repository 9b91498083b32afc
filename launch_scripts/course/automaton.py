"""Exercise 3: find an automaton with fewer trims and no more error.

The search tree of a plan grows with the trims. The paper's twelve drive the red car along its lane at 0.75 m/s. Find
six or fewer, of any speed and steering, that keep as near to the middle of the lane and are as fast.

The first trim is standstill. It leads to every trim and back; the others lead to their neighbours in this list only, so
order them by their steering. The maneuvers between them are the paper's: least effort (criterion J2) in 0.2 s.
"""

TRIMS = [  # (speed [m/s], steering [rad]). As given: the paper's
    (0.0, 0.0),
    (0.4, -0.60), (0.5, -0.48), (0.6, -0.36), (0.7, -0.24), (0.8, -0.12),
    (0.8, 0.0),
    (0.8, 0.12), (0.7, 0.24), (0.6, 0.36), (0.5, 0.48), (0.4, 0.60),
]

if __name__ == "__main__":
    print(len(TRIMS), "trims:", *TRIMS)
