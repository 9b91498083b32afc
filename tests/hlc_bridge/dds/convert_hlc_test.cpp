#include "hlc_bridge/dds/convert_hlc.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "hlc_bridge/dds/wire.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"

namespace hlc::dds::convert_hlc_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <class Message>
class OwnConversion : public testing::Test {};
using OwnMessages =
    testing::Types<coordination::Traffic, coordination::Prediction, coordination::Outcome,
                   ReportRecord, RunState, AutomatonRequest, AutomatonAnswer>;
TYPED_TEST_SUITE(OwnConversion, OwnMessages);

TYPED_TEST(OwnConversion, EveryFieldSurvivesTheWayOverTheWire) {
  const unsigned seed = 2;
  SCOPED_TRACE(seed);
  std::mt19937_64 random{seed};
  typename Wire<TypeParam>::Type wire;  // used again: nothing of the one before may stay
  for (int i = 0; i < 200; ++i) {
    const auto message = sample<TypeParam>(random);
    to_wire(message, wire);
    const Incoming<TypeParam> back = from_wire(wire);
    ASSERT_TRUE(back.message.has_value());
    ASSERT_EQ(back.invalid, 0U);
    ASSERT_EQ(text(*back.message), text(message));
  }
}

template <class Message>
Message good() {
  std::mt19937_64 random{3};
  return sample<Message>(random);
}

template <class Message>
bool is_refused(const Message& message) {
  typename Wire<Message>::Type wire;
  to_wire(message, wire);
  return !from_wire(wire).message.has_value();
}

TEST(OwnConversionRefuses, VehicleIdsOutside1To30) {
  for (const int id : {0, 31, 255}) {
    const VehicleId vehicle{static_cast<std::uint8_t>(id)};
    auto traffic = good<coordination::Traffic>();
    traffic.vehicle = vehicle;
    EXPECT_TRUE(is_refused(traffic));
    EXPECT_FALSE(can_be_written(traffic));
    traffic = good<coordination::Traffic>();
    traffic.silent.push_back(vehicle);
    EXPECT_TRUE(is_refused(traffic));
    auto prediction = good<coordination::Prediction>();
    prediction.vehicle = vehicle;
    EXPECT_TRUE(is_refused(prediction));
    EXPECT_FALSE(can_be_written(prediction));
    auto outcome = good<coordination::Outcome>();
    outcome.vehicle = vehicle;
    EXPECT_TRUE(is_refused(outcome));
    EXPECT_FALSE(can_be_written(outcome));
    auto report = good<ReportRecord>();
    report.report.vehicle = vehicle;
    EXPECT_TRUE(is_refused(report));
    EXPECT_FALSE(can_be_written(report));
    report = good<ReportRecord>();
    report.report.coupled.push_back(vehicle);
    EXPECT_TRUE(is_refused(report));
    report = good<ReportRecord>();
    report.report.missing.push_back(vehicle);
    EXPECT_TRUE(is_refused(report));
    report = good<ReportRecord>();
    report.report.waiting.vehicles.push_back(vehicle);
    EXPECT_TRUE(is_refused(report));
    report = good<ReportRecord>();
    report.report.blocked_by.push_back(vehicle);
    EXPECT_TRUE(is_refused(report));
  }
  EXPECT_FALSE(is_refused(good<coordination::Traffic>()));
  EXPECT_TRUE(can_be_written(good<coordination::Traffic>()));
}

TEST(OwnConversion, LeavesOutCornersOfPolygonsThatComeTwice) {
  auto traffic = good<coordination::Traffic>();
  traffic.reachable_area_m = {{Point{0, 0}, Point{0, 0}, Point{1, 0}, Point{1, 0}, Point{1, 0},
                               Point{0, 1}, Point{0, 0}, Point{0, 0}}};
  TrafficMessage wire;
  to_wire(traffic, wire);
  const auto read = from_wire(wire).message;
  ASSERT_TRUE(read.has_value());
  const ConvexPolygon expected{{Point{0, 0}, Point{1, 0}, Point{0, 1}}};
  EXPECT_EQ(read->reachable_area_m, expected);
}

