"""The map with cars at the start: few cars, many cars, a long road."""

import math
import unittest

from made_up_series import faults_of, legend_texts, ring, ring_place, road_place, texts_of
from matplotlib.patches import Polygon

from report import figure_scenario, map_axes, style


class Scenario(unittest.TestCase):
    def setUp(self) -> None:
        self.enterContext(style.journal())

    def test_cars_lanes_ids_and_zones_are_there(self) -> None:
        zone = {"min_x_m": -0.3, "max_x_m": 0.3, "min_y_m": 0.7, "max_y_m": 1.3, "max_speed_mps": 0.6}
        place = ring_place(3, {"zone": [zone], "look_ahead": [zone]})
        for car, radius in zip(place["vehicles"], (1.0, 1.01, 1.02), strict=True):
            car["path"]["points_m"] = ring(radius)
        drawing = figure_scenario.draw(place)
        texts = texts_of(drawing.figure)
        for text in ("$x$ [m]", "$y$ [m]", "1", "2", "3"):
            self.assertIn(text, texts)
        self.assertEqual(sum(r"v \leq 0.6" in text for text in texts), 1)
        self.assertEqual(legend_texts(drawing.figure),
                         ["1: red", "2: blue", "3: green", "lane, with id", "speed zone of a policy"])
        self.assertEqual(list(drawing.data["vehicle"]), [1, 2, 3])
        self.assertAlmostEqual(drawing.data["y_m"].iloc[1], math.sin(2.0 * math.pi / 3.0))
        self.assertEqual(faults_of(drawing), [])

    def test_twenty_cars_have_entries_that_differ(self) -> None:
        place = ring_place(20)
        for index, car in enumerate(place["vehicles"]):
            car["path"]["points_m"] = ring(0.9 + 0.01 * index)
        drawing = figure_scenario.draw(place)
        lines = drawing.figure.legends[0].get_lines()
        self.assertEqual(len({(line.get_color(), str(line.get_linestyle()), line._dash_pattern[1] and
                               tuple(line._dash_pattern[1])) for line in lines}), 20)
        self.assertEqual(len(set(legend_texts(drawing.figure)[:20])), 20)
        # The map, and a small one for each route.
        self.assertEqual(len(drawing.figure.axes), 1 + 20)
        self.assertEqual(faults_of(drawing), [])

    def test_a_long_road_is_divided_into_strips_with_few_arrows_and_every_car_once(self) -> None:
        drawing = figure_scenario.draw(road_place())
        strips = drawing.figure.axes
        self.assertEqual(len(strips), figure_scenario.MOST_STRIPS)
        limits = [axes.get_xlim() for axes in strips]
        for (_, end), (begin, _) in zip(limits, limits[1:], strict=False):
            self.assertAlmostEqual(end, begin)
        for car in range(20):
            x = 2.0 + 9.0 * car
            self.assertEqual(sum(low <= x < high for low, high in limits), 1)
        arrows = [line for line in strips[0].lines if isinstance(line.get_marker(), tuple)
                  and strips[0].get_xlim()[0] <= line.get_xdata()[0] <= strips[0].get_xlim()[1]]
        self.assertTrue(2 <= len(arrows) <= 10, len(arrows))
        self.assertIn("route of several cars", legend_texts(drawing.figure))
        self.assertEqual(faults_of(drawing), [])
        self.assertLess(drawing.figure.get_figheight(), 9.5)

    def test_an_upright_road_is_turned_and_not_mirrored(self) -> None:
        drawing = figure_scenario.draw(road_place(is_upright=True))
        axes = drawing.figure.axes[0]
        self.assertEqual((drawing.figure.axes[-1].get_xlabel(), axes.get_ylabel()), ("$y$ [m]", "$x$ [m]"))
        # The cars drive along y; x = 0.15 m, to the right of the axis of the road, is below it.
        car = next(patch for patch in axes.patches if isinstance(patch, Polygon) and patch.get_zorder() == 4)
        low, high = car.get_xy()[:, 1].min(), car.get_xy()[:, 1].max()
        self.assertAlmostEqual(0.5 * (low + high), -0.15)
        routes = [line for line in axes.lines if line.get_color() == style.MARK and len(line.get_xdata()) > 1]
        self.assertEqual([set(line.get_ydata()) for line in routes], [{-0.15}])
        axes.figure.draw_without_rendering()
        self.assertEqual(axes.yaxis.get_major_formatter()(-0.15, 0), "0.15")

    def test_goals_are_there_in_the_colour_of_their_cars_also_on_a_turned_road(self) -> None:
        for is_upright in (False, True):
            place = road_place(is_upright=is_upright)
            car = place["vehicles"][1]
            x, y = car["start"]["x_m"], car["start"]["y_m"]
            car["goal_m"] = [[x + 3.0, y + 3.0], [x + 4.0, y + 3.0], [x + 3.5, y + 4.5]]
            drawing = figure_scenario.draw(place)
            axes = drawing.figure.axes[0]
            goals = [patch for patch in axes.patches if isinstance(patch, Polygon) and patch.get_zorder() == 1.5]
            self.assertEqual(len(goals), 2)  # filled, and its outline
            corners = goals[0].get_xy()[:3].tolist()
            expected = [[b, -a] for a, b in car["goal_m"]] if is_upright else car["goal_m"]
            self.assertEqual(corners, expected)
            cars = [patch for patch in axes.patches if isinstance(patch, Polygon) and patch.get_zorder() == 4]
            self.assertEqual(goals[1].get_edgecolor(), cars[2].get_facecolor())  # two patches of each car
            self.assertIn("goal of a car, in its colour", legend_texts(drawing.figure))
            low, high = map_axes.extent_of(place)[2:]
            self.assertTrue(low < y + 3.0 and y + 4.5 < high)
            self.assertEqual(faults_of(drawing), [])

    def test_ids_of_lanelets_that_lie_on_each_other_stand_apart(self) -> None:
        place = ring_place(1)
        place["lanelets"].append({**place["lanelets"][0], "id": 77})
        axes = figure_scenario.draw(place).figure.axes[0]
        at = {text.get_text(): text.get_position() for text in axes.texts if text.get_fontsize() < 5}
        self.assertEqual(set(at), {"1", "2", "77"})
        self.assertGreater(math.dist(at["1"], at["77"]), 0.1)


if __name__ == "__main__":
    unittest.main()
