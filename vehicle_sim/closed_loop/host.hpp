#pragma once

#include <set>
#include <string>
#include <utility>

#include "hlc_bridge/machine/log_line.hpp"
#include "vehicle_sim/closed_loop/simulated_process.hpp"

namespace hlc::closed_loop {

/// The common endpoints of all machines (MachineProcess lists the other requirements on a host).
class Host {
 public:
  void perform(const machine::LogLine& line) const { place_.observer->on_log(place_.node, line); }
  [[nodiscard]] const std::string& name() const { return place_.network->name(place_.node); }

 protected:
  [[nodiscard]] const ProcessPlace& place() const { return place_; }
  void set_place(const ProcessPlace& place) { place_ = place; }

  /// @param topic  index among the description's `writes`
  template <class What>
  void publish(std::size_t topic, const What& what) const {
    place_.network->publish(place_.node, topic, what);
  }
  [[nodiscard]] machine::Participants participants(Domain domain) const {
    return place_.network->participants(place_.node, domain);
  }
  [[nodiscard]] std::set<std::string> readers(std::size_t topic) const {
    return place_.network->readers(place_.node, topic);
  }
  [[nodiscard]] std::set<std::string> writers(std::size_t topic) const {
    return place_.network->writers(place_.node, topic);
  }

 private:
  ProcessPlace place_;
};

}  // namespace hlc::closed_loop
