"""Intervals, the signed-rank test and Holm's correction against their definitions."""

import itertools
import unittest

import numpy as np
import pandas as pd
from made_up import seeds
from scipy import stats

from report.inference import (EXACT_PAIRS, Interval, holm, interval_of_mean, interval_over_starts, median_interval,
                              p_text, power_text, signed_rank_p)


class Holm(unittest.TestCase):
    """Holm's method is closed testing with Bonferroni's test of each intersection of hypotheses."""

    def test_is_closed_testing_of_up_to_four_hypotheses(self) -> None:
        for seed, generator in seeds(200):
            count = int(generator.integers(1, 5))
            p = pd.Series(generator.choice([0.001, 0.01, 0.0125, 0.02, 0.04, 0.05, 0.3, 0.9], count))
            expected = [max(min(1.0, len(chosen) * p[list(chosen)].min())
                            for size in range(1, count + 1) for chosen in itertools.combinations(range(count), size)
                            if i in chosen) for i in range(count)]
            with self.subTest(seed=seed, p=list(p)):
                np.testing.assert_allclose(holm(p), expected, rtol=1e-12)

    def test_absent_tests_count_for_none(self) -> None:
        corrected = holm(pd.Series([0.03, np.nan, 0.01], index=[7, 8, 9]))
        np.testing.assert_allclose(corrected, [0.03, np.nan, 0.02])
        self.assertEqual(list(corrected.index), [7, 8, 9])

    def test_a_family_without_effects_has_a_false_claim_in_at_most_one_of_twenty(self) -> None:
        for seed, generator in seeds(3):
            families = [holm(pd.Series(generator.uniform(size=10))).min() <= 0.05 for _ in range(1000)]
            with self.subTest(seed=seed):
                self.assertLess(np.mean(families), 0.05 + 4 * np.sqrt(0.05 * 0.95 / 1000))


