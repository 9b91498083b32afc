"""Positions relative to a path: arc length and signed distance."""

import numpy as np

AHEAD_M = 0.5  # how far from the place before the next one is searched: a tick at 5 m/s is 0.1 m


class Path:
    """A polyline for projections."""

    def __init__(self, points_m: np.ndarray) -> None:
        """points_m: the corners; a closed path repeats its first one at its end."""
        self.begin = points_m[:-1]
        along = np.diff(points_m, axis=0)
        self.length = np.linalg.norm(along, axis=1)
        self.unit = along / self.length[:, None]
        self.s = np.concatenate([[0.0], np.cumsum(self.length)])
        self.is_closed = bool(np.allclose(points_m[0], points_m[-1]))

    @property
    def total_m(self) -> float:
        """Length of the path [m]."""
        return float(self.s[-1])

    def nearest(self, point: np.ndarray, near_s: float | None) -> tuple[float, float]:
        """Arc length [m] and signed distance [m], to the left positive, of the nearest point.

        near_s: only places within AHEAD_M of it count, so that another strand nearby is never taken.
        """
        offset = point - self.begin
        share = np.clip(np.einsum("ij,ij->i", offset, self.unit), 0.0, self.length)
        gap = offset - share[:, None] * self.unit
        distance = np.linalg.norm(gap, axis=1)
        s = self.s[:-1] + share
        if near_s is not None:
            away = np.abs(s - near_s)
            if self.is_closed:
                away = np.minimum(away, self.total_m - away)
            if (away < AHEAD_M).any():
                distance = np.where(away < AHEAD_M, distance, np.inf)
        i = int(np.argmin(distance))
        side = self.unit[i, 0] * gap[i, 1] - self.unit[i, 1] * gap[i, 0]
        return float(s[i]), float(np.copysign(distance[i], side))

    def offsets(self, positions_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Arc lengths, unwrapped, from the first position on [m], and signed distances [m]."""
        s = np.zeros(len(positions_m))
        sides = np.zeros(len(positions_m))
        near = None
        for i, position in enumerate(positions_m):
            near, sides[i] = self.nearest(position, near)
            s[i] = near
        if self.is_closed and len(s):
            s = np.unwrap(s, period=self.total_m)
        return (s - s[0] if len(s) else s), sides
