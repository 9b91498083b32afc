// Checks every #include against the allowed dependencies. Debian puts the headers of Fast DDS, OMPL
// and all other libraries into the compiler's default path, so the build alone would not notice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "tests/house/arrows.hpp"
#include "tests/support/folders.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;

/// Headers, most of them from outside, that only some places may name: pattern of the header,
/// pattern of the files.
struct Outside {
  std::string header;
  std::string files;
  std::string why;
};
const std::vector<Outside> kOutside{
    {"^(fastdds|fastrtps|fastcdr)/.*", "^hlc_bridge/dds/fast_dds[._].*",
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
    {"^openssl/.*", "^(planner/common/sha256|hlc_bridge/dds/security\\.cpp).*",
     "hashes are made in one place, and certificates are read in one"},
    {"^tinyxml2.*", "^planner/(road|plot)/.*",
     "XML is read and written in planner/road, drawings in planner/plot"},
    {"^spdlog/.*", "^(hlc_bridge/(process|apps)|vehicle_sim/apps)/.*", "only processes log"},
    {"^CLI/.*", "^planner/apps/cli.hpp", "CLI11 has one entry, planner/apps/cli.hpp"},
    {"^pybind11/.*", "^vehicle_sim/python/.*", "only the Python package knows Python"},
    {"^boost/(asio|beast)[/.].*", "^hlc_bridge/live/boost_beast.hpp",
     "Boost.Asio and Boost.Beast have one entry, hlc_bridge/live/boost_beast.hpp"},
    {"^(thread|mutex|condition_variable|future|chrono|iostream|ctime)$",
     "^(hlc_bridge/(time|dds|process|record|doctor|live|apps)/.*|hlc_bridge/mcap/"
     "message_recorder.*|"
     "vehicle_sim/apps/.*|planner/apps/.*)",
     "planner, machines, results and the simulated vehicle know no clock, thread or console"},
};

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
  if (may_use(room, header)) return std::nullopt;
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

/// Paths of all sources, from the root and whole.
std::map<std::string, fs::path> sources() {
  const fs::path root = source_folder();
  std::map<std::string, fs::path> files;
  for (const char* top : {"planner", "hlc_bridge", "vehicle_sim"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".hpp" && extension != ".cpp") continue;
      files.emplace(entry.path().lexically_relative(root).generic_string(), entry.path());
    }
  }
  EXPECT_GT(files.size(), 50U);
  return files;
}

TEST(House, EveryIncludeFollowsAnArrow) {
  for (const auto& [file, path] : sources()) {
    ASSERT_TRUE(room_of(file)) << file << " lies in no folder of the house";
    for (const std::string& header : includes_of(path)) {
      const std::optional<std::string> fault = violation(file, header);
      EXPECT_FALSE(fault) << *fault;
    }
  }
}

/// Whether this line of code reads which kind of time a run has.
bool asks_for_logical_time(const std::string& line) {
  static const std::regex kQuestion(
      R"((?!\s*//).*\b(is_logical|logical_time|simulated_time)\b(?!\s*=[^=]).*)");
  return std::regex_match(line, kQuestion);
}

// Processes and machines are given what follows from it. Exempt are
// simulations of a lab and summaries of runs.
TEST(House, OnlyFlagsAndPacingAskForLogicalTime) {
  static const std::regex kMayAsk(
      "(hlc_bridge/(apps|result|record)/|vehicle_sim/(apps|closed_loop)/|"
      "hlc_bridge/machine/pacing\\.hpp).*");
  for (const auto& [file, path] : sources()) {
    if (std::regex_match(file, kMayAsk)) continue;
    std::ifstream stream(path);
    for (std::string line; std::getline(stream, line);) {
      EXPECT_FALSE(asks_for_logical_time(line)) << file << ": " << line;
    }
  }
}

TEST(House, AQuestionForLogicalTimeIsNoticed) {
  EXPECT_TRUE(asks_for_logical_time("  if (options_.logical_time) return;"));
  EXPECT_TRUE(asks_for_logical_time("  return is_logical == true ? a : b;"));
  EXPECT_FALSE(asks_for_logical_time("  facts.simulated_time = true;"));
  EXPECT_FALSE(asks_for_logical_time("  /// Only if simulated_time is set."));
  EXPECT_FALSE(asks_for_logical_time("  rules_in_logical_time(true);"));
}

TEST(House, ArrowsMakeNoCircle) { EXPECT_EQ(circle_of(arrows()), ""); }

TEST(House, AnArrowThatRunsUpIsNoticed) {
  EXPECT_TRUE(violation("planner/geometry/pose.cpp", "planner/search/search_engine.hpp"));
  EXPECT_TRUE(violation("hlc_bridge/process/hlc_process.cpp", "vehicle_sim/plant/plant.hpp"));
  EXPECT_TRUE(violation("vehicle_sim/tracking/follower.cpp", "planner/coordination/plan.hpp"));
  EXPECT_FALSE(violation("planner/search/search_engine.hpp", "planner/geometry/pose.hpp"));
}

TEST(House, ACircleIsNoticed) {
  Arrows all = arrows();
  all.at("planner/geometry").insert("planner/search");
  const std::string circle = circle_of(all);
  EXPECT_THAT(circle, testing::HasSubstr("planner/geometry"));
  EXPECT_THAT(circle, testing::HasSubstr("planner/search"));
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
  EXPECT_TRUE(violation("hlc_bridge/live/server.cpp", "boost/asio/io_context.hpp"));
  EXPECT_TRUE(violation("planner/apps/rollout.cpp", "CLI/CLI.hpp"));
  EXPECT_TRUE(violation("planner/rollout/rollout.cpp", "pybind11/pybind11.h"));
  EXPECT_FALSE(
      violation("hlc_bridge/dds/fast_dds_2.cpp", "fastdds/dds/domain/DomainParticipant.hpp"));
}

}  // namespace
}  // namespace hlc::test
