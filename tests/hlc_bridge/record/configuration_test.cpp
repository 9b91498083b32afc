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

TEST(Configuration, ChoicesOfARunLeadToTheCopiesInItsFolder) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "configuration");
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
  std::filesystem::create_directories(folder / "configuration");
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

TEST(Configuration, FolderWithoutFlagsIsNamed) {
  const test::TemporaryFolder folder;
  EXPECT_THAT([&] { static_cast<void>(kept_choices(folder.path())); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("flags.yaml: missing")));
}

}  // namespace
}  // namespace hlc::record
