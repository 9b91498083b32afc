#include "planner/controller/blocked_by.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/controller/self_loop.hpp"
#include "tests/planner/controller/blocked_road.hpp"

namespace hlc::controller::blocked_by_test {
namespace {

using namespace east_bound;
using coordination::FallbackReason;
using coordination::StepStatus;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::size_t kHorizon = 8;

/// Areas of a vehicle that stands there.
coordination::OccupiedAreas standing_at(double x_m) {
  return {.first = {kNow + 1}, .areas_m = {}, .final_area_m = wall(x_m)};
}

/// A step of car 1 that was to drive to x = 0.6.
class BlockedBy : public testing::Test {
 protected:
  std::vector<VehicleId> vehicles(FallbackReason reason) {
    const coordination::Report report{
        .vehicle = {1}, .step = {kNow}, .status = StepStatus::kFallback, .reason = reason};
    const coordination::Plan stays{
        {kNow}, {}, self_loop(subgraph()->automaton(), subgraph()->standstill())};
    return blocked_by({.report = report,
                       .in_force = stays,
                       .new_plan = is_published_ ? &motion_ : nullptr,
                       .horizon_steps = kHorizon,
                       .alone = [&]() -> std::optional<MotionAlone> {
                         ++searches_;
                         if (!is_alone_feasible_) return std::nullopt;
                         return MotionAlone{.plan = stays, .areas = motion_};
                       },
                       .others = [this] { return others_; }});
  }

  static OtherVehicle predicted(std::uint8_t vehicle, const coordination::OccupiedAreas& areas) {
    return {.vehicle = {vehicle},
            .compared = coordination::CoupledAreas{.reachable_area_m = &areas.final_area_m,
                                                   .predicted = &areas}};
  }
  static OtherVehicle not_received(std::uint8_t vehicle, const coordination::OccupiedAreas& areas) {
    return {.vehicle = {vehicle},
            .compared = coordination::CoupledAreas{.reachable_area_m = &areas.final_area_m}};
  }
  static OtherVehicle kept_clear_of(std::uint8_t vehicle, double x_m) {
    return {.vehicle = {vehicle},
            .areas_m = std::vector<std::vector<ConvexPolygon>>(kHorizon, {wall(x_m)})};
  }

