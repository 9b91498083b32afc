#include "planner/maneuver_design/automaton_configuration.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "planner/automaton/subgraph_yaml.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::maneuver_design {
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

/// Reads the text from a file; FILE stands for its path in a refusal.
AutomatonConfiguration read(const std::string& text) {
  const test::TemporaryFolder temporary;
  const std::filesystem::path path = temporary / "car.yaml";
  std::ofstream(path) << text;
  AutomatonConfiguration configuration;
  try {
    configuration = read_automaton_configuration(path);
  } catch (const std::invalid_argument& error) {
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

TEST(AutomatonConfiguration, EveryShippedFileIsReadAndItsGridsAreOfTheSizeInTheirName) {
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::source_folder() + "/launch_scripts/automata")) {
    if (entry.path().extension() != ".yaml") continue;
    ++files;
    const auto c = read_automaton_configuration(entry.path());
    EXPECT_FALSE(c.subgraphs.empty() && c.edges == EdgeChoice::kSubgraphs) << entry.path();
    const std::string name = entry.path().stem().string();
    if (name.starts_with("ucar_grid_")) {
      EXPECT_EQ(std::to_string(c.trims.size()), name.substr(name.rfind('_') + 1));
    }
  }
  EXPECT_GE(files, 5U);
}

TEST(AutomatonConfiguration, TheShippedFileHoldsThePapersTrimsAndTheDefaults) {
  const auto c =
      read_automaton_configuration(test::source_folder() + "/launch_scripts/automata/paper.yaml");
  ASSERT_EQ(c.trims.size(), 12U);
  EXPECT_EQ(c.trims[0], (automaton::Trim{0.0, 0.0}));
  EXPECT_EQ(c.trims[1], (automaton::Trim{0.4, -0.60}));
  EXPECT_EQ(c.trims[6], (automaton::Trim{0.8, 0.0}));
  EXPECT_EQ(c.trims[11], (automaton::Trim{0.4, 0.60}));
  EXPECT_EQ(c.vehicle.wheelbase_m, vehicle::VehicleParameters{}.wheelbase_m);
  EXPECT_EQ(c.vehicle.rear_axle_to_cg_m, vehicle::VehicleParameters{}.rear_axle_to_cg_m);
  EXPECT_EQ(c.vehicle.footprint.length_m, vehicle::VehicleParameters{}.footprint.length_m);
  EXPECT_EQ(c.vehicle.footprint.width_m, vehicle::VehicleParameters{}.footprint.width_m);
  EXPECT_EQ(c.vehicle.safety_margin_m, vehicle::VehicleParameters{}.safety_margin_m);
  EXPECT_EQ(c.limits.acceleration_mps2, vehicle::VehicleLimits{}.acceleration_mps2);
  EXPECT_EQ(c.limits.steering_rate_radps, vehicle::VehicleLimits{}.steering_rate_radps);
  EXPECT_EQ(c.limits.speed_min_mps, vehicle::VehicleLimits{}.speed_min_mps);
  EXPECT_EQ(c.limits.speed_max_mps, vehicle::VehicleLimits{}.speed_max_mps);
  EXPECT_EQ(c.limits.steering_max_rad, vehicle::VehicleLimits{}.steering_max_rad);
  EXPECT_EQ(c.step_s, 0.2);
  EXPECT_EQ(c.intervals, 20U);
  EXPECT_EQ(c.edges, EdgeChoice::kSubgraphs);
  ASSERT_EQ(c.criteria.size(), 3U);
  ASSERT_EQ(c.subgraphs.size(), 4U);
  const std::vector<std::string> names{"A", "B", "C", "D"};
  const std::vector<std::string> labels{"J1", "J2", "J3", "J3"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(c.subgraphs[i].name, names[i]);
    EXPECT_EQ(c.subgraphs[i].labels, (std::vector<std::string>{labels[i]}));
    EXPECT_EQ(c.subgraphs[i].rule, automaton::EdgeRule::kChain);
    EXPECT_EQ(c.subgraphs[i].trims.size(), i < 3 ? 12U : 8U);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(c.criteria[i].label, labels[i]);
    EXPECT_TRUE(c.criteria[i].weights.empty());
  }
  EXPECT_EQ(c.subgraphs[3].trims[2], TrimId{3});
}

