#include "hlc_bridge/result/planned_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "planner/automaton/trim_format.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::result {
namespace {

[[noreturn]] void refuse(const StepRecord& row, const std::string& what) {
  throw std::runtime_error(
      fmt::format("vehicle {}, step {}: {}", row.record.report.vehicle.value, row.step, what));
}

/// Pose at the begin of a motion with a known end.
Pose begin_of(const automaton::Maneuver& maneuver, const Pose& end) {
  return compose(end, between(maneuver.displacement, Pose{}));
}

}  // namespace

const automaton::Maneuver* maneuver_during(const StepRecord& row, const StepRecord* next,
                                           const automaton::UniversalAutomaton& automaton) {
  if (next == nullptr || next->step != row.step + 1) return nullptr;
  const coordination::Report& report = row.record.report;
  // A vehicle that stands and whose plan is re-anchored may continue in another equilibrium.
  const bool is_self_loop = report.maneuver == automaton::kSelfLoopLabel;
  const TrimId to = is_self_loop ? report.planned_trim : next->record.report.planned_trim;
  const automaton::Maneuver* const found = automaton.find(report.planned_trim, to, report.maneuver);
  if (found != nullptr && found->label == report.maneuver) return found;
  // Or it was to turn its wheels where it stands, and is re-anchored with others.
  const auto stands = [&automaton](TrimId trim) {
    return trim.index < automaton.trims.size() && automaton.trims[trim.index].is_equilibrium();
  };
  if (report.maneuver.empty() || !stands(report.planned_trim) || !stands(to)) return nullptr;
  return automaton.find(report.planned_trim, report.planned_trim, automaton::kSelfLoopLabel);
}

std::vector<const automaton::Maneuver*> planned_maneuvers(
    const coordination::Report& report, const automaton::UniversalAutomaton& automaton) {
  std::vector<const automaton::Maneuver*> maneuvers;
  TrimId from = report.planned_trim;
  for (const auto& [to, label] : report.plan) {
    const bool is_first = maneuvers.empty();
    if (is_first && label == automaton::kSelfLoopLabel) from = to;  // see maneuver_during
    const automaton::Maneuver* const maneuver = automaton.find(from, to, label);
    if (maneuver == nullptr) break;
    maneuvers.push_back(maneuver);
    from = to;
  }
  return maneuvers;
}

std::vector<vehicle::State> planned_motion(std::span<const StepRecord* const> rows,
                                           Nanoseconds period, Nanoseconds interval,
                                           const automaton::UniversalAutomaton& automaton) {
  std::vector<vehicle::State> states;
  const vehicle::VehicleParameters& vehicle = automaton.vehicle;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k]->step != k) refuse(*rows[k], "the step before was not reported");
    const coordination::Report& report = rows[k]->record.report;
    if (report.planned_trim.index >= automaton.trims.size()) {
      refuse(*rows[k], "planned_trim is none of the automaton");
    }
    const automaton::Trim& trim = automaton.trims[report.planned_trim.index];
    states.push_back({.pose = report.planned_pose,
                      .speed_mps = trim.speed_mps,
                      .steering_rad = trim.steering_rad});
    if (k + 1 == rows.size() || rows[k + 1]->step != k + 1) continue;
    const automaton::Maneuver* maneuver = maneuver_during(*rows[k], rows[k + 1], automaton);
    if (maneuver == nullptr) {
      refuse(*rows[k],
             fmt::format("no maneuver from trim {} to {} with label '{}', must be in the automaton",
                         report.planned_trim, rows[k + 1]->record.report.planned_trim,
                         one_line(report.maneuver)));
    }
    const Pose begin = begin_of(*maneuver, rows[k + 1]->record.report.planned_pose);
    for (Nanoseconds t = interval; t < period; t += interval) {
      vehicle::State state = automaton::state_at(*maneuver, 1e-9 * static_cast<double>(t), vehicle);
      state.pose = compose(begin, state.pose);
      states.push_back(state);
    }
  }
  return states;
}

std::vector<vehicle::State> driven_motion(std::span<const DrivenSample> drive, Nanoseconds begin,
                                          Nanoseconds interval, std::size_t count) {
  std::vector<vehicle::State> states;
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

}  // namespace hlc::result
