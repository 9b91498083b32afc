#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/messages/death.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/geometry/footprint.hpp"
#include "planner/policy/policy_settings.hpp"
#include "planner/right_of_way/conflict_map.hpp"
#include "planner/road/reference_path.hpp"

/// The records of a run as plain data; `hlc_bridge/record` reads and writes the files.
namespace hlc::result {

struct VehicleDescription {
  VehicleId id;
  std::string name;
  std::optional<road::ReferencePath>
      route;            ///< centre line; none without lanes, or if a fork changed it
  Footprint footprint;  ///< without margin
};

/// Something that is no vehicle, and stands in the run from a step on.
struct Obstacle {
  std::string name;      ///< the scenario's; empty: a fork added it
  std::uint64_t from{};  ///< step, from 0: k - k0
  ConvexPolygon area_m;
};

/// What was driven: the scenario, as needed for the result.
struct RunDescription {
  std::string scenario;
  std::string profile;
  std::string engine;                  ///< of the search
  std::string priorities{"constant"};  ///< name of the strategy
  std::string map;
  std::optional<std::uint64_t> noise_seed;  ///< none: the cars measured exactly
  std::string subgraph;
  std::string policy{policy::kNoPolicy};  ///< by which the controllers changed it
  bool has_two_rounds{};                  ///< controller::Rounds::kTwo
  std::size_t horizon_steps{};
  double step_s{};
  std::vector<VehicleDescription> vehicles;
  std::vector<Obstacle> obstacles;
  std::vector<VehicleDescription> guests;  ///< without routes
  /// LabLimits::tracking_error_max_m of the scenario's lab; 0: not known.
  double tracking_error_max_m{};
  /// The automaton of the plans: gives the planned poses between steps. None: only those at the
  /// steps.
  std::shared_ptr<const automaton::Subgraph> automaton;
  /// Of the routes of coordination::HeldRoad. None: no right of way.
  std::shared_ptr<const right_of_way::ConflictMap> conflicts;
};

/// How the run went, as observed by the lab control.
struct RunFacts {
  bool simulated_time{};
  std::vector<std::uint8_t> vehicle_ids;
  Nanoseconds period{};
  std::uint64_t steps{};                    ///< requested
  std::optional<std::uint64_t> first_step;  ///< k0; none if no controller started
  double wall_s{};                          ///< from the first trigger to the last answer
  double clock_s{};                         ///< time of the run in that span
  int exit_code{};
  std::string reason;  ///< one line; empty: no fault
  std::vector<Death> died;
};

/// A vehicle's true state at a tick.
struct DrivenSample {
  Nanoseconds t{};
  Pose pose;  ///< heading_rad is the yaw
  double speed_mps{};
  double throttle{};
  double steering{};
  Nanoseconds command_create{};  ///< create_stamp of the command being followed; 0: none
};

/// Everything recorded by one vehicle's process, by increasing time.
using Drive = std::vector<DrivenSample>;
using Drives = std::map<std::uint8_t, Drive>;

/// One vehicle in one step of the experiment.
struct StepRecord {
  std::uint64_t step{};                      ///< from 0: k - k0
  ReportRecord record;                       ///< of step k
  std::optional<Pose> driven;                ///< at t(k); none if it was not recorded
  std::optional<double> driven_speed_mps{};  ///< the same
  double t_s{};                              ///< t(k) since t(k0)
};

/// A line that a process of the run logged.
struct LoggedLine {
  std::string process;  ///< name of its log
  std::string stamp;    ///< local wall time, "2026-01-31 23:59:59.999"; empty: a line without
  std::string level;    ///< as logged: info, warning, error; empty: a line without
  std::string text;
  std::optional<double> run_s;  ///< the same time from t(0) of the run on; in real time only
};

/// The first step with a report other than standby; nothing if no vehicle started.
[[nodiscard]] std::optional<std::uint64_t> first_step_of(std::span<const ReportRecord> reports);

/// Pose at `t`: the sample of that time, else linear between its neighbours if they are not farther
/// apart than 0.1 s (yaw along the shorter arc), else nothing. @pre samples by increasing time
[[nodiscard]] std::optional<Pose> driven_pose_at(std::span<const DrivenSample> drive,
                                                 Nanoseconds t);
/// Speed at `t`, likewise [m/s].
[[nodiscard]] std::optional<double> driven_speed_mps_at(std::span<const DrivenSample> drive,
                                                        Nanoseconds t);

/// The reported steps among 0 ... steps - 1, by step, then vehicle; the last report of a step
/// counts. Empty if no vehicle started.
[[nodiscard]] std::vector<StepRecord> step_records(std::span<const ReportRecord> reports,
                                                   const Drives& drives, const RunFacts& facts);

/// Those of the steps before this one. @pre rows by step
[[nodiscard]] std::span<const StepRecord> rows_before(std::span<const StepRecord> rows,
                                                      std::uint64_t step);

}  // namespace hlc::result
