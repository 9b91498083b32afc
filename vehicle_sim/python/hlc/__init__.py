"""Plan and simulate model-scale cars: motion primitive automata, receding-horizon search, priorities.

    import hlc
    run = hlc.drive(hlc.load_scenario("paper_three_cars"))
    print(run.trace_sha256, run.planned.shape)

Lengths are in m, angles in rad, times in s, unless a name ends in another unit. Poses are (x, y, heading) in the frame
of the scenario's map. What is refused, or cannot be read, raises `Error`, a ValueError whose one line names the file,
the key, its value and what is allowed.
"""

from hlc._core import Error
from hlc.automata import Automaton, Maneuver, load_automaton
from hlc.files import data_folder, scenario_names
from hlc.learning import Environments, ParallelEnv, StepResult
from hlc.pareto import Cost, Front, criteria, pareto_front
from hlc.plots import plot_front, plot_paths, plot_plan, plot_ways
from hlc.problems import JointPlan, Plan, plan_joint_problem, plan_problem
from hlc.runs import FORK_CHANGES, Fork, Run, drive, replay, rollout
from hlc.scenarios import PriorityRule, Scenario, Situation, Vehicle, load_scenario

__all__ = [
    "Automaton", "Cost", "Environments", "Error", "FORK_CHANGES", "Fork", "Front", "JointPlan", "Maneuver",
    "ParallelEnv", "Plan", "PriorityRule", "Run", "Scenario", "Situation", "StepResult", "Vehicle", "criteria",
    "data_folder", "drive", "load_automaton", "load_scenario", "pareto_front", "plan_joint_problem", "plan_problem",
    "plot_front", "plot_paths", "plot_plan", "plot_ways", "replay", "rollout", "scenario_names",
]
