"""Drawings of the planner's programs: automaton, Pareto front, problem, sheet."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

import numpy as np
from made_up_series import comments_of, faults_of, legend_texts, ring_place, texts_of
from matplotlib.collections import QuadMesh
from matplotlib.colors import to_hex
from matplotlib.patches import ArrowStyle, FancyArrowPatch, Polygon

from report import draw, figure_automaton, figure_pareto, figure_problem, figure_scenario, style

SQUARE = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.2], [0.0, 0.2]]


def automaton(trims: int, labels: tuple[str, ...] = ("J1", "J2")) -> dict:
    """A chain of trims; of the first label in both directions, of the others upwards."""
    maneuvers = []
    for number in range(1, trims):
        maneuvers += [{"from": number, "to": number + 1, "label": label} for label in labels]
        maneuvers.append({"from": number + 1, "to": number, "label": labels[0]})
    return {"labels": list(labels), "maneuvers": maneuvers, "trims": [
        {"speed_mps": 0.1 * (number // 19), "steering_rad": 0.05 * (number % 19 - 9)} for number in range(trims)]}


def front(count: int = 5) -> dict:
    """A front; the middle point did not converge."""
    points = [{"objectives": [-0.1 * index, 1.0 + index ** 2], "is_converged": index != count // 2,
               "duration_s": 0.2, "states": [[0.1 * k, 0.01 * k * index, 0.02 * k, 0.5 * k] for k in range(5)],
               "inputs": [[float(index), -1.0]] * 4} for index in range(count)]
    return {"from": [0.0, 0.0], "to": [2.3, 0.62], "duration_s": [0.2, 0.2], "criteria": ["J1", "J2"], "knee": 1,
            "points": points, "weighted_sums": [[-0.1, 2.5], [-0.2, 4.0]]}


def problem(steps: int = 8, has_plan: bool = True, vehicles: int = 1) -> dict:
    """Cars that drive to the right below an obstacle that stands, and one that moves."""
    def shifted(x: float, y: float) -> list[list[float]]:
        return [[a + x, b + y] for a, b in SQUARE]

    vehicle = {"start": [0.0, 0.0, 0.0], "reference": [[0.2 * step, 0.0] for step in range(steps)],
               "boundary": [[[-1.0, -0.4], [3.0, -0.4]]],
               "obstacles": [[shifted(0.5, 0.4), shifted(1.0 - 0.1 * step, 0.8)] for step in range(steps)],
               "poses": [[0.19 * step, 0.01, 0.0] for step in range(steps)] if has_plan else [],
               "swept": [shifted(0.19 * step, -0.1) for step in range(steps)] if has_plan else []}
    return {"subgraph": "B", "horizon_steps": steps, "step_s": 0.2, "status": "optimal" if has_plan else "fallback",
            "reason": "none" if has_plan else "infeasible", "cost_m2": 0.03,
            "footprint": {"length_m": 0.22, "width_m": 0.11}, "vehicles": [vehicle] * vehicles}


class Automaton(unittest.TestCase):
    def setUp(self) -> None:
        self.enterContext(style.journal())

    def test_few_trims_are_a_graph_with_a_double_head_where_both_directions_exist(self) -> None:
        drawing = figure_automaton.draw(automaton(12))
        arrows = drawing.figure.axes[0].findobj(FancyArrowPatch)
        by_colour = [to_hex(arrow.get_edgecolor()) for arrow in arrows]
        self.assertEqual(by_colour.count(style.BLUE.lower()), 11)
        self.assertEqual(by_colour.count(style.VERMILION.lower()), 11)
        double = [arrow for arrow in arrows if isinstance(arrow.get_arrowstyle(), ArrowStyle.CurveFilledAB)]
        self.assertEqual({to_hex(arrow.get_edgecolor()) for arrow in double}, {style.BLUE.lower()})
        self.assertEqual(legend_texts(drawing.figure),
                         ["optimal for $J_1$", "optimal for $J_2$", "trim, with its number"])
        for text in (r"steering angle $\delta$ [rad]", "speed $v$ [m/s]", "12"):
            self.assertIn(text, texts_of(drawing.figure))
        self.assertEqual(faults_of(drawing), [])

    def test_an_arrow_bends_around_a_trim_on_its_way(self) -> None:
        places = np.array([[0.0, 0.0], [0.5, 0.5], [1.0, 1.0], [0.0, 1.0]])
        self.assertTrue(figure_automaton.passes_a_trim(places[0], places[2], places))
        self.assertFalse(figure_automaton.passes_a_trim(places[0], places[1], places))
        self.assertFalse(figure_automaton.passes_a_trim(places[0], places[3], places))

    def test_many_trims_are_a_matrix_per_criterion_in_its_colour(self) -> None:
        drawing = figure_automaton.draw(automaton(96, ("J1", "J2", "comfort", "J3")))
        panels = drawing.figure.axes[1:]
        self.assertEqual([axes.get_title(loc="left") for axes in panels],
                         ["optimal for $J_1$: 190 maneuvers", "optimal for $J_2$: 95 maneuvers",
                          "optimal for comfort: 95 maneuvers", "optimal for $J_3$: 95 maneuvers"])
        for axes, count, colour in zip(panels, (190, 95, 95, 95),
                                       (style.BLUE, style.VERMILION, style.PURPLE, style.GREEN), strict=True):
            mesh = axes.findobj(QuadMesh)[0]
            self.assertEqual(mesh.get_array().count(), count)
            self.assertEqual(to_hex(mesh.cmap(0)), colour.lower())
        # From trim 2 to trim 3: row 2, column 3.
        self.assertTrue(panels[1].findobj(QuadMesh)[0].get_array()[1, 2])
        self.assertIn("96", texts_of(drawing.figure))
        self.assertEqual(faults_of(drawing), [])


class Pareto(unittest.TestCase):
    def setUp(self) -> None:
        self.enterContext(style.journal())

    def test_symbols_units_ends_and_knee_are_there(self) -> None:
        drawing = figure_pareto.draw(front())
        texts = texts_of(drawing.figure)
        for text in ("$s_x$ [m]", "$s_y$ [m]", r"$\psi$ [rad]", "$u_v$ [m/s$^2$]", r"$u_\delta$ [rad/s]",
                     "$v$ [m/s]", "time $t$ [s]",
                     "Pareto-optimal maneuvers from (0 m/s, 0 rad) to (2.3 m/s, 0.62 rad) in 0.2 s"):
            self.assertIn(text, texts)
        self.assertEqual(legend_texts(drawing.figure), ["optimum of $J_2$", "between them", "optimum of $J_1$", "knee",
                                                        "weighted sums", "not converged"])
        self.assertEqual(faults_of(drawing), [])

    def test_the_ends_are_thick_and_what_did_not_converge_is_dashed(self) -> None:
        lines = figure_pareto.draw(front()).figure.axes[1].lines
        self.assertEqual([line.get_linewidth() > 1.0 for line in lines], [True, False, False, False, True])
        self.assertEqual([line.get_linestyle() for line in lines], ["-", "-", "--", "-", "-"])

    def test_an_input_is_constant_on_each_interval(self) -> None:
        times, values = figure_pareto.input_over_time(0)({"duration_s": 0.2, "inputs": [[1.0, 0.0], [2.0, 0.0]]})
        np.testing.assert_allclose(times, [0.0, 0.1, 0.1, 0.2])
        np.testing.assert_allclose(values, [1.0, 1.0, 2.0, 2.0])

    def test_the_data_are_the_front_and_the_weighted_sums(self) -> None:
        data = figure_pareto.draw(front()).data
        self.assertEqual(list(data["method"]), ["front"] * 5 + ["weighted sums"] * 2)
        self.assertEqual(list(data["J2"]), [1.0, 2.0, 5.0, 10.0, 17.0, 2.5, 4.0])


class Problem(unittest.TestCase):
    def setUp(self) -> None:
        self.enterContext(style.journal())

    def test_obstacles_have_numbers_and_one_that_stands_is_one(self) -> None:
        obstacles = figure_problem.obstacles_of(problem(vehicles=2))
        self.assertEqual([(one["number"], one["stands"]) for one in obstacles], [(1, True), (2, False)])
        drawing = figure_problem.draw(problem())
        for text in ("O1", "O2", "step", "$x$ [m]", "$y$ [m]", *[f"step {step}" for step in range(1, 9)]):
            self.assertIn(text, texts_of(drawing.figure))
        for text in ("car at the start", "obstacle O… in a step", "obstacle O… that stands", "boundary",
                     "its reference point"):
            self.assertIn(text, legend_texts(drawing.figure))
        self.assertEqual(faults_of(drawing), [])

    def test_a_step_shows_only_its_own_areas(self) -> None:
        drawing = figure_problem.draw(problem())
        panel = next(axes for axes in drawing.figure.axes if axes.get_title() == "step 3")
        outlines = {tuple(map(tuple, np.round(patch.get_xy()[:-1], 6))) for patch in panel.findobj(Polygon)}
        expected = {tuple((round(a + x, 6), round(b + y, 6)) for a, b in SQUARE)
                    for x, y in ((0.38, -0.1), (0.5, 0.4), (0.8, 0.8))}
        self.assertEqual(outlines, expected)

    def test_no_plan_is_named_with_its_reason(self) -> None:
        drawing = figure_problem.draw(problem(has_plan=False))
        self.assertIn("Planning problem: 8 steps of 0.2 s, subgraph B; no plan (infeasible)", texts_of(drawing.figure))
        self.assertNotIn("planned position after a step", legend_texts(drawing.figure))
        self.assertTrue(drawing.data["x_m"].isna().all())

    def test_long_horizons_have_as_many_small_maps_as_fit(self) -> None:
        drawing = figure_problem.draw(problem(steps=40, vehicles=3))
        titles = [axes.get_title() for axes in drawing.figure.axes if axes.get_title().startswith("step ")]
        self.assertEqual(len(titles), figure_problem.MOST_STEPS)
        self.assertEqual((titles[0], titles[-1]), ("step 1", "step 40"))
        self.assertEqual(len(drawing.data), 120)
        self.assertEqual(faults_of(drawing), [])


class Draw(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def run_main(self, *arguments: str) -> tuple[int, str]:
        """Exit code and what stands on stderr."""
        with contextlib.redirect_stderr(io.StringIO()) as errors:
            code = draw.main(list(arguments))
        return code, errors.getvalue()

    def test_each_kind_is_drawn_as_svg_and_pdf_and_nothing_else_is_left(self) -> None:
        for kind, data in (("automaton", automaton(12)), ("pareto", front()), ("problem", problem()),
                           ("scenario", ring_place(3)), ("sheet", ring_place(3))):
            file = self.folder / "data.json"
            file.write_text(json.dumps(data))
            for name in ("out.svg", "out.pdf", "out"):
                out = self.folder / name
                self.assertEqual(self.run_main(kind, str(file), str(out)), (0, ""))
            self.assertEqual((self.folder / "out").read_bytes(), (self.folder / "out.svg").read_bytes())
            self.assertGreater(len(comments_of(self.folder / "out.svg")), 3)
            self.assertTrue((self.folder / "out.pdf").read_bytes().startswith(b"%PDF"))
            self.assertEqual({one.name for one in self.folder.iterdir()}, {"data.json", "out", "out.svg", "out.pdf"})

    def test_bad_data_and_a_folder_that_is_missing_are_one_line(self) -> None:
        file = self.folder / "data.json"
        for text in ("", "{}", "[]", '{"trims": 3}'):
            file.write_text(text)
            code, errors = self.run_main("automaton", str(file), str(self.folder / "out.svg"))
            self.assertEqual((code, errors.count("\n")), (2, 1), text)
            self.assertIn("data.json", errors)
        file.write_text(json.dumps(automaton(3)))
        code, errors = self.run_main("automaton", str(file), str(self.folder / "none" / "out.svg"))
        self.assertEqual((code, errors.count("\n")), (2, 1))
        self.assertIn("No such file or directory, must be writable", errors)
        self.assertEqual([one.name for one in self.folder.iterdir()], ["data.json"])

    def test_a_sheet_has_the_poses_to_place_cars_by(self) -> None:
        place = ring_place(2)
        place["vehicles"][0]["start"] = {"x_m": 3.16, "y_m": 3.89, "yaw_rad": -0.04}
        with style.journal():
            sheet = legend_texts(figure_scenario.draw(place, with_poses=True).figure)
            self.assertEqual(sheet[0], r"1: red, $x$ 3.16 m, $y$ 3.89 m, $\psi$ -0.04 rad (-2°)")
            self.assertEqual(legend_texts(figure_scenario.draw(place).figure)[0], "1: red")


if __name__ == "__main__":
    unittest.main()
