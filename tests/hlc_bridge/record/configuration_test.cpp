#include "hlc_bridge/record/configuration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "planner/common/text_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::record {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Configuration, KeepsCopiesWhosePathsToEachOtherStayGood) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "scenarios");
  std::filesystem::create_directories(folder / "maps");
  std::filesystem::create_directories(folder / "run");
  test::put(folder / "scenarios" / "s.yaml", "map: ../maps/m.xml");
  test::put(folder / "maps" / "m.xml", "<map/>");
  const std::filesystem::path configuration = folder / "run" / "configuration";
  keep_configuration(folder / "run", {folder / "scenarios" / "s.yaml",
                                      folder / "scenarios" / ".." / "maps" / "m.xml"});
  EXPECT_EQ(read_file(configuration / "scenarios" / "s.yaml"), "map: ../maps/m.xml");
  EXPECT_EQ(read_file(configuration / "scenarios" / ".." / "maps" / "m.xml"), "<map/>");
}

TEST(Configuration, MissingFileIsNamed) {
  const test::TemporaryFolder folder;
  EXPECT_THAT([&] { keep_configuration(folder.path(), {folder / "nothing.yaml"}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("nothing.yaml: cannot be read")));
}

// It ended the program with the library's words, "cannot make absolute path".
TEST(Configuration, AnEmptyPathInTheFlagsOfARunIsRefusedByItsKey) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "configuration");
  const std::string flags = flags_yaml({.file = "/s.yaml", .map_file = "/m.xml"});
  for (const auto& [path, key] : {std::pair("/s.yaml", "scenario"), std::pair("/m.xml", "map")}) {
    std::string text = flags;
    text.erase(text.find(path), std::string(path).size());
    test::put(folder / "configuration" / "flags.yaml", text);
    EXPECT_THAT([&] { static_cast<void>(kept_choices(folder.path())); },
                testing::ThrowsMessage<std::invalid_argument>(
                    testing::HasSubstr(std::string(key) + " = , must be a path")));
  }
}

TEST(Configuration, ARuleInPythonIsNamedAsWhatItIs) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "configuration");
  test::put(folder / "configuration" / "flags.yaml",
            flags_yaml({.file = "/s.yaml", .priorities = kRuleInPython}));
  EXPECT_THAT(
      [&] { static_cast<void>(kept_choices(folder.path())); },
      ThrowsMessage<std::invalid_argument>(
          folder.path().string() +
          ": a run whose priorities are a rule in Python, which only Python can drive; must "
          "be a run with a rule that has a name"));
}

TEST(Configuration, ChoicesOfARunLeadToTheCopiesInItsFolder) {
  const test::TemporaryFolder folder;
  const std::filesystem::path configuration = folder / "configuration";
  for (const char* name : {"scenarios/s.yaml", "maps/m.xml"}) {
    std::filesystem::create_directories((configuration / name).parent_path());
    test::put(configuration / name, "copy");
  }
  const scenario::ScenarioChoices choices{.file = "/home/anna's/scenarios/s.yaml",
                                          .profile = "2022",
                                          .engine = {},
                                          .subgraph = "D",
                                          .policy = "zones, then \"fast\"",
                                          .map_file = "/elsewhere/maps/m.xml",
                                          .steps = 20,
                                          .cars = {},
                                          .seed = 7,
                                          .routes = scenario::kRandomRoutes};
  test::put(folder / "configuration" / "flags.yaml", flags_yaml(choices));
  const scenario::ScenarioChoices kept = kept_choices(folder.path());
  EXPECT_EQ(kept.file, folder / "configuration" / "scenarios" / "s.yaml");
  EXPECT_EQ(kept.profile, "2022");
  EXPECT_EQ(kept.engine, std::nullopt);
  EXPECT_EQ(kept.subgraph, "D");
  EXPECT_EQ(kept.policy, choices.policy);
  EXPECT_EQ(kept.map_file, folder / "configuration" / "maps" / "m.xml");
  EXPECT_EQ(kept.cars, std::nullopt);
  EXPECT_EQ(kept.seed, 7U);
  EXPECT_EQ(kept.routes, scenario::kRandomRoutes);
}

TEST(Configuration, ReadsWhatTheScriptWrites) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "configuration" / "scenarios");
  test::put(folder / "configuration" / "scenarios" / "circle.yaml", "copy");
  test::put(
      folder / "configuration" / "flags.yaml",
      "scenario: '/a/scenarios/circle.yaml'\nprofile: 'default'\nengine: null\nsubgraph: null\n"
      "map: null\ncars: 6\nsteps: 60\nsimulated_time: true\n");
  const scenario::ScenarioChoices kept = kept_choices(folder.path());
  EXPECT_EQ(kept.file, folder / "configuration" / "scenarios" / "circle.yaml");
  EXPECT_EQ(kept.subgraph, std::nullopt);
  EXPECT_EQ(kept.policy, std::nullopt);
  EXPECT_EQ(kept.map_file, std::nullopt);
  EXPECT_EQ(kept.cars, 6U);
}

/// A run of circle.yaml with six cars and noise, whose scenario is copied.
class ChoicesOfRun : public testing::Test {
 protected:
  ChoicesOfRun() {
    std::filesystem::create_directories(scenario_.parent_path());
    test::put(scenario_, "cars: 4\n");
    test::put(flags_,
              "scenario: '/a/scenarios/circle.yaml'\nprofile: '2022'\nengine: null\ncars: 6\n"
              "noise_seed: 3\n");
  }

