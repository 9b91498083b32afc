"""Medians, fronts and hypervolumes of fixed subgraphs and policies."""

import unittest

import numpy as np
from made_up import frame, run, seeds

from report.tradeoff import PAIRS, REFERENCE, tradeoff_data, tradeoff_markdown


def row(subgraph: str, policy: str, lap_s: float, effort: float, share: float = np.nan, **values: object) -> dict:
    """A run with a lap. @param share: clearly above the limit, of the time in zones"""
    return run(subgraph=subgraph, policy=policy, lap_s=lap_s, effort_per_m=effort, comfort_per_m=2.0 * effort,
               driven_error_mean_mm=20.0, above_limit_share=0.25 if share == share else np.nan,
               clearly_above_limit_share=share, **values)


# Fixed: fast with effort, slow without. The policy is between them, nearer to the best of both.
THREE = [row("fast", "none", 10.0, 10.0, 0.5), row("slow", "none", 20.0, 2.0, 0.0),
         row("slow", "mixed", 12.0, 3.0, 0.005)]


class Tradeoff(unittest.TestCase):
    """Of made-up runs."""

    def fronts(self, runs: list[dict], rows: str = "all", y: str = "effort_per_m") -> dict:
        data = tradeoff_data(frame(runs))[1]
        chosen = data[(data["rows"] == rows) & (data.x == "lap_s") & (data.y == y)]
        return {f"{one.subgraph} {one.policy}": one for _, one in chosen.iterrows()}

    def test_reference_points_are_these_constants(self) -> None:
        self.assertEqual({key: one.value for key, one in REFERENCE.items()},
                         {"lap_s": 32.0, "driven_error_mean_mm": 60.0, "effort_per_m": 50.0, "comfort_per_m": 50.0})
        text = tradeoff_markdown(frame(THREE))
        for one in REFERENCE.values():
            self.assertIn(f"{one.value:g} ({one.why})", text)

    def test_hypervolumes_are_areas_up_to_the_reference_point(self) -> None:
        fronts = self.fronts(THREE)
        # From (10, 10) and (20, 2) to (30, 50): 20 x 40 + 10 x 8. The policy adds 8 x 7 left of 20.
        self.assertEqual(fronts["fast none"].fixed, 976.0)
        self.assertEqual(fronts["slow mixed"]["with"], 976.0 + 8.0 * 7.0)
        self.assertEqual(fronts["slow mixed"].own, 20.0 * 47.0)
        self.assertTrue(all(one.not_dominated for one in fronts.values()))
        self.assertIn("| lap [s], effort per m | fast, slow, policy mixed | - | 976.000 | 1.057 |",
                      tradeoff_markdown(frame(THREE)))

    def test_a_row_beyond_the_reference_point_has_volume_0_and_is_marked(self) -> None:
        runs = THREE + [row("wild", "none", 9.0, 50.0), row("slow", "wild", 9.0, 151.0)]
        fronts = self.fronts(runs)
        for name in ("wild none", "slow wild"):
            self.assertEqual((fronts[name].is_beyond, fronts[name].own, fronts[name]["with"]), (True, 0.0, 976.0))
        self.assertFalse(fronts["fast none"].is_beyond)
        text = tradeoff_markdown(frame(runs))
        self.assertIn("| lap [s], effort per m | fast, slow, policy mixed, wild | wild, policy wild | 976.000 | 1.057 "
                      "| 1.000 (>) |", text)

    def test_a_further_row_changes_no_volume_of_the_others(self) -> None:
        for seed, generator in seeds(20):
            runs = [row(f"f{i}", "none", *generator.uniform(1.0, 40.0, 2)) for i in range(4)]
            runs += [row("f0", f"p{i}", *generator.uniform(1.0, 40.0, 2)) for i in range(3)]
            for y in ("effort_per_m", "comfort_per_m"):
                before, after = self.fronts(runs, y=y), self.fronts(runs + [row("f0", "bad", 99.0, 999.0)], y=y)
                with self.subTest(seed=seed, y=y):
                    for name, one in before.items():
                        for volume in ("own", "fixed", "with"):
                            self.assertEqual(one[volume], after[name][volume])

    def test_medians_have_intervals_from_six_starts_on(self) -> None:
        runs = [row("A", "none", 15.0 + start, 1.0, start=start) for start in range(6)]
        self.assertIn("| A | 17.50 [15.00 … 20.00] |", tradeoff_markdown(frame(runs)))
        self.assertIn("| A | 17.00 |", tradeoff_markdown(frame(runs[:5])))
        medians = tradeoff_data(frame(runs))[0].iloc[0]
        self.assertEqual((medians.lap_s, medians.lap_s_low, medians.lap_s_high), (17.5, 15.0, 20.0))

    def test_what_is_unknown_for_one_start_is_unknown(self) -> None:
        runs = [row("A", "none", 15.0, 1.0), row("A", "none", 15.0, np.nan) | {"comfort_per_m": 2.0}]
        text = tradeoff_markdown(frame(runs))
        self.assertIn("| A | 15.00 | 20.0 | - | 2.000 |", text)
        self.assertIn("| lap [s], effort per m | - | - | - |", text)
        self.assertIn("| lap [s], comfort per m | A | - |", text)

    def test_marks_rows_that_do_not_keep_the_limits_and_lets_the_others_compete_alone(self) -> None:
        text = tradeoff_markdown(frame(THREE))
        self.assertIn("| fast (!) | 10.00", text)
        self.assertIn("| slow | 20.00", text)
        within = self.fronts(THREE, "within_limits")
        self.assertEqual(sorted(within), ["slow mixed", "slow none"])
        self.assertEqual(within["slow none"].fixed, 12.0 * 48.0)
        one_of_two = [row("A", "none", 10.0, 1.0, 0.0), row("A", "none", 10.0, 1.0, 0.1)]
        self.assertIn("| A (!) |", tradeoff_markdown(frame(one_of_two)))
        self.assertNotIn("keep the limits", tradeoff_markdown(frame([row("A", "none", 10.0, 1.0)])))

    def test_without_a_fixed_one_that_keeps_the_limits_volumes_are_absolute(self) -> None:
        runs = [row("fast", "none", 10.0, 10.0, 0.5), row("fast", "zone", 12.0, 3.0, 0.0)]
        within = tradeoff_markdown(frame(runs)).partition("### Rows that keep the limits")[2]
        self.assertIn("| policy zone | - | 0.000 | 940.000 (of none) |", within)

    def test_states_what_a_policy_planned_on(self) -> None:
        one = row("A", "zone", 15.0, 1.0) | {"share.A": 0.5, "share.A, at most 0.4 m/s": 0.5, "share.B|C": np.nan}
        other = row("A", "zone", 15.0, 1.0) | {"share.A": 0.9, "share.A, at most 0.4 m/s": np.nan, "share.B|C": 0.1}
        self.assertIn("* policy zone: A 70.0 %; A, at most 0.4 m/s 25.0 %; B|C 5.0 %\n",
                      tradeoff_markdown(frame([one, other])))

    def test_names_cannot_break_tables(self) -> None:
        self.assertIn("| policy a\\|b | 14.00 |", tradeoff_markdown(frame([row("A", "a|b", 14.0, 1.0)])))

    def test_every_pair_has_reference_values(self) -> None:
        self.assertEqual(len(PAIRS), 3)
        self.assertTrue(all(key in REFERENCE for pair in PAIRS for key in pair))


if __name__ == "__main__":
    unittest.main()
