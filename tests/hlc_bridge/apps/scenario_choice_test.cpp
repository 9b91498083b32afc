#include "hlc_bridge/apps/scenario_choice.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;

/// A program's folder with the scenarios of the installation.
class ScenarioChoice : public testing::Test {
 protected:
  ScenarioChoice() {
    fs::create_directory(program_ / "scenarios");
    for (const char* name : {"lab_three_cars", "lab_circle", "lab_cars", "paper_red_alone"}) {
      test::put(scenario(name), std::string("name: ") + name);
    }
  }
  [[nodiscard]] fs::path scenario(const std::string& name) const {
    return program_ / "scenarios" / (name + ".yaml");
  }
  void write_default(const std::string& text) const {
    test::put(program_ / "default_scenario", text);
  }
  /// Message of the refusal.
  [[nodiscard]] std::string refusal(const std::string& environment) const {
    try {
      return "accepted: " + scenario_file("", environment, program_ / "").string();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  }
  const test::TemporaryFolder program_;
};

TEST_F(ScenarioChoice, TheFlagComesBeforeTheEnvironmentAndThatBeforeTheFileBesideTheProgram) {
  EXPECT_EQ(scenario_file("", "", program_ / ""), scenario("lab_three_cars"));
  write_default("paper_red_alone\n");
  EXPECT_EQ(scenario_file("", "", program_ / ""), scenario("paper_red_alone"));
  EXPECT_EQ(scenario_file("", "lab_circle", program_ / ""), scenario("lab_circle"));
  EXPECT_EQ(scenario_file("lab_cars", "lab_circle", program_ / ""), scenario("lab_cars"));
}

TEST_F(ScenarioChoice, AFileInPlaceOfANameIsTakenAsItIs) {
  const fs::path own = program_ / "own.yaml";
  test::put(own, "name: own\n");
  EXPECT_EQ(scenario_file(own, "", program_ / ""), own);
  EXPECT_EQ(scenario_file("", own.string(), program_ / ""), own);
  write_default("own.yaml\n");
  EXPECT_EQ(scenario_file("", "", program_ / ""), own) << "from the program's folder";
}

TEST_F(ScenarioChoice, AFolderWithTheNameOfAScenarioIsNone) {
  const test::TemporaryFolder working;
  fs::create_directory(working / "lab_three_cars");
  fs::create_directory(working / "lab_circle");
  const fs::path former = fs::current_path();
  fs::current_path(working / "");
  const fs::path by_default = scenario_file("", "", program_ / "");
  const fs::path named = scenario_file("", "lab_circle", program_ / "");
  fs::current_path(former);
  EXPECT_EQ(by_default, scenario("lab_three_cars"));
  EXPECT_EQ(named, scenario("lab_circle"));
}

TEST_F(ScenarioChoice, AnUnknownNameIsRefusedWithItsSource) {
  const std::string missing = ", must name an existing scenario; no file ";
  EXPECT_EQ(refusal("nowhere"), "HLC_SCENARIO = nowhere" + missing + scenario("nowhere").string());
  write_default("anywhere\n");
  EXPECT_EQ(refusal(""), (program_ / "default_scenario").string() + " = anywhere" + missing +
                             scenario("anywhere").string());
}

TEST_F(ScenarioChoice, ADefaultFileThatIsNotOneLineIsRefused) {
  for (const char* text : {"", "\n", "lab_circle\nlab_cars\n", "lab circle\n"}) {
    write_default(text);
    EXPECT_EQ(refusal(""), (program_ / "default_scenario").string() +
                               ": must be one line with a scenario's name or file, without blanks");
  }
}

}  // namespace
}  // namespace hlc::apps
