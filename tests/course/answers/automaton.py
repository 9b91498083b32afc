"""A good answer to exercise 3, found by random changes of one or two trims from one straight on and three bends."""

TRIMS = [(0.0, 0.0), (0.8, -0.26), (0.7, -0.07), (0.7, -0.01), (0.85, 0.21)]
