// Whatever comes in whatever order: what holds of the machine of a controller.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <tuple>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "tests/hlc_bridge/hlc/driven_machine.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::high_level_controller::hlc_machine_property_test {
namespace {

using namespace driven_machine;
using controller::east_bound::seen;
using testing::AnyOf;
using testing::Eq;

// --- logical time: the order of arrival does not count -------------------------------------------

constexpr std::size_t kCars = 3;
constexpr double kBeside_m = 0.25;  // coupled with the neighbour

/// The bitwise result of a step.
using Result =
    std::tuple<std::uint64_t, coordination::StepStatus, coordination::FallbackReason, double,
               double, std::uint64_t, std::uint64_t, double, std::size_t, std::size_t>;
Result result_of(const coordination::Report& report) {
  return {report.step.value,       report.status,        report.reason,   report.planned_pose.x_m,
          report.planned_pose.y_m, report.generated,     report.expanded, report.cost_m2,
          report.coupled.size(),   report.missing.size()};
}

/// Three machines side by side, whose cars follow their plans; nothing is lost.
class Platoon {
 public:
  /// @param random  picks what arrives next; nullptr: in the order of publishing
  std::array<std::vector<Result>, kCars> drive(std::uint64_t steps, std::mt19937_64* random) {
    for (std::size_t i = 0; i < kCars; ++i) {
      std::set<std::uint8_t> others{1, 2, 3};
      others.erase(id(i));
      deliver(i, peers(others));
    }
    for (std::uint64_t step = kFirstStep + 1; step <= kFirstStep + steps; ++step) {
      const VehicleStateList list = list_of(step, measured(step));
      for (std::size_t i = 0; i < kCars; ++i) on_the_way_.emplace_back(i, list);
      while (!on_the_way_.empty()) {
        const std::size_t next = random == nullptr ? 0 : (*random)() % on_the_way_.size();
        auto [to, event] = std::move(on_the_way_[next]);
        on_the_way_.erase(on_the_way_.begin() + static_cast<std::ptrdiff_t>(next));
        deliver(to, std::move(event));
      }
    }
    return results_;
  }

 private:
  static std::uint8_t id(std::size_t i) { return static_cast<std::uint8_t>(i + 1); }
  static double y_m(std::size_t i) { return kBeside_m * static_cast<double>(i); }

  [[nodiscard]] std::vector<coordination::MeasuredVehicle> measured(std::uint64_t step) {
    std::vector<coordination::MeasuredVehicle> states;
    for (std::size_t i = 0; i < kCars; ++i) {
      const controller::Controller& one = machines_.at(i).machine().controller();
      states.push_back(one.has_plan() ? controller::east_bound::following(one, step)
                                      : seen(id(i), 0.0, y_m(i)));
    }
    return states;
  }

  void deliver(std::size_t to, HlcEvent event) {
    machines_.at(to).on(std::move(event));
    publish<coordination::Traffic>(to);
    publish<coordination::Prediction>(to);
    publish<coordination::Outcome>(to);
    for (const ReportRecord& record : machines_.at(to).take<ReportRecord>()) {
      results_.at(to).push_back(result_of(record.report));
    }
  }
  template <class Message>
  void publish(std::size_t from) {
    for (const Message& message : machines_.at(from).take<Message>()) {
      for (std::size_t to = 0; to < kCars; ++to) {
        if (to != from) on_the_way_.emplace_back(to, message);
      }
    }
  }

  std::array<DrivenMachine, kCars> machines_{DrivenMachine{logical_time(), 1, y_m(0)},
                                             DrivenMachine{logical_time(), 2, y_m(1)},
                                             DrivenMachine{logical_time(), 3, y_m(2)}};
  std::vector<std::pair<std::size_t, HlcEvent>> on_the_way_;
  std::array<std::vector<Result>, kCars> results_;
};

TEST(HlcMachineProperty, InLogicalTimeTheOrderOfArrivalChangesNothing) {
  constexpr std::uint64_t kSteps = 25;
  const auto in_order = Platoon{}.drive(kSteps, nullptr);
  for (std::size_t i = 0; i < kCars; ++i) {
    ASSERT_EQ(in_order.at(i).size(), kSteps) << "every list is answered";
    EXPECT_EQ(std::get<1>(in_order.at(i).back()), coordination::StepStatus::kPlanned);
  }
  for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(10); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    ASSERT_EQ(Platoon{}.drive(kSteps, &random), in_order);
  }
}

// --- real time: whatever happens around it -------------------------------------------------------

/// Car 1's machine, to which anything may happen; car 2 is somewhere beside it.
class Turmoil {
 public:
  Turmoil(std::uint64_t seed, bool is_lab)
      : random_(seed), one_(is_lab ? real_time_in_the_lab() : real_time()) {
    one_.on(peers({2}));
  }

  void happens() {
    switch (pick(10)) {
      case 0:
        return one_.on(any_peers());
      case 1:
        return one_.on(pick(8) == 0 ? RunState{.phase = RunPhase::kMinimalRiskStop}
                                    : RunState{.start = pick(2) * one_.now().run});
      case 2:
        return one_.on(any_traffic());
      case 3:
        return one_.on(coordination::Prediction{.vehicle = {2}, .step = any_step()});
      case 4:
        return one_.on(coordination::Outcome{
            .vehicle = {2}, .step = any_step(), .wants_fallback = pick(2) == 0});
      case 5:
        return one_.on(AutomatonRequest{
            .vehicle = {1},
            .id = ++requests_,
            .subgraph = {.labels = {}, .max_speed_mps = 0.1 + 0.2 * static_cast<double>(pick(5))}});
      case 6:
        return prepare_requests();
      default:
        return see();
    }
  }

