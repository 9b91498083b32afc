#include "hlc_bridge/process/hlc_process.hpp"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <future>
#include <memory>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "planner/geometry/footprint.hpp"
#include "tests/hlc_bridge/process/running_hlc_process.hpp"

namespace hlc::process {
namespace {

TEST_F(HlcProcessTest, BearsItsVehiclesNameWhateverItsNodeId) {
  const dds::Participant lab{dds::on_loopback("observer", domains_.first(), dds::DomainRole::kLab)};
  const dds::Participant local_observer{
      dds::on_loopback("observer", local(), dds::DomainRole::kLocal)};
  const dds::Participant peer{
      dds::on_loopback("observer", controllers(), dds::DomainRole::kController)};
  for (const dds::Participant* observer : {&lab, &local_observer, &peer}) {
    EXPECT_TRUE(observer->wait_for({controller_name(1)}, dds::soon()));
  }
}

TEST_F(HlcProcessTest, IsNotDisturbedWhenAnotherControllerOfItsMachineLeaves) {
  FakeMiddleware middleware{local()};
  ASSERT_TRUE(middleware.lists.wait_for_matched(1, dds::soon()));
  {
    const dds::Participant neighbour{
        dds::on_loopback(controller_name(2), local(), dds::DomainRole::kLocal)};
    ASSERT_TRUE(neighbour.wait_for({controller_name(1)}, dds::soon()));
    ASSERT_TRUE(middleware.participant.wait_for({controller_name(2)}, dds::soon()));
  }
  ASSERT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), std::chrono::milliseconds{10},
      [&] { return middleware.participant.is_lost(controller_name(2)); }, [] {}));
  EXPECT_TRUE(gets_ready(middleware));
  EXPECT_FALSE(middleware.commands.now().empty());
}

TEST_F(HlcProcessTest, AnswersAMiddlewareThatIsStartedAgain) {
  auto middleware = std::make_unique<FakeMiddleware>(local());
  ASSERT_TRUE(gets_ready(*middleware));
  middleware = nullptr;
  middleware = std::make_unique<FakeMiddleware>(local());
  EXPECT_TRUE(gets_ready(*middleware));
  EXPECT_FALSE(middleware->commands.now().empty());
  EXPECT_EQ(code_.wait_for(std::chrono::seconds{0}), std::future_status::timeout);
}

TEST_F(HlcProcessTest, LeavesWithoutItsMiddlewareWhenTheOthersDriveOut) {
  const dds::Participant lab_control{
      dds::on_loopback(kLabControlName, controllers(), dds::DomainRole::kController)};
  dds::Participant others{dds::on_loopback("others", controllers(), dds::DomainRole::kController)};
  dds::Writer<RunState> run_states{others, dds::topics::run_state()};
  auto middleware = std::make_unique<FakeMiddleware>(local());
  ASSERT_TRUE(gets_ready(*middleware));
  ASSERT_TRUE(run_states.wait_for_matched(1, dds::soon()));
  run_states.write({.phase = RunPhase::kMinimalRiskStop, .start = 0});
  middleware = nullptr;
  ASSERT_EQ(code_.wait_until(dds::soon()), std::future_status::ready);
  EXPECT_EQ(code_.get(), kExitDied);
}

class ImpatientHlcProcessTest : public HlcProcessTest {
 protected:
  ImpatientHlcProcessTest() : HlcProcessTest(impatient()) {}

  static HlcProcessOptions impatient() {
    HlcProcessOptions options = on_loopback_alone();
    options.startup_timeout = std::chrono::seconds{8};
    return options;
  }
};

TEST_F(ImpatientHlcProcessTest, LeavesWhenItsMiddlewareStaysAway) {
  auto middleware = std::make_unique<FakeMiddleware>(local());
  ASSERT_TRUE(gets_ready(*middleware));
  middleware = nullptr;
  ASSERT_EQ(code_.wait_until(dds::soon()), std::future_status::ready);
  EXPECT_EQ(code_.get(), kExitDied);
}

TEST_F(HlcProcessTest, LeavesItsVehicleAloneWhereAnotherControllerOfItIs) {
  const dds::Participant duplicate{
      dds::on_loopback(controller_name(1), domains_.first(), dds::DomainRole::kLab)};
  FakeMiddleware middleware{local()};
  ASSERT_TRUE(duplicate.wait_for({controller_name(1)}, dds::soon()));
  ASSERT_TRUE(middleware.lists.wait_for_matched(1, dds::soon()));
  const Pose start = scenario::measured_start(red_alone(), scenario::vehicle_of(red_alone(), {1}));
  const auto has_left = [this] {
    return code_.wait_for(std::chrono::seconds{0}) == std::future_status::ready;
  };
  ASSERT_TRUE(time::Signal{}.repeat_until(dds::soon(), std::chrono::milliseconds{50}, has_left,
                                          [&] { middleware.lists.write(list_of(start, 0.0)); }));
  EXPECT_EQ(code_.get(), kExitBadInput);
  EXPECT_TRUE(middleware.commands.now().empty());
  EXPECT_TRUE(middleware.ready.now().empty());
}

