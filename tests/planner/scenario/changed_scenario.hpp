#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {

/// Texts of a file and what takes their place.
using TextChanges = std::vector<std::pair<std::string, std::string>>;

/// A shipped scenario with changes and further lines.
inline scenario::Scenario changed_scenario(const std::string& name, const std::string& lines,
                                           const TextChanges& changes = {},
                                           scenario::ScenarioChoices choices = {}) {
  const std::string shipped_in = source_folder() + "/launch_scripts/";
  std::ifstream shipped(shipped_in + "scenarios/" + name + ".yaml");
  std::string text((std::istreambuf_iterator<char>(shipped)), {});
  for (const auto& [from, to] : changes) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }
  for (std::size_t place = 0; (place = text.find("../", place)) != std::string::npos;) {
    text.replace(place, 3, shipped_in);
  }
  const TemporaryFolder folder;
  choices.file = folder / "scenario.yaml";
  std::ofstream(choices.file) << text << '\n' << lines << '\n';
  return scenario::read_scenario(choices);
}

/// The message with which it is refused; empty: it is not.
inline std::string error_of_scenario(const std::string& name, const std::string& lines,
                                     const TextChanges& changes = {}) {
  try {
    static_cast<void>(changed_scenario(name, lines, changes));
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace hlc::test
