#include "hlc_bridge/lab_control/attendance.hpp"

#include <algorithm>
#include <iterator>

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::lab_control {
namespace {

template <class Predicate>
std::vector<std::string> those_of(const std::vector<std::string>& names, Predicate holds) {
  std::vector<std::string> result;
  std::ranges::copy_if(names, std::back_inserter(result), holds);
  return result;
}

}  // namespace

Attendance::Attendance(const std::vector<std::uint8_t>& vehicle_ids,
                       const std::vector<std::uint8_t>& guest_ids) {
  for (const std::uint8_t id : vehicle_ids) {
    processes_.insert(processes_.end(),
                      {vehicle_name(id), middleware_name(id), controller_name(id)});
    timers_.insert(timers_.end(), {vehicle_name(id), middleware_name(id)});
  }
  for (const std::uint8_t id : guest_ids) {
    processes_.push_back(vehicle_name(id));
    timers_.push_back(vehicle_name(id));
  }
}

void Attendance::update(const std::set<std::string>& alive, const std::set<std::string>& lost) {
  alive_ = alive;
  lost_ = lost;
}

std::vector<std::string> Attendance::lost() const {
  return those_of(processes_, [this](const std::string& name) { return is_lost(name); });
}

std::vector<std::string> Attendance::absent() const {
  return those_of(processes_, [this](const std::string& name) { return !is_there(name); });
}

std::vector<std::string> Attendance::unreached_timers() const {
  return those_of(timers_,
                  [this](const std::string& name) { return !trigger_readers_.contains(name); });
}

}  // namespace hlc::lab_control
