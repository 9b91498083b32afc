"""The paper's Table 2 and the quantities of our runs beside it. Source: paper, Table 2."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

SIMULATION = "paper_three_cars"  # the scenario of the paper's simulation
LAB = "paper_red_alone"  # and of its lab


@dataclass(frozen=True)
class Quantity:
    """A row of a table."""

    name: str  # with its unit
    key: str  # its column, and its name in comma-separated values
    decimals: int
    simulation: dict[str, float] = field(default_factory=dict)  # the paper's values by subgraph
    lab: dict[str, float] = field(default_factory=dict)
    depends_on_machine: bool = False
    of: Callable[[pd.DataFrame], pd.Series] | None = None  # absent: the column itself

    def values(self, runs: pd.DataFrame) -> pd.Series:
        """Ours, a value per run."""
        return runs[self.key] if self.of is None else self.of(runs)

    def paper(self, scenario: str, subgraph: str) -> float:
        """NaN where the paper has none. @param scenario: SIMULATION or LAB"""
        return self._values(scenario).get(subgraph, np.nan)

    def is_compared_in(self, scenario: str) -> bool:
        """Whether the paper has it for as many cars: its vertices are one car's in the lab, three cars' in simulation."""
        return bool(self._values(scenario))

    def _values(self, scenario: str) -> dict[str, float]:
        return {SIMULATION: self.simulation, LAB: self.lab}[scenario]


def _by_subgraph(*values: float) -> dict[str, float]:
    """Of A to D, or of B to D."""
    return dict(zip("ABCD"[-len(values):], values))


def _share_of_wall(part: str) -> Callable[[pd.DataFrame], pd.Series]:
    """[%]"""
    return lambda runs: 100.0 * runs[part] / runs.wall_s.where(runs.wall_s > 0.0)


# Error and lap are those of the car of highest priority, as in the paper. The paper counts the vertices of one car in
# the lab, and the sum of three cars in its simulation.
QUANTITIES: tuple[Quantity, ...] = (
    Quantity("Reference error of planned positions, mean [mm]", "error_mean_mm", 1,
             _by_subgraph(40.1, 30.7, 30.8, 19.4), _by_subgraph(27.9, 19.9, 17.0)),
    Quantity("Reference error of planned positions, standard deviation [mm]", "error_std_mm", 1,
             _by_subgraph(35.9, 28.9, 28.8, 17.6), _by_subgraph(30.5, 23.7, 16.1)),
    Quantity("Reference error of driven positions, mean [mm]", "driven_error_mean_mm", 1),
    Quantity("Reference error of driven positions, standard deviation [mm]", "driven_error_std_mm", 1),
    Quantity("Time for one lap [s]", "lap_s", 2,
             _by_subgraph(13.8, 15.8, 15.8, 16.2), _by_subgraph(15.8, 16.0, 16.0)),
    Quantity("Max. generated vertices, one car", "generated_max", 0, lab=_by_subgraph(430.0, 322.0, 291.0)),
    Quantity("Max. generated vertices, sum of the cars of a step", "generated_sum_max", 0,
             simulation=_by_subgraph(159114.0, 1966.0, 1969.0, 879.0)),
    Quantity("Max. expanded vertices, one car", "expanded_max", 0),
    Quantity("Max. expanded vertices, sum of the cars of a step", "expanded_sum_max", 0),
    Quantity("Computation time, mean [ms]", "planning_mean_ms", 3,
             _by_subgraph(9738.3, 125.0, 166.5, 138.4), _by_subgraph(12.4, 11.8, 10.2), True),
    Quantity("Computation time, standard deviation [ms]", "planning_std_ms", 3,
             _by_subgraph(5228.1, 67.5, 80.1, 71.2), _by_subgraph(3.8, 3.1, 3.3), True),
    Quantity("Max. computation time [ms]", "planning_max_ms", 3,
             _by_subgraph(28436.7, 600.9, 570.7, 654.4), _by_subgraph(32.3, 24.5, 32.8), True),
    Quantity("Plans that took longer than a step [%]", "exceeding_step_percent", 2,
             of=lambda runs: 100.0 * runs.exceeding_step_share),
    Quantity("Computation time of a step of all cars, 99 % [ms]", "step_p99_ms", 2),
    Quantity("Max. computation time of a step of all cars [ms]", "step_max_ms", 2),
    Quantity("Longest wait for other cars [s]", "longest_wait_s", 1),
    Quantity("Fallback steps", "fallback_steps", 0),
    Quantity("Collisions", "collisions", 0),
    Quantity("Largest deviation from the plan [mm]", "deviation_max_mm", 1),
    Quantity("Effort J2 per driven metre, all cars", "effort_per_m", 3),
    Quantity("Criterion comfort per driven metre, all cars", "comfort_per_m", 3),
    Quantity("Wall time of the whole run [ms]", "wall_ms", 1, of=lambda runs: 1e3 * runs.wall_s),
    Quantity("- in planning [%]", "wall_planning_percent", 1, of=_share_of_wall("wall_planning_s")),
    Quantity("- in coordination [%]", "wall_coordination_percent", 1, of=_share_of_wall("wall_coordination_s")),
    Quantity("- in the simulated vehicles [%]", "wall_vehicles_percent", 1, of=_share_of_wall("wall_vehicles_s")),
)


def compared_cells() -> pd.DataFrame:
    """The cells that do not depend on the machine: scenario, subgraph, quantity, paper.

    The paper has subgraph A with three cars only. Its error and lap there are also compared with a red car alone, which
    is of highest priority: the others do not slow it down.
    """
    cells = [(scenario, subgraph, one.key, one.paper(scenario, subgraph))
             for scenario in (SIMULATION, LAB) for subgraph in "ABCD"
             for one in QUANTITIES if not one.depends_on_machine]
    cells += [(LAB, "A", one.key, one.paper(SIMULATION, "A"))
              for one in QUANTITIES if one.key in ("error_mean_mm", "error_std_mm", "lap_s")]
    return pd.DataFrame(cells, columns=["scenario", "subgraph", "quantity", "paper"]).dropna(ignore_index=True)
