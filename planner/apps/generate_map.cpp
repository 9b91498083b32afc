// Writes the map that the project ships: generate_map --out launch_scripts/maps/lab_like.xml

#include <iostream>

#include "planner/apps/flags.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/road/lab_like_map.hpp"
#include "planner/road/route.hpp"

namespace {

void run(const hlc::apps::OutputFile& out) {
  hlc::apps::check_output_files({out});
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
  CLI::App app{
      "Writes a CommonRoad 2020a map of the same shape as the lab's, and prints its circuits.",
      "generate_map"};
  hlc::apps::OutputFile out{"--out", {}};
  hlc::apps::declare_output(app, out, "file to write (XML)")->required();
  app.footer("Exit codes: 0 success, 1 an output cannot be written, 2 invalid input.");
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::exit_code_of("generate_map", [&out] { run(out); });
}
