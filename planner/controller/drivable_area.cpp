#include "planner/controller/drivable_area.hpp"

#include <utility>

namespace hlc::controller {

bool once_per_horizon(std::uint64_t stood_steps, std::size_t horizon_steps) {
  return stood_steps % horizon_steps == 0;
}

bool no_timeout(std::uint64_t /*stood_steps*/, std::size_t /*horizon_steps*/) { return false; }

void DrivableArea::update_drivable_area(const DrivableAreaInputs& inputs) {
  const bool has_timed_out = this->has_timed_out(inputs);
  const bool may_need_entry = entry_.is_possible && !entry_.area;
  if (inputs.is_ended && (is_departing_ || (may_need_entry && !inputs.lies_in_lanes()))) {
    entry_ = inputs.find_entry();
    is_departing_ = false;
  } else if (has_timed_out && may_need_entry) {
    // The vehicle may be waiting for another one: only an existing way out counts.
    if (LaneEntry way_out = inputs.find_entry(); way_out.area) entry_ = std::move(way_out);
  }
  // A vehicle that stands in its lanes may need the area to drive off.
  if (entry_.area && !inputs.is_ended && !stands_since_ && inputs.lies_in_lanes()) {
    entry_.area.reset();
  }
}

coordination::DrivableAreaState DrivableArea::state() const {
  coordination::DrivableAreaState state{.entry = std::nullopt,
                                        .is_possible = entry_.is_possible,
                                        .is_certain = entry_.is_certain,
                                        .is_departing = is_departing_,
                                        .stands_since = stands_since_};
  if (entry_.area) {
    const road::Widening& by = entry_.widening;
    state.entry = {
        .from_s_m = by.from_s_m, .to_s_m = by.to_s_m, .left_m = by.left_m, .right_m = by.right_m};
  }
  return state;
}

void DrivableArea::resume(const coordination::DrivableAreaState& state,
                          const road::DrivableRoute& route) {
  entry_ = {.is_possible = state.is_possible, .is_certain = state.is_certain, .area = {}};
  if (state.entry) {
    entry_.widening = {.from_s_m = state.entry->from_s_m,
                       .to_s_m = state.entry->to_s_m,
                       .left_m = state.entry->left_m,
                       .right_m = state.entry->right_m};
    entry_.area = road::widened(route, entry_.widening);
  }
  is_departing_ = state.is_departing;
  stands_since_ = state.stands_since;
}

coordination::FallbackReason DrivableArea::obstacle() const {
  if (entry_.is_possible) return coordination::FallbackReason::kNone;
  return entry_.is_certain ? coordination::FallbackReason::kOffRoute
                           : coordination::FallbackReason::kBudget;
}

bool DrivableArea::has_timed_out(const DrivableAreaInputs& inputs) {
  if (!inputs.stands) {
    stands_since_.reset();
    return false;
  }
  stands_since_ = stands_since_.value_or(inputs.next);
  const std::uint64_t stood_steps = inputs.next.value - stands_since_->value;
  return stood_steps > 0 && timeout_(stood_steps, horizon_steps_);
}

}  // namespace hlc::controller
