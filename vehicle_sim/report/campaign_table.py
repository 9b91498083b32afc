"""The runs of a campaign beside the paper's Table 2."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pandas as pd

from report import markdown, paper
from report.columns import IDENTITY
from report.results import FAILED, LAP, NO_LAP, NO_POLICY, OUTCOMES, STUCK, Campaign, with_lap

OUTCOME_NAMES = {LAP: "Starts with a lap", NO_LAP: "Starts without a lap, no car stuck",
                 STUCK: "Starts with a stuck car", FAILED: "Failed starts"}
PAPER_NAMES = {paper.SIMULATION: "the paper's simulation", paper.LAB: "the paper's lab"}
WORDS = (
    "Means over the starts with a lap, in brackets the smallest and the largest: starts without a lap, with a stuck "
    "car and failed ones are counted in rows of their own and are part of no mean. Errors and lap are those of the "
    "vehicle of highest priority, the lap that of its planned positions. Computation times are processor time of the "
    "planning thread, one car's; wall times are of runs driven beside each other (`--jobs`).\n\n"
)


class Column(NamedTuple):
    """The runs on one fixed subgraph, or with one policy."""

    subgraph: str
    policy: str
    runs: pd.DataFrame

    @property
    def name(self) -> str:
        return self.subgraph if self.policy == NO_POLICY else "policy " + self.policy


def groups_of(runs: pd.DataFrame) -> Iterator[tuple[str, str, list[Column]]]:
    """Scenario, profile and their columns, in the order of their appearance."""
    for (scenario, profile), group in runs.groupby(["scenario", "profile"], sort=False):
        columns = group.groupby(["subgraph", "policy"], sort=False)
        yield scenario, profile, [Column(subgraph, policy, of_column) for (subgraph, policy), of_column in columns]


def campaign_markdown(campaign: Campaign) -> str:
    """For every scenario and profile a table with a column per fixed subgraph and per policy and, of the paper's
    scenarios, before it the table beside the paper's values."""
    text = WORDS
    for scenario, profile, columns in groups_of(campaign.runs):
        title = f"{scenario}, profile {profile}"
        text += f"## {title} ({PAPER_NAMES[scenario]})\n\n" if scenario in PAPER_NAMES else f"## {title}\n\n"
        if scenario in PAPER_NAMES:
            text += "### Beside the paper's Table 2\n\n" + _beside_paper(scenario, columns) + "### All quantities\n\n"
        text += _all_quantities(columns) + _notes(columns, campaign.cars)
    return text


def campaign_data(campaign: Campaign) -> pd.DataFrame:
    """The same as rows: one per scenario, profile, column and quantity, then the counts of starts by outcome."""
    rows = []
    for scenario, profile, columns in groups_of(campaign.runs):
        for column in columns:
            heading = dict(zip(IDENTITY, (scenario, profile, column.subgraph, column.policy)))
            for one in paper.QUANTITIES:
                values = one.values(with_lap(column.runs)).dropna()
                row = heading | {"quantity": one.key, "runs": len(values), "mean": values.mean(), "min": values.min(),
                                 "max": values.max()}
                for name, theirs in {"simulation": paper.SIMULATION, "lab": paper.LAB}.items():
                    value = _papers(one, theirs, column) if scenario in PAPER_NAMES else np.nan
                    row |= {f"paper_{name}": value, f"difference_{name}_percent": _percent(values.mean(), value)}
                rows.append(row)
            counts = column.runs.outcome.value_counts()
            rows += [heading | {"quantity": f"starts_{outcome}", "runs": counts.get(outcome, 0)}
                     for outcome in OUTCOMES]
    return pd.DataFrame(rows)


def _papers(quantity: paper.Quantity, scenario: str, column: Column) -> float:
    """The paper has no policies."""
    return quantity.paper(scenario, column.subgraph) if column.policy == NO_POLICY else np.nan


def _difference(quantity: paper.Quantity, ours: float, theirs: float) -> str:
    """None of what was measured on another machine."""
    difference = np.nan if quantity.depends_on_machine else _percent(ours, theirs)
    return "-" if np.isnan(difference) else f"{difference:+.1f} %"


def _percent(ours: float, theirs: float) -> float:
    return 100.0 * (ours - theirs) / theirs


def _spread(values: pd.Series, decimals: int) -> str:
    values = values.dropna()
    if len(values) < 2:
        return markdown.number(values.mean(), decimals)
    return f"{values.mean():.{decimals}f} [{values.min():.{decimals}f} … {values.max():.{decimals}f}]"


def _beside_paper(scenario: str, columns: list[Column]) -> str:
    own_first = sorted(PAPER_NAMES, key=lambda name: name != scenario)
    titles = ["quantity", "subgraph", "ours"]
    for name in own_first:
        titles += [PAPER_NAMES[name], f"ours - {PAPER_NAMES[name]}"]
    rows = []
    for one in paper.QUANTITIES:
        for column in columns if one.is_compared_in(scenario) else []:
            ours = one.values(with_lap(column.runs))
            row = [one.name, column.name, _spread(ours, one.decimals)]
            for theirs in (_papers(one, name, column) for name in own_first):
                row += [markdown.number(theirs, min(one.decimals, 1)), _difference(one, ours.mean(), theirs)]
            rows.append(row)
    return markdown.table(titles, rows)


def _all_quantities(columns: list[Column]) -> str:
    rows = [[one.name] + [_spread(one.values(with_lap(column.runs)), one.decimals) for column in columns]
            for one in paper.QUANTITIES]
    rows += [[name] + [(column.runs.outcome == outcome).sum() for column in columns]
             for outcome, name in OUTCOME_NAMES.items()]
    return markdown.table(["quantity"] + [column.name for column in columns], rows)


def _notes(columns: list[Column], cars: pd.DataFrame) -> str:
    """Which starts failed, and which cars were stuck."""
    text = ""
    for column in columns:
        name = ("subgraph " if column.policy == NO_POLICY else "") + column.name
        for run in column.runs[column.runs.outcome == FAILED].itertuples():
            text += f"Failed: {name}, start {run.start}: {run.failure}\n\n"
        for run in column.runs[column.runs.outcome == STUCK].itertuples():
            stuck = cars[(cars.run == run.run) & cars.is_stuck].name
            text += f"Stuck: {name}, start {run.start}: {', '.join(stuck)}\n\n"
    return text
