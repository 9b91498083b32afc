#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/messages/instant.hpp"

namespace hlc::lab_control {

/// Live, lost and dropped processes of a run, and the readers of its triggers. Three processes per
/// vehicle: vehicle, middleware, controller (messages/node_names); of a guest the vehicle only.
class Attendance {
 public:
  explicit Attendance(const std::vector<std::uint8_t>& vehicle_ids,
                      const std::vector<std::uint8_t>& guest_ids = {});

  /// Live and lost participants; a name in both is lost.
  void update(const std::set<std::string>& alive, const std::set<std::string>& lost);
  void trigger_readers(std::set<std::string> names) { trigger_readers_ = std::move(names); }

  [[nodiscard]] bool is_lost(const std::string& process) const { return lost_.contains(process); }
  [[nodiscard]] bool is_there(const std::string& process) const {
    return alive_.contains(process) && !is_lost(process);
  }
  /// Processes of the run, in the order of the vehicles.
  [[nodiscard]] std::vector<std::string> lost() const;
  [[nodiscard]] std::vector<std::string> absent() const;
  /// Vehicles and middlewares that do not receive the triggers.
  [[nodiscard]] std::vector<std::string> unreached_timers() const;

  /// From now on the run continues without the process. False if it did already.
  bool drop(const std::string& process) { return dropped_.insert(process).second; }
  void take_back(const std::string& process) { dropped_.erase(process); }
  [[nodiscard]] const std::set<std::string>& dropped() const { return dropped_; }
  /// @param wall  time at which it was considered dead
  void died(const std::string& process, Nanoseconds wall) { died_at_[process] = wall; }
  /// @pre it has died
  [[nodiscard]] Nanoseconds died_at(const std::string& process) const {
    return died_at_.at(process);
  }

 private:
  std::vector<std::string> processes_;
  std::vector<std::string> timers_;
  std::set<std::string> alive_;
  std::set<std::string> lost_;
  std::set<std::string> trigger_readers_;
  std::set<std::string> dropped_;
  std::map<std::string, Nanoseconds> died_at_;
};

}  // namespace hlc::lab_control
