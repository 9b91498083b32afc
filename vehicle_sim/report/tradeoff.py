"""Whether switching subgraphs while driving is worthwhile: fixed subgraphs and policies in competition.

For each scenario and profile every fixed subgraph and every policy is a row, with medians over the starts with a lap. A
value that is unknown for one of these starts is unknown, and a row without values does not compete.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import pandas as pd

from report import markdown
from report.campaign_table import Column, groups_of
from report.columns import IDENTITY, SHARE
from report.front import hypervolume, non_dominated
from report.inference import median_interval
from report.paper import Quantity
from report.results import FAILED, NO_POLICY, with_lap

QUANTITIES: tuple[Quantity, ...] = (
    Quantity("lap [s]", "lap_s", 2),
    Quantity("error [mm]", "driven_error_mean_mm", 1),
    Quantity("effort per m", "effort_per_m", 3),
    Quantity("comfort per m", "comfort_per_m", 3),
    Quantity("vertices", "generated_max", 0),
    Quantity("planning, mean [ms]", "planning_mean_ms", 3),
    Quantity("planning, max. [ms]", "planning_max_ms", 3),
    Quantity("above limit [%]", "above_limit_percent", 1, of=lambda runs: 100.0 * runs.above_limit_share),
    Quantity("clearly above [%]", "clearly_above_limit_percent", 1,
             of=lambda runs: 100.0 * runs.clearly_above_limit_share),
    Quantity("largest excess [m/s]", "above_limit_max_mps", 3),
    Quantity("switches", "switches", 0),
)
NAMES = {one.key: one.name for one in QUANTITIES}
PAIRS = (("lap_s", "effort_per_m"), ("lap_s", "comfort_per_m"), ("driven_error_mean_mm", "effort_per_m"))


class ReferenceValue(NamedTuple):
    """A coordinate of the hypervolume's reference points."""

    value: float
    why: str


# Constants: with a reference that depends on the rows, a bad row would change the gain of all others.
REFERENCE: dict[str, ReferenceValue] = {
    "lap_s": ReferenceValue(32.0, "twice a lap of subgraph B"),
    "driven_error_mean_mm": ReferenceValue(60.0, "half the car's width of 107 mm, rounded up: the side is where the "
                                                 "centre should be"),
    "effort_per_m": ReferenceValue(50.0, "maneuvers that ignore the effort, J1 of profile default, cost 47 to 48"),
    "comfort_per_m": ReferenceValue(50.0, "as for the effort: J1 costs 48 to 49"),
}

MOST_ABOVE_LIMIT = 0.01  # of the time in zones; rows with more in some start do not keep the limits
CLEAR_EXCESS_MPS = 0.1  # kFollowerExcess_mps of vehicle_sim/campaign/zone_excess.hpp


@dataclass(frozen=True)
class Row:
    """A fixed subgraph, or a policy."""

    column: Column
    medians: dict[str, float]
    intervals: dict[str, tuple[float, float]]
    keeps_limits: bool

    @property
    def is_policy(self) -> bool:
        return self.column.policy != NO_POLICY

    @property
    def laps(self) -> int:
        return len(with_lap(self.column.runs))


def row_of(column: Column) -> Row:
    """Evaluates the column's runs."""
    laps = with_lap(column.runs)
    values = {one.key: one.values(laps) for one in QUANTITIES}
    known = {key: one if one.notna().all() else one.iloc[:0] for key, one in values.items()}
    return Row(column, {key: one.median() for key, one in known.items()},
               {key: median_interval(one) for key, one in known.items()},
               not (column.runs.clearly_above_limit_share > MOST_ABOVE_LIMIT).any())


def competition(rows: list[Row], pair: tuple[str, str], within_limits: bool) -> pd.DataFrame:
    """The rows with both values: `number` (among all rows), `not_dominated`, `is_beyond` (the reference point), and the
    hypervolumes of the row (`own`), of all fixed subgraphs (`fixed`), and of these and the row together (`with`)."""
    numbers = [i for i, row in enumerate(rows) if (row.keeps_limits or not within_limits)
               and not any(np.isnan(row.medians[key]) for key in pair)]
    points = np.array([[rows[i].medians[key] for key in pair] for i in numbers]).reshape(-1, 2)
    fixed = points[[not rows[i].is_policy for i in numbers]]
    reference = np.array([REFERENCE[key].value for key in pair])
    return pd.DataFrame({
        "number": numbers,
        "not_dominated": non_dominated(points),
        "is_beyond": (points >= reference).any(axis=1),
        "own": [hypervolume(point, reference) for point in points],
        "fixed": hypervolume(fixed, reference),
        "with": [hypervolume(np.vstack([fixed, point]), reference) for point in points],
    })


