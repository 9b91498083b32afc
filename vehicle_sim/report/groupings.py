"""Groupings of a sweep's runs by the values of settings."""

from collections.abc import Iterator

import pandas as pd

from report.columns import SETTING
from report.results import Sweep

Axes = tuple[str, ...]  # names of settings

MOST_VALUES = 32  # settings with more values have no table by value


def groupings_of(sweep: Sweep) -> list[Axes]:
    """All runs together (no setting), every setting of 2 ... MOST_VALUES values alone, then the sweep file's own
    `tables`; each once."""
    alone = [(name,) for name, values in sweep.settings.items() if 1 < len(values) <= MOST_VALUES]
    return list(dict.fromkeys([(), *alone, *sweep.tables]))


def columns_of(axes: Axes) -> list[str]:
    """Their columns in the runs."""
    return [SETTING + name for name in axes]


def groups_of(runs: pd.DataFrame, axes: Axes, then: list[str] | None = None) -> Iterator[tuple[tuple, pd.DataFrame]]:
    """The runs with the same values on the axes, and in the columns `then`, in the order of the sweep's values."""
    keys = columns_of(axes) + (then or [])
    if keys:
        yield from runs.groupby(keys, observed=True, sort=True)
    else:
        yield (), runs


def settings_text(axes: Axes) -> str:
    """ "drivable, search", "all"."""
    return ", ".join(axes) or "all"
