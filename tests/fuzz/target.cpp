#include "tests/fuzz/target.hpp"

#include <stdexcept>
#include <typeinfo>

namespace hlc::fuzz {

std::vector<Target> all_targets() {
  std::vector<Target> all;
  for (const auto make :
       {message_targets, planner_file_targets, run_file_targets, datagram_targets}) {
    for (Target& target : make()) all.push_back(std::move(target));
  }
  return all;
}

void read(const Target& target, std::string_view bytes) {
  try {
    target.read(bytes);
  } catch (const std::exception& error) {
    const std::type_info& type = typeid(error);
    if (type != typeid(std::invalid_argument) && type != typeid(std::runtime_error)) throw;
  }
}

}  // namespace hlc::fuzz