  [[nodiscard]] RunChoices choices(const RunChoices& given) const {
    return choices_of_run(folder_.path(), given);
  }
  void expect_refusal(const RunChoices& given, const std::string& message) const {
    EXPECT_THAT([&] { static_cast<void>(choices(given)); },
                ThrowsMessage<std::invalid_argument>(message + ": the run was driven so (" +
                                                     flags_.string() + ")"));
  }
  static RunChoices nothing() { return {.scenario = {.profile = ""}, .noise_seed = {}}; }

  test::TemporaryFolder folder_;
  std::filesystem::path scenario_{folder_ / "configuration" / "scenarios" / "circle.yaml"};
  std::filesystem::path flags_{folder_ / "configuration" / "flags.yaml"};
};

TEST_F(ChoicesOfRun, AreThoseOfItsFolder) {
  const RunChoices run = choices(nothing());
  EXPECT_EQ(run.scenario.file, scenario_);
  EXPECT_EQ(run.scenario.profile, "2022");
  EXPECT_EQ(run.scenario.cars, 6U);
  EXPECT_EQ(run.noise_seed, 3U);
}

TEST_F(ChoicesOfRun, MayBeRepeated) {
  test::put(folder_ / "circle.yaml", "cars: 4\n");
  const RunChoices run =
      choices({.scenario = {.file = folder_ / "circle.yaml", .profile = "2022", .cars = 6},
               .noise_seed = 3});
  EXPECT_EQ(run.scenario.file, scenario_);
}

TEST_F(ChoicesOfRun, AreNotContradicted) {
  RunChoices given = nothing();
  given.scenario.cars = 5;
  expect_refusal(given, "--cars = 5, must be 6");
  given = nothing();
  given.scenario.profile = "default";
  expect_refusal(given, "--profile = default, must be 2022");
  given = nothing();
  given.scenario.subgraph = "D";
  expect_refusal(given, "--subgraph = D, must be left out");
  given = nothing();
  given.noise_seed = 4;
  expect_refusal(given, "--noise_seed = 4, must be 3");
  given = nothing();
  given.scenario.file = folder_ / "circle.yaml";
  test::put(given.scenario.file, "cars: 5\n");
  expect_refusal(given, "--scenario = " + given.scenario.file.string() + ", must be " +
                            scenario_.string() + ", or the same");
}

TEST_F(ChoicesOfRun, WithoutFlagsAreThoseThatAreGiven) {
  std::filesystem::remove(flags_);
  RunChoices given = nothing();
  EXPECT_THAT([&] { static_cast<void>(choices(given)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("--scenario must be given")));
  given.scenario.file = folder_ / "circle.yaml";
  given.scenario.cars = 5;
  EXPECT_EQ(choices(given).scenario.file, given.scenario.file);
  EXPECT_EQ(choices(given).scenario.profile, "default");
  EXPECT_EQ(choices(given).scenario.cars, 5U);
}

TEST_F(ChoicesOfRun, OfAFileThatIsNotCopiedYetLeadToTheFile) {
  std::filesystem::remove(scenario_);
  EXPECT_EQ(choices(nothing()).scenario.file, "/a/scenarios/circle.yaml");
}

TEST(Configuration, ForksAreReadBackAndNameTheirObstaclesAndTheVehiclesTheyTakeOut) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "configuration");
  const std::vector<KeptFork> written{
      {.from = 4, .set = {"without=12", "obstacle=1.5,-2,0.4,0.3,0.25"}},
      {.from = 9, .set = {"obstacle=3,4,1,2", "speed=1:0.5"}}};
  write_file(forks_file(folder.path()), forks_yaml(written));
  const std::vector<KeptFork> forks = kept_forks(folder.path());
  EXPECT_EQ(forks_text(forks),
            "a fork: from step 4 on without=12, obstacle=1.5,-2,0.4,0.3,0.25; from step 9 on "
            "obstacle=3,4,1,2, speed=1:0.5");
  EXPECT_TRUE(takes_out(forks, 12));
  EXPECT_FALSE(takes_out(forks, 1));
  result::RunDescription description;
  add_obstacles(forks, description);
  const std::vector<result::Obstacle>& obstacles = description.obstacles;
  ASSERT_EQ(obstacles.size(), 2U);
  EXPECT_EQ(obstacles[0].from, 4U);
  EXPECT_EQ(obstacles[0].area_m, footprint_area({0.4, 0.3}, {1.5, -2.0, 0.25}));
  EXPECT_EQ(obstacles[1].area_m, footprint_area({1.0, 2.0}, {3.0, 4.0, 0.0}));
  EXPECT_EQ(forks_text({}), "");
  const KeptFork nothing_changed{.from = 2, .set = {}};
  EXPECT_EQ(forks_text({&nothing_changed, 1}), "a fork: from step 2 on nothing changed");
}

TEST(Configuration, FolderWithoutFlagsIsNamed) {
  const test::TemporaryFolder folder;
  EXPECT_THAT([&] { static_cast<void>(kept_choices(folder.path())); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("flags.yaml: missing")));
}

}  // namespace
}  // namespace hlc::record
