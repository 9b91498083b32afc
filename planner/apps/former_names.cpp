#include "planner/apps/former_names.hpp"

#include <algorithm>
#include <iostream>

namespace hlc::apps {

std::vector<std::string> with_present_names(const std::string& program, int argc,
                                            const char* const* argv,
                                            const std::vector<FormerName>& former) {
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; ++i) {
    std::string argument = argv[i];
    const std::string name = argument.substr(0, argument.find('='));
    const auto found = std::ranges::find(former, name, &FormerName::former);
    if (found != former.end()) {
      std::cerr << program << ": " << found->former << " is now " << found->now << '\n';
      argument.replace(0, name.size(), found->now);
    }
    arguments.push_back(argument);
  }
  return arguments;
}

}  // namespace hlc::apps