TEST(AutomatonConfiguration, OptionalKeysHaveTheirDefaults) {
  const AutomatonConfiguration c = read(kGood);
  EXPECT_EQ(c.intervals, 20U);
  EXPECT_EQ(c.vehicle.safety_margin_m, 0.010);
  EXPECT_EQ(c.identified.slip_gain_rad, vehicle::IdentifiedVehicle{}.slip_gain_rad);
}

TEST(AutomatonConfiguration, TheIdentifiedVehicleCanBeChanged) {
  EXPECT_EQ(message("width_m: 0.107", "width_m: 0.107, identified: {slip_gain_rad: 0.3}"),
            "no error");
  EXPECT_EQ(message("width_m: 0.107", "width_m: 0.107, identified: {slip_gain: 0.3}").substr(0, 60),
            "FILE:1: vehicle.identified.slip_gain = 0.3, unknown key; kno");
  EXPECT_EQ(
      message("width_m: 0.107", "width_m: 0.107, identified: {path_speed_steering: 0.3}"),
      "FILE:1: vehicle.identified.path_speed_steering = 0.3, must be a number >= -1 and <= 0");
}

TEST(AutomatonConfiguration, AVehicleOfWhichNothingIsIdentifiedDrivesAsTheModelDoes) {
  std::string text = kGood;
  text.replace(text.find("width_m: 0.107"), 14, "width_m: 0.107, identified: kinematic");
  const AutomatonConfiguration c = read(text);
  for (const double share : {-1.0, 0.0, 1.0}) {
    EXPECT_NEAR(automaton::yaw_minus_heading_rad(share * c.limits.steering_max_rad, c.vehicle,
                                                 c.identified),
                0.0, 1e-12);
  }
  for (double delta = -0.62; delta < 0.62; delta += 0.01) {
    EXPECT_NEAR(automaton::yaw_minus_heading_rad(delta, c.vehicle, c.identified), 0.0, 0.01);
  }
  EXPECT_EQ(message("width_m: 0.107", "width_m: 0.107, identified: ideal"),
            "FILE:1: vehicle.identified = ideal, must be kinematic");
}

constexpr const char* kTrims =
    "trims:\n  - {speed_mps: 0, steering_rad: 0}\n  - {speed_mps: 0.8, steering_rad: 0}\n";

TEST(AutomatonConfiguration, ALabelMayBeAPointOfAFront) {
  const std::string list = "criteria: [J2]";
  std::string text = kGood;
  text.replace(text.find(list), list.size(),
               "criteria: [J2, {name: middle, minimise: J1, bound: J2, share: 0.25}]");
  const AutomatonConfiguration c = read(text);
  ASSERT_EQ(c.criteria.size(), 2U);
  ASSERT_TRUE(c.criteria[1].front_point);
  EXPECT_EQ(c.criteria[1].front_point->minimised, "J1");
  EXPECT_EQ(c.criteria[1].front_point->bounded, "J2");
  EXPECT_EQ(c.criteria[1].front_point->share, 0.25);
  const auto refused = [&](const std::string& entry) {
    return message(list, "criteria: [J2, {name: middle, " + entry + "}]");
  };
  EXPECT_EQ(refused("minimise: J1, bound: J1, share: 0.5"),
            "FILE:12: criteria[2].bound = J1, must be another criterion than `minimise`");
  EXPECT_EQ(refused("minimise: J1, bound: J2, share: 1"),
            "FILE:12: criteria[2].share = 1, must be a number between 0 and 1; the ends of the "
            "front are the criteria alone");
  EXPECT_EQ(refused("minimise: J1, bound: J2, share: 0.5, weights: {J1: 1}"),
            "FILE:12: criteria[2].weights = (a map), unknown key; known keys: name, minimise, "
            "bound, share");
}

TEST(AutomatonConfiguration, AGridOfTrimsIsStandstillAndEachSpeedWithEachAngle) {
  std::string text = kGood;
  text.replace(text.find(kTrims), std::string(kTrims).size(),
               "trims: {speeds_mps: [0.4, 0.8], steering_rad: [-0.2, 0, 0.3]}\n");
  const std::vector<automaton::Trim> expected{{0.0, 0.0},  {0.4, -0.2}, {0.4, 0.0}, {0.4, 0.3},
                                              {0.8, -0.2}, {0.8, 0.0},  {0.8, 0.3}};
  EXPECT_EQ(read(text).trims, expected);
}

