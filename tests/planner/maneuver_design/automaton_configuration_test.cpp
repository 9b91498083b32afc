#include "planner/maneuver_design/automaton_configuration.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace hlc {
namespace {

const std::string kGood =
    R"(vehicle: {wheelbase_m: 0.15, rear_axle_to_cg_m: 0.075, length_m: 0.22, width_m: 0.107}
limits:
  acceleration_mps2: 12
  steering_rate_radps: 6.2
  speed_min_mps: 0
  speed_max_mps: 3.7
  steering_max_rad: 0.62
trims:
  - {speed_mps: 0, steering_rad: 0}
  - {speed_mps: 0.8, steering_rad: 0}
step_s: 0.2
criteria: [J2]
subgraphs:
  - {name: B, label: J2, trims: all}
)";

/// Reads the text from a file of this name in the test's own folder.
AutomatonConfiguration read(const std::string& text) {
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / (std::string(test->name()) + ".yaml");
  std::ofstream(path) << text;
  AutomatonConfiguration configuration;
  try {
    configuration = read_automaton_configuration(path);
  } catch (const std::invalid_argument& error) {
    std::filesystem::remove(path);
    std::string message = error.what();
    const std::string folder = path.string();
    EXPECT_EQ(message.substr(0, folder.size()), folder);
    EXPECT_EQ(message.find('\n'), std::string::npos);
    throw std::invalid_argument("FILE" + message.substr(folder.size()));
  }
  std::filesystem::remove(path);
  return configuration;
}

