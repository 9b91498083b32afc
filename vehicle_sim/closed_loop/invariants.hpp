#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/machine/log_line.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "planner/coordination/messages.hpp"
#include "planner/coordination/plan.hpp"
#include "planner/geometry/footprint.hpp"
#include "planner/geometry/pose.hpp"
#include "vehicle_sim/closed_loop/standing_areas.hpp"
#include "vehicle_sim/closed_loop/violation.hpp"

/// Invariants of a run under any faults, each as a small checker that is notified of events.
namespace hlc::closed_loop {

/// Driven footprints (without margin) never touch, nor any obstacle.
///
/// Poses of one instant are compared: a tick is checked once every vehicle has driven it. A vehicle
/// that has not begun stands at its start, one that has ended stands at its last pose.
class FootprintsCheck {
 public:
  FootprintsCheck(const Footprint& footprint, const std::map<std::uint8_t, Pose>& starts,
                  std::vector<ConvexPolygon> obstacles_m = {});

  /// @param tick           number of the vehicles' tick
  /// @param is_unreachable  no controller can be held responsible for where the vehicle is
  void driven(std::uint8_t vehicle, std::uint64_t tick, const Pose& pose,
              bool is_unreachable = false);
  /// Its process has ended, and it stands.
  void ended(std::uint8_t vehicle) { cars_.at(vehicle).has_ended = true; }
  /// It stands at once, wherever it is: for so long no controller can be held responsible.
  void died(std::uint8_t vehicle, std::uint64_t unreachable_ticks);
  void came_back(std::uint8_t vehicle) { cars_.at(vehicle).has_ended = false; }
  /// Checks the ticks that all have driven by now.
  void check(Nanoseconds at, Violations& violations);
  /// Smallest distance so far [m].
  [[nodiscard]] double smallest_distance_m() const { return smallest_distance_m_; }

 private:
  struct Car {
    Pose start;
    std::uint64_t first{};        ///< tick of poses[0]
    std::vector<Pose> poses;      ///< of the ticks since then
    std::uint64_t exempt_from{};  ///< ticks for which no controller is responsible; the last ones
    std::uint64_t exempt_until{};
    bool has_ended{};
    [[nodiscard]] std::uint64_t end() const { return first + poses.size(); }
    [[nodiscard]] const Pose& at(std::uint64_t tick) const;
    void exempt(std::uint64_t from, std::uint64_t until);
    [[nodiscard]] bool is_exempt(std::uint64_t tick) const {
      return tick >= exempt_from && tick < exempt_until;
    }
  };
  using Cars = std::map<std::uint8_t, Car>;

  /// The tick before which every vehicle that drives has driven; 0 if none does.
  [[nodiscard]] std::uint64_t all_driven_until() const;
  [[nodiscard]] bool touches_first_time(const Cars::value_type& a, const Cars::value_type& b,
                                        std::uint64_t tick);
  [[nodiscard]] bool touches_obstacle_first_time(const Cars::value_type& one, std::uint64_t tick);

  Footprint footprint_;
  double circumradius_m_;
  Cars cars_;
  std::optional<std::uint64_t> next_;  ///< next tick to check
  std::set<std::pair<std::uint8_t, std::uint8_t>> touched_;
  std::vector<ConvexPolygon> obstacles_m_;
  std::set<std::uint8_t> touched_obstacle_;
  double smallest_distance_m_{1e9};
};

/// The plan to stand where the vehicle stands: no other vehicle has agreed to it.
[[nodiscard]] inline bool is_anchored(const coordination::Plan& plan) {
  return plan.first() == plan.end();
}

/// Plans in force are free of each other pair by pair, until both stand, whenever one of them
/// changes. A plan is given by the areas that its vehicle has announced (Prediction::areas, with
/// margin and predicted drift), since the others keep clear of these: the areas of the current step
/// have been announced before. Two final areas may overlap by coordination::kSeparationTolerance_m:
/// the last area of a horizon contains the final one except for 2 um (Plan::areas_from), of which
/// no vehicle keeps clear. A plan comes into force with a report `planned`, and stays when its
/// controller is gone, until the next controller is on standby: its vehicle has then been seen
/// standing for a horizon.
///
/// No area of a new plan meets an obstacle that is no vehicle, the final one included, by more than
/// that tolerance; of each vehicle the first is reported.
///
/// A vehicle whose plan has run out stands; it is enough to be free of where it truly does.
///
/// A vehicle without a report for horizon + 1 + kSilentSteps steps has finished every plan that it
/// can have agreed to, and is a standing obstacle for the others (stands_for_good in missing.hpp).
///
/// A vehicle that was pushed off its plan, or is not seen (FallbackReason::kDeviation), drives
/// areas that no other vehicle agreed to (rule 4 of plan_in_force.hpp): it is ignored until its
/// next new plan. So is one whose plan has been anchored where it stands, and, while its controller
/// is silent, one that has never received its plan: the others keep clear of all that it can reach
/// from where they see it, not of a plan that it does not drive.
class PlansCheck {
 public:
  /// @param standing  of the vehicles whose plan has run out; nullptr: only their plans count
  explicit PlansCheck(std::size_t horizon_steps, const StandingAreas* standing = nullptr,
                      std::vector<ConvexPolygon> obstacles_m = {})
      : horizon_steps_(horizon_steps), standing_(standing), obstacles_m_(std::move(obstacles_m)) {}