TEST(AutomatonConfiguration, TheFrictionCircleLimitsTheTrims) {
  // At 0.8 m/s and 0.3 rad: 0.8^2 m^2/s^2 * 2.04 1/m = 1.30 m/s^2.
  std::string text = kGood;
  text.replace(text.find("steering_max_rad: 0.62"), 22,
               "steering_max_rad: 0.62\n  friction_mps2: 1.2");
  text.replace(text.find(kTrims), std::string(kTrims).size(),
               "trims: {speeds_mps: [0.4, 0.8], steering_rad: [0, 0.3]}\n");
  const AutomatonConfiguration c = read(text);
  EXPECT_EQ(c.limits.friction_mps2, 1.2);
  EXPECT_EQ(c.trims,
            (std::vector<automaton::Trim>{{0.0, 0.0}, {0.4, 0.0}, {0.4, 0.3}, {0.8, 0.0}}));
  EXPECT_EQ(message("steering_max_rad: 0.62\ntrims:\n  - {speed_mps: 0, steering_rad: 0}",
                    "steering_max_rad: 0.62\n  friction_mps2: 1.2\ntrims:\n"
                    "  - {speed_mps: 0.8, steering_rad: 0.3}"),
            "FILE:10: trims[1].speed_mps = 0.8, must be less with this steering: the friction "
            "circle is exceeded");
}

TEST(AutomatonConfiguration, RefusesNumbersThatNoVehicleHas) {
  for (const auto& [key, value, allowed] :
       std::vector<std::array<std::string, 3>>{{"wheelbase_m", "0.15", "100"},
                                               {"length_m", "0.22", "100"},
                                               {"acceleration_mps2", "12", "10000"},
                                               {"steering_rate_radps", "6.2", "10000"},
                                               {"speed_max_mps", "3.7", "1000"},
                                               {"step_s", "0.2", "100"}}) {
    const std::string error_text = message(key + ": " + value, key + ": 1e5");
    EXPECT_NE(error_text.find(key + " = 1e5, must be a number > 0 and <= " + allowed),
              std::string::npos)
        << error_text;
  }
}

TEST(AutomatonConfiguration, KnowsWhereItsKeysStand) {
  std::string text = kGood + "  - {name: C, label: J2, trims: all, max_speed_mps: 1}\n";
  const auto without_folder = [](const std::string& place) {
    return place.substr(place.rfind('/') + 1);
  };
  const std::string file = "car.yaml";
  const ConfigurationPlaces places = read(text).places;
  EXPECT_EQ(without_folder(places.intervals), file + ":1: intervals = 20");
  ASSERT_EQ(places.subgraphs.size(), 2U);
  EXPECT_EQ(without_folder(places.subgraphs[0].trims), file + ":14: subgraphs[1].trims = all");
  EXPECT_EQ(places.subgraphs[0].max_speed_mps, "");
  EXPECT_EQ(without_folder(places.subgraphs[1].max_speed_mps),
            file + ":15: subgraphs[2].max_speed_mps = 1");
  text.insert(text.find("criteria"), "intervals: 30\n");
  const AutomatonConfiguration c = read(text);
  EXPECT_EQ(without_folder(c.places.intervals), file + ":12: intervals = 30");
  const AutomatonConfiguration needed = needed_by(c.subgraphs[1], c);
  ASSERT_EQ(needed.places.subgraphs.size(), 1U);
  EXPECT_EQ(without_folder(needed.places.subgraphs[0].trims),
            file + ":16: subgraphs[2].trims = all");
}

