#pragma once

#include <string>

namespace hlc {

/// A process of a run that is not there any more, or gives no answer.
struct Death {
  std::string process;
  std::string sign;  ///< how it was noticed, in words
  friend bool operator==(const Death&, const Death&) = default;
};

}  // namespace hlc
