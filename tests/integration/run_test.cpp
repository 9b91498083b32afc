// Whole runs with real processes in logical time.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <random>
#include <regex>

#include "tests/integration/lab_processes.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

/// Runs to the end and returns the summary.
nlohmann::json drive(LabProcesses& lab, const std::vector<std::string>& order) {
  for (const std::string& name : order) lab.start(name);
  EXPECT_THAT(lab.still_running_after(120s), testing::IsEmpty());
  for (const std::string& name : order) {
    EXPECT_EQ(lab[name].wait_for(0ms), 0) << name << ": " << lab.log(name);
  }
  EXPECT_EQ(lab.summarize(), 0) << lab.log("summarize");
  return nlohmann::json::parse(read_text(lab.folder() / "summary.json"), nullptr, false);
}

TEST(Run, ThreeCarsDriveThePapersScenarioToTheEnd) {
  LabProcesses lab({.steps = 150});
  const nlohmann::json summary = drive(lab, lab.names());
  ASSERT_TRUE(summary.is_object());
  EXPECT_EQ(summary["steps"], 150);
  EXPECT_EQ(summary["collisions"], 0);
  EXPECT_GT(summary["min_footprint_distance_m"].get<double>(), 0.0);
  ASSERT_EQ(summary["vehicles"].size(), 3U);
  for (const nlohmann::json& vehicle : summary["vehicles"]) {
    EXPECT_EQ(vehicle["fallback_steps"], 0);
    EXPECT_EQ(vehicle["deadline_misses"], 0);
    EXPECT_LE(vehicle["tracking_error_mm"]["max"].get<double>(), 20.0) << vehicle["name"];
    EXPECT_LE(vehicle["tracking_error_mm"]["mean"].get<double>(), 10.0) << vehicle["name"];
    EXPECT_GT(vehicle["tracking_error_mm"]["max"].get<double>(), 0.0)
        << "the plan is not the drive";
  }
  EXPECT_GE(summary["vehicles"][0]["lap_s"].get<double>(), 15.5);
  EXPECT_LE(summary["vehicles"][0]["lap_s"].get<double>(), 16.7);
}

struct Variant {
  std::string name;
  std::string profile;
  std::string map_file;
};
void PrintTo(const Variant& one, std::ostream* out) { *out << one.name; }

class Variants : public testing::TestWithParam<Variant> {};

TEST_P(Variants, ThreeCarsDriveToTheEndWithoutFallbacks) {
  const Variant& variant = GetParam();
  if (!variant.map_file.empty() && !std::filesystem::exists(variant.map_file)) {
    GTEST_SKIP() << variant.map_file << " is not there";
  }
  LabProcesses lab({.profile = variant.profile, .map_file = variant.map_file, .steps = 150});
  const nlohmann::json summary = drive(lab, lab.names());
  ASSERT_TRUE(summary.is_object());
  EXPECT_EQ(summary["profile"], variant.profile);
  EXPECT_EQ(summary["steps"], 150);
  EXPECT_EQ(summary["collisions"], 0);
  ASSERT_EQ(summary["vehicles"].size(), 3U);
  for (const nlohmann::json& vehicle : summary["vehicles"]) {
    EXPECT_EQ(vehicle["fallback_steps"], 0) << vehicle["name"];
    EXPECT_TRUE(vehicle["lap_s"].is_number()) << vehicle["name"];
  }
}

const std::string kLabsMap = test::source_folder() + "/../shared/data/LabMapCommonRoad.xml";

INSTANTIATE_TEST_SUITE_P(Run, Variants,
                         testing::Values(Variant{"Profile2022", "2022", ""},
                                         Variant{"LabsMap", "default", kLabsMap},
                                         Variant{"LabsMapProfile2022", "2022", kLabsMap}),
                         [](const auto& one) { return one.param.name; });

TEST(Run, TheSameScenarioGivesTheSameBytesInWhateverOrderTheProcessesStart) {
  std::string steps;
  std::string hash;
  for (unsigned seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    LabProcesses lab({.steps = 40, .noise_seed = 7});
    std::vector<std::string> order = lab.names();
    std::mt19937 random(seed);
    std::ranges::shuffle(order, random);
    // Work beside the run, so that processes are not always served in the same order.
    ChildProcess load({"/bin/sh", "-c", "while :; do :; done"}, lab.folder() / "logs" / "load.log");
    const nlohmann::json summary = drive(lab, order);
    ASSERT_TRUE(summary.is_object());
    const std::string these_steps = read_text(lab.folder() / "steps.csv");
    EXPECT_GT(these_steps.size(), 1000U);
    if (seed == 0) {
      steps = these_steps;
      hash = summary["trace_sha256"];
    }
    EXPECT_EQ(these_steps, steps);
    EXPECT_EQ(summary["trace_sha256"], hash);
  }
}