TEST(AutomatonConfiguration, RefusesAGridThatIsNone) {
  const std::string allowed =
      "must be a list of {speed_mps, steering_rad}, one of speed 0 among them, or, with "
      "limits.speed_min_mps = 0, a grid {speeds_mps, steering_rad}";
  EXPECT_EQ(message(kTrims, "trims: many\n"), "FILE:8: trims = many, " + allowed);
  EXPECT_EQ(message(kTrims, ""), "FILE:1: trims is missing, " + allowed);
  EXPECT_EQ(message(kTrims, "trims: {speeds_mps: [0.8, 0.4], steering_rad: [0]}\n"),
            "FILE:8: trims.speeds_mps[2] = 0.4, must be larger than the number before");
  EXPECT_EQ(message(kTrims, "trims: {speeds_mps: [0], steering_rad: [0]}\n"),
            "FILE:8: trims.speeds_mps[1] = 0, must be a number > 0 and <= 3.7");
  EXPECT_EQ(message(kTrims, "trims: {speeds_mps: [], steering_rad: [0]}\n"),
            "FILE:8: trims.speeds_mps = (a list), must be a list with at least one number");
}

TEST(AutomatonConfiguration, RefusesWhatIsWrongNamingLineKeyValueAndRule) {
  EXPECT_EQ(message("acceleration_mps2: 12", "acceleration_mps2: -12"),
            "FILE:3: limits.acceleration_mps2 = -12, must be a number > 0 and <= 10000");
  EXPECT_EQ(message("acceleration_mps2: 12", "acceleration_mps2: fast"),
            "FILE:3: limits.acceleration_mps2 = fast, must be a number > 0 and <= 10000");
  EXPECT_EQ(message("speed_max_mps: 3.7", "speed_max_mps: 0"),
            "FILE:6: limits.speed_max_mps = 0, must be a number > 0 and <= 1000");
  EXPECT_EQ(message("speed_min_mps: 0", "speed_min_mps: -1"),
            "FILE:5: limits.speed_min_mps = -1, must be a number >= 0 and <= 1000");
  EXPECT_EQ(message("steering_max_rad: 0.62", "steering_max_rad: 1.6"),
            "FILE:7: limits.steering_max_rad = 1.6, must be a number > 0 and <= 1.5");
  EXPECT_EQ(
      message("steering_max_rad: 0.62", "steering_max_rad: 0.62\n  jerk: 1"),
      "FILE:8: limits.jerk = 1, unknown key; known keys: acceleration_mps2, steering_rate_radps, "
      "speed_min_mps, speed_max_mps, steering_max_rad, friction_mps2, curvature_max_per_m");
  EXPECT_EQ(message("step_s: 0.2", "step_s: 0"),
            "FILE:11: step_s = 0, must be a number > 0 and <= 100");
  EXPECT_EQ(message("step_s: 0.2\n", ""),
            "FILE:1: step_s is missing, must be a number > 0 and <= 100");
  EXPECT_EQ(message("step_s: 0.2", "step_s: 0.2\nintervals: 5"),
            "FILE:12: intervals = 5, must be a whole number >= 10 and <= 1000");
  EXPECT_EQ(message("rear_axle_to_cg_m: 0.075", "rear_axle_to_cg_m: 0.2"),
            "FILE:1: vehicle.rear_axle_to_cg_m = 0.2, must be a number >= 0 and <= 0.15");
  EXPECT_EQ(message("width_m: 0.107", "width_m: 0.107, safety_margin_m: -0.1"),
            "FILE:1: vehicle.safety_margin_m = -0.1, must be a number >= 0 and <= 100");
}

TEST(AutomatonConfiguration, RefusesTrimsOutsideTheLimitsTwiceOrWithoutStandstill) {
  EXPECT_EQ(message("speed_mps: 0.8, steering_rad: 0", "speed_mps: 4, steering_rad: 0"),
            "FILE:10: trims[2].speed_mps = 4, must be a number >= 0 and <= 3.7");
  EXPECT_EQ(message("speed_mps: 0.8, steering_rad: 0", "speed_mps: 0.8, steering_rad: -0.7"),
            "FILE:10: trims[2].steering_rad = -0.7, must be a number >= -0.62 and <= 0.62");
  EXPECT_EQ(message("speed_mps: 0.8, steering_rad: 0", "speed_mps: 0, steering_rad: 0"),
            "FILE:10: trims[2] = (a map), must be different from the other trims");
  EXPECT_EQ(message("speed_mps: 0, steering_rad: 0", "speed_mps: 0.4, steering_rad: 0"),
            "FILE:8: trims = (a list), must be a list with at least one trim of speed 0");
}

