"""Pairs, families and words of the paired comparisons; and of the comparison of subgraphs."""

import itertools
import unittest

import numpy as np
import pandas as pd
from made_up import run, seeds, sweep

from report.accuracy_comparison import accuracy_data, accuracy_markdown
from report.inference import holm, interval_of_mean, signed_rank_p
from report.paired_comparison import FACTOR, paired_data, paired_markdown
from report.paper import LAB

SETTINGS = {"search": ["a", "b", "c"], "margin": ["0", "1"]}


def made_runs(generator: np.random.Generator, starts: int = 8) -> list[dict]:
    """Of a sample of the combinations, in any order; some without a lap."""
    combinations = list(itertools.product(*SETTINGS.values()))
    driven = [combinations[i] for i in sorted(generator.permutation(6)[:5])]
    rows = [run(start, subgraph=subgraph, lap_s=15.0 if generator.uniform() < 0.8 else np.nan,
                error_mean_mm=float(generator.integers(10, 40)), generated_max=float(generator.integers(100, 900)),
                **{"set.search": search, "set.margin": margin})
            for search, margin in driven for subgraph in "AB" for start in range(starts)]
    return [rows[i] for i in generator.permutation(len(rows))]


class PairedComparison(unittest.TestCase):
    """Against loops over all runs."""

    def by_hand(self, rows: list[dict], value: str, subgraph: str, margin: str | None) -> tuple[int, list[float]]:
        """Pairs of `value` and "a", and the mean difference of each start with laps of both."""
        pairs, differences = 0, {}
        for second, first in itertools.product(rows, rows):
            same = all(second[name] == first[name] for name in ("set.margin", "subgraph", "start"))
            wanted = second["subgraph"] == subgraph and margin in (None, second["set.margin"])
            if not (same and wanted and second["set.search"] == value and first["set.search"] == "a"):
                continue
            pairs += 1
            if second["lap_s"] == first["lap_s"] == 15.0:
                change = second["error_mean_mm"] - first["error_mean_mm"]
                differences.setdefault(second["start"], []).append(change)
        return pairs, [float(np.mean(differences[start])) for start in sorted(differences)]

    def test_pairs_runs_that_differ_in_one_setting_alone(self) -> None:
        for seed, generator in seeds(15):
            rows = made_runs(generator)
            data = paired_data(sweep(SETTINGS, rows, tables=[("margin", "search")]))
            errors = data[(data.setting == "search") & (data.quantity == "error_mean_mm")]
            groups = itertools.product(((), ("0",), ("1",)), "bc", "AB")
            expected = {(within, value, subgraph) for within, value, subgraph in groups
                        if self.by_hand(rows, value, subgraph, next(iter(within), None))[0]}
            self.assertEqual(set(zip(errors.within, errors.value, errors.subgraph)), expected)
            for one in errors.itertuples():
                pairs, differences = self.by_hand(rows, one.value, one.subgraph, next(iter(one.within), None))
                with self.subTest(seed=seed, value=one.value, within=one.within, subgraph=one.subgraph):
                    self.assertEqual((one.pairs, one.starts), (pairs, len(differences)))
                    np.testing.assert_allclose(one.mean, interval_of_mean(differences).mean, rtol=1e-12)
                    np.testing.assert_allclose(one.half_width, interval_of_mean(differences).half_width, rtol=1e-12)
                    self.assertEqual(one.p, signed_rank_p(differences))

    def test_a_family_are_the_comparisons_of_one_setting_in_one_quantity(self) -> None:
        for seed, generator in seeds(10):
            data = paired_data(sweep(SETTINGS, made_runs(generator), tables=[("margin", "search")]))
            for family, rows in data.groupby(["setting", "quantity"]):
                with self.subTest(seed=seed, family=family):
                    self.assertTrue((rows.family == rows.p.notna().sum()).all())
                    pd.testing.assert_series_equal(rows.p_corrected, holm(rows.p), check_names=False)
                    self.assertEqual(list(rows.holds == 1), list(rows.p_corrected <= 0.05))

    def test_a_constant_effect_holds_and_none_does_not(self) -> None:
        rows = [run(start, error_mean_mm=20.0 + effect + start, lap_s=15.0 + 0.1 * (-1) ** start * (value == "b"),
                    **{"set.search": value})
                for value, effect in (("a", 0.0), ("b", 2.0)) for start in range(10)]
        text = paired_markdown(paired_data(sweep({"search": ["a", "b"]}, rows)))
        self.assertIn("| search | b | a |  | s, A | 10 | 10, 10 | 2.00 ± 0.00; p 0.002 * | 0.000 ± 0.075; p 1.000 | "
                      "0 ± 0; p 1.000 |", text)
        self.assertIn("quantity of this sweep: search 1 each.", text)
        self.assertNotIn("factor", text)
        self.assertNotIn("no claim", text)

    def test_names_the_settings_for_which_the_starts_are_too_few(self) -> None:
        rows = [run(start, **{"set.search": value}) for value in "ab" for start in range(4)]
        text = paired_markdown(paired_data(sweep({"search": ["a", "b"]}, rows)))
        self.assertIn("**No claim about search (4 starts, 1 claims) can hold at 5 %**", text)

    def test_names_a_family_that_a_missing_lap_leaves_with_too_few_starts(self) -> None:
        rows = [run(start, **{"set.search": value}) for value in "ab" for start in range(8)]
        for one in rows[:4]:
            one["lap_s"] = np.nan
        text = paired_markdown(paired_data(sweep({"search": ["a", "b"]}, rows)))
        self.assertIn("**No claim about search (4 starts, 1 claims) can hold at 5 %**", text)

    def test_the_distance_to_the_paper_leaves_out_pairs_without_a_lap(self) -> None:
        rows = [run(start, scenario=LAB, subgraph="D", error_mean_mm=17.0, error_std_mm=16.1, lap_s=16.0,
                    generated_max=291.0 * (1.0 + start / 100.0) * (2.0 if value == "b" else 1.0),
                    **{"set.search": value}) for value in "ab" for start in range(8)]
        rows[-1]["lap_s"] = np.nan
        data = paired_data(sweep({"search": ["a", "b"]}, rows))
        one = data[data.quantity == FACTOR].iloc[0]
        # D of one cell of four: sqrt(ln(2 c)^2 / 4) - sqrt(ln(c)^2 / 4) = ln(2) / 2.
        self.assertAlmostEqual(one["mean"], np.log(2.0) / 2, places=12)
        self.assertEqual((one.pairs, one.pairs_with_laps), (8, 7))
        self.assertIn("| search | b | a |  | 8, 1 | 1.414 [1.414 … 1.414]; p 0.016 * |", paired_markdown(data))

    def test_without_several_values_there_is_nothing_to_compare(self) -> None:
        self.assertEqual(paired_markdown(paired_data(sweep({"search": ["a"]}, [run(**{"set.search": "a"})]))), "")


