"""A comparison of priorities: its table, its figures, and what is refused."""

import json
import tempfile
import unittest
from pathlib import Path

import pandas as pd
from made_up import ORIGIN, seeds

from report import figure_priorities, style
from report.errors import InputError
from report.priorities import excess_percent, nearest_rank, priorities_data, priorities_markdown
from report.results import read_folder

RUN = {"planned": 20, "vehicle_steps": 20, "driven_m": 9.0, "deadlock_step": "", "compared_steps": 0, "cost_m2": 0,
       "optimal_order_m2": 0, "worse_steps": 0}


def write(folder: Path, text_of_step: str = "1.5", **values: object) -> None:
    """Two draws of two strategies with 2 and 4 cars, 10 steps; step k of run r takes r + k [ms]."""
    cells = [(cars, strategy, draw) for cars in (2, 4) for strategy in ("constant", "best") for draw in (1, 2)]
    runs = pd.DataFrame([{"run": run, "cars": cars, "strategy": strategy, "draw": draw, "steps": 10} | RUN | values
                         for run, (cars, strategy, draw) in enumerate(cells)])
    steps = [{"run": run, "step": step, "step_ms": str(run + step), "levels": 1 + step % 3}
             for run in runs.run for step in range(10)]
    steps[12]["step_ms"] = text_of_step
    runs.to_csv(folder / "runs.csv", index=False)
    pd.DataFrame(steps).to_csv(folder / "steps.csv", index=False)
    pd.DataFrame({"run": [0, 0, 1, 4], "vehicles": 2, "cost_m2": [1.0, 2.0, 4.0, 1.0],
                  "bound_m2": [1.0, 1.0, 4.0, 0.0]}).to_csv(folder / "gaps.csv", index=False)
    plan = {"scenario": "s", "profile": "default", "subgraph": "A", "steps": 10, "step_s": 0.2, "horizon_steps": 8,
            "max_levels": 0, "strategies": ["constant", "best"], "cars": [2, 4], "draws": [1, 2], "runs": 8}
    (folder / "campaign.json").write_text(json.dumps({"kind": "priorities", "origin": ORIGIN, "priorities": plan}))


