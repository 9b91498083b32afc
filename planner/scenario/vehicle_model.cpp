#include "planner/scenario/vehicle_model.hpp"

#include "planner/automaton/vehicle_yaml.hpp"
#include "planner/common/node.hpp"

namespace hlc::scenario {

vehicle::IdentifiedVehicle vehicle_model_of_file(const std::filesystem::path& scenario_file) {
  const auto name = Node::read_yaml(scenario_file).required<std::string>("automaton");
  const Node automaton = Node::read_yaml(scenario_file.parent_path() / name);
  const Node vehicle = automaton.map("vehicle");
  return automaton::read_identified(vehicle, automaton::read_vehicle(vehicle),
                                    automaton::read_limits(automaton.map("limits")));
}

}  // namespace hlc::scenario
