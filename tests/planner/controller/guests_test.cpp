// What a controller plans near a guest.
#include "planner/controller/guests.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "planner/geometry/footprint.hpp"
#include "tests/planner/controller/east_bound.hpp"

namespace hlc::controller::guests_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr VehicleId kOwn{1};
constexpr VehicleId kGuest{7};
const coordination::Guest kSlow{.vehicle = kGuest,
                                .footprint = {0.22, 0.107},
                                .safety_margin_m = 0.01,
                                .limits = {.speed_mps = 0.5,
                                           .acceleration_mps2 = 1.0,
                                           .deceleration_mps2 = 2.0,
                                           .curvature_per_m = 3.0}};

std::unique_ptr<Controller> controller(const coordination::Guest& guest) {
  return std::make_unique<Controller>(
      ControllerOptions{.vehicle = kOwn, .guests = {guest}}, east_bound::subgraph(),
      road::ReferencePath({Point(0.0, 0.0), Point(10.0, 0.0)}, false), road::Corridor{});
}

/// A guest is none of the active vehicles.
Observation at(std::uint64_t k, const Controller& one,
               const std::vector<coordination::MeasuredVehicle>& guests) {
  Observation observation = east_bound::at(
      k, {one.has_plan() ? east_bound::following(one, k) : east_bound::seen(kOwn.value, 0.0, 0.0)});
  observation.states.insert(observation.states.end(), guests.begin(), guests.end());
  return observation;
}

coordination::Report step(Controller& one, std::uint64_t k,
                          const std::vector<coordination::MeasuredVehicle>& guests) {
  static_cast<void>(one.observe(at(k, one, guests)));
  one.couple({});
  static_cast<void>(one.plan({}));
  coordination::Report report = one.commit({}, {});
  one.note_causes(report);
  return report;
}

std::unique_ptr<Controller> standing(const coordination::Guest& guest) {
  auto one = controller(guest);
  static_cast<void>(one->stand_by(at(100, *one, {})));
  return one;
}

coordination::MeasuredVehicle guest_at(double x_m, double heading_rad, double speed_mps) {
  return {.vehicle = kGuest, .pose = {x_m, 0.0, heading_rad}, .speed_mps = speed_mps};
}

/// In no step of the horizon does the plan of this step move where the guest may be.
void expect_passively_safe(const Controller& one, std::uint64_t k,
                           const coordination::MeasuredVehicle& guest) {
  const automaton::UniversalAutomaton& automaton = *automaton::paper_automaton();
  for (std::uint64_t j = 1; j <= one.options().horizon_steps; ++j) {
    const automaton::Maneuver& maneuver = one.plan_in_force().maneuver_during({k + j});
    if (search::stands_in(maneuver)) continue;
    const double from_s = automaton.step_s * static_cast<double>(j);
    const ConvexPolygon swept =
        transformed(maneuver.swept_area_m, one.plan_in_force().pose_at({k + j}));
    EXPECT_FALSE(intersects(swept, coordination::reachable_area(one.options().guests.front(), guest,
                                                                from_s, from_s + automaton.step_s)))
        << "step " << j;
  }
}

TEST(Guests, ThatWereNeverSeenAreNotThere) {
  Guests guests({kSlow});
  guests.observe(east_bound::at(3, {}));
  EXPECT_THAT(guests.seen(), IsEmpty());
  EXPECT_THAT(guests.avoided_in_motion_m({}, 8, 0.2), IsEmpty());
  guests.observe(east_bound::at(4, {guest_at(1.0, 0.0, 0.0)}));
  EXPECT_THAT(guests.seen(), ElementsAre(kGuest));
}

