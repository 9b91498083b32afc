#include "hlc_bridge/lab_control/tick_master.hpp"

#include <algorithm>

namespace hlc::lab_control {

TickMaster::TickMaster(const std::vector<std::string>& timers) {
  for (const std::string& timer : timers) {
    requests_.emplace(timer, std::nullopt);
  }
}

bool TickMaster::request(const std::string& timer, Nanoseconds tick) {
  const auto found = requests_.find(timer);
  if (found == requests_.end() || (found->second && *found->second >= tick)) {
    return false;
  }
  found->second = tick;
  return true;
}

void TickMaster::forget(const std::string& timer) {
  const auto found = requests_.find(timer);
  if (found != requests_.end()) {
    found->second.reset();
  }
}

void TickMaster::drop(const std::string& timer) { requests_.erase(timer); }

std::vector<std::string> TickMaster::unanswered() const {
  std::vector<std::string> names;
  for (const auto& [timer, request] : requests_) {
    if (!has_answered(request)) {
      names.push_back(timer);
    }
  }
  return names;
}

std::optional<Nanoseconds> TickMaster::releasable() const {
  std::optional<Nanoseconds> smallest;
  for (const auto& [timer, request] : requests_) {
    if (!has_answered(request)) {
      return std::nullopt;
    }
    smallest = smallest ? std::min(*smallest, *request) : *request;
  }
  return smallest;
}

Nanoseconds TickMaster::release() {
  released_ = releasable().value();
  return *released_;
}

bool TickMaster::waits_for_released(const std::string& timer, Nanoseconds tick) const {
  const auto found = requests_.find(timer);
  return found != requests_.end() && released_ == tick && found->second == tick;
}

}  // namespace hlc::lab_control
