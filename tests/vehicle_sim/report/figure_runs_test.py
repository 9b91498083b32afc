"""Figures of runs over place: paths and errors."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
from made_up_series import MadeUp, legend_texts, ring, texts_of

from report import figure_error, figure_paths, lateral, map_axes, style


class Lateral(unittest.TestCase):
    def setUp(self) -> None:
        self.path = lateral.Path(map_axes.closed(ring(1.0, 720), True))

    def test_a_lap_and_a_half_outside_has_its_arc_length_and_a_negative_side(self) -> None:
        turns = np.linspace(0.0, 3.0 * np.pi, 400)
        s, side = self.path.offsets(1.1 * np.column_stack([np.cos(turns), np.sin(turns)]))
        np.testing.assert_allclose(s, turns, atol=1e-3)
        np.testing.assert_allclose(side, -0.1, atol=1e-4)

    def test_another_strand_nearby_is_not_taken(self) -> None:
        strands = lateral.Path(np.array([[0.0, 0.0], [5.0, 0.0], [5.0, 0.2], [0.0, 0.2]]))
        x = np.linspace(0.0, 3.0, 60)
        s, side = strands.offsets(np.column_stack([x, 0.05 * x]))
        np.testing.assert_allclose(s, x, atol=1e-9)
        np.testing.assert_allclose(side, 0.05 * x, atol=1e-9)


class Paths(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.enterContext(style.journal())

    def test_the_box_lies_where_two_differ_most_and_a_third_that_stands_does_not_count(self) -> None:
        path = lateral.Path(map_axes.closed(ring(1.0, 720), True))
        turns = np.linspace(0.0, 2.0 * np.pi, 700)
        unit = np.column_stack([np.cos(turns), np.sin(turns)])
        bulge = 1.0 + 0.1 * np.exp(-((turns - 2.0) / 0.1) ** 2)
        drives = [unit, bulge[:, None] * unit, np.repeat(unit[:1], 700, axis=0)]
        place, largest = figure_paths.where_they_differ(path, drives)
        self.assertAlmostEqual(largest, 0.1, delta=0.002)
        np.testing.assert_allclose(place, 1.05 * np.array([np.cos(2.0), np.sin(2.0)]), atol=0.03)

    def test_all_starts_are_drawn_and_their_positions_are_the_data(self) -> None:
        group = MadeUp(starts=3).group(self.folder)
        drawing = figure_paths.draw(group)
        texts = texts_of(drawing.figure)
        for text in ("$x$ [m]", "$y$ [m]", "whole drive"):
            self.assertIn(text, texts)
        self.assertIn("box enlarged: they differ most, by 30 mm", texts)  # 1 cm and 4 cm outside
        for text in ("subgraph A", "subgraph B", "centre of the lane", "thin: 2 other starts each", "lane"):
            self.assertIn(text, legend_texts(drawing.figure))
        self.assertEqual(set(drawing.data["start"]), {0, 1, 2})
        plotted = {tuple(line.get_xdata()) for line in drawing.figure.axes[0].lines}
        for _, own in drawing.data.groupby(["planned_on", "start"]):
            self.assertIn(tuple(own["x_m"]), plotted)

    def test_a_car_that_ends_stuck_has_the_word_where_it_stands(self) -> None:
        made_up = MadeUp(starts=1)
        self.assertNotIn("gridlock", texts_of(figure_paths.draw(made_up.group(self.folder)).figure))
        made_up.stuck = {(1, 1)}
        group = made_up.group(self.folder)
        words = [text for text in figure_paths.draw(group).figure.axes[0].texts if text.get_text() == "gridlock"]
        self.assertEqual(len(words), 1)
        end = group.drive_of(group.runs[1], 1).iloc[-1]
        self.assertEqual(words[0].xy, (end["x_m"], end["y_m"]))

    def test_words_of_cars_that_stand_at_one_place_do_not_lie_on_each_other(self) -> None:
        made_up = MadeUp(starts=1)
        made_up.stuck = {(0, 1), (1, 1)}
        figure = figure_paths.draw(made_up.group(self.folder)).figure
        figure.draw_without_rendering()
        first, second = [text for text in figure.axes[0].texts if text.get_text() == "gridlock"]
        self.assertFalse(first.get_window_extent().overlaps(second.get_window_extent()))


class Errors(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.enterContext(style.journal())

    def test_axes_have_units_and_the_own_start_is_the_data(self) -> None:
        group = MadeUp().group(self.folder)
        drawing = figure_error.draw(group)
        texts = texts_of(drawing.figure)
        self.assertIn("arc length along the lane's centre, from the start [m]", texts)
        self.assertIn("distance to the lane's centre [mm]", texts)
        own = drawing.data[(drawing.data["what"] == "own start") & (drawing.data["planned_on"] == "subgraph B")]
        self.assertEqual(set(own["error_mm"].round(9)), {40.0})
        line = drawing.figure.axes[1].lines
        self.assertTrue(any(list(one.get_ydata()) == list(own["error_mm"]) for one in line))
        self.assertEqual(own["arc_length_m"].iloc[0], 0.0)

    def test_the_band_is_the_spread_over_other_starts_at_the_same_place(self) -> None:
        made_up = MadeUp(planned_on=(("A", "none"),), starts=12, steps=60)
        group = made_up.group(self.folder)
        band = figure_error.spread(group, group.runs[0])
        whole = band[band["starts"] == 11]
        self.assertGreater(len(whole), 10)
        # Errors of the other starts are 20, 30, ... 120 mm everywhere.
        np.testing.assert_allclose(whole["median_mm"], 70.0)
        np.testing.assert_allclose(whole["low_mm"], 25.0)
        np.testing.assert_allclose(whole["high_mm"], 115.0)
        self.assertIn("11 other starts at the same place: 5 % to 95 %", legend_texts(figure_error.draw(group).figure))

    def test_errors_of_one_place_meet_wherever_a_start_begins(self) -> None:
        made_up = MadeUp(planned_on=(("A", "none"),), starts=4, steps=60)
        made_up.place["vehicles"][0]["start_s_m"] = 2.0
        made_up.error_at = lambda run, s_m: 5.0 * ((s_m - 2.0) % (2.0 * np.pi))  # by the place on the route
        group = made_up.group(self.folder)
        band = figure_error.spread(group, group.runs[0])
        self.assertGreater(len(band), 20)
        inner = band[(band["arc_length_m"] > 0.3) & (band["arc_length_m"] < 6.0)]
        np.testing.assert_allclose(inner["median_mm"], 5.0 * inner["arc_length_m"], atol=0.5)
        np.testing.assert_allclose(inner["high_mm"], inner["low_mm"], atol=1.0)

    def test_a_start_that_stands_long_at_a_place_counts_once_there(self) -> None:
        made_up = MadeUp(planned_on=(("A", "none"),), starts=4, steps=60)
        before = figure_error.spread(*self.first_of(made_up))
        made_up.stuck = {(3, 1)}
        after = figure_error.spread(*self.first_of(made_up))
        shared = before.merge(after, on="arc_length_m")
        same = shared[shared["starts_x"] == shared["starts_y"]]
        self.assertGreater(len(same), 3)
        np.testing.assert_allclose(same["median_mm_x"], same["median_mm_y"])

    def first_of(self, made_up: MadeUp):
        """The group and its first run."""
        group = made_up.group(self.folder)
        return group, group.runs[0]

    def test_gridlock_is_named_of_the_own_start_and_counted_of_the_others(self) -> None:
        made_up = MadeUp(planned_on=(("A", "none"),), starts=4)
        self.assertFalse([text for text in texts_of(figure_error.draw(made_up.group(self.folder)).figure)
                          if "gridlock" in text])
        made_up.stuck = {(0, 1), (2, 1), (3, 1)}
        texts = texts_of(figure_error.draw(made_up.group(self.folder)).figure)
        self.assertIn("gridlock", texts)
        figure = figure_error.draw(made_up.group(self.folder)).figure
        figure.draw_without_rendering()
        word = next(text for text in figure.axes[0].texts if text.get_text() == "gridlock")
        self.assertLessEqual(word.get_window_extent().x1, figure.axes[0].get_window_extent().x1)
        self.assertIn("subgraph A (gridlock in 2 of 3 other starts)", texts)


if __name__ == "__main__":
    unittest.main()