TEST(Guests, ThatAreNoLongerSeenMayBeWhereverTheyCanHaveGot) {
  Guests guests({kSlow});
  guests.observe(east_bound::at(4, {guest_at(1.0, 0.0, 0.3)}));
  const auto seen_m = guests.reachable_m(kGuest, 8, 0.2);
  guests.observe(east_bound::at(6, {}));
  const auto lost_m = guests.reachable_m(kGuest, 8, 0.2);
  for (std::size_t j = 0; j + 2 < 8; ++j) {
    EXPECT_EQ(lost_m[j].vertices_m, seen_m[j + 2].vertices_m) << "step " << j;
  }
}

TEST(Controller, PassesAParkedGuestOutsideOfWhatItCanReach) {
  const auto one = standing(kSlow);
  const coordination::MeasuredVehicle parked = guest_at(1.2, 0.0, 0.0);
  const ConvexPolygon place = footprint_area(kSlow.footprint, parked.pose);
  for (std::uint64_t k = 101; k < 130; ++k) {
    const coordination::Report report = step(*one, k, {parked});
    if (report.status == coordination::StepStatus::kPlanned) expect_passively_safe(*one, k, parked);
    EXPECT_FALSE(
        intersects(footprint_area(kSlow.footprint, one->plan_in_force().pose_at({k})), place))
        << "step " << k;
  }
  EXPECT_GT(one->plan_in_force().pose_at({130}).x_m, 2.0);
}

TEST(Controller, DrivesBehindAGuestThatDrivesAway) {
  const auto one = standing(kSlow);
  coordination::MeasuredVehicle guest = guest_at(0.8, 0.0, 0.4);
  for (std::uint64_t k = 101; k < 140; ++k) {
    const coordination::Report report = step(*one, k, {guest});
    if (report.status == coordination::StepStatus::kPlanned) expect_passively_safe(*one, k, guest);
    guest.pose.x_m += 0.4 * 0.2;
  }
  EXPECT_GT(one->plan_in_force().pose_at({140}).x_m, 2.0);
}

/// From ahead and from behind, at most so fast as it may.
TEST(Controller, StandsWheneverAGuestThatDrivesAtItTouchesIt) {
  for (const double heading_rad : {std::numbers::pi, 0.0}) {
    const auto one = standing(kSlow);
    const double ahead = std::cos(heading_rad);
    coordination::MeasuredVehicle guest = guest_at(-1.5 * ahead, heading_rad, 0.5);
    for (std::uint64_t k = 101; k < 130; ++k) {
      const coordination::Report report = step(*one, k, {guest});
      if (report.status == coordination::StepStatus::kPlanned) {
        expect_passively_safe(*one, k, guest);
      }
      const bool touches =
          intersects(footprint_area(kSlow.footprint, guest.pose),
                     footprint_area(kSlow.footprint, one->plan_in_force().pose_at({k})));
      EXPECT_TRUE(!touches || search::stands_in(one->plan_in_force().maneuver_during({k})))
          << "step " << k;
      guest.pose.x_m += ahead * 0.5 * 0.2;
    }
  }
}

TEST(Controller, PublishesNothingToPlanForItFromWhileAGuestIsSeen) {
  ControllerOptions options{.vehicle = kOwn, .guests = {kSlow}};
  options.others = [](VehicleId) { return std::unique_ptr<Controller>{}; };
  Controller one(options, east_bound::subgraph(),
                 road::ReferencePath({Point(0.0, 0.0), Point(10.0, 0.0)}, false), road::Corridor{});
  static_cast<void>(one.stand_by(at(100, one, {})));
  EXPECT_TRUE(one.observe(at(101, one, {})).planning);
  one.couple({});
  static_cast<void>(one.plan({}));
  static_cast<void>(one.commit({}, {}));
  static_cast<void>(one.observe(at(102, one, {guest_at(3.0, 0.0, 0.0)})));
  one.couple({});
  static_cast<void>(one.plan({}));
  static_cast<void>(one.commit({}, {}));
  EXPECT_FALSE(one.observe(at(103, one, {guest_at(3.0, 0.0, 0.0)})).planning);
}

}  // namespace
}  // namespace hlc::controller::guests_test
