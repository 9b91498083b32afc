"""Which runs of a sweep do not count, and why."""

import re

import pandas as pd

from report.results import FAILED

MOST_SHOWN = 20
NUMBER = re.compile(r"[0-9]+(?:[.][0-9]+)?")
NUMBER_HERE = "\0"  # no text of a file contains it


def failure_markdown(runs: pd.DataFrame) -> str:
    """Reasons that differ in numbers only are merged, with the range of these numbers. Empty if all runs count."""
    failed = runs[runs.outcome == FAILED]
    if failed.empty:
        return ""
    texts = failed.subgraph.astype(str) + ": " + failed.failure.str.replace(NUMBER, NUMBER_HERE, regex=True)
    reasons = sorted((failures for _, failures in failed.failure.groupby(texts, sort=False)), key=len, reverse=True)
    text = f"## Runs that do not count: {len(failed)}\n\n"
    for failures in reasons[:MOST_SHOWN]:
        text += f"* {len(failures)} times subgraph {failed.subgraph[failures.index[0]]}: {_with_ranges(failures)}\n"
    if len(reasons) > MOST_SHOWN:
        text += f"* and {len(reasons) - MOST_SHOWN} other reasons, see runs.csv\n"
    return text + "\n"


def _with_ranges(failures: pd.Series) -> str:
    """ "vehicle 1 was out of its areas in 2 … 7 steps" """
    columns = zip(*(NUMBER.findall(failure) for failure in failures))

    def span(_: re.Match) -> str:
        numbers = next(columns)
        least, most = min(numbers, key=float), max(numbers, key=float)
        return least if float(least) == float(most) else f"{least} … {most}"

    return NUMBER.sub(span, failures.iloc[0])
