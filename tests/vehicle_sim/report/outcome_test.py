"""Means over starts with a lap never contain a failed run, a stuck car or a run without a lap."""

import unittest

import numpy as np
import pandas as pd
from made_up import campaign, frame, run, seeds, sweep

from report import columns
from report.accuracy_comparison import accuracy_data
from report.campaign_table import campaign_data
from report.paired_comparison import paired_data
from report.results import FAILED, LAP, NO_LAP, STUCK
from report.setting_tables import setting_data
from report.tradeoff import tradeoff_data

NO_MEANS = ({"stuck_vehicles": 2}, {"failure": "vehicles touched"}, {"lap_s": np.nan}, {"error_mean_mm": np.nan})
NUMBERS = columns.OPTIONAL[:7] + columns.REQUIRED[:-1] + columns.MEASURED


def random_run(generator: np.random.Generator, start: int, **values: object) -> dict[str, object]:
    """With a lap."""
    return run(start, **{name: generator.uniform(1.0, 50.0) for name in NUMBERS} | values)


def without_counts(data: pd.DataFrame) -> pd.DataFrame:
    """Only what is a mean, a median, an interval or a p."""
    counts = {"runs", "good_runs", LAP, NO_LAP, STUCK, FAILED, "pairs", "laps_first", "laps_second", "compared",
              "more_accurate", "median_ratio", "most_in_a_step"}
    return data.drop(columns=counts & set(data.columns))


class Outcome(unittest.TestCase):
    """One for each run."""

    def test_is_the_first_that_applies(self) -> None:
        runs = [run(), run(lap_s=np.nan), run(error_mean_mm=np.nan), run(stuck_vehicles=1),
                run(stuck_vehicles=1, lap_s=np.nan), run(failure="x", stuck_vehicles=1, lap_s=np.nan)]
        self.assertEqual(list(frame(runs).outcome), [LAP, NO_LAP, NO_LAP, STUCK, STUCK, FAILED])

    def test_other_outcomes_change_no_mean_of_a_campaign(self) -> None:
        for seed, generator in seeds(10):
            good = [random_run(generator, start, subgraph=subgraph, policy=policy)
                    for subgraph, policy in (("A", "none"), ("B", "none"), ("A", "zone")) for start in range(7)]
            bad = [random_run(generator, 7 + i, subgraph=one["subgraph"], policy=one["policy"]) | {"error_mean_mm": 0.0}
                   | NO_MEANS[generator.integers(len(NO_MEANS))] for i, one in enumerate(good)]
            tables = [(campaign_data(campaign(runs)), *tradeoff_data(frame(runs))) for runs in (good, good + bad)]
            with self.subTest(seed=seed):
                for before, after in zip(*tables):
                    if "quantity" in before:
                        before, after = (one[~one.quantity.str.startswith("starts_")] for one in (before, after))
                    pd.testing.assert_frame_equal(without_counts(before), without_counts(after), check_exact=True)

    def test_other_outcomes_change_no_mean_of_a_sweep(self) -> None:
        settings = {"search": ["a", "b"]}
        for seed, generator in seeds(10):
            good = [random_run(generator, start, subgraph=subgraph, **{"set.search": value})
                    for value in "ab" for subgraph in "AB" for start in range(7)]
            bad = [random_run(generator, 7 + i % 7, subgraph=one["subgraph"], **{"set.search": one["set.search"]})
                   | NO_MEANS[generator.integers(len(NO_MEANS))] for i, one in enumerate(good)]
            with self.subTest(seed=seed):
                for data in (setting_data, paired_data, accuracy_data):
                    before, after = (data(sweep(settings, runs)) for runs in (good, good + bad))
                    pd.testing.assert_frame_equal(without_counts(before), without_counts(after), check_exact=True)

    def test_a_lap_of_one_run_of_a_pair_alone_is_no_difference(self) -> None:
        settings = {"search": ["a", "b"]}
        for seed, generator in seeds(10):
            pairs = [[random_run(generator, start, subgraph=subgraph, **{"set.search": value})
                      for value, subgraph in (("a", "A"), ("b", "B"), ("a", "B"), ("b", "A"))] for start in range(14)]
            good = [one for start in pairs[:7] for one in start]
            # The first two have a partner in both comparisons, the last two are these partners.
            for start in pairs[7:]:
                bad = (0, 1) if generator.uniform() < 0.5 else (2, 3)
                for i in bad:
                    start[i] |= NO_MEANS[generator.integers(len(NO_MEANS))]
            with self.subTest(seed=seed):
                for data in (paired_data, accuracy_data):
                    before, after = (data(sweep(settings, runs)) for runs in (good, [*good, *sum(pairs[7:], [])]))
                    pd.testing.assert_frame_equal(without_counts(before), without_counts(after), check_exact=True)


if __name__ == "__main__":
    unittest.main()
