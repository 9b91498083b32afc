#include "planner/coordination/plan.hpp"

#include <algorithm>
#include <utility>

#include "planner/common/demand.hpp"

namespace hlc::coordination {

Plan::Plan(StepIndex first, const Pose& pose, const automaton::Maneuver& standstill,
           const Owner& owner)
    : Plan(first, pose, Entry(owner, &standstill)) {}

Plan::Plan(StepIndex first, std::vector<Pose> poses,
           const std::vector<const automaton::Maneuver*>& maneuvers,
           const automaton::Maneuver& standstill, const Owner& owner)
    : first_(first), standstill_(owner, &standstill), poses_(std::move(poses)) {
  HLC_DEMAND(poses_.size() == maneuvers.size() + 1, poses_.size(), maneuvers.size());
  maneuvers_.reserve(maneuvers.size());
  for (const automaton::Maneuver* maneuver : maneuvers) maneuvers_.emplace_back(owner, maneuver);
}

Plan::Plan(StepIndex first, const Pose& pose, Entry standstill)
    : first_(first), standstill_(std::move(standstill)), poses_{pose} {}

Plan Plan::moved(const Pose& from, const Pose& to) const {
  Plan result = *this;
  for (Pose& pose : result.poses_) pose = compose(to, between(from, pose));
  return result;
}

StepIndex Plan::end() const { return {first_.value + maneuvers_.size()}; }

const Pose& Plan::pose_at(StepIndex step) const {
  HLC_DEMAND(step >= first_, step, first_);
  return poses_[std::min<std::size_t>(step.value - first_.value, poses_.size() - 1)];
}

const Plan::Entry& Plan::entry_during(StepIndex step) const {
  HLC_DEMAND(step >= first_, step, first_);
  const std::size_t i = step.value - first_.value;
  return i < maneuvers_.size() ? maneuvers_[i] : standstill_;
}

const automaton::Maneuver& Plan::maneuver_during(StepIndex step) const {
  return *entry_during(step);
}

TrimId Plan::trim_at(StepIndex step) const { return maneuver_during(step).from; }

std::vector<PlannedManeuver> Plan::maneuvers_from(StepIndex step) const {
  std::vector<PlannedManeuver> maneuvers;
  do {
    maneuvers.push_back({.to = trim_at({step.value + 1}), .label = maneuver_during(step).label});
    ++step.value;
  } while (step < end());
  return maneuvers;
}

vehicle::State Plan::state_at(StepIndex step, double time_s,
                              const vehicle::VehicleParameters& vehicle) const {
  vehicle::State state = automaton::state_at(maneuver_during(step), time_s, vehicle);
  state.pose = compose(pose_at(step), state.pose);
  return state;
}

OccupiedAreas Plan::areas_from(StepIndex from) const {
  OccupiedAreas areas{.first = from, .areas_m = {}, .final_area_m = {}};
  if (from < end()) areas.areas_m.reserve(end().value - from.value);
  for (StepIndex step = from; step < end(); ++step.value) {
    areas.areas_m.push_back(transformed(maneuver_during(step).swept_area_m, pose_at(step)));
  }
  areas.final_area_m = transformed(standstill_->swept_area_m, poses_.back());
  return areas;
}

Plan Plan::continued(StepIndex step, const std::vector<const automaton::Maneuver*>& continuation,
                     const automaton::Maneuver& standstill, const Owner& owner) const {
  return continued(step, continuation, Entry(owner, &standstill));
}

Plan Plan::continued(StepIndex step, const std::vector<const automaton::Maneuver*>& continuation,
                     const Entry& standstill) const {
  const StepIndex keep_from{
      std::max(first_.value, step.value < 2 ? std::uint64_t{0} : step.value - 2)};
  Plan result(keep_from, pose_at(keep_from), standstill);
  const std::size_t size = step.value - keep_from.value + continuation.size();
  result.maneuvers_.reserve(size);
  result.poses_.reserve(size + 1);
  const auto append = [&result](const Entry& maneuver) {
    result.maneuvers_.push_back(maneuver);
    result.poses_.push_back(compose(result.poses_.back(), maneuver->displacement));
  };
  for (StepIndex kept = keep_from; kept < step; ++kept.value) append(entry_during(kept));
  for (const automaton::Maneuver* maneuver : continuation) {
    const TrimId at = result.maneuvers_.empty() ? standstill_->from : result.maneuvers_.back()->to;
    HLC_DEMAND(maneuver->from == at, maneuver->from.index, at.index);
    append(Entry(standstill, maneuver));
  }
  HLC_DEMAND(result.maneuvers_.empty() || result.maneuvers_.back()->to == standstill->from,
             standstill->from.index);
  return result;
}

}  // namespace hlc::coordination
