#include "planner/maneuver_design/criteria.hpp"

#include <stdexcept>

#include "planner/maneuver_design/effort.hpp"

namespace hlc {

std::vector<std::string> criterion_names() { return {"J2"}; }

std::unique_ptr<RunningCost> make_criterion(const std::string& name) {
  if (name == "J2") {
    return std::make_unique<Effort>();
  }
  std::string names;
  for (const std::string& known : criterion_names()) {
    names += (names.empty() ? "" : ", ") + known;
  }
  throw std::invalid_argument("criterion = " + name + ", allowed " + names);
}

}  // namespace hlc
