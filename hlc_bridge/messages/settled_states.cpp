#include "hlc_bridge/messages/settled_states.hpp"

#include <cmath>

namespace hlc {
namespace {

bool fits(const VehicleState& before, const VehicleState& after) {
  if (after.create_stamp < before.create_stamp) return false;
  const Nanoseconds pause = after.create_stamp - before.create_stamp;
  const double most_m = SettledStates::kMostJump_m +
                        SettledStates::kMostSpeed_mps * 1e-9 * static_cast<double>(pause);
  return pause <= SettledStates::kMostPause &&
         std::hypot(after.pose.x_m - before.pose.x_m, after.pose.y_m - before.pose.y_m) <= most_m;
}

}  // namespace

bool is_finite(const VehicleState& state) {
  return std::isfinite(state.pose.x_m) && std::isfinite(state.pose.y_m) &&
         std::isfinite(state.pose.heading_rad) && std::isfinite(state.speed_mps);
}

bool is_located(const VehicleState& state) { return state.ips_update_age <= kMaxPositionAge; }

void SettledStates::add(const VehicleState& state) {
  if (!is_finite(state) || !is_located(state)) {
    last_.reset();
    return;
  }
  if (last_ && last_->create_stamp == state.create_stamp) return;
  if (!last_ || !fits(*last_, state)) since_ = state.create_stamp;
  last_ = state;
}

bool SettledStates::have_settled() const { return last_ && last_->create_stamp - since_ >= kSpan; }

}  // namespace hlc
