#include "vehicle_sim/tracking/command_buffer.hpp"

#include <tuple>
#include <utility>

namespace hlc {

bool CommandBuffer::Arrival::replaces(const Arrival& other) const {
  return std::tie(command.create_stamp, number) >
         std::tie(other.command.create_stamp, other.number);
}

void CommandBuffer::add(TrajectoryCommand command) {
  if (waiting_.size() == kCapacity) {
    waiting_.pop_front();
  }
  waiting_.push_back({.command = std::move(command), .number = arrivals_++});
}

const TrajectoryCommand* CommandBuffer::usable_at(Nanoseconds t_now) {
  for (Arrival& arrival : waiting_) {
    const bool is_valid = arrival.command.valid_after_stamp <= t_now;
    if (is_valid && (!active_ || arrival.replaces(*active_))) {
      active_ = std::move(arrival);
    }
  }
  // Whatever was valid has either been taken or is older than what is active.
  std::erase_if(waiting_,
                [&](const Arrival& arrival) { return arrival.command.valid_after_stamp <= t_now; });
  const bool is_usable = active_ && t_now - active_->command.valid_after_stamp < kCommandLifetime;
  return is_usable ? &active_->command : nullptr;
}

void CommandBuffer::clear() {
  active_.reset();
  waiting_.clear();
}

}  // namespace hlc
