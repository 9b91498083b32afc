"""Dominance and hypervolume against a grid."""

import unittest

import numpy as np
from made_up import seeds

from report.front import hypervolume, non_dominated


class Front(unittest.TestCase):
    """Points on a grid of integers, whose cells can be counted."""

    def test_hypervolume_is_the_number_of_dominated_cells(self) -> None:
        for seed, generator in seeds(100):
            points = generator.integers(0, 14, (int(generator.integers(0, 9)), 2)).astype(float)
            reference = np.array([10.0, 12.0])
            cells = np.array([(x, y) for x in range(10) for y in range(12)])
            dominated = (points[None] <= cells[:, None]).all(axis=2).any(axis=1)
            with self.subTest(seed=seed):
                self.assertEqual(hypervolume(points, reference), dominated.sum())

    def test_hypervolume_needs_no_order_and_grows_with_points(self) -> None:
        for seed, generator in seeds(50):
            points = generator.integers(0, 77, (6, 2)) / 64  # sums of these have no rounding
            volume = hypervolume(points, np.ones(2))
            with self.subTest(seed=seed):
                self.assertEqual(hypervolume(generator.permutation(points), np.ones(2)), volume)
                self.assertLessEqual(hypervolume(points[:-1], np.ones(2)), volume)
                self.assertEqual(hypervolume(points[non_dominated(points)], np.ones(2)), volume)

    def test_a_point_beyond_the_reference_adds_nothing(self) -> None:
        reference = np.array([10.0, 10.0])
        for beyond in ([10.0, 0.0], [0.0, 10.0], [0.0, 11.0]):
            self.assertEqual(hypervolume(np.array([[5.0, 5.0], beyond]), reference), 25.0)

    def test_a_row_is_dominated_by_one_that_is_nowhere_worse_and_somewhere_better(self) -> None:
        points = np.array([[1.0, 4.0], [2.0, 2.0], [2.0, 2.0], [2.0, 3.0], [5.0, 1.0]])
        self.assertEqual(list(non_dominated(points)), [True, True, True, False, True])


if __name__ == "__main__":
    unittest.main()
