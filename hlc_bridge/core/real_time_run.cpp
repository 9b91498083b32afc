#include "hlc_bridge/core/real_time_run.hpp"

#include "hlc_bridge/core/node_names.hpp"

namespace hlc {

void RealTimeRun::ready(const ReadyStatus& status) {
  for (const std::uint8_t id : settings().vehicle_ids) {
    if (status.source_id == middleware_ready_id(id)) {
      ready_.insert(middleware_name(id));
    }
  }
}

void RealTimeRun::state(const VehicleState& state) {
  if (state.vehicle_id != 0) {
    ready_.insert(vehicle_name(state.vehicle_id));
  }
}

std::vector<std::string> RealTimeRun::not_ready() const {
  std::vector<std::string> lines;
  for (const std::uint8_t id : settings().vehicle_ids) {
    for (const std::string& name : {middleware_name(id), vehicle_name(id)}) {
      if (ready_.count(name) == 0) {
        lines.push_back(name);
      }
    }
  }
  return lines;
}

void RealTimeRun::go_on(LabRunActions& actions) {
  if (!triggered_) {
    triggered_ = true;
    actions.triggers.push_back(now() + kStartDelay);
  }
}

void RealTimeRun::drop(const std::string& process) { ready_.erase(process); }

}  // namespace hlc
