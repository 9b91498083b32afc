"""The most accurate choices of trims by size, and the ranks of the trims of the automaton's own subgraphs."""

import pandas as pd

from report.columns import SETTING
from report.front import non_dominated
from report.markdown import number, table
from report.results import LAP, Sweep

TRIMS = "trims"  # the setting; its values are numbers from 1, separated by blanks
OBJECTIVES = ["moving", "error_mean_mm"]


def choices_of(sweep: Sweep) -> pd.DataFrame:
    """Combinations that drive a lap from every start: scenario, subgraph, `moving` (number of enabled moving trims),
    means over the starts, by moving trims, then error."""
    keys = ["scenario", "subgraph", "combination"]
    groups = sweep.runs.assign(has_lap=sweep.runs.outcome == LAP).groupby(keys, observed=True)
    choices = groups[["error_mean_mm", "lap_s", "generated_max"]].mean()
    choices["name"] = groups[[SETTING + name for name in sweep.settings]].first().apply(_name, axis=1, args=(sweep,))
    trims = groups[SETTING + TRIMS].first().map(trims_of).astype(object)
    choices["trims"] = trims
    choices["moving"] = [len(one & set(sweep.moving_trims)) for one in trims]
    choices = choices[groups.has_lap.all()].reset_index().sort_values(["scenario", "subgraph", *OBJECTIVES],
                                                                     kind="stable", ignore_index=True)
    return choices


def trims_of(text: str) -> frozenset[int]:
    """ "1 5 7" """
    return frozenset(int(one) for one in text.split())


def _name(settings: pd.Series, sweep: Sweep) -> str:
    """Trims first, then settings with several values."""
    others = [f"{name} {settings[SETTING + name]}" for name, values in sweep.settings.items()
              if name != TRIMS and len(values) > 1]
    return ", ".join([settings[SETTING + TRIMS], *others])


def trims_markdown(sweep: Sweep, choices: pd.DataFrame) -> str:
    """@param choices: of choices_of"""
    text = ""
    for scenario in sweep.scenarios:
        for subgraph in sweep.subgraphs:
            own = choices[(choices.scenario == scenario) & (choices.subgraph == subgraph)]
            text += (f"## Trims: {scenario}, maneuvers of {subgraph}\n\n{len(own)} of {sweep.combinations} choices "
                     f"drive a lap from every start, without a stuck car.\n\n")
            text += _table(sweep, own.reset_index(drop=True)) if len(own) else ""
    return text


def _table(sweep: Sweep, choices: pd.DataFrame) -> str:
    notes = [(i, "front") for i in choices.index[non_dominated(choices[OBJECTIVES].to_numpy(float))]]
    # Sorted: the first with so many is the most accurate of them.
    largest = choices[choices.moving == choices.moving.max()].error_mean_mm.iloc[0]
    notes.append(((choices.error_mean_mm <= largest).idxmax(), "smallest, not less accurate than the largest"))
    for name, offered in sweep.offered_trims.items():
        notes += [(i, f"trims of {name}: {_place(choices, choices.loc[i])}")
                  for i in choices.index[choices.trims == frozenset(offered)]]
    rows = [[choices.moving[i], choices.name[i], number(choices.error_mean_mm[i], 2), number(choices.lap_s[i], 2),
             number(choices.generated_max[i], 0), note] for i, note in notes]
    return table(["moving trims", "trims", "error, mean [mm]", "lap [s]", "max. generated", ""], rows)


def _place(choices: pd.DataFrame, one: pd.Series) -> str:
    same_size = choices.moving == one.moving
    more_accurate = choices.error_mean_mm < one.error_mean_mm
    no_worse = (choices.moving <= one.moving) & (choices.error_mean_mm <= one.error_mean_mm)
    dominating = (no_worse & ((choices.moving < one.moving) | more_accurate)).sum()
    front = "on the front" if dominating == 0 else f"{dominating} choices dominate it"
    return f"{front}; number {(same_size & more_accurate).sum() + 1} of {same_size.sum()} with as many trims"
