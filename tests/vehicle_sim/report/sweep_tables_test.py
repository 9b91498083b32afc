"""Results by setting, choices of trims, failures."""

import itertools
import unittest

import numpy as np
from made_up import frame, run, seeds, sweep

from report.failure_list import failure_markdown
from report.groupings import MOST_VALUES, groupings_of
from report.setting_tables import setting_data, setting_markdown
from report.trims_front import choices_of, trims_markdown


class SettingTables(unittest.TestCase):
    """Groupings and counts."""

    def test_groupings_are_all_then_each_setting_of_several_values_then_the_files_own(self) -> None:
        many = [str(i) for i in range(MOST_VALUES + 1)]
        settings = {"one": ["1"], "two": ["1", "2"], "many": many}
        rows = [run(**{"set.one": "1", "set.two": "1", "set.many": "0"})]
        made = sweep(settings, rows, tables=[("two",), ("many", "two")])
        self.assertEqual(groupings_of(made), [(), ("two",), ("many", "two")])

    def test_rows_are_in_the_order_of_the_values_with_their_outcomes(self) -> None:
        rows = [run(start, lap_s=lap, **{"set.search": value})
                for value, lap in (("z", 14.0), ("a", 16.0)) for start in range(4)]
        rows[1] |= {"stuck_vehicles": 1}
        rows[2] |= {"failure": "vehicles touched"}
        rows[5] |= {"lap_s": np.nan}
        text = setting_markdown(setting_data(sweep({"search": ["z", "a"]}, rows)))
        self.assertIn("### s, by search\n", text)
        self.assertLess(text.index("| z | A | 1 | 2 / 0 / 1 / 1 | 20.0 ± 0.0 | 1.0 ± 0.0 | 14.00 ± 0.00 | 1 ± 0 |"),
                        text.index("| a | A | 1 | 3 / 1 / 0 / 0 |"))

    def test_combinations_of_a_start_count_once(self) -> None:
        rows = [run(start, lap_s=lap, **{"set.search": value})
                for (start, value), lap in zip(itertools.product((0, 1), "ab"), (10.0, 20.0, 16.0, np.nan))]
        data = setting_data(sweep({"search": ["a", "b"]}, rows))
        whole = data[(data.settings == ()) & (data.quantity == "lap_s")].iloc[0]
        self.assertEqual((whole["mean"], whole.lap, whole.no_lap), (15.5, 3, 1))


class TrimsFront(unittest.TestCase):
    """Choices of trims; trim 1 is standstill."""

    TRIMS = {"1 2 3 4": 20.0, "1 2 3": 20.0, "1 2": 30.0, "1 3": 25.0, "1 4": 10.0}

    def made(self):
        rows = [run(start, error_mean_mm=error + start, lap_s=np.nan if trims == "1 4" and start else 15.0,
                    **{"set.trims": trims, "set.search": "2022"}) for trims, error in self.TRIMS.items()
                for start in (0, 1)]
        return sweep({"search": ["2022"], "trims": list(self.TRIMS)}, rows,
                     offered_trims={"C": [4, 3, 2, 1], "D": [2, 1]}, moving_trims=[2, 3, 4])

    def test_names_the_front_the_smallest_accurate_one_and_the_automatons_own(self) -> None:
        text = trims_markdown(self.made(), choices_of(self.made()))
        self.assertIn("4 of 5 choices drive a lap from every start", text)
        self.assertIn("| 1 | 1 3 | 25.50 | 15.00 | 1 | front |\n| 2 | 1 2 3 | 20.50 | 15.00 | 1 | front |\n"
                      "| 2 | 1 2 3 | 20.50 | 15.00 | 1 | smallest, not less accurate than the largest |\n"
                      "| 3 | 1 2 3 4 | 20.50 | 15.00 | 1 | trims of C: 1 choices dominate it; number 1 of 1 with as "
                      "many trims |\n"
                      "| 1 | 1 2 | 30.50 | 15.00 | 1 | trims of D: 1 choices dominate it; number 2 of 2 with as many "
                      "trims |", text)

    def test_choices_are_in_the_order_of_size_then_error(self) -> None:
        self.assertEqual(list(choices_of(self.made()).name), ["1 3", "1 2", "1 2 3", "1 2 3 4"])


class FailureList(unittest.TestCase):
    """Reasons without their numbers."""

    def test_merges_reasons_that_differ_in_numbers_with_their_range(self) -> None:
        runs = [run(failure=f"vehicle 1 left its area in {steps} steps, by 0.{steps} m") for steps in (10, 9, 3)]
        text = failure_markdown(frame(runs + [run(), run(subgraph="B1", failure="no # of 7 cars")]))
        self.assertIn("## Runs that do not count: 4\n\n* 3 times subgraph A: vehicle 1 left its area in 3 … 10 steps, "
                      "by 0.10 … 0.9 m\n", text)
        self.assertIn("* 1 times subgraph B1: no # of 7 cars\n", text)
        self.assertEqual(failure_markdown(frame([run()])), "")

    def test_one_failure_of_many_runs_is_named(self) -> None:
        runs = frame([run(), run(), run(failure="vehicle 1 left its announced areas in 2 steps")])
        runs["subgraph"] = runs.subgraph.astype("category")
        runs["failure"] = runs.failure.astype(object)
        self.assertEqual(failure_markdown(runs), "## Runs that do not count: 1\n\n"
                         "* 1 times subgraph A: vehicle 1 left its announced areas in 2 steps\n\n")

    def test_counts_every_failed_run_once(self) -> None:
        for seed, generator in seeds(10):
            runs = [run(failure=f"{'abc'[generator.integers(3)]} {generator.integers(100)}") for _ in range(40)]
            text = failure_markdown(frame(runs))
            with self.subTest(seed=seed):
                self.assertEqual(sum(int(line.split()[1]) for line in text.splitlines() if line[:1] == "*"), 40)


if __name__ == "__main__":
    unittest.main()