/// Message for the good text with one piece replaced.
std::string message(const std::string& piece, const std::string& replacement) {
  std::string text = kGood;
  const std::size_t at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  text.replace(at, piece.size(), replacement);
  try {
    (void)read(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(AutomatonConfiguration, TheShippedFileHoldsThePapersTrimsAndTheDefaults) {
  const auto c = read_automaton_configuration(HLC_SOURCE_DIR "/launch_scripts/automata/paper.yaml");
  ASSERT_EQ(c.trims.size(), 12U);
  EXPECT_EQ(c.trims[0], (Trim{0.0, 0.0}));
  EXPECT_EQ(c.trims[1], (Trim{0.4, -0.60}));
  EXPECT_EQ(c.trims[6], (Trim{0.8, 0.0}));
  EXPECT_EQ(c.trims[11], (Trim{0.4, 0.60}));
  EXPECT_EQ(c.vehicle.wheelbase_m, VehicleParameters{}.wheelbase_m);
  EXPECT_EQ(c.vehicle.rear_axle_to_cg_m, VehicleParameters{}.rear_axle_to_cg_m);
  EXPECT_EQ(c.vehicle.footprint.length_m, VehicleParameters{}.footprint.length_m);
  EXPECT_EQ(c.vehicle.footprint.width_m, VehicleParameters{}.footprint.width_m);
  EXPECT_EQ(c.vehicle.safety_margin_m, VehicleParameters{}.safety_margin_m);
  EXPECT_EQ(c.limits.acceleration_mps2, VehicleLimits{}.acceleration_mps2);
  EXPECT_EQ(c.limits.steering_rate_radps, VehicleLimits{}.steering_rate_radps);
  EXPECT_EQ(c.limits.speed_min_mps, VehicleLimits{}.speed_min_mps);
  EXPECT_EQ(c.limits.speed_max_mps, VehicleLimits{}.speed_max_mps);
  EXPECT_EQ(c.limits.steering_max_rad, VehicleLimits{}.steering_max_rad);
  EXPECT_EQ(c.step_s, 0.2);
  EXPECT_EQ(c.intervals, 20U);
  EXPECT_EQ(c.criteria, (std::vector<std::string>{"J2"}));
  ASSERT_EQ(c.subgraphs.size(), 2U);
  EXPECT_EQ(c.subgraphs[0].name, "B");
  EXPECT_EQ(c.subgraphs[0].trims.size(), 12U);
  EXPECT_EQ(c.subgraphs[1].name, "D");
  EXPECT_EQ(c.subgraphs[1].trims.size(), 8U);
  EXPECT_EQ(c.subgraphs[1].trims[2], TrimId{3});
}

TEST(AutomatonConfiguration, OptionalKeysHaveTheirDefaults) {
  const AutomatonConfiguration c = read(kGood);
  EXPECT_EQ(c.intervals, 20U);
  EXPECT_EQ(c.vehicle.safety_margin_m, 0.010);
  EXPECT_EQ(c.identified.slip_gain_rad, IdentifiedVehicle{}.slip_gain_rad);
}

TEST(AutomatonConfiguration, TheIdentifiedVehicleCanBeChanged) {
  EXPECT_EQ(message("width_m: 0.107", "width_m: 0.107, identified: {slip_gain_rad: 0.3}"),
            "no error");
  EXPECT_EQ(message("width_m: 0.107", "width_m: 0.107, identified: {slip_gain: 0.3}").substr(0, 60),
            "FILE:1: vehicle.identified.slip_gain = 0.3, unknown key, all");
  EXPECT_EQ(
      message("width_m: 0.107", "width_m: 0.107, identified: {path_speed_steering: 0.3}"),
      "FILE:1: vehicle.identified.path_speed_steering = 0.3, allowed a number >= -1 and <= 0");
}

TEST(AutomatonConfiguration, RefusesWhatIsWrongNamingLineKeyValueAndRule) {
  EXPECT_EQ(message("acceleration_mps2: 12", "acceleration_mps2: -12"),
            "FILE:3: limits.acceleration_mps2 = -12, allowed a number > 0");
  EXPECT_EQ(message("acceleration_mps2: 12", "acceleration_mps2: fast"),
            "FILE:3: limits.acceleration_mps2 = fast, allowed a number > 0");
  EXPECT_EQ(message("speed_max_mps: 3.7", "speed_max_mps: 0"),
            "FILE:6: limits.speed_max_mps = 0, allowed a number > 0");
  EXPECT_EQ(message("speed_min_mps: 0", "speed_min_mps: -1"),
            "FILE:5: limits.speed_min_mps = -1, allowed a number >= 0");
  EXPECT_EQ(message("steering_max_rad: 0.62", "steering_max_rad: 1.6"),
            "FILE:7: limits.steering_max_rad = 1.6, allowed a number > 0 and <= 1.5");
  EXPECT_EQ(
      message("steering_max_rad: 0.62", "steering_max_rad: 0.62\n  jerk: 1"),
      "FILE:8: limits.jerk = 1, unknown key, allowed keys acceleration_mps2, steering_rate_radps, "
      "speed_min_mps, speed_max_mps, steering_max_rad");
  EXPECT_EQ(message("step_s: 0.2", "step_s: 0"), "FILE:11: step_s = 0, allowed a number > 0");
  EXPECT_EQ(message("step_s: 0.2\n", ""), "FILE:1: step_s is missing, allowed a number > 0");
  EXPECT_EQ(message("step_s: 0.2", "step_s: 0.2\nintervals: 5"),
            "FILE:12: intervals = 5, allowed a whole number >= 10 and <= 1000");
  EXPECT_EQ(message("rear_axle_to_cg_m: 0.075", "rear_axle_to_cg_m: 0.2"),
            "FILE:1: vehicle.rear_axle_to_cg_m = 0.2, allowed a number >= 0 and <= 0.15");
  EXPECT_EQ(message("width_m: 0.107", "width_m: 0.107, safety_margin_m: -0.1"),
            "FILE:1: vehicle.safety_margin_m = -0.1, allowed a number >= 0");
}

TEST(AutomatonConfiguration, RefusesTrimsOutsideTheLimitsTwiceOrWithoutStandstill) {
  EXPECT_EQ(message("speed_mps: 0.8, steering_rad: 0", "speed_mps: 4, steering_rad: 0"),
            "FILE:10: trims[2].speed_mps = 4, allowed a number >= 0 and <= 3.7");
  EXPECT_EQ(message("speed_mps: 0.8, steering_rad: 0", "speed_mps: 0.8, steering_rad: -0.7"),
            "FILE:10: trims[2].steering_rad = -0.7, allowed a number >= -0.62 and <= 0.62");
  EXPECT_EQ(message("speed_mps: 0.8, steering_rad: 0", "speed_mps: 0, steering_rad: 0"),
            "FILE:10: trims[2] = (a map), allowed trims that differ from each other");
  EXPECT_EQ(message("speed_mps: 0, steering_rad: 0", "speed_mps: 0.4, steering_rad: 0"),
            "FILE:8: trims = (a list), allowed at least one trim of speed 0");
}

TEST(AutomatonConfiguration, RefusesUnknownCriteriaAndBadSubgraphs) {
  EXPECT_EQ(message("criteria: [J2]", "criteria: [J0]"),
            "FILE:12: criteria[1] = J0, allowed J1, J2, J3, comfort, energy, stopping_distance, "
            "travel_time");
  EXPECT_EQ(message("criteria: [J2]", "criteria: []"),
            "FILE:12: criteria = (a list), allowed at least one criterion");
  EXPECT_EQ(message("criteria: [J2]", "criteria: [J2, J2]"),
            "FILE:12: criteria[2] = J2, allowed each criterion once");
  EXPECT_EQ(message("label: J2", "label: J1"), "FILE:14: subgraphs[1].label = J1, allowed J2");
  EXPECT_EQ(message("trims: all", "trims: some"),
            "FILE:14: subgraphs[1].trims = some, allowed all");
  EXPECT_EQ(message("trims: all", "trims: [1, 3]"),
            "FILE:14: subgraphs[1].trims[2] = 3, allowed a whole number >= 1 and <= 2");
  EXPECT_EQ(message("trims: all", "trims: [1, 2, 1]"),
            "FILE:14: subgraphs[1].trims[3] = 1, allowed each trim once");
  EXPECT_EQ(message("trims: all", "trims: [2]"),
            "FILE:14: subgraphs[1].trims = (a list), allowed a list that holds a trim of speed 0");
  EXPECT_EQ(message("trims: all}", "trims: all}\n  - {name: B, label: J2, trims: all}"),
            "FILE:15: subgraphs[2].name = B, allowed a name that no other subgraph has");
}

}  // namespace
}  // namespace hlc
