#include "hlc_bridge/view/page_messages.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "hlc_bridge/result/joint_gaps.hpp"
#include "hlc_bridge/view/page_parts.hpp"
#include "hlc_bridge/view/step_messages.hpp"

namespace hlc::view {
namespace {

constexpr Nanoseconds kLargestGap = 100'000'000;  ///< as in driven_pose_at

std::vector<const result::StepRecord*> rows_of(VehicleId vehicle, const FinishedRun& run) {
  std::vector<const result::StepRecord*> rows;
  for (const result::StepRecord& row : run.rows) {
    if (row.record.report.vehicle == vehicle) rows.push_back(&row);
  }
  return rows;
}

/// How far the plans of each vehicle and those coupled with it are from their joint optimum.
std::map<VehicleId, StepMessages::Together> together_by_vehicle(const FinishedRun& run) {
  std::map<VehicleId, StepMessages::Together> together;
  for (const auto& [step, gaps] : result::joint_gaps_by_step(run.rows)) {
    for (const coordination::JointGap& gap : gaps) {
      for (const VehicleId vehicle : gap.vehicles) together[vehicle][step] = text_of(gap);
    }
  }
  return together;
}

/// Messages `maneuvers` and, per vehicle that reported, `steps`.
void add_steps(const FinishedRun& run, Json& messages) {
  StepMessages encoder(run.description);
  Json steps = Json::array();
  std::map<VehicleId, StepMessages::Together> together = together_by_vehicle(run);
  for (const result::VehicleDescription& vehicle : run.description.vehicles) {
    const std::vector<const result::StepRecord*> rows = rows_of(vehicle.id, run);
    if (rows.empty() || !takes_part(vehicle.id, run.facts)) continue;
    steps.push_back(encoder.of(vehicle.id, rows, together[vehicle.id]));
  }
  messages.push_back(encoder.new_maneuvers());
  for (Json& message : steps) messages.push_back(std::move(message));
}

/// Messages `drive` of what was driven from t(0) to the end of the last step.
void add_drives(const FinishedRun& run, Json& messages) {
  if (!run.facts.first_step || run.rows.empty()) return;
  const Nanoseconds begin = *run.facts.first_step * run.facts.period;
  const Nanoseconds end = begin + (run.rows.back().step + 1) * run.facts.period;
  for (const auto& [id, drive] : run.drives) {
    if (!takes_part(VehicleId{id}, run.facts)) continue;
    const auto is_before = [](const result::DrivenSample& sample, Nanoseconds t) {
      return sample.t < t;
    };
    auto first = std::lower_bound(drive.begin(), drive.end(), begin, is_before);
    const auto last = std::lower_bound(first, drive.end(), end + 1, is_before);
    while (first != last) {
      auto next = std::next(first);
      const Nanoseconds tick = next != last ? next->t - first->t : 0;
      while (tick <= kLargestGap && next != last && next->t - std::prev(next)->t == tick) ++next;
      messages.push_back(drive_message(id, {first, next}, begin, tick));
      first = next;
    }
  }
}

/// Messages `why` of the vehicles that have explanations.
void add_explanations(const FinishedRun& run, Json& messages) {
  for (const result::VehicleDescription& vehicle : run.description.vehicles) {
    Json steps = Json::array();
    for (const result::Explanation& one : run.explanations) {
      if (one.vehicle == vehicle.id) steps.push_back({one.step, one.last, one.text});
    }
    if (steps.empty() || !takes_part(vehicle.id, run.facts)) continue;
    messages.push_back(
        {{"kind", "why"}, {"vehicle", vehicle.id.value}, {"steps", std::move(steps)}});
  }
}

void add_searches(const FinishedRun& run, Json& messages) {
  for (const result::SearchPage& one : run.searches) {
    if (!takes_part(one.vehicle, run.facts)) continue;
    messages.push_back({{"kind", "search"},
                        {"vehicle", one.vehicle.value},
                        {"step", one.step},
                        {"page", one.html}});
  }
}

}  // namespace

std::string page_messages(const FinishedRun& run) {
  Json messages = Json::array({run_message(run)});
  add_steps(run, messages);
  add_drives(run, messages);
  add_explanations(run, messages);
  add_searches(run, messages);
  messages.push_back(log_message(run.log));
  return text_of(messages);
}

}  // namespace hlc::view
