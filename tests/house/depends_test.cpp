// Holds every target's DEPENDS against the arrows of the house, as layering_test every #include.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/house/arrows.hpp"
#include "tests/support/folders.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;

/// A library or program as a CMakeLists.txt declares it.
struct Target {
  std::string name;
  std::string folder;  ///< from the root
  std::vector<std::string> depends;
};

std::string without_comments(const std::string& text) {
  return std::regex_replace(text, std::regex("#[^\n]*"), "");
}

/// Targets of hlc_add_library, hlc_add_program and what is made of them (add_run_program), and what
/// target_link_libraries adds to them.
std::vector<Target> targets_of(const std::string& folder, const std::string& cmake) {
  static const std::regex kCall(
      R"((hlc_add_library|\w*add\w*_program|target_link_libraries)\s*\(\s*([\w]+)([^)]*)\))");
  static const std::set<std::string> kWords{"PUBLIC", "PRIVATE", "INTERFACE"};
  const std::string text = without_comments(cmake);
  std::vector<Target> targets;
  for (std::sregex_iterator call(text.begin(), text.end(), kCall), end; call != end; ++call) {
    Target target{.name = (*call)[2], .folder = folder, .depends = {}};
    std::istringstream words((*call)[3]);
    bool is_dependency = (*call)[1] == "target_link_libraries";
    for (std::string word; words >> word;) {
      if (word == "SOURCES") {
        is_dependency = false;
      } else if (word == "DEPENDS") {
        is_dependency = true;
      } else if (is_dependency && !kWords.contains(word)) {
        target.depends.push_back(word);
      }
    }
    targets.push_back(std::move(target));
  }
  return targets;
}

/// Of the whole house.
std::vector<Target> all_targets() {
  const fs::path root = source_folder();
  std::vector<Target> targets;
  for (const char* top : {"planner", "hlc_bridge", "vehicle_sim"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.path().filename() != "CMakeLists.txt") continue;
      std::ifstream file(entry.path());
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      const std::string folder =
          entry.path().parent_path().lexically_relative(root).generic_string();
      const std::vector<Target> more = targets_of(folder, text);
      targets.insert(targets.end(), more.begin(), more.end());
    }
  }
  return targets;
}

/// What is wrong with a dependency, or nothing; those on foreign libraries are not looked at.
/// @param folders  of all targets
std::optional<std::string> violation(const Target& target, const std::string& dependency,
                                     const std::map<std::string, std::string>& folders) {
  const auto found = folders.find(dependency);
  if (found == folders.end()) return std::nullopt;
  const std::string from = room_of(target.folder).value();
  const std::string to = room_of(found->second).value();
  if (may_link(from, to)) return std::nullopt;
  return target.name + " DEPENDS " + dependency + ": no arrow from " + from + " to " + to;
}

std::map<std::string, std::string> folders_of(const std::vector<Target>& targets) {
  std::map<std::string, std::string> folders;
  for (const Target& target : targets) folders.try_emplace(target.name, target.folder);
  return folders;
}

TEST(HouseTargets, DependOnlyAlongArrows) {
  const std::vector<Target> targets = all_targets();
  const std::map<std::string, std::string> folders = folders_of(targets);
  std::size_t num_looked_at = 0;
  for (const Target& target : targets) {
    for (const std::string& dependency : target.depends) {
      num_looked_at += folders.count(dependency);
      const std::optional<std::string> fault = violation(target, dependency, folders);
      EXPECT_FALSE(fault) << *fault;
    }
  }
  EXPECT_GT(folders.size(), 40U);
  EXPECT_GT(num_looked_at, 80U);
}

TEST(HouseTargets, DependOnEachOtherInNoCircle) {
  Arrows links;
  for (const Target& target : all_targets()) links[target.name];
  for (const Target& target : all_targets()) {
    for (const std::string& dependency : target.depends) {
      if (links.contains(dependency)) links.at(target.name).insert(dependency);
    }
  }
  EXPECT_EQ(circle_of(links), "");
}

TEST(HouseTargets, ADependencyAgainstTheArrowsIsNoticed) {
  const std::vector<Target> targets = targets_of(
      "planner/geometry",
      "hlc_add_library(low # a comment\n  SOURCES a.cpp\n  DEPENDS high Eigen3::Eigen)\n");
  ASSERT_EQ(targets.size(), 1U);
  EXPECT_EQ(targets[0].depends, (std::vector<std::string>{"high", "Eigen3::Eigen"}));
  const std::map<std::string, std::string> folders{{"low", "planner/geometry"},
                                                   {"high", "planner/search/ompl"}};
  EXPECT_TRUE(violation(targets[0], "high", folders));
  EXPECT_FALSE(violation(targets[0], "Eigen3::Eigen", folders));
  EXPECT_FALSE(
      violation({.name = "high", .folder = "planner/search", .depends = {}}, "low", folders));
}

TEST(HouseTargets, WhatIsLinkedBesideDependsIsNoticedToo) {
  const std::vector<Target> targets = targets_of(
      "planner/search", "target_link_libraries(a PRIVATE b)\nadd_run_program(p\n DEPENDS a)");
  ASSERT_EQ(targets.size(), 2U);
  EXPECT_EQ(targets[0].depends, std::vector<std::string>{"b"});
  EXPECT_EQ(targets[1].depends, std::vector<std::string>{"a"});
}

}  // namespace
}  // namespace hlc::test
