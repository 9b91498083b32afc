#pragma once

#include <string>
#include <vector>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::closed_loop {

/// A violated invariant.
struct Violation {
  Nanoseconds at{};   ///< true time since the begin of the run
  std::string check;  ///< name of the rule
  std::string text;   ///< one line
};
using Violations = std::vector<Violation>;

}  // namespace hlc::closed_loop