class PrioritiesPage(unittest.TestCase):
    """Of made-up rows in a folder of its own."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_a_row_is_of_all_steps_and_cases_of_its_runs(self) -> None:
        write(self.folder, text_of_step="3")
        data = priorities_data(read_folder(self.folder))
        self.assertEqual(list(zip(data.cars, data.strategy)),
                         [(2, "constant"), (2, "best"), (4, "constant"), (4, "best")])
        first, third, last = data.iloc[0], data.iloc[2], data.iloc[3]
        self.assertAlmostEqual(first.step_mean_ms, 5.0)  # 0 ... 9 and 1 ... 10
        self.assertEqual((first.step_p99_ms, first.levels_mean, first.levels_max), (10.0, 1.9, 3))
        self.assertAlmostEqual(first.speed_mps, 18.0 / 20.0 * 20.0 / 36.0 / 0.2)  # no way in the first step
        self.assertEqual((first.cases, first.excess_median_percent, first.excess_p99_percent), (3, 0.0, 100.0))
        self.assertAlmostEqual(first.excess_percent, 100.0 / 6.0)
        self.assertAlmostEqual(first.proven_percent, 200.0 / 3.0)
        self.assertEqual((third.excess_p99_percent, last.cases), (float("inf"), 0))
        text = priorities_markdown(read_folder(self.folder), data)
        self.assertIn("| 4 | `constant` | 9.00 | 9.00 | 14.00 |", text)
        self.assertIn("| any amount | any amount | any amount | 0.0 (1) |", text)

    def test_runs_with_a_car_that_stood_and_costs_against_the_optimal_order_are_counted(self) -> None:
        write(self.folder, deadlock_step=3, compared_steps=4, cost_m2=3.0, optimal_order_m2=2.0)
        data = priorities_data(read_folder(self.folder))
        self.assertEqual(list(data.standing_runs), [2, 2, 2, 2])
        self.assertIn("| 2 of 2 | 1.5000 (8) |", priorities_markdown(read_folder(self.folder), data))

    def test_a_wrong_value_is_refused_at_its_line(self) -> None:
        write(self.folder, text_of_step="fast")
        with self.assertRaisesRegex(InputError, r'steps.csv:14: step_ms = "fast", must be a number, or empty$'):
            read_folder(self.folder)
        write(self.folder, driven_m="")
        with self.assertRaisesRegex(InputError, r'runs.csv:2: driven_m = "", must be a number$'):
            read_folder(self.folder)

    def test_missing_rows_are_refused(self) -> None:
        for name, rows in (("runs.csv", "7 rows, 7 different ones, must be 8"),
                           ("steps.csv", "79 rows, must be 80")):
            write(self.folder)
            path = self.folder / name
            path.write_text("\n".join(path.read_text().splitlines()[:-1]) + "\n")
            with self.assertRaisesRegex(InputError, f"{name}: {rows}"):
                read_folder(self.folder)

    def test_rows_that_the_campaign_has_not_are_refused(self) -> None:
        for name, column, value, message in (("runs.csv", "cars", "9", "cars = 9, must be one of"),
                                             ("runs.csv", "draw", "77", "draw = 77, must be one of"),
                                             ("steps.csv", "step", "1", "a step twice, must be"),
                                             ("steps.csv", "run", "50", "must be"),
                                             ("gaps.csv", "bound_m2", "-5", "bound_m2 = -5.0, must be >= 0"),
                                             ("gaps.csv", "run", "50", "run 50, must be a run of runs.csv")):
            write(self.folder)
            path = self.folder / name
            rows = pd.read_csv(path, dtype=str)
            rows.loc[0, column] = value
            rows.to_csv(path, index=False)
            with self.subTest(name=name, column=column), self.assertRaisesRegex(InputError, f"{name}: .*{message}"):
                read_folder(self.folder)

    def test_figures_are_written_with_the_values_of_the_table(self) -> None:
        write(self.folder)
        results = read_folder(self.folder)
        data = priorities_data(results)
        with style.journal():
            for drawing in figure_priorities.drawings_of(results, data):
                style.save(drawing, self.folder)
        names = ["planning_time", "levels", "cost", "standing"]
        for name in names:
            for kind in ("svg", "pdf"):
                self.assertGreater((self.folder / f"priorities_{name}.{kind}").stat().st_size, 1000)
        drawn = {name: pd.read_csv(self.folder / f"priorities_{name}.csv") for name in names}
        for name in ("step_median_ms", "step_p99_ms"):
            self.assertEqual(list(drawn["planning_time"][name]), list(data[name]))
        self.assertEqual(list(drawn["levels"].levels_mean), list(data.levels_mean))
        self.assertEqual(list(zip(drawn["cost"].cars, drawn["cost"].strategy)), [(2, "constant")])
        self.assertAlmostEqual(drawn["cost"].cost_per_bound[0], 7.0 / 6.0, places=5)
        self.assertEqual(list(drawn["standing"].standing_percent), [0.0] * 4)


class Figures(unittest.TestCase):
    """Of single values."""

    def test_the_nearest_rank_is_the_smallest_value_that_the_share_does_not_exceed(self) -> None:
        for _, random in seeds(20):
            values = pd.Series(random.normal(size=int(random.integers(1, 300))))
            rank = nearest_rank(values, 0.99)
            self.assertGreaterEqual((values <= rank).mean(), 0.99)
            self.assertLess((values < rank).mean(), 0.99)

    def test_rounding_is_no_excess(self) -> None:
        excess = excess_percent(pd.Series([1.0 + 5e-10, 1.1, 0.0]), pd.Series([1.0, 1.0, 0.0]))
        self.assertEqual([round(one, 6) for one in excess], [0.0, 10.0, 0.0])