TEST(OwnConversionRefuses, PolygonsThatAreNoArea) {
  ConvexPolygon too_many;
  for (int i = 0; i < 1001; ++i) too_many.vertices_m.emplace_back(i, i * i);
  const std::vector<ConvexPolygon> bad{
      {{Point{0, 0}}},
      {{Point{0, 0}, Point{1, 0}}},
      {{Point{0, 0}, Point{1, 0}, Point{1, 0}, Point{0, 0}}},
      {{Point{0, 0}, Point{1, 0}, Point{kNan, 1}}},
      {{Point{0, 0}, Point{1, 0}, Point{1, std::numeric_limits<double>::infinity()}}},
      {{Point{0, 0}, Point{-1.001e9, 0}, Point{0, 1}}},
      {{Point{0, 0}, Point{0, 1}, Point{1, 0}}},               // clockwise
      {{Point{0, 0}, Point{1, 0}, Point{0, 1}, Point{1, 1}}},  // bow tie
      {{Point{0, 0}, Point{4, 0}, Point{1, 1}, Point{0, 4}}},  // dent
      too_many};
  for (const ConvexPolygon& polygon : bad) {
    auto traffic = good<coordination::Traffic>();
    traffic.reachable_area_m = polygon;
    EXPECT_TRUE(is_refused(traffic));
    traffic = good<coordination::Traffic>();
    traffic.running.final_area_m = polygon;
    EXPECT_TRUE(is_refused(traffic));
    traffic = good<coordination::Traffic>();
    traffic.running.areas_m.push_back(polygon);
    EXPECT_TRUE(is_refused(traffic));
    auto prediction = good<coordination::Prediction>();
    prediction.areas.areas_m.push_back(polygon);
    EXPECT_TRUE(is_refused(prediction));
    auto desiring = good<coordination::Prediction>();
    desiring.desired = coordination::OccupiedAreas{.areas_m = {polygon}};
    EXPECT_TRUE(is_refused(desiring));
  }
}

TEST(OwnConversionRefuses, LaneClaimsWithoutPlace) {
  auto traffic = good<coordination::Traffic>();
  traffic.claim = coordination::LaneClaim{.route = 2, .place_m = 1.5, .ahead_m = 0.8};
  EXPECT_FALSE(is_refused(traffic));
  for (const double bad : {kNan, std::numeric_limits<double>::infinity(), 1.001e9}) {
    traffic.claim->place_m = bad;
    EXPECT_TRUE(is_refused(traffic));
    traffic.claim->place_m = 1.5;
    traffic.claim->ahead_m = bad;
    EXPECT_TRUE(is_refused(traffic));
    traffic.claim->ahead_m = 0.8;
  }
}

TEST(OwnConversionRefuses, PlanningInputsWithNumbersThatAreNotFinite) {
  auto traffic = good<coordination::Traffic>();
  traffic.planning = coordination::PlanningInput{.base = {.poses = {{}}}};
  EXPECT_FALSE(is_refused(traffic));
  traffic.planning->base.poses.front().y_m = kNan;
  EXPECT_TRUE(is_refused(traffic));
  traffic.planning->base.poses.assign(2000, {});
  EXPECT_TRUE(is_refused(traffic)) << "more than any program sends";
  traffic.planning->base.poses.resize(1);
  traffic.planning->path_s_m = kNan;
  EXPECT_TRUE(is_refused(traffic));
}

// Whatever a sender without right of way leaves there.
TEST(OwnConversion, IgnoresTheClaimOfATrafficMessageWithoutClaim) {
  auto traffic = good<coordination::Traffic>();
  traffic.claim = coordination::LaneClaim{.route = 2, .place_m = kNan, .ahead_m = 0.8};
  TrafficMessage wire;
  to_wire(traffic, wire);
  wire.claims_lane(false);
  const auto read = from_wire(wire).message;
  ASSERT_TRUE(read.has_value());
  EXPECT_FALSE(read->claim.has_value());
}

TEST(OwnConversionRefuses, NumbersThatAreNotFinite) {
  auto traffic = good<coordination::Traffic>();
  traffic.next_pose.heading_rad = kNan;
  EXPECT_TRUE(is_refused(traffic));
  auto report = good<ReportRecord>();
  report.report.planned_pose.x_m = kNan;
  EXPECT_TRUE(is_refused(report));
  report = good<ReportRecord>();
  report.report.cost_m2 = kNan;
  EXPECT_TRUE(is_refused(report));
  report = good<ReportRecord>();
  report.report.gap_m2 = kNan;
  EXPECT_TRUE(is_refused(report));
  report = good<ReportRecord>();
  report.report.deviation_m = kNan;
  EXPECT_TRUE(is_refused(report));
  report = good<ReportRecord>();
  report.report.bound_m2 = kNan;
  EXPECT_TRUE(is_refused(report));
}