  void predicted(const coordination::Prediction& prediction) {
    predicted_[prediction.vehicle] = prediction;
  }
  void published(const coordination::Traffic& traffic);
  void reported(const coordination::Report& report, const coordination::Plan* in_force,
                Nanoseconds at, Violations& violations);
  /// Whether the vehicle has received its plan in force.
  void received(VehicleId vehicle, bool is_received) {
    const auto found = in_force_.find(vehicle);
    if (found != in_force_.end()) found->second.is_received = is_received;
  }

 private:
  using Pair = std::pair<VehicleId, VehicleId>;

  struct InForce {
    coordination::OccupiedAreas areas;
    StepIndex last_report;
    bool is_received{true};
  };
  [[nodiscard]] bool meet(const coordination::OccupiedAreas& areas, VehicleId other,
                          const InForce& plan, StepIndex now) const;
  [[nodiscard]] bool is_relied_on(const InForce& plan, StepIndex now) const;
  [[nodiscard]] bool meets_obstacle(const coordination::OccupiedAreas& areas) const;

  std::size_t horizon_steps_;
  const StandingAreas* standing_;
  std::vector<ConvexPolygon> obstacles_m_;
  std::set<VehicleId> met_obstacle_;
  std::map<VehicleId, coordination::Prediction> predicted_;
  std::map<VehicleId, InForce> in_force_;
  std::set<Pair> met_;
};

/// A process that stops has logged the reason: one that ends with an exit code of failure, in a
/// warning or an error of its log; a vehicle that no longer follows a command, in a line of its
/// log. A report of a fallback that only others cause (kMissing, kNeighbour) names them; a conflict
/// may be due to the vehicle's own drift (controller/blocked_by.hpp).
class ReasonsCheck {
 public:
  void started(const std::string& process) { lines_[process] = {}; }
  void log(const std::string& process, const machine::LogLine& line, Nanoseconds at);
  /// One tick of a vehicle.
  void driven(const std::string& vehicle, bool follows, Nanoseconds at);
  void ended(const std::string& process, int exit_code, Nanoseconds at, Violations& violations);
  static void reported(const coordination::Report& report, Nanoseconds at, Violations& violations);
  /// To be called between two iterations, so that lines of an iteration are known when its ticks
  /// are checked.
  void check(Nanoseconds at, Violations& violations);

 private:
  struct Lines {
    bool has_complained{};  ///< in a warning or an error
    std::optional<Nanoseconds> last;
    bool follows{};
    std::optional<Nanoseconds> stopped;  ///< and has not been checked yet
  };
  std::map<std::string, Lines> lines_;
};

/// Within 5 s after the last fault every vehicle that can plan has a new plan. Exempt are:
/// processes that have ended, a search without a solution (kInfeasible, kBudget), a vehicle that
/// fits no route (kOffRoute) or makes a minimal-risk stop; and a vehicle whose plan meets another
/// one (kConflict): it has received all messages and is blocked, as cars on a circle that all drive
/// through its centre are without any fault. Checked is that no vehicle is missing, late, not seen,
/// or silent.
class PlanningCheck {
 public:
  static constexpr Nanoseconds kPatience = 5 * kNanosecondsPerSecond;

  /// @param calm_from  end of the last fault, true time since the begin of the run
  explicit PlanningCheck(Nanoseconds calm_from) : calm_from_(calm_from) {}

  void report(const ReportRecord& record, Nanoseconds at);
  [[nodiscard]] bool is_on_standby(std::uint8_t vehicle) const {
    return standby_.contains(vehicle);
  }
  /// To be called at calm_from + kPatience.
  /// @param able  vehicles whose processes are all there
  void check(const std::vector<std::uint8_t>& able, Nanoseconds at, Violations& violations) const;

 private:
  Nanoseconds calm_from_;
  std::map<std::uint8_t, std::string> last_;  ///< what it reported last
  std::set<std::uint8_t> standby_;            ///< in its last report
  std::map<std::uint8_t, bool> plans_;
};

}  // namespace hlc::closed_loop
