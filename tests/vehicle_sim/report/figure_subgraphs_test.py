"""Subgraphs over time: only what changes."""

import tempfile
import unittest
from pathlib import Path

from made_up_series import MadeUp, legend_texts, texts_of
from matplotlib.colors import to_hex
from matplotlib.patches import Rectangle

from report import figure_subgraphs, style


class Subgraphs(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.enterContext(style.journal())
        self.made_up = MadeUp(cars=3, planned_on=(("J2", "none"), ("J2", "zone"), ("J2", "time")), starts=1)
        self.made_up.subgraph_at = lambda run, vehicle, step: (
            "J2, at most 0.6 m/s" if run["policy"] == "zone" and vehicle < 3 and 10 <= step < 20 else "J2")

    def test_only_cars_and_runs_that_changed_are_drawn(self) -> None:
        drawings = figure_subgraphs.draw(self.made_up.group(self.folder))
        self.assertEqual([drawing.name for drawing in drawings], ["subgraphs_two_rings_the_2022"])
        panels = drawings[0].figure.axes
        self.assertEqual([axes.get_title(loc="left") for axes in panels],
                         ["policy zone (1 cars without a change left out)"])
        self.assertEqual([label.get_text() for label in panels[0].get_yticklabels()], ["1: red", "2: blue"])
        self.assertIn("Without any change: subgraph J2, policy time.", drawings[0].caption)
        for text in ("time [s]", "speed [m/s]", "car"):
            self.assertIn(text, texts_of(drawings[0].figure))

    def test_bands_begin_and_end_with_the_steps(self) -> None:
        data = figure_subgraphs.draw(self.made_up.group(self.folder))[0].data
        red = data[data["vehicle"] == 1]
        self.assertEqual(list(red["planned_on"]), ["J2", "J2, at most 0.6 m/s", "J2"])
        for begin, end, low, high in zip(red["from_s"], red["to_s"], (0.0, 2.0, 4.0), (2.0, 4.0, 8.0), strict=True):
            self.assertAlmostEqual(begin, low)
            self.assertAlmostEqual(end, high)

    def test_a_limit_is_a_hatch_on_the_same_colour(self) -> None:
        figure = figure_subgraphs.draw(self.made_up.group(self.folder))[0].figure
        self.assertEqual(legend_texts(figure), ["J2", "J2, at most 0.6 m/s", "speed"])
        plain, limited = figure.legends[0].get_patches()
        self.assertEqual(plain.get_facecolor(), limited.get_facecolor())
        self.assertNotEqual(plain.get_hatch(), limited.get_hatch())

    def test_time_in_zones_is_shaded_for_its_length(self) -> None:
        self.made_up.limit_at = lambda run, time_s: "0.6" if 1.0 <= time_s <= 3.0 else ""
        figure = figure_subgraphs.draw(self.made_up.group(self.folder))[0].figure
        shades = [patch for patch in figure.axes[0].patches
                  if isinstance(patch, Rectangle) and to_hex(patch.get_facecolor()) == style.ZONE]
        self.assertEqual(len(shades), 2)
        for shade in shades:
            self.assertAlmostEqual(shade.get_x(), 1.0)
            self.assertAlmostEqual(shade.get_width(), 2.0)
        self.assertEqual(legend_texts(figure)[-2:], ["in a speed zone", "its limit"])

    def test_a_car_that_ends_stuck_has_the_word(self) -> None:
        self.assertNotIn("gridlock ", texts_of(figure_subgraphs.draw(self.made_up.group(self.folder))[0].figure))
        self.made_up.stuck = {(1, 2)}
        self.assertIn("gridlock ", texts_of(figure_subgraphs.draw(self.made_up.group(self.folder))[0].figure))

    def test_many_rows_are_divided_among_figures_and_none_is_lost(self) -> None:
        made_up = MadeUp(cars=20, planned_on=(("J2", "zone"), ("J2", "time")), starts=1, steps=10)
        made_up.subgraph_at = lambda run, vehicle, step: "J2" if step < 5 else "comfort"
        drawings = figure_subgraphs.draw(made_up.group(self.folder))
        self.assertEqual([drawing.name for drawing in drawings],
                         ["subgraphs_two_rings_the_2022", "subgraphs_two_rings_the_2022_2"])
        self.assertEqual([len(drawing.data) for drawing in drawings], [40, 40])

    def test_sixteen_subgraphs_look_different(self) -> None:
        looks = figure_subgraphs.looks_of([f"label {number}" for number in range(16)])
        self.assertEqual(len({(look["facecolor"], look["hatch"]) for look in looks.values()}), 16)

    def test_nothing_that_changes_is_no_figure(self) -> None:
        self.assertEqual(figure_subgraphs.draw(MadeUp().group(self.folder)), [])


if __name__ == "__main__":
    unittest.main()
