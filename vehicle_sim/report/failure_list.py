"""Which runs of a sweep do not count, and why."""

import re

import pandas as pd

from report.results import FAILED

MOST_SHOWN = 20
NUMBER = re.compile(r"[0-9]+(?:[.][0-9]+)?")


def failure_markdown(runs: pd.DataFrame) -> str:
    """Reasons that differ in numbers only are merged, with the range of these numbers. Empty if all runs count."""
    failed = runs[runs.outcome == FAILED]
    if failed.empty:
        return ""
    texts = "subgraph " + failed.subgraph.astype(str) + ": " + failed.failure.str.replace(NUMBER, "#", regex=True)
    reasons = failed.failure.groupby(texts)
    text = f"## Runs that do not count: {len(failed)}\n\n"
    order = reasons.size().sort_values(ascending=False, kind="stable")
    for reason in order.index[:MOST_SHOWN]:
        text += f"* {order[reason]} times {_with_ranges(reason, reasons.get_group(reason))}\n"
    if len(order) > MOST_SHOWN:
        text += f"* and {len(order) - MOST_SHOWN} other reasons, see runs.csv\n"
    return text + "\n"


def _with_ranges(reason: str, failures: pd.Series) -> str:
    """ "vehicle 1 was out of its areas in 2 … 7 steps" """
    columns = iter(zip(*(NUMBER.findall(failure) for failure in failures)))

    def span(match: re.Match) -> str:
        numbers = next(columns)
        least, most = min(numbers, key=float), max(numbers, key=float)
        return least if float(least) == float(most) else f"{least} … {most}"

    subgraph, place, rest = reason.partition(": ")
    return subgraph + place + re.sub("#", span, rest)
