// Writes the maps that the project ships, launch_scripts/maps/NAME.xml: generate_map --map NAME

#include <iostream>
#include <string>

#include "planner/apps/flags.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/road/lab_like_map.hpp"
#include "planner/road/lab_network_map.hpp"
#include "planner/road/route.hpp"

namespace {

constexpr char kLabLike[] = "lab_like";
constexpr char kLabNetwork[] = "lab_network";

void run(const std::string& name, const hlc::apps::OutputFile& out) {
  hlc::apps::check_output_files({out});
  if (name == kLabNetwork) {
    const hlc::road::LaneletMap map = hlc::road::lab_network_map();
    hlc::road::write_lanelet_map(map, *out.file);
    std::cout << map.lanelets.size() << " lanelets\n";
    return;
  }
  const hlc::road::RoadNetwork network = hlc::road::lab_like_map();
  hlc::road::write_lanelet_map(network.map, *out.file);
  for (const hlc::road::NamedRoute& route : network.routes) {
    std::cout << route.name << ":";
    for (const hlc::road::LaneletId id : route.lanelets) {
      std::cout << " " << id;
    }
    std::cout << " (" << hlc::road::build_route(network.map, route.lanelets, true).path.length_m()
              << " m)\n";
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Writes a CommonRoad 2020a map of the same shape as the lab's.", "generate_map"};
  std::string name = kLabLike;
  hlc::apps::OutputFile out{"--out", {}};
  app.add_option("--map", name,
                 "lab_like: three circuits, which are printed; lab_network: the lab's whole road "
                 "network with its lanelet numbers")
      ->check(hlc::apps::among({kLabLike, kLabNetwork}))
      ->capture_default_str();
  hlc::apps::declare_output(app, out, "file to write (XML)")->required();
  app.footer("Exit codes: 0 success, 1 an output cannot be written, 2 invalid input.");
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::exit_code_of("generate_map", [&] { run(name, out); });
}