class SignedRank(unittest.TestCase):
    """Exact p, also with ties."""

    def test_is_the_share_of_signs_with_as_extreme_a_sum_of_ranks(self) -> None:
        for seed, generator in seeds(60):
            differences = generator.integers(-4, 5, int(generator.integers(1, 10))).astype(float)
            nonzero = differences[differences != 0]
            if nonzero.size == 0:
                continue
            ranks = stats.rankdata(np.abs(nonzero))
            sums = np.array([np.dot(signs, ranks) for signs in itertools.product((0, 1), repeat=nonzero.size)])
            observed = ranks[nonzero > 0].sum()
            expected = min(1.0, 2 * min((sums <= observed).mean(), (sums >= observed).mean()))
            with self.subTest(seed=seed, differences=list(differences)):
                self.assertAlmostEqual(signed_rank_p(differences), expected, places=12)

    def test_without_ties_is_that_of_scipy(self) -> None:
        for seed, generator in seeds(20):
            differences = generator.normal(0.3, 1.0, int(generator.integers(6, 50)))
            with self.subTest(seed=seed):
                self.assertAlmostEqual(signed_rank_p(differences), stats.wilcoxon(differences, method="exact").pvalue,
                                       places=12)

    def test_of_many_pairs_continues_without_a_jump(self) -> None:
        for seed, generator in seeds(5):
            differences = generator.normal(0.1, 1.0, EXACT_PAIRS)
            approximate = stats.wilcoxon(differences, method="asymptotic").pvalue
            with self.subTest(seed=seed):
                self.assertAlmostEqual(signed_rank_p(differences), approximate, delta=1e-3)
                self.assertGreater(signed_rank_p(np.append(differences, -1e-9)), 0.5 * approximate)

    def test_of_nothing_is_nothing_and_of_zeros_one(self) -> None:
        self.assertTrue(np.isnan(signed_rank_p([])))
        self.assertEqual(signed_rank_p([0.0, 0.0]), 1.0)
        self.assertEqual(signed_rank_p([1.0]), 1.0)

    def test_too_few_starts_for_a_family_are_named(self) -> None:
        for seed, generator in seeds(30):
            starts, count = int(generator.integers(1, 14)), int(generator.integers(1, 40))
            best = holm(pd.Series([signed_rank_p(np.arange(1.0, starts + 1))] + [1.0] * (count - 1))).min()
            text = power_text({"width": (starts, (count + 1) // 2), "search": (starts, count), "lap": (starts, 0)})
            with self.subTest(seed=seed, starts=starts, count=count):
                self.assertEqual(text == "", best <= 0.05)
                if text:
                    needed = int(text.split("all can with ")[1].split()[0])
                    self.assertLessEqual(count * signed_rank_p(np.ones(needed)), 0.05)
                    self.assertGreater(count * signed_rank_p(np.ones(needed - 1)), 0.05)
                    self.assertIn(f"search ({starts} starts, {count} claims)", text)
                    self.assertNotIn("lap", text.split("claim about")[1])


class Intervals(unittest.TestCase):
    """95 % of the intervals hold the true value."""

    def coverage(self, share: float, samples: int, at_most: float = 1.0) -> None:
        slack = 4 * np.sqrt(0.95 * 0.05 / samples)
        self.assertGreater(share, 0.95 - slack)
        self.assertLess(share, min(1.0, at_most + slack))

    def test_of_the_mean_hold_it_as_often_as_stated(self) -> None:
        for seed, generator in seeds(3):
            for count in (2, 5, 30):
                samples = generator.normal(3.0, 2.0, (2000, count))
                held = [abs(one.mean - 3.0) <= one.half_width for one in map(interval_of_mean, samples)]
                with self.subTest(seed=seed, count=count):
                    self.coverage(np.mean(held), 2000, at_most=0.95)

    def test_of_the_median_hold_that_of_a_skewed_distribution(self) -> None:
        for seed, generator in seeds(3):
            for count in (6, 8, 25):
                samples = generator.exponential(1.0, (2000, count))
                held = [low <= np.log(2.0) <= high for low, high in map(median_interval, samples)]
                k = int(stats.binom.ppf(0.025, count, 0.5))
                exact = 1 - 2 * stats.binom.cdf(k - 1, count, 0.5)
                with self.subTest(seed=seed, count=count):
                    self.coverage(np.mean(held), 2000, at_most=exact)

    def test_of_the_median_are_order_statistics_of_at_least_six_values(self) -> None:
        self.assertEqual(median_interval(np.arange(6.0)), (0.0, 5.0))
        self.assertEqual(median_interval(np.arange(9.0)), (1.0, 7.0))
        for count in range(6):
            self.assertTrue(np.isnan(median_interval(np.arange(float(count)))).all())

    def test_of_the_mean_are_students(self) -> None:
        interval = interval_of_mean([1.0, 2.0, 3.0])
        self.assertEqual(interval.mean, 2.0)
        self.assertAlmostEqual(interval.half_width, 4.302653 / np.sqrt(3.0), places=6)
        self.assertEqual(interval_of_mean([5.0]).text(1), "5.0")
        self.assertEqual(interval_of_mean([]).text(1), "-")
        self.assertEqual(interval.text(1), "2.0 ± 2.5")

    def test_over_starts_counts_each_start_once(self) -> None:
        values = pd.Series([1.0, 3.0, 3.0, 3.0, 3.0, np.nan])
        interval = interval_over_starts(values, pd.Series([0, 1, 1, 1, 1, 2]))
        self.assertEqual((interval.mean, interval.count), (2.0, 2))

    def test_marks_what_holds_and_what_the_mean_does_not_show(self) -> None:
        self.assertEqual(p_text(0.0123, Interval(2.0, 1.0, 9)), "p 0.012 *")
        self.assertEqual(p_text(0.05, Interval(-2.0, 1.0, 9)), "p 0.050 *")
        self.assertEqual(p_text(0.0512, Interval(2.0, 1.0, 9)), "p 0.051")
        self.assertEqual(p_text(1e-6, Interval(0.5, 1.0, 9)), "p < 0.001 * (†)")
        self.assertEqual(p_text(np.nan, Interval(np.nan, np.nan, 0)), "-")


if __name__ == "__main__":
    unittest.main()