TEST_F(HlcProcessTest, StaysWhenAnotherControllerOfItsVehicleComesLater) {
  FakeMiddleware middleware{local()};
  ASSERT_TRUE(gets_ready(middleware));
  const dds::Participant duplicate{
      dds::on_loopback(controller_name(1), domains_.first(), dds::DomainRole::kLab)};
  ASSERT_TRUE(duplicate.wait_for({controller_name(1)}, dds::soon()));
  const Pose start = scenario::measured_start(red_alone(), scenario::vehicle_of(red_alone(), {1}));
  const std::size_t before = middleware.commands.now().size();
  EXPECT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), std::chrono::milliseconds{50},
      [&] { return middleware.commands.now().size() >= before + 30; },
      [&] { middleware.lists.write(list_of(start, 0.0)); }));
}

/// Of a vehicle that drives far away.
coordination::Traffic traffic_of(std::uint8_t vehicle, std::uint64_t step) {
  const ConvexPolygon far = footprint_area({.length_m = 0.2, .width_m = 0.1}, {90.0, 90.0, 0.0});
  coordination::Traffic traffic;
  traffic.vehicle = {vehicle};
  traffic.step = {step};
  traffic.running.first = traffic.step;
  traffic.running.final_area_m = far;
  traffic.reachable_area_m = far;
  return traffic;
}

// As two that are ready, which neither knew of the other: one was cut off and has been replaced.
TEST_F(HlcProcessTest, LeavesWhenAnotherOneSpeaksForItsVehicle) {
  FakeMiddleware middleware{local()};
  Others others{controllers()};
  ASSERT_TRUE(others.traffic.wait_for_matched(1, dds::soon()));
  ASSERT_TRUE(gets_ready(middleware));
  const Pose start = scenario::measured_start(red_alone(), scenario::vehicle_of(red_alone(), {1}));
  const std::size_t before = middleware.commands.now().size();
  EXPECT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), std::chrono::milliseconds{50},
      [&] { return middleware.commands.now().size() >= before + 5; },
      [&] { middleware.lists.write(list_of(start, 0.0)); }));
  const auto has_left = [this] {
    return code_.wait_for(std::chrono::seconds{0}) == std::future_status::ready;
  };
  ASSERT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), std::chrono::milliseconds{50}, has_left,
      [&] { others.traffic.write(traffic_of(1, time::real_time_now() / kPeriod)); }));
  EXPECT_EQ(code_.get(), kExitBadInput);
}

TEST_F(HlcProcessTest, ShowsTheOperatorItsStateAndWhatItLogs) {
  Operator lab_control{domains_.first()};
  FakeMiddleware middleware{local()};
  ASSERT_TRUE(lab_control.sees(*process_) && middleware.lists.wait_for_matched(1, dds::soon()));
  // Each is repeated: samples from before the match of writer and reader are lost.
  const Pose start = scenario::measured_start(red_alone(), scenario::vehicle_of(red_alone(), {1}));
  const bool is_drawn = time::Signal{}.repeat_until(
      dds::soon(), std::chrono::milliseconds{50},
      [&] { return lab_control.drawings.wait_for(0).size() >= 2; },
      [&] { middleware.lists.write(list_of(start, 0.0)); });
  ASSERT_TRUE(is_drawn);
  const Visualization state = lab_control.drawings.wait_for(2)[1];
  EXPECT_EQ(state.text, "1: standby");
  EXPECT_NEAR(state.points_m.at(0).x(), start.x_m, 0.01);

  const bool is_logged = time::Signal{}.repeat_until(
      dds::soon(), std::chrono::milliseconds{10},
      [&] { return !lab_control.log.wait_for(0).empty(); },
      [] {
        spdlog::info("not for the operator's level critical");
        spdlog::error("the operator's line");
      });
  ASSERT_TRUE(is_logged);
  for (const Log& line : lab_control.log.wait_for(1)) {
    EXPECT_EQ(line.content, "the operator's line");
    EXPECT_EQ(line.id, "high_level_controller");
    EXPECT_EQ(line.level, 1);
  }

  // From some line on the process knows that the operator wants to read everything.
  lab_control.level.write({.level = 3});
  const bool reads_all = time::Signal{}.repeat_until(
      dds::soon(), std::chrono::milliseconds{10},
      [&] {
        return std::ranges::any_of(lab_control.log.wait_for(1),
                                   [](const Log& line) { return line.level == 3; });
      },
      [] { spdlog::info("for the operator's level of all lines"); });
  EXPECT_TRUE(reads_all);
}

