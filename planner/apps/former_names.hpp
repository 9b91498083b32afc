#pragma once

#include <string>
#include <vector>

namespace hlc::apps {

/// A flag's name up to the last release. It still works, with a warning; it is not in the help.
struct FormerName {
  std::string former;  ///< "--config"
  std::string now;     ///< "--configuration"
};

/// The arguments after the program's name with today's names. Each former one is named on stderr:
/// "PROGRAM: --config is now --configuration".
[[nodiscard]] std::vector<std::string> with_present_names(const std::string& program, int argc,
                                                          const char* const* argv,
                                                          const std::vector<FormerName>& former);

}  // namespace hlc::apps
