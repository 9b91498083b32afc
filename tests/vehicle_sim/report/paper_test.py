"""The paper's values, the distance to them, and our runs beside them."""

import unittest

import numpy as np
import pandas as pd
from made_up import campaign, frame, run, seeds, sweep

from report.campaign_table import campaign_data, campaign_markdown
from report.paper import LAB, QUANTITIES, SIMULATION, compared_cells
from report.paper_comparison import comparison_markdown, judged_combinations
from report.paper_distance import cells_of, distances_of, factor

MOST = np.log(10.0)
# Paper, Table 2, of subgraph D in the lab.
PAPERS_D = {"scenario": LAB, "profile": "2022", "subgraph": "D", "error_mean_mm": 17.0, "error_std_mm": 16.1,
            "lap_s": 16.0, "generated_max": 291.0}


class Table2(unittest.TestCase):
    """The paper's Table 2, row by row as printed."""

    ROWS = {
        "error_mean_mm": ((40.1, 30.7, 30.8, 19.4), (27.9, 19.9, 17.0)),
        "error_std_mm": ((35.9, 28.9, 28.8, 17.6), (30.5, 23.7, 16.1)),
        "lap_s": ((13.8, 15.8, 15.8, 16.2), (15.8, 16.0, 16.0)),
        "generated_sum_max": ((159114, 1966, 1969, 879), ()),
        "generated_max": ((), (430, 322, 291)),
        "planning_mean_ms": ((9738.3, 125.0, 166.5, 138.4), (12.4, 11.8, 10.2)),
        "planning_std_ms": ((5228.1, 67.5, 80.1, 71.2), (3.8, 3.1, 3.3)),
        "planning_max_ms": ((28436.7, 600.9, 570.7, 654.4), (32.3, 24.5, 32.8)),
    }

    def test_has_the_papers_values_and_no_others(self) -> None:
        for one in QUANTITIES:
            simulation, lab = self.ROWS.get(one.key, ((), ()))
            with self.subTest(quantity=one.key):
                self.assertEqual(one.simulation, dict(zip("ABCD", simulation)))
                self.assertEqual(one.lab, dict(zip("BCD", lab)))
                self.assertEqual(one.depends_on_machine, one.key.startswith("planning"))

    def test_cells_that_do_not_depend_on_the_machine(self) -> None:
        cells = compared_cells()
        self.assertEqual(cells.groupby("scenario").size().to_dict(), {SIMULATION: 16, LAB: 15})
        alone = cells[(cells.scenario == LAB) & (cells.subgraph == "A")]
        self.assertEqual(dict(zip(alone.quantity, alone.paper)),
                         {"error_mean_mm": 40.1, "error_std_mm": 35.9, "lap_s": 13.8})


class Distance(unittest.TestCase):
    """D of made-up runs."""

    def distance(self, *runs: dict) -> float:
        return distances_of(frame(list(runs)).assign(combination=0), ["combination"]).get(0)

    def test_is_nothing_for_the_papers_own_cells(self) -> None:
        self.assertEqual(self.distance(run(**PAPERS_D)), 0.0)
        self.assertEqual(factor(0.0), 1.0)

    def test_is_the_mean_square_of_the_logarithms_of_the_ratios(self) -> None:
        for seed, generator in seeds(20):
            logs = dict(zip(("error_mean_mm", "error_std_mm", "lap_s", "generated_max"), generator.uniform(-3, 3, 4)))
            values = PAPERS_D | {name: PAPERS_D[name] * np.exp(log) for name, log in logs.items()}
            expected = np.mean(np.clip(list(logs.values()), -MOST, MOST) ** 2)
            with self.subTest(seed=seed):
                self.assertAlmostEqual(self.distance(run(**values)), expected, places=12)

    def test_is_that_of_the_mean_over_the_starts(self) -> None:
        self.assertEqual(self.distance(run(0, **PAPERS_D | {"lap_s": 15.0}), run(1, **PAPERS_D | {"lap_s": 17.0})), 0.0)

    def test_an_error_of_zero_is_a_factor_of_ten(self) -> None:
        self.assertAlmostEqual(self.distance(run(**PAPERS_D | {"error_mean_mm": 0.0})), MOST**2 / 4, places=12)

    def test_is_unknown_if_a_start_has_no_lap(self) -> None:
        for change in ({"lap_s": np.nan}, {"stuck_vehicles": 1}, {"failure": "vehicles touched"}):
            self.assertTrue(np.isnan(self.distance(run(**PAPERS_D), run(1, **PAPERS_D | change))))

    def test_is_unknown_if_one_subgraph_of_several_has_no_lap(self) -> None:
        runs = [run(**PAPERS_D), run(**PAPERS_D | {"subgraph": "C", "lap_s": np.nan})]
        self.assertTrue(np.isnan(self.distance(*runs)))
        cells = cells_of(frame(runs).assign(combination=0), ["combination"])
        self.assertEqual(list(cells.ours.isna()), [True] * 4 + [False] * 4)

    def test_three_cars_have_the_vertices_of_a_step_summed(self) -> None:
        values = {"scenario": SIMULATION, "subgraph": "D", "error_mean_mm": 19.4, "error_std_mm": 17.6, "lap_s": 16.2,
                  "generated_max": 1.0, "generated_sum_max": 879.0}
        self.assertEqual(self.distance(run(**values)), 0.0)

    def test_other_scenarios_have_none(self) -> None:
        self.assertIsNone(self.distance(run(scenario="circle")))
        self.assertTrue(cells_of(frame([run(scenario="circle")]).assign(combination=0), ["combination"]).empty)


