#pragma once

#include <string>

namespace hlc {

/// A process of a run that has left, or does not respond.
struct Death {
  std::string process;
  std::string sign;  ///< how it was noticed, in words
  friend bool operator==(const Death&, const Death&) = default;
};

}  // namespace hlc
