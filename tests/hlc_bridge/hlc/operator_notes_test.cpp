#include "hlc_bridge/hlc/operator_notes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/controller/control_loop.hpp"
#include "planner/coordination/priorities/strategies.hpp"
#include "tests/planner/controller/east_bound.hpp"

namespace hlc::high_level_controller::operator_notes_test {
namespace {

using controller::east_bound::at;
using controller::east_bound::following;
using controller::east_bound::seen;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

std::vector<machine::LogLine> lines_of(HlcActions& actions) {
  std::vector<machine::LogLine> lines;
  for (const HlcAction& action : actions.take())
    lines.push_back(std::get<machine::LogLine>(action));
  return lines;
}

TEST(OperatorNotes, LogThatAVehicleIsStuckOnceInAWait) {
  const auto controller = controller::east_bound::controller(1);
  static_cast<void>(controller->stand_by(at(99, {seen(1, 0.0, 0.0)})));
  OperatorNotes notes;
  HlcActions actions;
  for (std::uint64_t k = 100; k < 320; ++k) {
    coordination::Report report{
        .vehicle = {1}, .step = {k}, .status = coordination::StepStatus::kPlanned};
    if (k != 210) report.waiting = {.vehicles = {{4}}, .since = {k < 210 ? 100U : 211U}};
    notes.note_step(*controller, report, actions);
  }
  const machine::LogLine line = machine::warning(
      "stuck: vehicle 1, waiting for 4 for 20.0 s, although its road would be free without the "
      "others; it has not moved since its controller began: if that was at the start of the run, "
      "place the vehicles elsewhere");
  EXPECT_THAT(lines_of(actions), ElementsAre(line, line));
}

TEST(OperatorNotes, LogOnceWhatDisturbsAVehicleAndThatItPlansOn) {
  const auto one = controller::east_bound::controller(1);
  static_cast<void>(one->stand_by(at(100, {seen(1, 0.0, 0.0)})));
  OperatorNotes notes;
  HlcActions actions;
  std::uint64_t k = 100;
  const auto drive = [&](int steps, const std::optional<double>& beside_m) {
    for (int i = 0; i < steps; ++i) {
      ++k;
      coordination::MeasuredVehicle car = following(*one, k);
      car.pose.y_m += beside_m.value_or(0.0);
      static_cast<void>(one->observe(
          at(k, beside_m ? std::vector{car} : std::vector<coordination::MeasuredVehicle>{})));
      one->couple({});
      static_cast<void>(one->plan({}));
      notes.note_step(*one, one->commit({}, {}), actions);
    }
  };
  drive(5, 0.0);
  drive(3, std::nullopt);
  drive(2, 0.0);
  drive(2, 0.080);
  drive(2, 1.3);
  drive(1, 0.0);
  EXPECT_THAT(lines_of(actions),
              ElementsAre(Field(&machine::LogLine::text, HasSubstr("vehicle 1 is not seen")),
                          machine::info("vehicle 1 plans on"),
                          Field(&machine::LogLine::text, HasSubstr("is off its plan by 80 mm")),
                          Field(&machine::LogLine::text, HasSubstr("vehicle 1 is elsewhere")),
                          machine::info("vehicle 1 plans on")));
}

/// Car 1 of a controller that plans for others, beside car 2, whose traffic comes without a
/// planning input.
class NotesOfRounds : public testing::Test {
 protected:
  void step(std::uint64_t k) {
    const std::vector states{seen(1, 0.0, 0.0), seen(2, 0.0, 0.3)};
    const auto two = controller::east_bound::controller(2, 0.3);
    static_cast<void>(loop_.begin(at(k, states)));
    static_cast<void>(two->stand_by(at(k - 1, states)));
    loop_.receive(two->observe(at(k, states)));
    static_cast<void>(loop_.proceed());
    notes_.note_rounds({1}, *loop_.two_rounds(), actions_);
    static_cast<void>(loop_.proceed());
    static_cast<void>(loop_.proceed());
  }

  controller::Controller one_{
      controller::ControllerOptions{
          .vehicle = {1},
          .others = [](VehicleId id) { return controller::east_bound::controller(id.value); }},
      controller::east_bound::subgraph(),
      road::ReferencePath({Point(0.0, 0.0), Point(10.0, 0.0)}, false), road::Corridor{}};
  controller::ControlLoop loop_{one_, {}, controller::Rounds::kTwo};
  OperatorNotes notes_;
  HlcActions actions_;
};

TEST_F(NotesOfRounds, LogOnceForWhomVehiclesPlanOneAfterTheOther) {
  static_cast<void>(loop_.stand_by(at(99, {seen(1, 0.0, 0.0), seen(2, 0.0, 0.3)})));
  step(100);
  step(101);
  EXPECT_THAT(
      lines_of(actions_),
      ElementsAre(Field(&machine::LogLine::text,
                        HasSubstr("one after the other: vehicle 2 cannot be planned for here: not "
                                  "seen"))));
}

TEST(OperatorNotes, NameTheOwnVehicleAloneIfOthersCannotPlanForIt) {
  const auto one = controller::east_bound::controller(1);
  controller::TwoRounds rounds({});
  rounds.choose(*one);
  OperatorNotes notes;
  HlcActions actions;
  notes.note_rounds({1}, rounds, actions);
  EXPECT_THAT(lines_of(actions),
              ElementsAre(Field(&machine::LogLine::text,
                                HasSubstr("the others cannot plan for this vehicle 1: it is not "
                                          "seen, misses another controller"))));
}

TEST(OperatorNotes, LogOnceThatMoreVehiclesAreCoupledThanPrioritiesCompare) {
  const controller::ControllerStrategies optimal{
      .priorities = {.strategy = &coordination::kOptimalPriorities}};
  std::vector<std::unique_ptr<controller::Controller>> all;
  std::vector<coordination::MeasuredVehicle> states;
  for (std::uint8_t id = 1; id <= 6; ++id) {
    all.push_back(controller::east_bound::controller(id, 0.3 * id, optimal));
    states.push_back(seen(id, 0.0, 0.3 * id));
  }
  for (const auto& one : all) static_cast<void>(one->stand_by(at(99, states)));
  OperatorNotes notes;
  HlcActions actions;
  for (std::uint64_t k = 100; k < 102; ++k) {
    std::vector<coordination::Traffic> traffic;
    for (const auto& one : all) traffic.push_back(one->observe(at(k, states)));
    controller::Controller& first = *all.front();
    first.couple(traffic);
    ASSERT_EQ(first.component().size(), 6U);
    for (const auto& one : all) {
      notes.note_step(first, one->fall_back(coordination::FallbackReason::kLate), actions);
    }
  }
  EXPECT_THAT(lines_of(actions),
              ElementsAre(machine::warning("6 vehicles are coupled, priorities optimal compare "
                                           "orders of 5 at most: larger groups get constant")));
}

TEST(OperatorNotes, LogOnceThatStepsEndLateWithoutNamingPlanningAloneAsTheCause) {
  const auto one = controller::east_bound::controller(1);
  controller::TwoRounds rounds({});
  OperatorNotes notes;
  HlcActions actions;
  for (std::uint64_t k = 100; k < 110; ++k) {
    static_cast<void>(one->stand_by(at(k, {seen(1, 0.0, 0.0)})));
    rounds.end_late(*one);
    notes.note_rounds({1}, rounds, actions);
  }
  EXPECT_THAT(lines_of(actions),
              ElementsAre(Field(&machine::LogLine::text,
                                HasSubstr("3 of 50 steps with two rounds ended late"))));
}

}  // namespace
}  // namespace hlc::high_level_controller::operator_notes_test