// The controllers' plans alone move nothing: with the followers' gains at zero the cars stay where
// they are.
TEST(Run, WithoutTheFollowersGainsTheRunFails) {
  LabProcesses lab({.steps = 15, .vehicle_flags = {"--gains_scale=0"}});
  lab.start_all();
  ASSERT_THAT(lab.still_running_after(120s), testing::IsEmpty());
  EXPECT_EQ(lab.summarize(), 5) << lab.log("summarize");
}

TEST(Run, MeasurementNoiseDoesNotMakeCarsTouch) {
  LabProcesses lab({.steps = 100, .noise_seed = 3});
  const nlohmann::json summary = drive(lab, lab.names());
  ASSERT_TRUE(summary.is_object());
  EXPECT_EQ(summary["collisions"], 0);
}

TEST(Run, CarsOnACircleCrossWithoutTouching) {
  LabProcesses lab({.scenario = "circle", .steps = 60});
  const nlohmann::json summary = drive(lab, lab.names());
  ASSERT_TRUE(summary.is_object());
  EXPECT_EQ(summary["collisions"], 0);
  EXPECT_EQ(summary["vehicles"].size(), 4U);
  EXPECT_TRUE(summary["vehicles"][0]["lap_s"].is_null());
}

/// The shipped scenario with `rounds: two`.
std::filesystem::path in_two_rounds(const std::string& name, const TemporaryFolder& folder) {
  const std::string scripts = source_folder() + "/launch_scripts";
  const std::string text = read_text(scripts + "/scenarios/" + name + ".yaml");
  std::filesystem::path file = folder.path() / (name + ".yaml");
  std::ofstream(file) << std::regex_replace(text, std::regex(R"(\.\./)"), scripts + "/")
                      << "rounds: two\n";
  return file;
}

TEST(Run, InTwoRoundsCarsDriveAsTheyDoOneAfterTheOther) {
  const TemporaryFolder folder;
  constexpr int kSteps = 40 / static_cast<int>(kThinning);
  LabProcesses sequential({.scenario = "lab_cars", .cars = 5, .steps = kSteps});
  const nlohmann::json expected = drive(sequential, sequential.names());
  LabProcesses two(
      {.scenario = in_two_rounds("lab_cars", folder).string(), .cars = 5, .steps = kSteps});
  const nlohmann::json summary = drive(two, two.names());
  ASSERT_TRUE(summary.is_object());
  EXPECT_EQ(summary["trace_sha256"], expected["trace_sha256"]);
  for (int id = 1; id <= 5; ++id) {
    EXPECT_THAT(two.log("high_level_controller_" + std::to_string(id)),
                testing::Not(testing::HasSubstr("one after the other")));
  }
}

// The middleware of the fifth car used to be in the first domain of another test, and its end ended
// that test's processes.
TEST(Run, EveryDomainOfALabIsReserved) {
  const LabProcesses lab({.scenario = "lab_cars", .cars = 20});
  const int last = lab.lab_domain() + 20;
  for (int domain = lab.lab_domain(); domain <= last; ++domain) {
    const std::string file = domain_lock_file(domain);
    const int lock = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    EXPECT_GE(lock, 0) << file;
    EXPECT_NE(flock(lock, LOCK_EX | LOCK_NB), 0) << file << " is free";
    close(lock);
  }
}

TEST(Run, RealTimeDrivesToTheEnd) {
  LabProcesses lab({.steps = 15, .simulated_time = false});
  for (const std::string& name : lab.names()) lab.start(name);
  ASSERT_THAT(lab.still_running_after(120s), testing::IsEmpty());
  EXPECT_EQ(lab["lab_control"].wait_for(0ms), 0) << lab.log("lab_control");
  EXPECT_EQ(lab.summarize(), 0) << lab.log("summarize");
}

}  // namespace
}  // namespace hlc::test
