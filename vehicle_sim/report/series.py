"""The series of a campaign's runs: OUT/series, which `evaluate --series` writes.

Columns: vehicle_sim/campaign/run_series.hpp; places.json: planner/plot/scenario_data.hpp and
vehicle_sim/apps/evaluation_series.hpp.
"""

import json
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from .errors import InputError

NO_POLICY = "none"
TEXTS = ("scenario", "profile", "subgraph", "policy", "name", "planned_on", "pair")
TRUTHS = ("searched", "is_stuck")
COLUMNS = {
    "steps": ("run", "scenario", "profile", "subgraph", "policy", "start", "vehicle", "name", "step", "time_s",
              "planned_on", "generated", "expanded", "searched", "planning_ms", "arc_length_m", "error_mm", "is_stuck"),
    "drives": ("run", "vehicle", "time_s", "x_m", "y_m", "yaw_rad", "speed_mps", "zone_limit_mps"),
    "distances": ("run", "first", "second", "pair", "time_s", "distance_m", "kept_m"),
}


@dataclass(frozen=True)
class Run:
    """A run of which series are known."""

    number: int
    subgraph: str
    policy: str
    start: int
    fault: str  # why it does not count; empty: it does

    @property
    def label(self) -> str:
        """What it planned on: "subgraph B", "policy zone"."""
        return f"subgraph {self.subgraph}" if self.policy == NO_POLICY else f"policy {self.policy}"


@dataclass(frozen=True)
class Group:
    """The runs of one scenario and profile, which one figure shows."""

    scenario: str
    profile: str
    place: dict  # of places.json
    runs: list[Run]  # of the scenario's own start
    others: list[Run]  # of other starts
    steps: pd.DataFrame
    drives: pd.DataFrame
    distances: pd.DataFrame

    @property
    def cars(self) -> list[tuple[int, str]]:
        """Ids and names, by priority."""
        return [(car["id"], car["name"]) for car in self.place["vehicles"]]

    @property
    def first(self) -> dict:
        """The car of highest priority, of which the paper shows path and error."""
        return self.place["vehicles"][0]

    def other_starts(self, run: Run) -> list[Run]:
        """The runs that differ from this one in their start only."""
        return [other for other in self.others if (other.subgraph, other.policy) == (run.subgraph, run.policy)]

    def steps_of(self, run: Run, vehicle: int) -> pd.DataFrame:
        """The steps of a car, by time."""
        return self.steps[(self.steps["run"] == run.number) & (self.steps["vehicle"] == vehicle)]

    def drive_of(self, run: Run, vehicle: int) -> pd.DataFrame:
        """The ticks of a car, by time."""
        return self.drives[(self.drives["run"] == run.number) & (self.drives["vehicle"] == vehicle)]

    def ends_stuck(self, run: Run, vehicle: int) -> bool:
        """True if the car stands in gridlock as the run ends."""
        own = self.steps_of(run, vehicle)
        return bool(len(own) and own["is_stuck"].iloc[-1])


def read_table(file: Path, columns: tuple[str, ...]) -> pd.DataFrame:
    """A CSV file of the series. Raises InputError in one line."""
    try:
        texts = {name: str for name in TEXTS + TRUTHS if name in columns}
        table = pd.read_csv(file, dtype=texts, keep_default_na=False, na_values={
            name: [""] for name in columns if name not in texts})
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}, must be a file of evaluate --series") from error
    except (ValueError, pd.errors.ParserError) as error:
        raise InputError(f"{file}: {str(error).splitlines()[0]}, must be comma separated rows") from error
    if missing := [name for name in columns if name not in table.columns]:
        raise InputError(f"{file}: column {missing[0]} is missing, must have {', '.join(columns)}")
    for name in columns:
        if name in TRUTHS:
            check_values(file, name, table[name], ~table[name].isin(("true", "false")), "true or false")
            table[name] = table[name] == "true"
        elif name not in texts:
            numbers = pd.to_numeric(table[name], errors="coerce")
            check_values(file, name, table[name], numbers.isna() & table[name].notna(), "a number")
            table[name] = numbers
    return table


def check_values(file: Path, column: str, values: pd.Series, is_wrong: pd.Series, allowed: str) -> None:
    """Raises InputError that names the first wrong value."""
    if is_wrong.any():
        row = int(is_wrong.to_numpy().argmax())
        raise InputError(f"{file}:{row + 2}: {column} = {values.iloc[row]}, must be {allowed}")


def read_places(file: Path) -> dict:
    """The scenarios and runs of places.json. Raises InputError in one line."""
    try:
        places = json.loads(file.read_text(encoding="utf-8"))
        for run in places["runs"]:
            _ = [run[key] for key in ("run", "scenario", "profile", "subgraph", "policy", "start", "fault")]
        for place in places["scenarios"]:
            _ = [place[key] for key in ("scenario", "step_s", "lanelets", "footprint", "vehicles", "zones")]
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}, must be a file of evaluate --series") from error
    except (ValueError, TypeError) as error:
        raise InputError(f"{file}: {error}, must be an object with scenarios and runs") from error
    except KeyError as error:
        raise InputError(f"{file}: {error.args[0]} is missing, must be a file of evaluate --series") from error
    return places


def read_series(folder: Path) -> list[Group]:
    """The groups of a folder `series`, in the order of the campaign. Raises InputError in one line."""
    places = read_places(folder / "places.json")
    tables = {name: read_table(folder / f"{name}.csv", columns) for name, columns in COLUMNS.items()}
    by_name = {place["scenario"]: place for place in places["scenarios"]}
    members: dict[tuple[str, str], list[Run]] = {}
    for run in places["runs"]:
        members.setdefault((run["scenario"], run["profile"]), []).append(
            Run(run["run"], run["subgraph"], run["policy"], run["start"], run["fault"]))
    groups = []
    for (scenario, profile), runs in members.items():
        numbers = [run.number for run in runs]
        own = {name: table[table["run"].isin(numbers)] for name, table in tables.items()}
        groups.append(Group(scenario, profile, by_name[scenario], [run for run in runs if run.start == 0],
                            [run for run in runs if run.start != 0], **own))
    return groups
