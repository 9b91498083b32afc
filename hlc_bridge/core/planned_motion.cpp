#include "hlc_bridge/core/planned_motion.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hlc {
namespace {

[[noreturn]] void refuse(const StepRecord& row, const std::string& what) {
  throw std::runtime_error("vehicle " + std::to_string(row.record.report.vehicle.value) +
                           ", step " + std::to_string(row.step) + ": " + what);
}

/// Pose at the begin of a motion of which the end is known.
Pose begin_of(const Maneuver& maneuver, const Pose& end) {
  return compose(end, between(maneuver.displacement, Pose{}));
}

}  // namespace

const Maneuver* maneuver_during(const StepRecord& row, const StepRecord* next,
                                const Subgraph& automaton) {
  const Report& report = row.record.report;
  if (next == nullptr || next->step != row.step + 1 ||
      report.planned_trim.index >= automaton.automaton().trims.size()) {
    return nullptr;
  }
  const Maneuver* nearest = nullptr;
  double nearest_m = 0.0;
  for (const Edge& edge : automaton.successors(report.planned_trim)) {
    if (edge.to != next->record.report.planned_trim) continue;
    const Pose end = compose(report.planned_pose, edge.maneuver->displacement);
    const double distance_m =
        (end.position_m() - next->record.report.planned_pose.position_m()).norm();
    if (nearest != nullptr && distance_m >= nearest_m) continue;
    nearest = edge.maneuver;
    nearest_m = distance_m;
  }
  return nearest;
}

std::vector<State> planned_motion(std::span<const StepRecord* const> rows, Nanoseconds period,
                                  Nanoseconds interval, const Subgraph& automaton) {
  std::vector<State> states;
  const VehicleParameters& vehicle = automaton.automaton().vehicle;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k]->step != k) refuse(*rows[k], "the step before was not reported");
    const Report& report = rows[k]->record.report;
    if (report.planned_trim.index >= automaton.automaton().trims.size()) {
      refuse(*rows[k], "planned_trim is none of the automaton");
    }
    const Trim& trim = automaton.automaton().trims[report.planned_trim.index];
    states.push_back({.pose = report.planned_pose,
                      .speed_mps = trim.speed_mps,
                      .steering_rad = trim.steering_rad});
    if (k + 1 == rows.size() || rows[k + 1]->step != k + 1) continue;
    const Maneuver* maneuver = maneuver_during(*rows[k], rows[k + 1], automaton);
    if (maneuver == nullptr) refuse(*rows[k], "no maneuver leads to the next planned trim");
    const Pose begin = begin_of(*maneuver, rows[k + 1]->record.report.planned_pose);
    for (Nanoseconds t = interval; t < period; t += interval) {
      State state = state_at(*maneuver, 1e-9 * static_cast<double>(t), vehicle);
      state.pose = compose(begin, state.pose);
      states.push_back(state);
    }
  }
  return states;
}

std::vector<State> driven_motion(std::span<const DrivenSample> drive, Nanoseconds begin,
                                 Nanoseconds interval, std::size_t count) {
  std::vector<State> states;
  const auto is_before = [](const DrivenSample& sample, Nanoseconds t) { return sample.t < t; };
  for (std::size_t i = 0; i < count; ++i) {
    const Nanoseconds t = begin + i * interval;
    const std::optional<Pose> pose = driven_pose_at(drive, t);
    if (!pose) break;
    const auto after = std::lower_bound(drive.begin(), drive.end(), t, is_before);
    double speed_mps = after->speed_mps;
    if (after->t != t) {
      const DrivenSample& before = *std::prev(after);
      const double part =
          static_cast<double>(t - before.t) / static_cast<double>(after->t - before.t);
      speed_mps = before.speed_mps + part * (after->speed_mps - before.speed_mps);
    }
    states.push_back({.pose = *pose, .speed_mps = speed_mps, .steering_rad = 0.0});
  }
  return states;
}

}  // namespace hlc
