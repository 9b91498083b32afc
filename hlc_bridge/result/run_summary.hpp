#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/result/guest_encounters.hpp"
#include "hlc_bridge/result/run_record.hpp"
#include "hlc_bridge/result/statistics.hpp"
#include "hlc_bridge/result/waits.hpp"
#include "planner/coordination/joint_gap.hpp"

namespace hlc::result {

inline constexpr double kMillimetresPerMetre = 1e3;  ///< for people; a summary's lengths are in m

struct VehicleSummary {
  VehicleId id;
  std::string name;
  std::size_t steps{};  ///< reported ones; fewer than requested if the vehicle's controller died
  /// Planned positions along the route, from step 1 on: the plan of step 0 is driven from then on,
  /// and until then the vehicle stands, whatever it plans. So the lap compares with the authors'
  /// simulation, whose plans are driven at once. Closed routes only.
  std::optional<double> lap_s;
  /// When it came to stand at its goal, where it is in its last step; from step 0 on.
  std::optional<double> arrived_s;
  std::optional<Statistics> reference_error_m;  ///< planned positions to the route's centre line
  /// Positions driven at the steps' times to the same line.
  std::optional<Statistics> driven_error_m;
  std::optional<Statistics> tracking_error_m;  ///< driven to planned position, at every tick
  std::optional<Statistics> driven_speed_mps;  ///< at the steps' times
  std::optional<Statistics> plan_cost_m2;      ///< of the steps in which a plan was found
  /// Largest footprint_deviation_m at any tick. Excluded are steps near the steering limit, and
  /// those after them until the vehicle is back: their areas hold the drift
  /// (planner/controller/drift.hpp), and the controller reports a vehicle that leaves them.
  std::optional<double> deviation_max_m;
  std::size_t steps_outside_announced_area{};  ///< steps in which the controller found its vehicle
                                               ///< outside its areas
  std::optional<Statistics> generated;         ///< vertices per step in which the vehicle planned
  std::optional<Statistics> expanded;
  std::optional<Statistics> planning_s;  ///< of those steps
  std::size_t plans_exceeding_step{};    ///< steps whose search alone took longer than a step
  /// Of the steps in which a plan was found, the share in which the search stopped at its budget.
  std::optional<double> budget_share;
  std::size_t fallback_steps{};
  std::size_t undrivable_steps{};  ///< steps whose new plan or command was beyond the lab's limits
  std::size_t deadline_misses{};   ///< late, or (real time) without a report: list not answered
  std::optional<Wait> wait;        ///< the longest; none: it never waited
  bool is_stuck{};                 ///< in its last step (planner/coordination/waiting.hpp)
};

struct Host {
  std::string cpu;
  unsigned cores{};
  std::string kernel;
};

/// The result of a run (keys of summary.json).
struct RunSummary {
  RunDescription description;
  std::size_t steps{};                       ///< steps of the experiment that any vehicle reported
  std::vector<VehicleSummary> vehicles;      ///< in the scenario's order
  std::size_t generated_vertices_sum_max{};  ///< largest sum over all vehicles in one step
  std::size_t expanded_vertices_sum_max{};
  std::optional<coordination::JointGapFigures> joint_gap;  ///< none: no gap is known
  std::optional<double> min_footprint_distance_m;          ///< driven; none with one vehicle
  std::optional<double> min_obstacle_distance_m;           ///< the same; none without obstacles
  GuestEncounters with_guests;
  /// Of vehicles, with obstacles, and of moving vehicles with guests.
  std::size_t collisions{};
  double wall_s{};
  double realtime_factor{};  ///< time of the run / wall_s
  /// From the list's t_now until the command (ReportRecord::response_ns), over all vehicles and
  /// steps; none in logical time.
  std::optional<Statistics> response_s;
  std::string trace_sha256;
  std::string revision;
  Host host;
};

/// Evaluates a run's records. A vehicle plans in steps with status planned or fallback; the other
/// steps do not count for vertices and planning time. Driven footprints are checked from t(k0) to
/// the end of the last step. The plan in force during step k is the maneuver named in report k,
/// from its planned pose on (maneuver_during); if that is not known, only the pose at t(k) counts,
/// and nothing as long as there is no plan.
/// @param rows  of step_records()
[[nodiscard]] RunSummary summarize(const RunDescription& description, const RunFacts& facts,
                                   std::span<const StepRecord> rows, const Drives& drives);

}  // namespace hlc::result
