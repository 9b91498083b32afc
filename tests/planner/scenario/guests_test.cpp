// The guests of a scenario: what is read, what is refused, and who knows of them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "planner/common/text_file.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/planner/scenario/changed_scenario.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::scenario::guests_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;

const std::string kLimits =
    "limits: {speed_mps: 1.0, acceleration_mps2: 1.5, deceleration_mps2: 3.0, "
    "curvature_per_m: 4.0}";
const std::string kArea = "area: {rectangle: {x_m: 2.0, y_m: 1.5, length_m: 3.0, width_m: 2.0}}";

std::string guest(const std::string& rest, const std::string& start = "x_m: 2.0, y_m: 2.0",
                  const std::string& id = "7") {
  return fmt::format("guests: [{{id: {}, start: {{{}}}, {}}}]", id, start, rest);
}

std::string error_of(const std::string& key) { return test::error_of_scenario("circle", key); }

TEST(Guests, AreReadWithTheAutomatonsFootprintUnlessTheyHaveTheirOwn) {
  const Scenario scenario = test::changed_scenario(
      "circle", guest(fmt::format("drive: wander, seed: 5, {}, {}", kArea, kLimits)));
  ASSERT_THAT(scenario.guests, SizeIs(1));
  const ScenarioGuest& one = scenario.guests.front();
  EXPECT_EQ(one.guest.vehicle, VehicleId{7});
  EXPECT_EQ(one.name, "guest 7");
  EXPECT_EQ(one.seed, 5U);
  EXPECT_EQ(one.home_m.min_m, Point(0.5, 0.5));
  EXPECT_EQ(one.home_m.max_m, Point(3.5, 2.5));
  const automaton::UniversalAutomaton& automaton = scenario.subgraph->automaton();
  EXPECT_EQ(one.guest.footprint.length_m, automaton.vehicle.footprint.length_m);
  EXPECT_EQ(one.guest.safety_margin_m, automaton.vehicle.safety_margin_m);
  const Scenario other = test::changed_scenario(
      "circle",
      guest("drive: by_hand, footprint: {length_m: 0.5, width_m: 0.3}, name: van, " + kLimits));
  EXPECT_EQ(other.guests.front().guest.footprint.length_m, 0.5);
  EXPECT_EQ(other.guests.front().drive, GuestDrive::kByHand);
}

TEST(Guests, AreKnownToEveryController) {
  const Scenario scenario = test::changed_scenario("circle", guest("drive: by_hand, " + kLimits));
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    const auto controller = make_controller(scenario, vehicle.id);
    ASSERT_THAT(controller->options().guests, SizeIs(1));
    EXPECT_EQ(controller->options().guests.front().limits.curvature_per_m, 4.0);
  }
}

TEST(Guests, ThatWanderDoSoByAnotherSeedFromOtherStarts) {
  const Scenario scenario =
      read_scenario({.file = test::source_folder() + "/launch_scripts/scenarios/lab_guest.yaml"});
  EXPECT_NE(with_random_starts(scenario, 4).guests.front().seed,
            with_random_starts(scenario, 5).guests.front().seed);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(overlapped_by_guest(0, with_random_starts(scenario, seed)), "") << "seed " << seed;
  }
}

TEST(Guests, WithABadValueAreRefusedByItsPlace) {
  EXPECT_THAT(error_of(guest("drive: fly, " + kLimits)),
              AllOf(HasSubstr("guests[1].drive = fly"), HasSubstr("by_hand, track, wander")));
  EXPECT_THAT(error_of(guest("drive: by_hand")), HasSubstr("guests[1].limits"));
  EXPECT_THAT(error_of(guest("drive: by_hand, limits: {speed_mps: 1.0, acceleration_mps2: 1.5, "
                             "deceleration_mps2: 3.0, curvature_per_m: 0}")),
              HasSubstr("guests[1].limits.curvature_per_m = 0"));
  EXPECT_THAT(error_of(guest("drive: wander, " + kLimits)), HasSubstr("guests[1].area"));
  EXPECT_THAT(error_of(guest("drive: by_hand, seed: 3, " + kLimits)), HasSubstr("seed"));
  EXPECT_THAT(error_of(guest("drive: by_hand, " + kLimits, "x_m: .nan, y_m: 0")),
              HasSubstr("guests[1].start.x_m"));
}

TEST(Guests, NeedAnIdOfTheirOwnAndAFreePlace) {
  EXPECT_THAT(error_of(guest("drive: by_hand, " + kLimits, "x_m: 2.0, y_m: 2.0", "1")),
              HasSubstr("guests[1].id = 1, must be none of the vehicles' ids"));
  const ScenarioVehicle first = test::changed_scenario("circle", "").vehicles.front();
  EXPECT_THAT(error_of(guest("drive: by_hand, " + kLimits,
                             fmt::format("x_m: {}, y_m: {}", first.start.x_m, first.start.y_m))),
              AllOf(HasSubstr("guests[1].start.x_m"), HasSubstr("overlap vehicle 1")));
}

TEST(GuestTracks, AreReadFromTheColumnsTimeAndPlace) {
  const test::TemporaryFolder folder;
  write_file(folder / "track.csv", "y_m,t_s,x_m\n1.5,0,2\n1.6,0.5,2.1\n");
  const std::vector<TimedPoint> track = read_track(folder / "track.csv");
  ASSERT_THAT(track, SizeIs(2));
  EXPECT_EQ(track[1].time_s, 0.5);
  EXPECT_EQ(track[1].position_m, Point(2.1, 1.6));
}

std::string error_of_track(const std::string& text) {
  const test::TemporaryFolder folder;
  write_file(folder / "track.csv", text);
  try {
    static_cast<void>(read_track(folder / "track.csv"));
  } catch (const std::exception& error) {
    return error.what();
  }
  return "none";
}

TEST(GuestTracks, WithABadValueAreRefusedByTheirLine) {
  EXPECT_THAT(error_of_track("t_s,x_m\n0,1\n"), HasSubstr("no column y_m"));
  EXPECT_THAT(error_of_track("t_s,x_m,y_m\n0,1,1\n"), HasSubstr("rows = 1, must be >= 2"));
  EXPECT_THAT(error_of_track("t_s,x_m,y_m\n0,1,1\n1,1,1\n1,2,2\n"),
              AllOf(HasSubstr("track.csv:4"), HasSubstr("larger than in the row above")));
  EXPECT_THAT(error_of_track("t_s,x_m,y_m\n0,1,1\n1,nan,1\n"), HasSubstr("track.csv:3"));
  EXPECT_THAT(error_of_track("t_s,x_m,y_m\n-1,1,1\n1,1,1\n"), HasSubstr("track.csv:2"));
}

TEST(GuestTracks, ThatAreMissingEndTheReadingOfTheScenario) {
  EXPECT_THAT(error_of(guest("drive: track, track: none.csv, " + kLimits)), HasSubstr("none.csv"));
}

}  // namespace
}  // namespace hlc::scenario::guests_test
