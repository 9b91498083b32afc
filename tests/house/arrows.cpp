#include "tests/house/arrows.hpp"

#include <algorithm>
#include <vector>

namespace hlc::test {
namespace {

const Arrows kArrows{
    {"planner/common", {}},
    {"planner/geometry", {"planner/common"}},
    {"planner/vehicle", {"planner/common", "planner/geometry"}},
    {"planner/automaton", {"planner/common", "planner/vehicle", "planner/geometry"}},
    {"planner/maneuver_design",
     {"planner/automaton", "planner/common", "planner/vehicle", "planner/geometry"}},
    {"planner/road", {"planner/common", "planner/vehicle", "planner/geometry"}},
    {"planner/search",
     {"planner/automaton", "planner/common", "planner/road", "planner/vehicle",
      "planner/geometry"}},
    {"planner/joint_search",
     {"planner/search", "planner/automaton", "planner/common", "planner/road", "planner/vehicle",
      "planner/geometry"}},
    {"planner/coordination",
     {"planner/search", "planner/automaton", "planner/common", "planner/road", "planner/vehicle",
      "planner/geometry"}},
    {"planner/right_of_way",
     {"planner/coordination/messages.hpp", "planner/common", "planner/road", "planner/vehicle",
      "planner/geometry"}},
    {"planner/controller",
     {"planner/right_of_way", "planner/coordination", "planner/search", "planner/automaton",
      "planner/common", "planner/road", "planner/vehicle", "planner/geometry"}},
    {"planner/policy",
     {"planner/controller", "planner/coordination", "planner/search", "planner/automaton",
      "planner/common", "planner/road", "planner/vehicle", "planner/geometry"}},
    {"planner/scenario",
     {"planner/policy", "planner/controller", "planner/right_of_way", "planner/coordination",
      "planner/search", "planner/automaton", "planner/maneuver_design", "planner/common",
      "planner/road", "planner/vehicle", "planner/geometry"}},
    {"planner/rollout",
     {"planner/policy", "planner/scenario", "planner/controller", "planner/coordination",
      "planner/joint_search", "planner/search", "planner/automaton", "planner/common",
      "planner/road", "planner/vehicle", "planner/geometry"}},
    {"planner/plot",
     {"planner/scenario", "planner/joint_search", "planner/maneuver_design", "planner/search",
      "planner/automaton", "planner/common", "planner/road", "planner/vehicle",
      "planner/geometry"}},
    {"planner/apps", {"planner"}},
    // Code that forwards messages needs only the parts of the planner in them.
    {"hlc_bridge/messages",
     {"planner/geometry", "planner/coordination/messages.hpp", "planner/coordination/report.hpp",
      "planner/automaton/trim_id.hpp", "planner/automaton/criterion.hpp",
      "planner/automaton/subgraph_request.hpp"}},
    {"hlc_bridge/machine", {"hlc_bridge/messages"}},
    {"hlc_bridge/time", {"hlc_bridge/messages"}},
    {"hlc_bridge/mcap", {"hlc_bridge/messages", "planner/common/growing_file.hpp"}},
    {"hlc_bridge/dds",
     {"hlc_bridge/messages", "planner/geometry", "planner/coordination/messages.hpp",
      "planner/coordination/report.hpp"}},
    {"hlc_bridge/hlc",
     {"hlc_bridge/machine", "hlc_bridge/messages", "planner/policy", "planner/controller",
      "planner/coordination", "planner/search", "planner/maneuver_design", "planner/automaton",
      "planner/road", "planner/vehicle", "planner/geometry", "planner/common"}},
    {"hlc_bridge/middleware", {"hlc_bridge/machine", "hlc_bridge/messages"}},
    {"hlc_bridge/lab_control", {"hlc_bridge/machine", "hlc_bridge/messages"}},
    {"hlc_bridge/result", {"hlc_bridge/messages", "planner"}},
    {"hlc_bridge/record", {"hlc_bridge/result", "hlc_bridge/messages", "planner"}},
    {"hlc_bridge/view",
     {"hlc_bridge/result", "hlc_bridge/mcap/merge.hpp", "hlc_bridge/messages", "planner"}},
    {"hlc_bridge/render", {"planner/common"}},
    {"hlc_bridge/live",
     {"hlc_bridge/view", "hlc_bridge/messages", "hlc_bridge/dds", "hlc_bridge/time",
      "planner/common"}},
    {"hlc_bridge/process",
     {"hlc_bridge/hlc", "hlc_bridge/middleware", "hlc_bridge/lab_control", "hlc_bridge/machine",
      "hlc_bridge/messages", "hlc_bridge/dds", "hlc_bridge/time", "hlc_bridge/view",
      "hlc_bridge/record", "hlc_bridge/result", "planner"}},
    {"hlc_bridge/doctor", {"hlc_bridge/messages", "hlc_bridge/dds", "hlc_bridge/time"}},
    {"hlc_bridge/apps", {"hlc_bridge", "planner"}},
    {"vehicle_sim/plant", {"planner/geometry", "planner/vehicle"}},
    // The follower sees commands on the wire, never a plan.
    {"vehicle_sim/tracking", {"hlc_bridge/messages", "planner/geometry", "planner/vehicle"}},
    {"vehicle_sim/guest",
     {"hlc_bridge/messages", "planner/coordination/guest.hpp", "planner/geometry",
      "planner/vehicle", "planner/common"}},
    {"vehicle_sim/vehicle",
     {"hlc_bridge/machine", "hlc_bridge/messages", "hlc_bridge/result/run_record.hpp",
      "vehicle_sim/guest", "vehicle_sim/plant", "vehicle_sim/tracking", "planner/geometry",
      "planner/vehicle"}},
    {"vehicle_sim/closed_loop",
     {"hlc_bridge/machine", "hlc_bridge/messages", "hlc_bridge/hlc", "hlc_bridge/middleware",
      "hlc_bridge/lab_control", "hlc_bridge/result", "vehicle_sim/vehicle", "vehicle_sim/tracking",
      "planner"}},
    {"vehicle_sim/run_folder",
     {"hlc_bridge/messages", "hlc_bridge/result", "hlc_bridge/record", "vehicle_sim/closed_loop",
      "vehicle_sim/vehicle", "vehicle_sim/tracking", "planner"}},
    {"vehicle_sim/campaign",
     {"hlc_bridge/messages", "hlc_bridge/result", "vehicle_sim/closed_loop", "vehicle_sim/vehicle",
      "vehicle_sim/plant", "vehicle_sim/tracking", "planner"}},
    // Without DDS, clocks and threads: a run in Python is a function.
    {"vehicle_sim/python",
     {"hlc_bridge/messages", "hlc_bridge/result", "hlc_bridge/record",
      "hlc_bridge/apps/finished_run.hpp", "vehicle_sim/closed_loop", "vehicle_sim/run_folder",
      "planner"}},
    {"vehicle_sim/apps",
     {"vehicle_sim", "hlc_bridge/process/shell.hpp", "hlc_bridge/process/log.hpp", "hlc_bridge/dds",
      "hlc_bridge/machine", "hlc_bridge/mcap/recorded_messages.hpp", "hlc_bridge/time",
      "hlc_bridge/messages", "hlc_bridge/result", "hlc_bridge/record", "hlc_bridge/apps",
      "hlc_bridge/render/child_process.hpp", "planner"}},
};

/// Of a folder everything in it, of a file that one.
bool is_below(const std::string& path, const std::string& folder) {
  return path == folder || path.starts_with(folder + "/");
}

/// Extends the way by rooms that its last one uses, until one stands on it twice.
bool closes(const Arrows& arrows, std::vector<std::string>& way, std::set<std::string>& done) {
  const std::string room = way.back();
  if (done.contains(room)) return false;
  for (const auto& [other, unused] : arrows) {
    const bool is_used = std::ranges::any_of(arrows.at(room), [&](const std::string& allowed) {
      return is_below(other, allowed) || is_below(allowed, other);
    });
    if (other == room || !is_used) continue;
    const bool is_on_way = std::ranges::find(way, other) != way.end();
    way.push_back(other);
    if (is_on_way || closes(arrows, way, done)) return true;
    way.pop_back();
  }
  done.insert(room);
  return false;
}

}  // namespace

const Arrows& arrows() { return kArrows; }

std::optional<std::string> room_of(const std::string& path) {
  for (const auto& [room, allowed] : kArrows) {
    if (is_below(path, room)) return room;
  }
  return std::nullopt;
}

bool may_use(const std::string& room, const std::string& file) {
  return is_below(file, room) ||
         std::ranges::any_of(kArrows.at(room),
                             [&](const std::string& allowed) { return is_below(file, allowed); });
}

bool may_link(const std::string& room, const std::string& other) {
  return room == other || std::ranges::any_of(kArrows.at(room), [&](const std::string& allowed) {
           return is_below(other, allowed) || is_below(allowed, other);
         });
}

std::string circle_of(const Arrows& arrows) {
  std::set<std::string> done;
  for (const auto& [room, unused] : arrows) {
    std::vector<std::string> way{room};
    if (!closes(arrows, way, done)) continue;
    std::string line = way.front();
    for (std::size_t i = 1; i < way.size(); ++i) line += " -> " + way[i];
    return line;
  }
  return {};
}

}  // namespace hlc::test
