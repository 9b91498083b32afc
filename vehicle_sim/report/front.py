"""Dominance and hypervolume of points whose coordinates are to be minimised."""

import numpy as np


def non_dominated(points: np.ndarray) -> np.ndarray:
    """True for each row that no other row dominates, i.e. is at most equal in all coordinates and smaller in one."""
    no_worse = (points[:, None, :] <= points[None, :, :]).all(axis=2)
    better = (points[:, None, :] < points[None, :, :]).any(axis=2)
    return ~(no_worse & better).any(axis=0)


def hypervolume(points: np.ndarray, reference: np.ndarray) -> float:
    """Area that the points (rows of two coordinates) dominate up to the reference point; points beyond it in some
    coordinate add nothing. Source: Zitzler and Thiele, IEEE Transactions on Evolutionary Computation 3 (1999)."""
    points = np.asarray(points, dtype=float).reshape(-1, 2)
    inside = points[(points < reference).all(axis=1)]
    inside = inside[np.argsort(inside[:, 0], kind="stable")]
    widths = np.diff(np.append(inside[:, 0], reference[0]))
    heights = reference[1] - np.minimum.accumulate(inside[:, 1]) if len(inside) else np.zeros(1)
    return float((widths[:len(inside)] * heights[:len(inside)]).sum())
