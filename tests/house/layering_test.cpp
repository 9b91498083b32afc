// Checks every #include against the allowed dependencies. Debian puts the headers of Fast DDS, OMPL
// and all other libraries into the compiler's default path, so the build alone would not notice.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/folders.hpp"

namespace hlc {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// Folder of the house -> folders that its files may include, beside itself. A folder stands for
/// those below it.
const std::map<std::string, Names> kArrows{
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
    {"planner/coordination",
     {"planner/search", "planner/automaton", "planner/common", "planner/road", "planner/vehicle",
      "planner/geometry"}},
    {"planner/controller",
     {"planner/coordination", "planner/search", "planner/automaton", "planner/common",
      "planner/road", "planner/vehicle", "planner/geometry"}},
    {"planner/policy",
     {"planner/controller", "planner/coordination", "planner/search", "planner/automaton",
      "planner/common", "planner/road", "planner/vehicle", "planner/geometry"}},
    {"planner/scenario",
     {"planner/policy", "planner/controller", "planner/coordination", "planner/search",
      "planner/automaton", "planner/maneuver_design", "planner/common", "planner/road",
      "planner/vehicle", "planner/geometry"}},
    {"planner/rollout",
     {"planner/policy", "planner/scenario", "planner/controller", "planner/coordination",
      "planner/search", "planner/automaton", "planner/common", "planner/road", "planner/vehicle",
      "planner/geometry"}},
    {"planner/plot",
     {"planner/scenario", "planner/maneuver_design", "planner/search", "planner/automaton",
      "planner/common", "planner/road", "planner/vehicle", "planner/geometry"}},
    {"planner/apps", {"planner"}},
    // Code that forwards messages needs only the parts of the planner in them.
    {"hlc_bridge/messages",
     {"planner/geometry", "planner/coordination/messages.hpp", "planner/coordination/report.hpp",
      "planner/automaton/trim_id.hpp", "planner/automaton/criterion.hpp",
      "planner/automaton/subgraph_request.hpp"}},
    {"hlc_bridge/machine", {"hlc_bridge/messages"}},
    {"hlc_bridge/time", {"hlc_bridge/messages"}},
    {"hlc_bridge/dds",
     {"hlc_bridge/messages", "planner/geometry", "planner/coordination/messages.hpp",
      "planner/coordination/report.hpp"}},
    {"hlc_bridge/hlc", {"hlc_bridge/machine", "hlc_bridge/messages", "planner"}},
    {"hlc_bridge/middleware", {"hlc_bridge/machine", "hlc_bridge/messages"}},
    {"hlc_bridge/lab_control", {"hlc_bridge/machine", "hlc_bridge/messages"}},
    {"hlc_bridge/result", {"hlc_bridge/messages", "planner"}},
    {"hlc_bridge/record", {"hlc_bridge/result", "hlc_bridge/messages", "planner"}},
    {"hlc_bridge/view", {"hlc_bridge/messages", "planner"}},
    {"hlc_bridge/process",
     {"hlc_bridge/hlc", "hlc_bridge/middleware", "hlc_bridge/lab_control", "hlc_bridge/machine",
      "hlc_bridge/messages", "hlc_bridge/dds", "hlc_bridge/time", "hlc_bridge/view",
      "hlc_bridge/record", "hlc_bridge/result", "planner"}},
    {"hlc_bridge/doctor", {"hlc_bridge/messages", "hlc_bridge/dds", "hlc_bridge/time"}},
    {"hlc_bridge/apps", {"hlc_bridge", "planner"}},
    {"vehicle_sim/plant", {"planner/geometry", "planner/vehicle"}},
    // The follower sees commands on the wire, never a plan.
    {"vehicle_sim/tracking", {"hlc_bridge/messages", "planner/geometry", "planner/vehicle"}},
    {"vehicle_sim/vehicle",
     {"hlc_bridge/machine", "hlc_bridge/messages", "hlc_bridge/result/run_record.hpp",
      "vehicle_sim/plant", "vehicle_sim/tracking", "planner/geometry", "planner/vehicle"}},
    {"vehicle_sim/closed_loop",
     {"hlc_bridge/machine", "hlc_bridge/messages", "hlc_bridge/hlc", "hlc_bridge/middleware",
      "hlc_bridge/lab_control", "hlc_bridge/result", "vehicle_sim/vehicle", "vehicle_sim/tracking",
      "planner"}},
    {"vehicle_sim/campaign",
     {"hlc_bridge/messages", "hlc_bridge/result", "vehicle_sim/closed_loop", "vehicle_sim/vehicle",
      "vehicle_sim/plant", "vehicle_sim/tracking", "planner"}},
    {"vehicle_sim/apps",
     {"vehicle_sim", "hlc_bridge/process/shell.hpp", "hlc_bridge/process/log.hpp", "hlc_bridge/dds",
      "hlc_bridge/machine", "hlc_bridge/time", "hlc_bridge/messages", "hlc_bridge/result",
      "hlc_bridge/record", "hlc_bridge/apps", "planner"}},
};

/// Headers, most of them from outside, that only some places may name: pattern of the header,
/// pattern of the files.
struct Outside {
  std::string header;
  std::string files;
  std::string why;
};
const std::vector<Outside> kOutside{
    {"^(fastdds|fastrtps|fastcdr)/.*", "^hlc_bridge/dds/fast_dds\\..*",
     "Fast DDS has one entry, hlc_bridge/dds/fast_dds"},
    {"^ompl/(?!datastructures/BinaryHeap\\.h).*", "^planner/(search/ompl/.*|apps/ompl_example.cpp)",
     "OMPL stays in its adapter"},
    {"^ompl/datastructures/BinaryHeap\\.h", "^planner/search/best_first/.*",
     "OMPL's heap, which needs no library, is for the best-first engine"},
    {"^planner/search/ompl/.*",
     "^planner/(search/ompl/.*|scenario/engine_choice.cpp|apps/ompl_example.cpp)",
     "the search and the controller do not know OMPL"},
    {"^nlopt.*", "^planner/maneuver_design/solver/.*", "only the maneuvers' solver optimises"},
    {"^planner/maneuver_design/solver/(?!maneuver_solver\\.hpp).*",
     "^planner/maneuver_design/solver/.*", "the solver has one entry, maneuver_solver.hpp"},
    {"^planner/maneuver_design/(automaton_|built_|pareto_|two_criteria_|trim_choice|unit_cost).*",
     "^(?!planner/maneuver_design/solver/).*", "the solver knows nothing of what it is used for"},
    {"^yaml-cpp/.*", "^planner/common/parse_yaml.*", "YAML is parsed in one place"},
    {"^openssl/.*", "^planner/common/sha256.*", "hashes are made in one place"},
    {"^tinyxml2.*", "^planner/(road|plot)/.*",
     "XML is read and written in planner/road, drawings in planner/plot"},
    {"^spdlog/.*", "^(hlc_bridge/(process|apps)|vehicle_sim/apps)/.*", "only processes log"},
    {"^CLI/.*", "^planner/apps/cli.hpp", "CLI11 has one entry, planner/apps/cli.hpp"},
    {"^(thread|mutex|condition_variable|future|chrono|iostream|ctime)$",
     "^(hlc_bridge/(time|dds|process|record|doctor|apps)/.*|vehicle_sim/apps/.*|planner/apps/.*)",
     "planner, machines, results and the simulated vehicle know no clock, thread or console"},
};

/// Of a folder everything in it, of a file that one.
bool is_below(const std::string& path, const std::string& folder) {
  return path == folder || path.starts_with(folder + "/");
}

/// The folder of the house that a path from the root lies in; nothing for foreign paths.
std::optional<std::string> room_of(const std::string& path) {
  for (const auto& [room, allowed] : kArrows) {
    if (is_below(path, room)) return room;
  }
  return std::nullopt;
}

/// What is wrong with one include, or nothing.
std::optional<std::string> violation(const std::string& file, const std::string& header) {
  for (const Outside& rule : kOutside) {
    if (std::regex_match(header, std::regex(rule.header)) &&
        !std::regex_match(file, std::regex(rule.files))) {
      return file + " includes " + header + ": " + rule.why;
    }
  }
  static const std::regex kOwn("^(planner|hlc_bridge|vehicle_sim|tests)/.*");
  if (!std::regex_match(header, kOwn)) return std::nullopt;
  const std::string room = room_of(file).value();
  if (is_below(header, room)) return std::nullopt;
  for (const std::string& allowed : kArrows.at(room)) {
    if (is_below(header, allowed)) return std::nullopt;
  }
  return file + " includes " + header + ": no arrow from " + room;
}

std::vector<std::string> includes_of(const fs::path& file) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"].*)");
  std::vector<std::string> headers;
  std::ifstream stream(file);
  std::smatch match;
  for (std::string line; std::getline(stream, line);) {
    if (std::regex_match(line, match, kInclude)) headers.push_back(match[1]);
  }
  return headers;
}

