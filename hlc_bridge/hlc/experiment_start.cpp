#include "hlc_bridge/hlc/experiment_start.hpp"

#include <algorithm>
#include <utility>

namespace hlc::high_level_controller {

void ExperimentStart::trigger(Nanoseconds next_start) {
  if (!time_) time_ = next_start;
}

void ExperimentStart::receive(const RunState& state) {
  if (state.start != 0) trigger(state.start);
}

bool ExperimentStart::join_if_others_drive(const controller::Observation& observation,
                                           bool has_lab_control) {
  if (time_) return false;
  const std::uint64_t now = observation.step.value;
  for (const VehicleId vehicle : observation.active) {
    const auto found = newest_traffic_.find(vehicle);
    if (vehicle == vehicle_ || found == newest_traffic_.end()) continue;
    const std::uint64_t step = found->second.value;
    if (step + 1 < now || step > now + 1) continue;
    if (!has_lab_control) return !std::exchange(was_kept_out_, true);
    time_ = step * step_ns_;
    is_inferred_ = true;
  }
  return false;
}

void ExperimentStart::enter(StepIndex step) {
  if (first_step_) return;
  first_step_ = step;
  if (rule_ == StartRule::kTogether || !time_) return;
  first_step_ = std::min(step, StepIndex{(*time_ + step_ns_ - 1) / step_ns_});
}

bool ExperimentStart::is_joining(const VehicleStateList& list) const {
  if (rule_ == StartRule::kTogether) return false;
  return is_inferred_ || (time_ && list.t_now >= *time_ + kLateSteps * step_ns_);
}

}  // namespace hlc::high_level_controller