TEST(AutomatonConfiguration, ReadsWeightedSums) {
  std::string text = kGood;
  text.replace(text.find("[J2]"), 4,
               "[J2, {name: half, weights: {J1: 0.5, J2: 0.25}, normalised: true}, {name: "
               "much, weights: {comfort: 2}}]");
  const AutomatonConfiguration c = read(text);
  ASSERT_EQ(c.criteria.size(), 3U);
  EXPECT_EQ(c.criteria[1].label, "half");
  ASSERT_EQ(c.criteria[1].weights.size(), 2U);
  EXPECT_EQ(c.criteria[1].weights[0].criterion, "J1");
  EXPECT_EQ(c.criteria[1].weights[0].weight, 0.5);
  EXPECT_EQ(c.criteria[1].weights[1].weight, 0.25);
  EXPECT_TRUE(c.criteria[1].normalised);
  EXPECT_FALSE(c.criteria[2].normalised);
}

TEST(AutomatonConfiguration, RefusesBadWeightedSums) {
  const auto refusal = [](const std::string& sum) {
    return message("[J2]", "[J2, " + sum + "]").substr(0, 90);
  };
  EXPECT_EQ(refusal("{name: J1, weights: {J1: 1}}"),
            std::string("FILE:12: criteria[2].name = J1, must be one line of text and "
                        "unique: neither empty, nor 'trim', nor a criterion's")
                .substr(0, 90));
  EXPECT_EQ(refusal("{name: x, weights: {J1: -1}}"),
            "FILE:12: criteria[2].weights.J1 = -1, must be a number >= 0");
  EXPECT_EQ(refusal("{name: x, weights: {J1: 0}}"),
            "FILE:12: criteria[2].weights = (a map), must be a map with at least one weight > 0");
  EXPECT_EQ(refusal("{name: x, weights: {J7: 1}}").substr(0, 54),
            "FILE:12: criteria[2].weights.J7 = 1, unknown key; know");
  EXPECT_EQ(refusal("{name: x, weights: {J1: 1}, normalised: true}"),
            "FILE:12: criteria[2].normalised = true, must be false with a single weight > 0");
  EXPECT_EQ(refusal("{name: x, weights: {J1: 1, J2: 0}, normalised: true}"),
            "FILE:12: criteria[2].normalised = true, must be false with a single weight > 0");
  EXPECT_EQ(refusal("{name: \"x\\ny\", weights: {J1: 1}}").substr(0, 69),
            "FILE:12: criteria[2].name = x\\ny, must be one line of text and unique");
}

TEST(AutomatonConfiguration, ReadsAllThatASubgraphCanSay) {
  std::string text = kGood;
  text.replace(text.find("[J2]"), 4, "[J2, J3]");
  text.replace(text.find("  - {speed_mps: 0.8, steering_rad: 0}"), 37,
               "  - {speed_mps: 0.8, steering_rad: 0}\n  - {speed_mps: 0.4, steering_rad: 0.1}");
  text += R"(  - name: all of it
    labels: [J3, J2]
    trims: [1, 3, 2]
    rule: reachable
    max_speed_mps: 0.9
    disabled_edges: [{from: 2, to: 3}, {from: 3, to: 2, label: J3}]
    edges: [{from: 1, to: 2, labels: [J2]}]
edges: all
own_steps: optimised
horizon_steps: 4
)";
  const AutomatonConfiguration c = read(text);
  EXPECT_EQ(c.edges, EdgeChoice::kAll);
  EXPECT_EQ(c.self_loops, SelfLoops::kOptimised);
  EXPECT_EQ(c.horizon_steps, 4U);
  ASSERT_EQ(c.subgraphs.size(), 2U);
  const automaton::SubgraphSpec& s = c.subgraphs[1];
  EXPECT_EQ(s, (automaton::SubgraphSpec{
                   .name = "all of it",
                   .labels = {"J3", "J2"},
                   .trims = {{0}, {2}, {1}},
                   .rule = automaton::EdgeRule::kReachable,
                   .max_speed_mps = 0.9,
                   .disabled_edges = {{{{1}, {2}}, std::nullopt}, {{{2}, {1}}, "J3"}},
                   .edges = {{{{0}, {1}}, {"J2"}}}}));
  // Printed, it reads back.
  std::string again = text.substr(0, text.find("subgraphs:")) + "subgraphs:\n";
  for (const automaton::SubgraphSpec& one : c.subgraphs)
    again += "  - " + automaton::to_yaml(one) + "\n";
  EXPECT_EQ(read(again).subgraphs, c.subgraphs);
}