TEST(House, EveryIncludeFollowsAnArrow) {
  const fs::path root = test::source_folder();
  std::size_t num_files = 0;
  for (const char* top : {"planner", "hlc_bridge", "vehicle_sim"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".hpp" && extension != ".cpp") continue;
      const std::string file = entry.path().lexically_relative(root).generic_string();
      ++num_files;
      ASSERT_TRUE(room_of(file)) << file << " lies in no folder of the house";
      for (const std::string& header : includes_of(entry.path())) {
        const std::optional<std::string> fault = violation(file, header);
        EXPECT_FALSE(fault) << *fault;
      }
    }
  }
  EXPECT_GT(num_files, 50U);
}

TEST(House, AnArrowThatRunsUpIsNoticed) {
  EXPECT_TRUE(violation("planner/geometry/pose.cpp", "planner/search/search_engine.hpp"));
  EXPECT_TRUE(violation("hlc_bridge/process/hlc_process.cpp", "vehicle_sim/plant/plant.hpp"));
  EXPECT_TRUE(violation("vehicle_sim/tracking/follower.cpp", "planner/coordination/plan.hpp"));
  EXPECT_FALSE(violation("planner/search/search_engine.hpp", "planner/geometry/pose.hpp"));
}

TEST(House, AForeignHeaderInTheWrongPlaceIsNoticed) {
  EXPECT_TRUE(
      violation("planner/search/collision.cpp", "fastdds/dds/domain/DomainParticipant.hpp"));
  EXPECT_TRUE(
      violation("hlc_bridge/dds/participant.cpp", "fastdds/dds/domain/DomainParticipant.hpp"));
  EXPECT_TRUE(violation("planner/controller/controller.cpp", "chrono"));
  EXPECT_TRUE(violation("planner/controller/controller.cpp", "spdlog/spdlog.h"));
  EXPECT_TRUE(violation("planner/search/collision.cpp", "ompl/base/Planner.h"));
  EXPECT_TRUE(violation("planner/search/best_first/best_first_search.cpp", "ompl/base/Planner.h"));
  EXPECT_TRUE(violation("planner/search/search_engine.cpp", "planner/search/ompl/ompl_engine.hpp"));
  EXPECT_FALSE(violation("planner/search/best_first/best_first_search.cpp",
                         "ompl/datastructures/BinaryHeap.h"));
  EXPECT_TRUE(violation("planner/maneuver_design/pareto_front.cpp",
                        "planner/maneuver_design/solver/attempt.hpp"));
  EXPECT_TRUE(violation("planner/maneuver_design/solver/attempt.cpp",
                        "planner/maneuver_design/pareto_front.hpp"));
  EXPECT_TRUE(violation("planner/apps/rollout.cpp", "CLI/CLI.hpp"));
  EXPECT_FALSE(
      violation("hlc_bridge/dds/fast_dds.cpp", "fastdds/dds/domain/DomainParticipant.hpp"));
}

}  // namespace
}  // namespace hlc