TEST_F(HlcProcessTest, TellsTheOperatorThatItsVehicleFitsNoRouteAndIsNotReadyUntilItDoes) {
  Operator lab_control{domains_.first()};
  FakeMiddleware middleware{local()};
  ASSERT_TRUE(lab_control.sees(*process_) && middleware.lists.wait_for_matched(1, dds::soon()));
  const Pose start = scenario::measured_start(red_alone(), scenario::vehicle_of(red_alone(), {1}));
  const Pose beside = compose(start, {0.0, 0.0, 1.5});
  ASSERT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), std::chrono::milliseconds{50},
      [&] { return middleware.commands.wait_for(0).size() >= 8; },
      [&] { middleware.lists.write(list_of(beside, 0.0)); }));
  ASSERT_GE(lab_control.log.wait_for(1).size(), 1U);
  EXPECT_NE(lab_control.log.wait_for(1)[0].content.find("fits no route: nearest is red"),
            std::string::npos)
      << lab_control.log.wait_for(1)[0].content;
  EXPECT_TRUE(middleware.ready.wait_for(0).empty());
  EXPECT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), std::chrono::milliseconds{50},
      [&] { return !middleware.ready.wait_for(0).empty(); },
      [&] { middleware.lists.write(list_of(start, 0.0)); }));
}

/// Receives from every sender from now on.
bool are_matched(FakeMiddleware& middleware, Others& others) {
  return middleware.lists.wait_for_matched(1, dds::soon()) &&
         others.traffic.wait_for_matched(1, dds::soon()) &&
         others.reports.reader().wait_for_matched(1, dds::soon());
}

TEST_F(HlcProcessTest, NeitherTrafficOfWhoTakesNoPartNorOfAnotherTimeStartsItsVehicle) {
  FakeMiddleware middleware{local()};
  Others others{controllers()};
  ASSERT_TRUE(are_matched(middleware, others));
  const Pose start = scenario::measured_start(red_alone(), scenario::vehicle_of(red_alone(), {1}));
  EXPECT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), std::chrono::milliseconds{20}, [&] { return others.reports.now().size() >= 5; },
      [&] {
        VehicleStateList list = list_of(start, 0.0);
        list.active_vehicle_ids = {1, 2};
        others.traffic.write(traffic_of(2, list.t_now / kPeriod - 3));
        others.traffic.write(traffic_of(3, list.t_now / kPeriod));
        middleware.lists.write(list);
      }));
  for (const ReportRecord& record : others.reports.now()) {
    EXPECT_EQ(record.report.status, coordination::StepStatus::kStandby);
  }
}

TEST_F(HlcProcessTest, JoinsARunningExperimentByTheOthersTrafficOnceItsVehicleStands) {
  FakeMiddleware middleware{local()};
  Others others{controllers()};
  ASSERT_TRUE(are_matched(middleware, others));
  const Pose start = scenario::measured_start(red_alone(), scenario::vehicle_of(red_alone(), {1}));
  const auto publish_speed = [&](double speed_mps) {
    VehicleStateList list = list_of(start, speed_mps);
    list.active_vehicle_ids = {1, 2};
    others.traffic.write(traffic_of(2, list.t_now / kPeriod));
    middleware.lists.write(list);
  };
  const auto ends = std::chrono::steady_clock::now() + std::chrono::seconds{1};
  static_cast<void>(time::Signal{}.repeat_until(
      ends, std::chrono::milliseconds{50}, [] { return false; }, [&] { publish_speed(0.5); }));
  EXPECT_TRUE(middleware.commands.wait_for(0).empty()) << "it drives what it was left";
  EXPECT_TRUE(others.reports.wait_for(0).empty());
  const auto drives = [&] {
    return std::ranges::any_of(others.reports.wait_for(0), [](const ReportRecord& record) {
      return record.report.status == coordination::StepStatus::kPlanned;
    });
  };
  EXPECT_TRUE(time::Signal{}.repeat_until(dds::soon(), std::chrono::milliseconds{20}, drives,
                                          [&] { publish_speed(0.0); }));
  EXPECT_EQ(others.reports.wait_for(1)[0].report.status, coordination::StepStatus::kStandby);
}

TEST_F(HlcProcessTest, WithoutTriggerAndTrafficItWaits) {
  FakeMiddleware middleware{local()};
  Others others{controllers()};
  ASSERT_TRUE(are_matched(middleware, others));
  const Pose start = scenario::measured_start(red_alone(), scenario::vehicle_of(red_alone(), {1}));
  ASSERT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), std::chrono::milliseconds{50},
      [&] { return others.reports.wait_for(0).size() >= 5; },
      [&] { middleware.lists.write(list_of(start, 0.0)); }));
  for (const ReportRecord& record : others.reports.wait_for(5)) {
    EXPECT_EQ(record.report.status, coordination::StepStatus::kStandby);
  }
}

TEST_F(HlcProcessTest, AsksTheLabControlToStopWhenItsPeriodIsNotTheLabs) {
  Operator lab_control{domains_.first()};
  FakeMiddleware middleware{local()};
  ASSERT_TRUE(lab_control.sees(*process_) && middleware.lists.wait_for_matched(1, dds::soon()));
  VehicleStateList list = list_of_nobody();
  list.period_ms = 400;
  middleware.lists.write(list);
  ASSERT_EQ(lab_control.stop_requests.wait_for(1).size(), 1U);
  ASSERT_EQ(code_.wait_until(dds::soon()), std::future_status::ready);
  EXPECT_EQ(code_.get(), kExitBadInput);
}

}  // namespace
}  // namespace hlc::process