def tradeoff_markdown(runs: pd.DataFrame) -> str:
    """Medians, non-dominated rows and hypervolumes."""
    references = "; ".join(f"{NAMES[key]} {one.value:g} ({one.why})" for key, one in REFERENCE.items())
    text = (
        "# Fixed subgraphs and policies\n\nMedians over the starts with a lap and without a stuck car, in brackets "
        "their 95 % intervals from order statistics (at least 95 % for any distribution; fewer than six starts have "
        "none). Lap (planned positions) and error (driven positions to the lane's centre, mean) are those of the "
        "vehicle of highest priority, all else is of all vehicles: effort J2 and comfort of the driven maneuvers per "
        "driven metre, the largest number of generated vertices of a car in a step, processor time per plan, the share "
        "of the time in speed zones above their limit, in driven speed without tolerance, and switches of the "
        "subgraph. Hypervolumes with a policy are relative to that of the fixed subgraphs: 1 is no gain. Their "
        "reference points are fixed: "
        f"{references}. A row beyond a reference point has volume 0 there and is marked (>).\n\n")
    for scenario, profile, columns in groups_of(runs):
        rows = [row_of(column) for column in columns]
        has_zones = any(row.column.runs.above_limit_share.notna().any() for row in rows)
        text += f"## {scenario}, profile {profile}\n\n" + _medians(rows)
        if has_zones:
            text += (f"(!): does not keep the limits of the zones: in some start clearly above, by more than "
                     f"{CLEAR_EXCESS_MPS:.1f} m/s, for more than {100 * MOST_ABOVE_LIMIT:.0f} % of the time in zones."
                     f"\n\n")
        text += _uses(rows) + "### All rows\n\n" + _fronts(rows, False)
        text += "### Rows that keep the limits\n\n" + _fronts(rows, True) if has_zones else ""
    return text


def tradeoff_data(runs: pd.DataFrame) -> tuple[pd.DataFrame, pd.DataFrame]:
    """The medians with their intervals, a row per column; and dominance and hypervolumes, a row per competing row."""
    medians, fronts = [], []
    for scenario, profile, columns in groups_of(runs):
        rows = [row_of(column) for column in columns]
        headings = [dict(zip(IDENTITY, (scenario, profile, one.subgraph, one.policy))) for one in columns]
        for row, heading in zip(rows, headings):
            cells = {}
            for key in NAMES:
                cells[key] = row.medians[key]
                cells[f"{key}_low"], cells[f"{key}_high"] = row.intervals[key]
            medians.append(heading | cells | {"keeps_limits": int(row.keeps_limits), "laps": row.laps,
                                              "good_runs": _good_runs(row), "runs": len(row.column.runs)})
        for within_limits in (False, True):
            for pair in PAIRS:
                front = competition(rows, pair, within_limits)
                front = pd.DataFrame([headings[i] for i in front.number], columns=IDENTITY).join(front)
                fronts.append(front.assign(rows="within_limits" if within_limits else "all", x=pair[0], y=pair[1],
                                           reference_x=REFERENCE[pair[0]].value, reference_y=REFERENCE[pair[1]].value))
    return pd.DataFrame(medians), pd.concat(fronts).drop(columns="number")


def _good_runs(row: Row) -> int:
    return int((row.column.runs.outcome != FAILED).sum())


def _medians(rows: list[Row]) -> str:
    body = []
    for row in rows:
        cells = [row.column.name + ("" if row.keeps_limits else " (!)")]
        for one in QUANTITIES:
            low, high = row.intervals[one.key]
            bounds = "" if np.isnan(low) else f" [{low:.{one.decimals}f} … {high:.{one.decimals}f}]"
            cells.append(markdown.number(row.medians[one.key], one.decimals) + bounds)
        body.append(cells + [row.laps, f"{_good_runs(row)} / {len(row.column.runs)}"])
    return markdown.table(["", *NAMES.values(), "laps", "runs that count / all"], body)


def _uses(rows: list[Row]) -> str:
    """Means over the runs with a lap."""
    text = ""
    for row in rows:
        if not row.is_policy or row.laps == 0:
            continue
        shares = with_lap(row.column.runs).filter(regex="^" + SHARE.replace(".", "[.]")).fillna(0.0).mean()
        shares = shares[shares > 0.0].sort_index().sort_values(ascending=False, kind="stable")
        uses = (f"{name.removeprefix(SHARE)} {100 * share:.1f} %" for name, share in shares.items())
        text += f"* {row.column.name}: " + "; ".join(uses) + "\n"
    return f"Shares of the steps, by what was planned on:\n\n{text}\n" if text else ""


def _fronts(rows: list[Row], within_limits: bool) -> str:
    policies = [i for i, row in enumerate(rows) if row.is_policy]
    titles = ["", "not dominated", "(>) beyond the reference point", "hypervolume of the fixed"]
    titles += [f"with {rows[i].column.name}" for i in policies]
    body = []
    for pair in PAIRS:
        front = competition(rows, pair, within_limits).set_index("number")
        cells = [", ".join(NAMES[key] for key in pair)]
        cells += [", ".join(rows[i].column.name for i in front.index[front[flag]]) or "-"
                  for flag in ("not_dominated", "is_beyond")]
        fixed = front.fixed.iloc[0] if len(front) else np.nan
        cells.append(markdown.number(fixed, 3))
        for i in policies:
            if i not in front.index:
                cells.append("-")
                continue
            volume = front.at[i, "with"]
            text = f"{volume / fixed:.3f}" if fixed > 0.0 else f"{volume:.3f} (of none)"
            cells.append(text + (" (>)" if front.at[i, "is_beyond"] else ""))
        body.append(cells)
    return markdown.table(titles, body)
