// Writes the map that the project ships: generate_map --out launch_scripts/maps/lab_like.xml

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>

#include "planner/road/lab_like_map.hpp"
#include "planner/road/route.hpp"

int main(int argc, char** argv) {
  CLI::App app{
      "Writes a CommonRoad 2020a map of the same shape as the lab's, and prints its circuits."};
  std::string file;
  app.add_option("--out", file, "file to write")->required();
  try {
    app.parse(argc, argv);
    const hlc::RoadNetwork network = hlc::lab_like_map();
    hlc::write_lanelet_map(network.map, file);
    for (const hlc::NamedRoute& route : network.routes) {
      std::cout << route.name << ":";
      for (const hlc::LaneletId id : route.lanelets) {
        std::cout << " " << id;
      }
      std::cout << " (" << hlc::build_route(network.map, route.lanelets, true).path.length_m()
                << " m)\n";
    }
    return 0;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const std::exception& error) {
    std::cerr << "generate_map: " << error.what() << "\n";
    return 2;
  }
}
