"""The page of a campaign, a sweep or a comparison of priorities, and the data of its tables."""

from dataclasses import dataclass, field

import pandas as pd

from report.accuracy_comparison import accuracy_data, accuracy_markdown
from report.campaign_table import campaign_data, campaign_markdown
from report.failure_list import failure_markdown
from report.paired_comparison import paired_data, paired_markdown
from report.paper_comparison import comparison_markdown, judged_combinations
from report.paper_distance import factor
from report.priorities import Priorities, priorities_data, priorities_markdown
from report.results import NO_POLICY, Campaign, Sweep
from report.setting_tables import setting_data, setting_markdown
from report.tradeoff import tradeoff_data, tradeoff_markdown
from report.trims_front import TRIMS, choices_of, trims_markdown


@dataclass(frozen=True)
class Page:
    """Markdown, and tables by the name of their file."""

    text: str
    origin: str  # the last lines
    data: dict[str, pd.DataFrame] = field(default_factory=dict)


def page_of(results: Campaign | Sweep | Priorities) -> Page:
    """All tables."""
    origin = results.origin
    text = (f"Command: `{origin['command']}`\n\nProgram {origin['revision']}, compiled by {origin['compiler']}; "
            f"{origin['processor']}.\n")
    if isinstance(results, Priorities):
        data = priorities_data(results)
        return Page(priorities_markdown(results, data), text, {"priorities": data})
    return _campaign_page(results, text) if isinstance(results, Campaign) else _sweep_page(results, text)


def _campaign_page(campaign: Campaign, origin: str) -> Page:
    text = "# Evaluation\n\n" + campaign_markdown(campaign)
    data = {"evaluation": campaign_data(campaign)}
    if (campaign.runs.policy != NO_POLICY).any():
        text += tradeoff_markdown(campaign.runs)
        data["tradeoff"], data["tradeoff_fronts"] = tradeoff_data(campaign.runs)
    return Page(text, origin, data)


def _sweep_page(sweep: Sweep, origin: str) -> Page:
    text = (f"# Sweep {sweep.file}\n\n{len(sweep.runs)} runs: {sweep.combinations} combinations of settings; scenarios "
            f"{len(sweep.scenarios)}, subgraphs {len(sweep.subgraphs)}, starts {sweep.starts}, automata "
            f"{sweep.automata}.\n\n")
    data = {}
    judged = judged_combinations(sweep)
    if TRIMS in sweep.settings:
        data["trims"] = choices_of(sweep)
        text += trims_markdown(sweep, data["trims"])
        data["trims"] = data["trims"].drop(columns="trims")
    elif judged is not None:
        text += comparison_markdown(sweep)
    if judged is not None:
        distances = {f"factor_{name}": factor(judged[name]) for name in ("choosing", "held_out")}
        data["combinations"] = judged.reset_index().drop(columns=["choosing", "held_out"]).assign(
            **{name: values.to_numpy() for name, values in distances.items()})
    accuracy, paired, settings = accuracy_data(sweep), paired_data(sweep), setting_data(sweep)
    data |= {"accuracy": accuracy, "paired": paired, "settings": settings.drop(columns="cell")}
    text += accuracy_markdown(accuracy) + paired_markdown(paired) + setting_markdown(settings)
    text += failure_markdown(sweep.runs)
    return Page(text, origin, {name: _flat(table) for name, table in data.items() if not table.empty})


def _flat(data: pd.DataFrame) -> pd.DataFrame:
    """Several settings or values in one cell, separated by semicolons; none: "all" and nothing."""
    data = data.copy()
    for name, empty in {"settings": "all", "values": "", "with": "", "within": ""}.items():
        if name in data:
            data[name] = ["; ".join(values) or empty for values in data[name]]
    return data