  /// Of what was published since the last call.
  void check() {
    for (const HlcAction& action : one_.take_all()) {
      if (const auto* traffic = std::get_if<coordination::Traffic>(&action))
        last_traffic_ = traffic->step;
      if (const auto* prediction = std::get_if<coordination::Prediction>(&action)) {
        ASSERT_EQ(prediction->step, last_traffic_)
            << "a controller that plans has published its traffic";
      }
      if (const auto* record = std::get_if<ReportRecord>(&action)) {
        ASSERT_GT(record->report.step, last_report_) << "each step is done once";
        last_report_ = record->report.step;
      }
      if (const auto* command = std::get_if<TrajectoryCommand>(&action)) check(*command);
      if (const auto* prepare = std::get_if<PrepareRequest>(&action)) in_work_.push_back(*prepare);
    }
  }

  void end() {
    const bool is_symbol = pick(2) == 0;
    if (is_symbol && !one_.exit_code()) {
      check();
      is_stopped_ = true;
      one_.on(SystemTrigger{.next_start = kStopSymbol});
      ASSERT_TRUE(one_.exit_code());
    } else {
      one_.on(machine::StopSignal{});
      one_.pass(CommandCopies::kPause);
      ASSERT_TRUE(one_.exit_code());
    }
    EXPECT_THAT(*one_.exit_code(),
                AnyOf(Eq(kExitGood), Eq(kExitBadInput), Eq(kExitMissing), Eq(kExitDied)));
    check();
  }

  [[nodiscard]] bool has_ended() const { return one_.exit_code().has_value(); }
  [[nodiscard]] bool has_planned() const { return last_traffic_.value != 0; }

 private:
  std::uint64_t pick(std::uint64_t count) { return random_() % count; }
  StepIndex any_step() { return {one_.step() + pick(5) - 2}; }

  HlcPeers any_peers() {
    HlcPeers result = peers({2});
    if (pick(8) == 0) result.lab = {.alive = {}, .lost = {kLabControlName}};
    if (pick(8) == 0) result.local.lost = {middleware_name(1)};
    if (pick(8) == 0) result.command_readers = 0;
    if (pick(8) == 0) result.stop_request_readers = 0;
    if (pick(8) == 0) result.lab.alive.insert(controller_name(1));
    if (pick(4) == 0) result.controllers.alive.clear();
    if (pick(4) == 0) result.receivers.clear();
    return result;
  }
  coordination::Traffic any_traffic() {
    coordination::Traffic traffic;
    traffic.vehicle = {static_cast<std::uint8_t>(pick(20) == 0 ? 1 : 2)};
    traffic.step = any_step();
    return traffic;
  }
  void check(const TrajectoryCommand& command) {
    ASSERT_TRUE(lists_.contains(command.create_stamp)) << "it answers a list";
    ASSERT_GE(command.create_stamp, last_command_);
    ASSERT_FALSE(is_stopped_) << "the vehicle must receive nothing";
    last_command_ = command.create_stamp;
  }
  void prepare_requests() {
    EXPECT_LE(in_work_.size(), 1U);
    for (const PrepareRequest& one : std::exchange(in_work_, {})) {
      one_.on(prepare(one_.machine().request_base(), one.request));
    }
  }
  void see() {
    const controller::Controller& controller = one_.machine().controller();
    const std::uint64_t step = std::max(one_.step() + 1, one_.now().run / kPeriod + 1);
    coordination::MeasuredVehicle own = seen(1, 0.0, 0.0);
    if (controller.has_plan()) own = controller::east_bound::following(controller, step);
    if (pick(20) == 0) own.pose.y_m += 0.05;
    std::vector<coordination::MeasuredVehicle> vehicles{own};
    if (pick(4) != 0) vehicles.push_back(seen(2, 1.0, 0.3));
    const VehicleStateList list = one_.wait_for_list(vehicles);
    lists_.insert(list.t_now);
    one_.delay(pick(4) == 0 ? pick(kPeriod) : 0);
    one_.on(list);
    one_.pass(pick(kPeriod / 2));
  }

  std::mt19937_64 random_;
  DrivenMachine one_;
  std::set<Nanoseconds> lists_;
  Nanoseconds last_command_{};
  StepIndex last_report_{};
  StepIndex last_traffic_{};
  std::uint64_t requests_{};
  std::vector<PrepareRequest> in_work_;
  bool is_stopped_{};
};

TEST(HlcMachineProperty, WhateverHappensEveryListIsAnsweredOnceAndItEnds) {
  std::size_t planned = 0;
  for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Turmoil turmoil(seed, seed % 2 == 0);
    for (int i = 0; i < 150 && !turmoil.has_ended(); ++i) {
      turmoil.happens();
      turmoil.check();
      if (testing::Test::HasFailure()) return;
    }
    planned += turmoil.has_planned();
    turmoil.end();
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(planned, 0U);
  RecordProperty("runs_that_planned", static_cast<int>(planned));
}

}  // namespace
}  // namespace hlc::high_level_controller::hlc_machine_property_test
