#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::lab_control {

/// Names of all timers of a run.
inline std::set<std::string> timers_of(const std::vector<std::uint8_t>& vehicle_ids) {
  std::set<std::string> names;
  for (const std::uint8_t id : vehicle_ids) {
    names.insert({vehicle_name(id), middleware_name(id)});
  }
  return names;
}

}  // namespace hlc::lab_control
