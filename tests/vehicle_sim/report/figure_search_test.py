"""Figures of the search and of distances over time."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
import pandas as pd
from made_up_series import MadeUp, legend_texts, texts_of

from report import figure_distances, figure_planning_time, figure_vertices, style


class WithFolder(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.enterContext(style.journal())


class Vertices(WithFolder):
    def test_each_car_has_a_line_in_both_panels_of_a_run(self) -> None:
        drawing = figure_vertices.draw(MadeUp(cars=3).group(self.folder))
        panels = drawing.figure.axes
        self.assertEqual([axes.get_title(loc="left") for axes in panels],
                         ["subgraph A: generated", "subgraph A: expanded", "subgraph B: generated",
                          "subgraph B: expanded"])
        own = drawing.data[(drawing.data["planned_on"] == "subgraph B") & (drawing.data["vehicle"] == 2)]
        for axes, kind in zip(panels[2:], ("generated", "expanded"), strict=True):
            self.assertEqual(len(axes.lines), 3)
            np.testing.assert_array_equal(axes.lines[1].get_ydata(), own[kind])
        self.assertEqual(legend_texts(drawing.figure), ["car 1: red", "car 2: blue", "car 3: green"])
        self.assertIn("vertices in a step", texts_of(drawing.figure))
        self.assertIn("time [s]", texts_of(drawing.figure))

    def test_steps_without_a_search_are_gaps(self) -> None:
        drawing = figure_vertices.draw(MadeUp(starts=1).group(self.folder))
        first = drawing.data[drawing.data["time_s"] == 0.0]
        self.assertTrue(first["generated"].isna().all())
        self.assertFalse(drawing.data[drawing.data["time_s"] > 0.0]["generated"].isna().any())

    def test_of_many_cars_the_largest_and_the_median_have_colours(self) -> None:
        drawing = figure_vertices.draw(MadeUp(cars=20, starts=1).group(self.folder))
        self.assertEqual(legend_texts(drawing.figure),
                         ["largest tree of a car", "median of the cars", "each of the 20 cars"])
        self.assertEqual(len(drawing.figure.axes[0].lines), 20 + 2)


class PlanningTime(WithFolder):
    def test_exceedance_is_the_share_that_took_at_least_as_long(self) -> None:
        table = figure_planning_time.exceedance(np.array([0.2, 0.1, 0.4, 0.2, 3.0]))
        self.assertEqual(list(table["planning_ms"]), [0.1, 0.2, 0.4, 3.0])
        np.testing.assert_allclose(table["share_percent"], [100.0, 80.0, 40.0, 20.0])

    def test_quantiles_and_the_length_of_a_step_are_drawn(self) -> None:
        group = MadeUp(starts=1).group(self.folder)
        drawing = figure_planning_time.draw(group)
        boxes = drawing.figure.axes[0]
        times = group.steps[group.steps["run"] == 0]["planning_ms"].dropna()
        np.testing.assert_allclose(boxes.lines[0].get_xdata(), times.quantile([0.05, 0.95]))
        np.testing.assert_allclose(boxes.lines[1].get_xdata(), times.quantile([0.25, 0.75]))
        np.testing.assert_allclose(boxes.lines[2].get_xdata(), [times.median()])
        np.testing.assert_allclose(boxes.lines[3].get_xdata(), [times.max()])
        self.assertIn("length of a step (200 ms)", legend_texts(drawing.figure))
        self.assertIn("planning time of a car's step [ms]", texts_of(drawing.figure))
        self.assertIn("share of the plans [%]", texts_of(drawing.figure))

    def test_times_that_nobody_measured_give_no_figure(self) -> None:
        group = MadeUp(starts=1).group(self.folder)
        group.steps["planning_ms"] = np.nan
        self.assertIsNone(figure_planning_time.draw(group))


class Distances(WithFolder):
    def test_lines_break_where_a_pair_was_out_of_sight(self) -> None:
        pair = pd.DataFrame({"time_s": [0.00, 0.02, 0.50, 0.52], "distance_m": [0.3, 0.2, 0.4, 0.5]})
        line = figure_distances.with_gaps(pair)
        np.testing.assert_array_equal(line["distance_m"], [0.3, 0.2, np.nan, 0.4, 0.5])

    def test_the_least_distance_is_named_and_bounds_are_drawn(self) -> None:
        drawing = figure_distances.draw(MadeUp(cars=3, starts=1).group(self.folder))
        self.assertIn("subgraph A: at least 51 mm", texts_of(drawing.figure))
        self.assertIn("distance of footprints [m]", texts_of(drawing.figure))
        self.assertEqual(legend_texts(drawing.figure),
                         ["red and blue", "blue and green", "contact", "safety margins of both (20 mm)"])
        self.assertLess(drawing.data["distance_m"].max(), figure_distances.SHOWN_M)
        self.assertAlmostEqual(drawing.data["distance_m"].min(), 0.051)

    def test_of_many_pairs_the_closest_have_colours(self) -> None:
        drawing = figure_distances.draw(MadeUp(cars=20, starts=1, steps=10).group(self.folder))
        legend = legend_texts(drawing.figure)
        self.assertEqual(legend[:2], ["red and blue", "blue and green"])
        self.assertIn("11 other pairs", legend)
        self.assertEqual(len(legend), 8 + 3)

    def test_a_run_without_a_close_pair_has_a_panel_that_names_it(self) -> None:
        made_up = MadeUp(starts=1)
        made_up.distance_at = lambda run, time_s: 0.3 if run["run"] == 0 else 0.8
        self.assertIn("subgraph B: never below 0.6 m",
                      texts_of(figure_distances.draw(made_up.group(self.folder)).figure))
        made_up.distance_at = lambda run, time_s: 0.8
        self.assertIsNone(figure_distances.draw(made_up.group(self.folder)))


if __name__ == "__main__":
    unittest.main()
