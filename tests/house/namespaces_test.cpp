// One namespace per room: holds every namespace that a file opens against the room it lies in.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/folders.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;

/// Folders and files whose namespace is not hlc:: and the name of the room's folder. What every
/// room uses is in hlc itself.
const std::map<std::string, std::string> kNamespaces{
    {"planner/common", "hlc"},
    {"planner/geometry", "hlc"},
    {"planner/automaton/trim_id.hpp", "hlc"},
    {"planner/automaton/criterion.hpp", "hlc"},
    {"planner/automaton/subgraph_request.hpp", "hlc"},
    {"planner/coordination/ids.hpp", "hlc"},
    {"hlc_bridge/messages", "hlc"},
    {"hlc_bridge/hlc", "hlc::high_level_controller"},
    {"vehicle_sim/vehicle", "hlc::simulated_vehicle"},
    {"tests/simulation", "hlc::closed_loop"},
    {"tests/support", "hlc::test"},
    {"tests/benchmarks", "hlc::test"},
    {"tests/integration", "hlc::test"},
    {"tests/soak", "hlc::test"},
    {"tests/fuzz", "hlc::fuzz"},
    {"tests/house", "hlc::test"},
};

/// Of a file in a room, planner/search/ompl/ompl_engine.cpp, or one of its tests.
std::string namespace_of(std::string file) {
  if (file.starts_with("tests/") && !kNamespaces.contains(file.substr(0, file.find('/', 6)))) {
    file = file.substr(6);
  }
  for (fs::path path = file; path.has_parent_path(); path = path.parent_path()) {
    const auto found = kNamespaces.find(path.generic_string());
    if (found != kNamespaces.end()) return found->second;
  }
  return "hlc::" + (++fs::path(file).begin())->string();
}

/// Whether `name` is the namespace `outer` or one inside it.
bool is_within(const std::string& name, const std::string& outer) {
  return name == outer || name.starts_with(outer + "::");
}

/// What is wrong with one line of a file, or nothing.
std::optional<std::string> namespace_fault_of(const std::string& file, const std::string& line) {
  static const std::regex kOpen(R"(^\s*(?:inline\s+)?namespace\s+(hlc[\w:]*)\s*\{.*)");
  static const std::regex kUsing(R"(^\s*using\s+namespace\s.*)");
  std::smatch match;
  if (std::regex_match(line, match, kOpen)) {
    const std::string room = namespace_of(file);
    if (is_within(match[1], room)) return std::nullopt;
    if (file.starts_with("tests/") && is_within(match[1], "hlc::test")) return std::nullopt;
    return file + " opens " + match.str(1) + ": its room is " + room;
  }
  if (file.ends_with(".hpp") && std::regex_match(line, kUsing)) {
    return file + ": using namespace in a header";
  }
  return std::nullopt;
}

TEST(Namespaces, AFileOpensOnlyThatOfItsRoom) {
  const fs::path root = source_folder();
  std::size_t num_files = 0;
  for (const char* top : {"planner", "hlc_bridge", "vehicle_sim", "tests"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".hpp" && extension != ".cpp") continue;
      ++num_files;
      const std::string file = entry.path().lexically_relative(root).generic_string();
      std::ifstream stream(entry.path());
      for (std::string line; std::getline(stream, line);) {
        const std::optional<std::string> fault = namespace_fault_of(file, line);
        EXPECT_FALSE(fault) << *fault;
      }
    }
  }
  EXPECT_GT(num_files, 50U);
}

TEST(Namespaces, OneOfAnotherRoomIsNoticed) {
  EXPECT_FALSE(namespace_fault_of("planner/search/collision.cpp", "namespace hlc::search {"));
  EXPECT_FALSE(
      namespace_fault_of("planner/search/ompl/ompl_engine.hpp", "namespace hlc::search {"));
  EXPECT_FALSE(
      namespace_fault_of("tests/planner/search/frame_test.cpp", "namespace hlc::search {"));
  EXPECT_FALSE(namespace_fault_of("tests/planner/search/frame_test.cpp", "namespace hlc::test {"));
  EXPECT_FALSE(namespace_fault_of("planner/automaton/trim_id.hpp", "namespace hlc {"));
  EXPECT_TRUE(namespace_fault_of("planner/search/collision.cpp", "namespace hlc {"));
  EXPECT_TRUE(namespace_fault_of("planner/search/collision.cpp", "namespace hlc::test {"));
  EXPECT_TRUE(namespace_fault_of("planner/search/collision.cpp", "namespace hlc::road {"));
  EXPECT_TRUE(namespace_fault_of("planner/automaton/automaton.hpp", "namespace hlc {"));
  EXPECT_TRUE(namespace_fault_of("tests/planner/search/frame_test.cpp", "namespace hlc {"));
  EXPECT_TRUE(namespace_fault_of("tests/soak/soak_test.cpp", "namespace hlc::soak {"));
}

TEST(Namespaces, ADirectiveInAHeaderIsNoticed) {
  EXPECT_TRUE(namespace_fault_of("planner/road/route.hpp", "using namespace search;"));
  EXPECT_FALSE(namespace_fault_of("planner/road/route.cpp", "using namespace search;"));
}

}  // namespace
}  // namespace hlc::test
