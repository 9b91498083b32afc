// Writes the maps that the project ships, launch_scripts/maps/NAME.xml: generate_map --shape NAME;
// and towns: generate_map --blocks WxH

#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include "planner/apps/flags.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/road/lab_like_map.hpp"
#include "planner/road/lab_network_map.hpp"
#include "planner/road/route.hpp"
#include "planner/road/town_map.hpp"

namespace {

constexpr char kLabLike[] = "lab_like";
constexpr char kLabNetwork[] = "lab_network";

/// "4x3": 4 columns, 3 rows. Nothing if the text is none, or a number is out of bounds.
std::optional<hlc::road::Blocks> blocks_of(const std::string& text) {
  const auto numbers = hlc::apps::two_whole_numbers(text, 'x', hlc::road::Blocks::kMost);
  if (!numbers) return std::nullopt;
  return hlc::road::Blocks{.columns = static_cast<int>(numbers->first),
                           .rows = static_cast<int>(numbers->second)};
}

/// With the circuits that are to be printed, if any.
hlc::road::RoadNetwork network_of(const std::string& name, const std::string& blocks) {
  if (const auto town = blocks_of(blocks)) return {.map = hlc::road::town_map(*town), .routes = {}};
  if (name == kLabNetwork) return {.map = hlc::road::lab_network_map(), .routes = {}};
  return hlc::road::lab_like_map();
}

void run(const std::string& name, const std::string& blocks, double scale,
         const hlc::apps::OutputFile& out) {
  hlc::apps::check_output_files({out});
  hlc::road::RoadNetwork network = network_of(name, blocks);
  network.map = hlc::road::scaled(std::move(network.map), scale);
  hlc::road::write_lanelet_map(network.map, *out.file);
  if (network.routes.empty()) std::cout << network.map.lanelets.size() << " lanelets\n";
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
  hlc::apps::CommandLine app{
      "Writes a CommonRoad 2020a map: of the same shape as the lab's, or of a town.",
      "generate_map"};
  std::string name = kLabLike;
  std::string blocks;
  hlc::apps::OutputFile out{"--out", {}};
  CLI::Option* map =
      app.add_option(
             "--shape", name,
             "lab_like: three circuits, which are printed; lab_network: the lab's whole road "
             "network with its lanelet numbers")
          ->check(hlc::apps::among({kLabLike, kLabNetwork}))
          ->capture_default_str();
  const std::string allowed = fmt::format("WxH, each in 1 ... {}", hlc::road::Blocks::kMost);
  app.add_option("--blocks", blocks,
                 "a town instead: W crossings from west to east, H from south to north, with the "
                 "roads between and around them; default: none")
      ->check(hlc::apps::allowing(
          [](const std::string& text) { return blocks_of(text).has_value(); }, allowed, allowed))
      ->excludes(map);
  double scale = 1.0;
  app.add_option("--scale", scale,
                 "factor on all lengths: 18 for full-size cars, with lanes of 2.7 m")
      ->check(hlc::apps::within(0.1, 100.0))
      ->capture_default_str();
  hlc::apps::declare_output(app, out, "file to write (XML)")->required();
  hlc::apps::declare_help_end(
      app, {.examples = {"generate_map --out lab_like.xml",
                         "generate_map --blocks 2x2 --scale 18 --out town.xml"}});
  if (const auto code = hlc::apps::parse_flags(app, argc, argv, {{"--map", "--shape"}})) {
    return *code;
  }
  return hlc::apps::exit_code_of("generate_map", [&] { run(name, blocks, scale, out); });
}
