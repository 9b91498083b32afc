#include "planner/maneuver_design/criteria.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "planner/maneuver_design/comfort.hpp"
#include "planner/maneuver_design/distance.hpp"
#include "planner/maneuver_design/effort.hpp"
#include "planner/maneuver_design/energy.hpp"
#include "planner/maneuver_design/stopping_distance.hpp"
#include "planner/maneuver_design/travel_time.hpp"
#include "planner/maneuver_design/weighted_sum.hpp"

namespace hlc::maneuver_design {
namespace {

using Cost = std::unique_ptr<RunningCost>;

struct Criterion {
  const char* name;
  Cost (*make)(const vehicle::VehicleParameters& vehicle);
};

Cost make_j3(const vehicle::VehicleParameters& /*vehicle*/) {
  return std::make_unique<WeightedSum>(std::vector<WeightedCost>{
      {0.5, std::make_shared<Distance>()}, {0.5, std::make_shared<Effort>()}});
}

const std::array<Criterion, 7> kCriteria{{
    {"J1", [](const vehicle::VehicleParameters&) -> Cost { return std::make_unique<Distance>(); }},
    {"J2", [](const vehicle::VehicleParameters&) -> Cost { return std::make_unique<Effort>(); }},
    {"J3", make_j3},
    {"comfort",
     [](const vehicle::VehicleParameters& v) -> Cost { return std::make_unique<Comfort>(v); }},
    {"energy",
     [](const vehicle::VehicleParameters&) -> Cost { return std::make_unique<Energy>(); }},
    {"stopping_distance",
     [](const vehicle::VehicleParameters&) -> Cost {
       return std::make_unique<StoppingDistance>();
     }},
    {"travel_time",
     [](const vehicle::VehicleParameters&) -> Cost { return std::make_unique<TravelTime>(); }},
}};

}  // namespace

std::vector<std::string> criterion_names() {
  std::vector<std::string> names;
  for (const Criterion& criterion : kCriteria) {
    names.emplace_back(criterion.name);
  }
  return names;
}

std::unique_ptr<RunningCost> make_criterion(const std::string& name,
                                            const vehicle::VehicleParameters& vehicle) {
  for (const Criterion& criterion : kCriteria) {
    if (name == criterion.name) return criterion.make(vehicle);
  }
  throw std::invalid_argument(
      fmt::format("criterion = {}, must be one of {}", name, fmt::join(criterion_names(), ", ")));
}

}  // namespace hlc::maneuver_design