  coordination::OccupiedAreas motion_{standing_at(0.6)};
  const coordination::OccupiedAreas near_{standing_at(0.65)};
  const coordination::OccupiedAreas far_{standing_at(2.0)};
  std::vector<OtherVehicle> others_;
  bool is_published_{true};
  bool is_alone_feasible_{true};
  int searches_{};
};

TEST_F(BlockedBy, AConflictNamesThoseWhosePredictionsMeetThePlanSorted) {
  others_ = {predicted(5, near_), predicted(2, far_), predicted(3, near_), not_received(4, near_),
             kept_clear_of(6, 0.6)};
  EXPECT_THAT(vehicles(FallbackReason::kConflict), ElementsAre(VehicleId{3}, VehicleId{5}));
  EXPECT_EQ(searches_, 0);
}

TEST_F(BlockedBy, AConflictMayBeginInTheLastStep) {
  coordination::OccupiedAreas late = far_;
  late.areas_m.assign(kHorizon - 1, wall(2.0));
  late.final_area_m = wall(0.6);
  others_ = {predicted(2, late)};
  EXPECT_THAT(vehicles(FallbackReason::kConflict), ElementsAre(VehicleId{2}));
}

TEST_F(BlockedBy, AMissingPredictionNamesThoseThatCouldReachThePlan) {
  others_ = {predicted(2, near_), not_received(4, far_), not_received(3, near_)};
  EXPECT_THAT(vehicles(FallbackReason::kMissing), ElementsAre(VehicleId{3}));
}

TEST_F(BlockedBy, WithoutAPlanAMissingMessageNamesThoseOutOfContact) {
  is_published_ = false;
  others_ = {not_received(3, near_),
             {.vehicle = {2}, .is_out_of_contact = true},
             {.vehicle = {4}, .withholds_road = true}};
  EXPECT_THAT(vehicles(FallbackReason::kMissing), ElementsAre(VehicleId{2}));
}

TEST_F(BlockedBy, AFallbackOfTheComponentNamesThoseWhoVotedForIt) {
  others_ = {{.vehicle = {4}, .is_opposed = true},
             {.vehicle = {2}, .is_opposed = true},
             kept_clear_of(3, 0.6)};
  EXPECT_THAT(vehicles(FallbackReason::kNeighbour), ElementsAre(VehicleId{2}, VehicleId{4}));
}

TEST_F(BlockedBy, WhereNoPlanIsFeasibleThoseInTheWayOfTheMotionAloneAreNamed) {
  is_published_ = false;
  others_ = {
      kept_clear_of(5, 0.6), kept_clear_of(2, 2.0), {.vehicle = {4}, .withholds_road = true}};
  EXPECT_THAT(vehicles(FallbackReason::kInfeasible), ElementsAre(VehicleId{4}, VehicleId{5}));
  EXPECT_THAT(vehicles(FallbackReason::kConflict), ElementsAre(VehicleId{4}, VehicleId{5}))
      << "its drift would have led into them";
}

TEST_F(BlockedBy, WhereTheMapAloneLeavesNoPlanNobodyIsNamed) {
  is_published_ = false;
  is_alone_feasible_ = false;
  others_ = {kept_clear_of(5, 0.6)};
  EXPECT_THAT(vehicles(FallbackReason::kInfeasible), IsEmpty());
}

TEST_F(BlockedBy, ReasonsOfTheVehicleItselfNameNobodyAndCostNoSearch) {
  using enum FallbackReason;
  others_ = {predicted(2, near_), {.vehicle = {3}, .is_out_of_contact = true, .is_opposed = true}};
  for (const FallbackReason reason : {kNone, kBudget, kDeviation, kLate, kUndrivable, kOffRoute}) {
    EXPECT_THAT(vehicles(reason), IsEmpty()) << to_string(reason);
  }
  EXPECT_EQ(searches_, 0);
}

TEST_F(BlockedRoad, AReportNamesTheCarWhoseNewPlanIsMet) {
  start(10.0, {});
  parked_x_m_ = -0.5;  // behind
  begin_step();
  coordination::Prediction crossing = stays(k_);
  for (const bool is_new : {true, false}) {
    Controller one = *one_;
    crossing.is_new = is_new;
    crossing.areas.final_area_m = wall(0.6);
    coordination::Report report = one.commit(std::vector{crossing}, {});
    one.note_causes(report);
    ASSERT_EQ(report.reason, FallbackReason::kConflict);
    EXPECT_THAT(report.blocked_by, ElementsAre(VehicleId{2})) << is_new;
  }
}

TEST_F(BlockedRoad, AReportNamesTheCarWhosePredictionIsMissing) {
  start(10.0, {});
  parked_x_m_ = -0.5;  // behind
  begin_step();
  const coordination::Report report = finish(one_->commit({}, {}));
  ASSERT_EQ(report.reason, FallbackReason::kMissing);
  EXPECT_THAT(report.blocked_by, ElementsAre(VehicleId{2}));
}

// It may be anywhere.
TEST_F(BlockedRoad, AReportNamesTheCarThatIsNeitherReceivedNorSeen) {
  start();
  Observation observation = at(k_, {following(*one_, k_)});
  observation.active = {{1}, {2}};
  static_cast<void>(one_->observe(observation));
  one_->couple({});
  static_cast<void>(one_->plan({}));
  const coordination::Report report = finish(one_->commit({}, {}));
  ASSERT_EQ(report.reason, FallbackReason::kMissing);
  EXPECT_THAT(report.blocked_by, ElementsAre(VehicleId{2}));
}

// The area that it can reach covers the own car.
TEST_F(BlockedRoad, AReportNamesTheSilentCarThatLeavesNoRoom) {
  start();
  static_cast<void>(step_alone());
  const coordination::Report report = step(false);
  ASSERT_EQ(report.reason, FallbackReason::kInfeasible);
  EXPECT_THAT(report.blocked_by, ElementsAre(VehicleId{2}));
}

TEST_F(BlockedRoad, AReportOfANewPlanNamesNobody) {
  start();
  const coordination::Report report = step();
  ASSERT_EQ(report.status, StepStatus::kPlanned);
  ASSERT_THAT(report.waiting.vehicles, ElementsAre(VehicleId{2}));
  EXPECT_THAT(report.blocked_by, IsEmpty());
}

}  // namespace
}  // namespace hlc::controller::blocked_by_test
