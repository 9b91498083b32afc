#include "hlc_bridge/core/planned_motion.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "planner/controller/plan_in_force.hpp"

namespace hlc {
namespace {

/// More than the rounding of a step.
constexpr double kSamePlace_m = 1e-6;

[[noreturn]] void refuse(const StepRecord& row, const std::string& what) {
  throw std::runtime_error("vehicle " + std::to_string(row.record.report.vehicle.value) +
                           ", step " + std::to_string(row.step) + ": " + what);
}

/// True if the plan may have been set down anew in that step: then it does not lead where it led.
///
/// That goes by the position alone. The deviation that is reported may be less: it is how far the
/// footprint leaves what the planned one covers with and without its slip.
bool may_have_moved(const Report& report, const Subgraph& automaton) {
  constexpr double kLeastReported = 0.2;
  return report.deviation_m > kLeastReported * DeviationRules{}.reanchor_share *
                                  automaton.automaton().vehicle.safety_margin_m;
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
  const Report& after = next->record.report;
  const auto missed_m = [&](const Maneuver& maneuver) {
    const Pose end = compose(report.planned_pose, maneuver.displacement);
    return (end.position_m() - after.planned_pose.position_m()).norm();
  };
  const Maneuver* nearest = nullptr;
  for (const Edge& edge : automaton.successors(report.planned_trim)) {
    if (edge.to != after.planned_trim) continue;
    if (nearest == nullptr || missed_m(*edge.maneuver) < missed_m(*nearest)) {
      nearest = edge.maneuver;
    }
  }
  if (nearest != nullptr && missed_m(*nearest) <= kSamePlace_m) return nearest;
  for (const Maneuver& maneuver : automaton.automaton().maneuvers) {
    const bool fits = maneuver.from == report.planned_trim && maneuver.to == after.planned_trim;
    if (fits && missed_m(maneuver) <= kSamePlace_m) return &maneuver;
  }
  const bool is_own_step = report.planned_trim == after.planned_trim;
  return is_own_step || may_have_moved(report, automaton) ? nearest : nullptr;
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
    if (maneuver == nullptr)
      refuse(*rows[k], "no maneuver of the automaton leads to the next planned pose");
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
