#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/result/run_record.hpp"
#include "vehicle_sim/closed_loop/announced_check.hpp"
#include "vehicle_sim/closed_loop/driven_plans.hpp"
#include "vehicle_sim/closed_loop/invariants.hpp"
#include "vehicle_sim/closed_loop/simulated_lab.hpp"

namespace hlc::closed_loop {

/// Receives a line for each event of a run. @param at  true time since the begin of the run
using Trace = std::function<void(Nanoseconds at, const std::string& line)>;

/// What the run's processes record, as far as controllers can be held responsible for it.
struct FaultRecords {
  std::vector<ReportRecord> reports;
  /// By true time. Without the ticks in which a vehicle is out of reach (DrivenPlans), not seen
  /// since (AnnouncedCheck), or braking after the stop symbol.
  result::Drives drives;
};

struct FaultRunResult {
  Violations violations;
  std::uint64_t hash{};       ///< of all that was reported, driven and logged, and when
  std::uint64_t car_steps{};  ///< control steps that were reported
  std::uint64_t planned{};    ///< car-steps with a new plan
  /// Car-steps of vehicles that are out of reach (DrivenPlans), or not seen since (AnnouncedCheck)
  std::uint64_t unreachable{};
  double smallest_distance_m{};  ///< between driven footprints
  std::optional<FaultRecords> records;
};

/// Everything that is checked and hashed while a run goes on.
class RunMonitor final : public RunObserver {
 public:
  RunMonitor(const RunMonitor&) = delete;  // checks refer to `standing_`
  RunMonitor& operator=(const RunMonitor&) = delete;
  RunMonitor(const scenario::Scenario& scenario, Nanoseconds calm_from, const Trace& trace);

  /// Before the first event.
  void keep_records() { result_.records.emplace(); }
  /// The lab that it observes; before the first event.
  void attach(SimulatedLab& lab) { lab_ = &lab; }

  void on_log(NodeId node, const machine::LogLine& line) override;
  void on_driven(std::uint8_t vehicle, Nanoseconds time,
                 const result::DrivenSample& sample) override;
  void on_traffic(const coordination::Traffic& traffic, bool is_seen) override {
    driven_.published(traffic, is_seen || lab_->is_logical());
    announced_.published(traffic, is_seen);
    plans_.published(traffic);
  }
  void on_prediction(const coordination::Prediction& prediction) override;
  void on_report(const ReportRecord& record, const coordination::Plan* in_force) override;
  void on_command(const TrajectoryCommand& command) override;
  void on_received(const TrajectoryCommand& command) override { driven_.received(command); }
  /// From now on it brakes at once, wherever it is and whoever is near: it is no longer checked.
  void on_stop_symbol(std::uint8_t vehicle) override { stopped_.insert(vehicle); }

  void killed(const ProcessSlot& slot);
  /// It has been killed or suspended.
  void held_up(const ProcessSlot& slot);
  /// It has begun or ended.
  void changed(const ProcessSlot& slot);
  void report_violation(const std::string& text);
  void check_ticks();
  void check_planning(const std::vector<std::uint8_t>& able) {
    planning_.check(able, lab_->now(), result_.violations);
  }

  /// Somebody has planned.
  [[nodiscard]] bool has_begun() const { return result_.planned > 0; }
  /// By its controller's last report.
  [[nodiscard]] bool is_on_standby(std::uint8_t vehicle) const {
    return planning_.is_on_standby(vehicle);
  }
  [[nodiscard]] std::optional<Pose> pose_of(std::uint8_t vehicle) const;
  [[nodiscard]] FaultRunResult result();

  template <class Line>
  void trace(Line line) const {
    if (trace_) trace_(lab_->now(), line());
  }

 private:
  /// A lease, and the step under way.
  static constexpr Nanoseconds kLabControlIsMissed = 3 * kNanosecondsPerSecond;

  void came_back(std::uint8_t vehicle);
  void check_lab_control(const coordination::Report& report);
  void record(std::uint8_t vehicle, Nanoseconds tick, const result::DrivenSample& sample);
  void add_to_hash(std::uint64_t value);

  Nanoseconds period_;
  FootprintsCheck footprints_;
  StandingAreas standing_;
  PlansCheck plans_;
  DrivenPlans driven_;
  AnnouncedCheck announced_;
  ReasonsCheck reasons_;
  PlanningCheck planning_;
  const Trace& trace_;
  const SimulatedLab* lab_{};
  struct Last {
    Nanoseconds tick{};
    Pose pose;
    Nanoseconds follows{};
  };
  std::map<std::uint8_t, Last> last_;
  std::set<std::uint8_t> stopped_;
  std::optional<Nanoseconds> lab_control_died_;
  FaultRunResult result_;
  bool has_violation_{};
};

}  // namespace hlc::closed_loop