TEST(AutomatonConfiguration, RefusesTrimsThatDoNotHangTogetherOrCannotStopWithinTheHorizon) {
  const std::string disabled = "trims: all, disabled_edges: [{from: 1, to: 2}]}";
  EXPECT_EQ(message("trims: all}", disabled),
            "FILE:14: subgraphs[1].trims = all, must be connected trims: no edges lead "
            "from trim 1 to trim 2");
  EXPECT_EQ(message("trims: all}", "trims: all, disabled_edges: [{from: 2, to: 1}]}"),
            "FILE:14: subgraphs[1].trims = all, must be trims that reach a trim of speed 0 within "
            "the horizon of 8 steps; trim 2 never reaches it");
  // Ten trims of rising speed, each within one step of its neighbours alone.
  std::string text = kGood;
  text.replace(text.find("acceleration_mps2: 12"), 21, "acceleration_mps2: 1");
  text.replace(text.find("  - {speed_mps: 0.8, steering_rad: 0}\n"), 38, [] {
    std::string trims;
    for (int i = 1; i <= 9; ++i) {
      trims += "  - {speed_mps: " + std::to_string(0.2 * i) + ", steering_rad: 0}\n";
    }
    return trims;
  }());
  text.replace(text.find("trims: all}"), 11, "trims: all, rule: reachable}");
  try {
    (void)read(text);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "FILE:22: subgraphs[1].trims = all, must be trims that reach a trim of speed 0 "
                 "within the horizon of 8 steps; trim 10 needs 9 steps");
  }
  text += "horizon_steps: 9\n";
  EXPECT_NO_THROW((void)read(text));
}