class AccuracyComparison(unittest.TestCase):
    """Neighbours in the list of subgraphs."""

    def test_counts_combinations_with_a_lap_from_every_start_and_states_the_family(self) -> None:
        errors = {("a", "A"): 20.0, ("a", "B"): 10.0, ("b", "A"): 20.0, ("b", "B"): 30.0}
        rows = [run(start, subgraph=subgraph, error_mean_mm=error + start * (subgraph == "B"), **{"set.search": value})
                for (value, subgraph), error in errors.items() for start in range(6)]
        rows[-1]["lap_s"] = np.nan
        data = accuracy_data(sweep({"search": ["a", "b"]}, rows, tables=[("search",)]))
        text = accuracy_markdown(data)
        self.assertIn("in this sweep: B against A 3.\n\n**No claim about B against A (6 starts, 3 claims) can hold at "
                      "5 %**: with n starts no p is below 2 / 2ⁿ, and the smallest one is corrected by the number of "
                      "claims; all can with 7 starts.", text)
        self.assertIn("| all |  | 1 of 1, 0.62; 0.83 ± 3.35 mm; p 0.625 |", text)
        self.assertIn("| search | a | 1 of 1, 0.62; -7.50 ± 1.96 mm; p 0.094 |", text)
        self.assertIn("| search | b | 0 of 0; 12.00 ± 1.96 mm; p 0.125 |", text)

    def test_the_order_of_a_tables_settings_makes_no_second_claim(self) -> None:
        for seed, generator in seeds(3):
            rows = made_runs(generator)
            one = accuracy_data(sweep(SETTINGS, rows, tables=[("margin", "search")]))
            both = accuracy_data(sweep(SETTINGS, rows, tables=[("margin", "search"), ("search", "margin")]))
            with self.subTest(seed=seed):
                pd.testing.assert_frame_equal(one, both)

    def test_a_single_subgraph_has_no_neighbour(self) -> None:
        self.assertEqual(accuracy_markdown(accuracy_data(sweep({"search": ["a"]}, [run(**{"set.search": "a"})]))), "")


if __name__ == "__main__":
    unittest.main()
