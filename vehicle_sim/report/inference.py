"""Intervals and tests over starts. Runs of one start are not independent, so each start counts once, as the mean of
its values."""

from typing import NamedTuple

import numpy as np
import pandas as pd
from scipy import stats

from report.markdown import number

CONFIDENCE = 0.95
LEVEL = 0.05  # of significance
EXACT_PAIRS = 300  # with more of them the signed-rank test's normal approximation is off by some 1e-4


class Interval(NamedTuple):
    """A mean and its uncertainty."""

    mean: float
    half_width: float  # NaN of a single value
    count: int  # independent values

    def text(self, decimals: int) -> str:
        """ "24.3 ± 0.4", "24.3" of a single value, "-" of none."""
        mean = number(self.mean, decimals)
        return mean if np.isnan(self.half_width) else f"{mean} ± {number(self.half_width, decimals)}"


def interval_of_mean(values: np.ndarray | pd.Series) -> Interval:
    """Student's 95 % interval of the mean of independent values, mean +- t s / sqrt(n), with s their standard deviation
    and t the 97.5 % quantile for n - 1 degrees of freedom; exact for values from a normal distribution."""
    values = np.asarray(values, dtype=float)
    if values.size == 0:
        return Interval(np.nan, np.nan, 0)
    if values.size == 1:
        return Interval(float(values[0]), np.nan, 1)
    quantile = stats.t.ppf(0.5 + CONFIDENCE / 2, values.size - 1)
    half_width = quantile * values.std(ddof=1) / np.sqrt(values.size)
    return Interval(float(values.mean()), float(half_width), values.size)


def means_of_starts(values: pd.Series, starts: pd.Series) -> pd.Series:
    """Absent values are left out, and so are starts without any."""
    return values.groupby(starts).mean().dropna()


def interval_over_starts(values: pd.Series, starts: pd.Series) -> Interval:
    """The interval of the mean over the starts."""
    return interval_of_mean(means_of_starts(values, starts))


def median_interval(values: np.ndarray | pd.Series) -> tuple[float, float]:
    """The interval [x_(k), x_(n+1-k)] of order statistics with the largest k for which at least 95 % of such intervals
    hold the median of any continuous distribution: P(Bin(n, 1/2) < k) <= 2.5 %. NaN of fewer than six values, which
    have no such interval. Source: David and Nagaraja, Order Statistics, section 7.1."""
    ordered = np.sort(np.asarray(values, dtype=float))
    k = int(stats.binom.ppf((1 - CONFIDENCE) / 2, ordered.size, 0.5)) if ordered.size else 0
    return (float(ordered[k - 1]), float(ordered[-k])) if k > 0 else (np.nan, np.nan)


def signed_rank_p(differences: np.ndarray | pd.Series) -> float:
    """Two-sided p of Wilcoxon's signed-rank test for differences of independent pairs: how probable such a sum of
    ranks is if each difference could as well have the other sign. Exact also with ties (mean ranks; zeros are left
    out), up to EXACT_PAIRS pairs. 1 if all are zero, NaN without a pair."""
    differences = np.asarray(differences, dtype=float)
    nonzero = differences[differences != 0.0]
    if differences.size == 0 or nonzero.size == 0:
        return np.nan if differences.size == 0 else 1.0
    if nonzero.size > EXACT_PAIRS:
        return float(stats.wilcoxon(nonzero, method="asymptotic").pvalue)
    doubled = np.rint(2 * stats.rankdata(np.abs(nonzero))).astype(int)  # mean ranks are multiples of 1/2
    distribution = np.zeros(doubled.sum() + 1)
    distribution[0] = 1.0
    for rank in doubled:
        distribution = 0.5 * (distribution + np.concatenate([np.zeros(rank), distribution[:-rank]]))
    positive = doubled[nonzero > 0].sum()
    return float(min(1.0, 2 * min(distribution[:positive + 1].sum(), distribution[positive:].sum())))


def holm(p: pd.Series) -> pd.Series:
    """The p of one family of tests corrected by Holm's step-down method: the family's probability of any false
    rejection stays below the level, whatever the dependence of the tests. NaN stays NaN and counts for no test.
    Source: Holm, Scandinavian Journal of Statistics 6 (1979)."""
    ordered = p.dropna().sort_values(kind="stable")
    factors = np.arange(len(ordered), 0, -1)
    return (ordered * factors).cummax().clip(upper=1.0).reindex(p.index)


TEST_WORDS = (
    "p: Wilcoxon's signed-rank test over the starts, of differences rounded to the decimals shown (those of 0 are left "
    "out), corrected by Holm's method within the family; * holds at 5 %, and "
    "(†) with an interval of the mean that includes 0: most starts agree, few large differences do not. "
)


def p_text(corrected: float, interval: Interval) -> str:
    """ "p 0.012 *", see TEST_WORDS."""
    if np.isnan(corrected):
        return "-"
    text = "p < 0.001" if corrected < 0.001 else f"p {corrected:.3f}"
    if corrected > LEVEL:
        return text
    return text + (" * (†)" if abs(interval.mean) <= interval.half_width else " *")


def power_text(families: dict[str, tuple[int, int]]) -> str:
    """Names the families in which no claim can hold: with n starts that all agree p is 2 / 2^n, and the smallest p of m
    is corrected by the factor m. @param families: numbers of starts and of tests by name"""
    weak = {name: (starts, count) for name, (starts, count) in families.items() if count * 2.0 ** (1 - starts) > LEVEL}
    if not weak:
        return ""
    needed = int(np.ceil(1 + np.log2(max(count for _, count in weak.values()) / LEVEL)))
    names = ", ".join(f"{name} ({starts} starts, {count} claims)" for name, (starts, count) in weak.items())
    return (f"**No claim about {names} can hold at 5 %**: with n starts no p is below 2 / 2ⁿ, and the smallest one is "
            f"corrected by the number of claims; all can with {needed} starts.\n\n")