class Comparison(unittest.TestCase):
    """Combinations of a sweep."""

    SETTINGS = {"search": ["near", "far", "never"]}

    def runs(self, starts: int = 8) -> list[dict]:
        laps = {"near": 16.0, "far": 20.0, "never": 16.0}
        rows = [run(start, **PAPERS_D | {"lap_s": lap + 0.01 * start, "set.search": search})
                for search, lap in laps.items() for start in range(starts)]
        rows[-starts]["lap_s"] = np.nan
        return rows

    def test_leaves_out_and_counts_a_combination_in_which_a_start_has_no_lap(self) -> None:
        made = sweep(self.SETTINGS, self.runs())
        judged = judged_combinations(made)
        self.assertEqual(list(judged.index), [0, 1, 2])
        self.assertEqual(list(judged.choosing.isna()), [False, False, True])
        self.assertEqual(list(judged.may_be_as_near), [True, False, False])
        text = comparison_markdown(made)
        self.assertIn("**1 of 3 combinations are left out** (each from 1 to 1 of 8 starts): ", text)
        self.assertEqual(list(judged.starts_without_lap), [0, 0, 1])
        self.assertIn("The nearest of 2 combinations is chosen by the starts 0 to 3; its distance is measured on the "
                      "starts 4 to 7", text)
        self.assertIn("| search | never | 1 | 1 | - | - | - | - |", text)

    def test_a_missing_lap_of_a_held_out_start_has_no_part_in_the_choice(self) -> None:
        rows = self.runs()
        before = judged_combinations(sweep(self.SETTINGS, rows))
        rows[7]["lap_s"] = np.nan  # of the nearest
        judged = judged_combinations(sweep(self.SETTINGS, rows))
        pd.testing.assert_series_equal(judged.choosing, before.choosing)
        self.assertEqual(list(judged.held_out.isna()), [True, False, True])
        self.assertEqual(list(judged.may_be_as_near), [True, False, False])

    def test_a_far_outlier_among_the_left_out_changes_no_other(self) -> None:
        rows = self.runs()
        before = judged_combinations(sweep(self.SETTINGS, rows))
        for row in rows:
            row["error_mean_mm"] = 1e9 if row["set.search"] == "never" else row["error_mean_mm"]
        pd.testing.assert_frame_equal(judged_combinations(sweep(self.SETTINGS, rows)), before)

    def test_a_single_start_holds_nothing_out(self) -> None:
        rows = [row for row in self.runs() if row["start"] == 0]
        self.assertIn("with a single start nothing is held out", comparison_markdown(sweep(self.SETTINGS, rows)))

    def test_without_cells_or_laps_there_is_no_ranking(self) -> None:
        rows = self.runs()
        self.assertIsNone(judged_combinations(sweep(self.SETTINGS, [row | {"scenario": "s"} for row in rows])))
        text = comparison_markdown(sweep(self.SETTINGS, [row | {"lap_s": np.nan} for row in rows]))
        self.assertIn("**3 of 3 combinations are left out**", text)
        self.assertNotIn("nearest", text)


class CampaignTable(unittest.TestCase):
    """The page of the paper's Table 2."""

    def test_has_the_signed_difference_to_both_columns_with_the_scenarios_own_first(self) -> None:
        runs = [run(start, scenario=LAB, subgraph="D", error_mean_mm=error) for start, error in enumerate((16.0, 20.0))]
        text = campaign_markdown(campaign(runs))
        self.assertIn("| the paper's lab | ours - the paper's lab | the paper's simulation | ours - the paper's", text)
        self.assertIn("mean [mm] | D | 18.0 [16.0 … 20.0] | 17.0 | +5.9 % | 19.4 | -7.2 % |", text)
        text = campaign_markdown(campaign([row | {"scenario": SIMULATION} for row in runs]))
        self.assertIn("mean [mm] | D | 18.0 [16.0 … 20.0] | 19.4 | -7.2 % | 17.0 | +5.9 % |", text)

    def test_policies_and_other_scenarios_have_no_paper(self) -> None:
        text = campaign_markdown(campaign([run(scenario=LAB, subgraph="D", policy="zone")]))
        self.assertIn("mean [mm] | policy zone | 20.0 | - | - | - | - |", text)
        self.assertNotIn("paper", campaign_markdown(campaign([run()])).partition("## s, profile default")[2])
        self.assertTrue(campaign_data(campaign([run(subgraph="D")])).paper_lab.isna().all())

    def test_counts_starts_by_outcome_and_names_what_failed_or_was_stuck(self) -> None:
        runs = [run(0), run(1, lap_s=np.nan), run(2, stuck_vehicles=1, error_mean_mm=0.0),
                run(3, failure="vehicles touched"), run(4, error_mean_mm=22.0)]
        text = campaign_markdown(campaign(runs))
        self.assertIn("| Reference error of planned positions, mean [mm] | 21.0 [20.0 … 22.0] |", text)
        self.assertIn("| Starts with a lap | 2 |\n| Starts without a lap, no car stuck | 1 |\n"
                      "| Starts with a stuck car | 1 |\n| Failed starts | 1 |", text)
        self.assertIn("Failed: subgraph A, start 3: vehicles touched\n", text)
        self.assertIn("Stuck: subgraph A, start 2: red\n", text)


if __name__ == "__main__":
    unittest.main()
