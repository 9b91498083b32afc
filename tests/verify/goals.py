"""Do the driven cars solve the planning problems of their run's map? By CommonRoad's reader.

A vehicle `problem 7` drives planning problem 7 of the map's file.
"""

import numpy as np
from commonroad.common.file_reader import CommonRoadFileReader
from commonroad.planning.planning_problem import PlanningProblem
from commonroad.scenario.state import CustomState
from run import Finding, Run, State, states

START_M = 0.051  # way_to_goal.hpp, and the first 10 ms


def reached_at(problem: PlanningProblem, motion: list[State], every: int) -> int | None:
    """Number of the first of the problem's time steps in which the goal is reached."""
    for step, s in enumerate(motion[::every]):
        state = CustomState(
            time_step=step,
            position=np.array([s.x_m, s.y_m]),
            orientation=s.heading_rad,
            velocity=s.speed_mps,
        )
        if problem.goal.is_reached(state):
            return step
    return None


def check_vehicle(
    problem: PlanningProblem, motion: list[State], every: int
) -> tuple[list[str], int | None]:
    faults = []
    start = problem.initial_state.position
    off_m = ((motion[0].x_m - start[0]) ** 2 + (motion[0].y_m - start[1]) ** 2) ** 0.5
    if off_m > START_M:
        faults.append(f"starts {off_m:.3f} m off the initial state")
    step = reached_at(problem, motion, every)
    if step is None:
        faults.append("never reaches the goal")
    if step == 0:
        faults.append("is in the goal from the start, so that nothing is checked")
    return faults, step


def check_goals(run: Run) -> tuple[list[Finding], str]:
    problem_of = {
        vehicle: int(name.removeprefix("problem "))
        for vehicle, name in run.configuration.name_of.items()
        if name.startswith("problem ")
    }
    if not problem_of:
        return [], "the scenario has no planning problems"
    scenario, problems = CommonRoadFileReader(str(run.configuration.map_file)).open()
    every = round(scenario.dt / run.scenario.dt)
    findings, at_s = [], []
    for vehicle, number in problem_of.items():
        problem = problems.find_planning_problem_by_id(number)
        faults, step = check_vehicle(problem, states(run.driven[vehicle]), every)
        text = f"vehicle {vehicle}, planning problem {number}: "
        findings += [Finding("goals", text + fault) for fault in faults]
        at_s.append(f"{(step or 0) * scenario.dt:.1f}")
    return findings, f"{len(problem_of)} planning problems solved, at {', '.join(at_s)} s"