TEST(OwnConversionRefuses, CertificatesWithoutMeaning) {
  const auto refused_with = [](auto damage) {
    auto report = good<ReportRecord>();
    coordination::Certificate certificate{
        .footprint = {.length_m = 0.2, .width_m = 0.1},
        .areas = {.first = {report.report.step}, .areas_m = {}, .final_area_m = {}},
        .is_agreed = true,
        .separations = {{.from = {2}, .lines = {{.direction_rad = 1.0, .offset_m = 2.0}}}}};
    damage(certificate);
    report.report.certificate = std::make_shared<const coordination::Certificate>(certificate);
    return is_refused(report);
  };
  using coordination::Certificate;
  EXPECT_FALSE(refused_with([](Certificate&) {}));
  EXPECT_TRUE(refused_with([](Certificate& one) { one.footprint.width_m = kNan; }));
  EXPECT_TRUE(refused_with([](Certificate& one) { one.separations[0].from = {31}; }));
  EXPECT_TRUE(refused_with([](Certificate& one) {
    one.separations[0].known = static_cast<coordination::KnownMotion>(4);
  }));
  EXPECT_TRUE(refused_with([](Certificate& one) { one.separations[0].lines[0].offset_m = kNan; }));
  EXPECT_TRUE(
      refused_with([](Certificate& one) { one.separations[0].lines[0].direction_rad = kNan; }));
  EXPECT_TRUE(refused_with([](Certificate& one) { one.separations[0].lines.resize(1001); }));
  EXPECT_TRUE(
      refused_with([](Certificate& one) { one.separations.resize(1001, one.separations[0]); }));
  EXPECT_TRUE(refused_with([](Certificate& one) {
    one.areas.final_area_m = {{Point{0, 0}, Point{1, 0}}};
  }));
}

TEST(OwnConversionRefuses, AWaitThatBeginsAfterItsStep) {
  auto report = good<ReportRecord>();
  report.report.step = {200};
  report.report.arrived_since.reset();
  report.report.waiting = {.vehicles = {{2}}, .since = {200}};
  EXPECT_FALSE(is_refused(report));
  report.report.waiting.since = {201};
  EXPECT_TRUE(is_refused(report));
}

TEST(OwnConversionRefuses, AnArrivalAfterItsStep) {
  auto report = good<ReportRecord>();
  report.report.step = {200};
  report.report.waiting = {};
  report.report.arrived_since = StepIndex{200};
  EXPECT_FALSE(is_refused(report));
  report.report.arrived_since = StepIndex{201};
  EXPECT_TRUE(is_refused(report));
}

TEST(OwnConversionRefuses, APlanOfWhichTrimsOrLabelsAreMissing) {
  ReportMessage report;
  to_wire(good<ReportRecord>(), report);
  report.plan_trims({1, 2});
  report.plan_labels({"J2", "J1"});
  EXPECT_TRUE(from_wire(report).message.has_value());
  report.plan_labels({"J2"});
  EXPECT_FALSE(from_wire(report).message.has_value());
  report.plan_labels({"J2", std::string(kMaxText + 1, 'x')});
  EXPECT_FALSE(from_wire(report).message.has_value());
  report.plan_labels({"J2", "J1"});
  report.held_ahead_m(1e300);
  EXPECT_FALSE(from_wire(report).message.has_value());
}

TEST(OwnConversionRefuses, NamesThatNobodyGives) {
  const std::string longest(kMaxText, 'x');
  ReportMessage report;
  to_wire(good<ReportRecord>(), report);
  report.maneuver(longest);
  report.subgraph(longest);
  EXPECT_TRUE(from_wire(report).message.has_value());
  report.maneuver(longest + "x");
  EXPECT_FALSE(from_wire(report).message.has_value());
  report.maneuver(longest);
  report.subgraph(longest + "x");
  EXPECT_FALSE(from_wire(report).message.has_value());
}

// Without its reports a controller would seem dead.
TEST(OwnConversionCuts, NamesOfAReportThatWouldBeRefused) {
  auto report = good<ReportRecord>();
  report.report.maneuver = std::string(kMaxText + 1, 'm');
  report.report.subgraph = std::string(kMaxText + 1, 's');
  ReportMessage wire;
  to_wire(report, wire);
  const auto read = from_wire(wire).message;
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->report.maneuver, std::string(kMaxText, 'm'));
  EXPECT_EQ(read->report.subgraph, std::string(kMaxText, 's'));
}

TEST(OwnConversionRefuses, UnknownEnumerationValues) {
  ReportMessage report;
  to_wire(good<ReportRecord>(), report);
  EXPECT_TRUE(from_wire(report).message.has_value());
  report.status(4);
  EXPECT_FALSE(from_wire(report).message.has_value());
  report.status(0);
  report.reason(10);
  EXPECT_FALSE(from_wire(report).message.has_value());
  report.reason(0);
  report.quality(4);
  EXPECT_FALSE(from_wire(report).message.has_value());
  RunStateMessage state;
  state.phase(2);
  EXPECT_FALSE(from_wire(state).message.has_value());
}

}  // namespace
}  // namespace hlc::dds::convert_hlc_test
