"""Columns of runs.csv and cars.csv; the meaning of each: vehicle_sim/campaign/run_figures.hpp."""

IDENTITY = ("scenario", "profile", "subgraph", "policy")

# Absent where there is nothing to measure: no lap, no speed zone, a criterion without known costs.
OPTIONAL = (
    "lap_s", "error_mean_mm", "error_std_mm", "driven_error_mean_mm", "driven_error_std_mm", "effort_per_m",
    "comfort_per_m", "above_limit_share", "clearly_above_limit_share", "above_limit_max_mps",
)
# Every run that counts has these.
REQUIRED = (
    "generated_max", "generated_sum_max", "expanded_max", "expanded_sum_max", "deviation_max_mm", "longest_wait_s",
    "fallback_steps", "collisions", "switches", "stuck_vehicles",
)
# Of a campaign only, because a sweep does not measure times.
MEASURED = (
    "planning_mean_ms", "planning_std_ms", "planning_max_ms", "exceeding_step_share", "step_p99_ms", "step_max_ms",
    "wall_s", "wall_planning_s", "wall_coordination_s", "wall_vehicles_s",
)
SHARE = "share."  # then the name of a subgraph
SETTING = "set."  # then the name of a setting of a sweep

CAR_NUMBERS = (
    "lap_s", "error_mean_mm", "error_std_mm", "driven_error_mean_mm", "driven_error_std_mm", "tracking_error_mean_mm",
    "generated_mean", "generated_max", "expanded_mean", "expanded_max", "planning_mean_ms", "planning_max_ms",
    "fallback_steps", "deadline_misses", "longest_wait_s",
)
