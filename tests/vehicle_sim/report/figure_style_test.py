"""Colours and dashes."""

import unittest

from report import style


class Strokes(unittest.TestCase):
    def test_twenty_eight_series_are_all_different(self) -> None:
        self.assertEqual(len({style.stroke(index) for index in range(28)}), 28)

    def test_neighbours_differ_in_colour_and_dashes(self) -> None:
        for index in range(6):
            self.assertNotEqual(style.stroke(index).colour, style.stroke(index + 1).colour)
            self.assertNotEqual(style.stroke(index).dashes, style.stroke(index + 1).dashes)

    def test_cars_named_as_colours_have_these_and_no_two_are_alike(self) -> None:
        names = ["red", "one", "blue", "red", *[f"car {index}" for index in range(16)]]
        looks = style.strokes_of_cars(names)
        self.assertEqual(looks[0], style.Stroke(style.VERMILION))
        self.assertEqual(looks[2], style.Stroke(style.BLUE))
        self.assertEqual(len(set(looks)), 20)

    def test_more_cars_than_strokes_still_have_one_each(self) -> None:
        self.assertEqual(len(style.strokes_of_cars([f"car {index}" for index in range(60)])), 60)

    def test_dashed_lines_lie_above_those_that_they_leave_visible(self) -> None:
        ranks = [style.Stroke("#000000", dashes).rank for dashes in style.STROKES]
        self.assertEqual(ranks, sorted(set(ranks)))
        self.assertEqual(ranks[0], 0.0)


if __name__ == "__main__":
    unittest.main()