TEST(AutomatonConfiguration, RefusesBadEdgesOfSubgraphs) {
  const auto refusal = [](const std::string& more) {
    return message("trims: all}", "trims: all, " + more + "}");
  };
  EXPECT_EQ(refusal("labels: [J2]"),
            "FILE:14: subgraphs[1].label = J2, must be given without `labels`");
  EXPECT_EQ(refusal("rule: ring"),
            "FILE:14: subgraphs[1].rule = ring, must be one of chain, reachable");
  EXPECT_EQ(refusal("max_speed_mps: -1"),
            "FILE:14: subgraphs[1].max_speed_mps = -1, must be a number >= 0");
  EXPECT_EQ(refusal("disabled_edges: [{from: 1, to: 3}]"),
            "FILE:14: subgraphs[1].disabled_edges[1].to = 3, must be a whole number >= 1 and <= 2");
  EXPECT_EQ(refusal("disabled_edges: [{from: 1, to: 1}]"),
            "FILE:14: subgraphs[1].disabled_edges[1].to = 1, must be an edge other than standing, "
            "which must "
            "be possible");
  EXPECT_EQ(refusal("disabled_edges: [{from: 1, to: 2, label: J1}]"),
            "FILE:14: subgraphs[1].disabled_edges[1].label = J1, must be J2");
  // Out of an enabled trim, only what the rule gives can be disabled ...
  std::string text = kGood;
  text.replace(text.find("[J2]"), 4, "[J2, J3]");
  text.replace(text.find("acceleration_mps2: 12"), 21, "acceleration_mps2: 4");
  text.replace(text.find("  - {speed_mps: 0.8, steering_rad: 0}"), 37,
               "  - {speed_mps: 0.8, steering_rad: 0}\n  - {speed_mps: 1.6, steering_rad: 0}");
  const auto message_of = [&text](const std::string& subgraph) -> std::string {
    try {
      (void)read(text.substr(0, text.find("  - {name: B")) + "  - {name: B, label: J2, " +
                 subgraph + "}\n");
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no error";
  };
  const std::string all = "rule: reachable, trims: all, ";
  EXPECT_EQ(
      message_of(all + "disabled_edges: [{from: 1, to: 3}]"),
      "FILE:15: subgraphs[1].disabled_edges[1].to = 3, must be a trim that the rule connects with "
      "`from`");
  EXPECT_EQ(
      message_of("trims: [1, 2], disabled_edges: [{from: 2, to: 3}]"),
      "FILE:15: subgraphs[1].disabled_edges[1].to = 3, must be a trim that the rule connects with "
      "`from`");
  EXPECT_EQ(message_of("trims: all, disabled_edges: [{from: 1, to: 2, label: J3}]"),
            "FILE:15: subgraphs[1].disabled_edges[1].label = J3, must be J2");
  EXPECT_EQ(
      message_of(
          "trims: all, disabled_edges: [{from: 1, to: 2, label: J3}], edges: [{from: 1, to: 2, "
          "labels: [J2, J3]}]"),
      "no error");
  // ... but any edge out of a disabled one, which may be left by it.
  EXPECT_EQ(message_of("trims: [1, 2], disabled_edges: [{from: 3, to: 1, label: J3}]"), "no error");
  EXPECT_EQ(message_of(all + "max_speed_mps: 1, disabled_edges: [{from: 3, to: 1, label: J3}]"),
            "no error");
  EXPECT_EQ(refusal("edges: [{from: 2, to: 2, labels: [J2]}]"),
            "FILE:14: subgraphs[1].edges[1].to = 2, must be a trim that the rule connects with "
            "`from`");
  EXPECT_EQ(
      refusal("edges: [{from: 1, to: 2, labels: []}]"),
      "FILE:14: subgraphs[1].edges[1].labels = (a list), must be a list with at least one label");
}

TEST(AutomatonConfiguration, ARunNeedsTheLabelsOfItsSubgraphAlone) {
  const auto c =
      read_automaton_configuration(test::source_folder() + "/launch_scripts/automata/paper.yaml");
  const AutomatonConfiguration needed = needed_by(c.subgraphs[3], c);
  ASSERT_EQ(needed.criteria.size(), 1U);
  EXPECT_EQ(needed.criteria[0].label, "J3");
  EXPECT_EQ(needed.subgraphs, (std::vector<automaton::SubgraphSpec>{c.subgraphs[3]}));
}

TEST(AutomatonConfiguration, RefusesUnknownCriteriaAndBadSubgraphs) {
  EXPECT_EQ(
      message("criteria: [J2]", "criteria: [J0]"),
      "FILE:12: criteria[1] = J0, must be one of J1, J2, J3, comfort, energy, stopping_distance, "
      "travel_time");
  EXPECT_EQ(message("criteria: [J2]", "criteria: []"),
            "FILE:12: criteria = (a list), must be a list with at least one criterion");
  EXPECT_EQ(message("criteria: [J2]", "criteria: [J2, J2]"),
            "FILE:12: criteria[2] = J2, must be unique");
  EXPECT_EQ(message("label: J2", "label: J1"), "FILE:14: subgraphs[1].label = J1, must be J2");
  for (const std::string name : {"\"\"", "\"two\\nlines\""}) {
    EXPECT_EQ(message("name: B", "name: " + name).substr(0, 24), "FILE:14: subgraphs[1].na");
  }
  EXPECT_EQ(message("trims: all", "trims: some"),
            "FILE:14: subgraphs[1].trims = some, must be all");
  EXPECT_EQ(message("trims: all", "trims: [1, 3]"),
            "FILE:14: subgraphs[1].trims[2] = 3, must be a whole number >= 1 and <= 2");
  EXPECT_EQ(message("trims: all", "trims: [1, 2, 1]"),
            "FILE:14: subgraphs[1].trims[3] = 1, must be unique");
  EXPECT_EQ(message("trims: all", "trims: [2]"),
            "FILE:14: subgraphs[1].trims = (a list), must be a list with a trim of speed 0");
  EXPECT_EQ(message("trims: all}", "trims: all}\n  - {name: B, label: J2, trims: all}"),
            "FILE:15: subgraphs[2].name = B, must be a name that no other subgraph has");
}

}  // namespace
}  // namespace hlc::maneuver_design
