#include "hlc_bridge/hlc/reconfiguration.hpp"

#include <gtest/gtest.h>

#include "planner/maneuver_design/built_automaton.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"

namespace hlc::high_level_controller::reconfiguration_test {
namespace {

constexpr VehicleId kRed{1};
constexpr Nanoseconds kStep = 200'000'000;

const scenario::Scenario& scenario() {
  static const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/paper_red_alone.yaml"});
  return scenario;
}

AutomatonRequest slow(std::uint64_t id, double max_speed_mps, Nanoseconds valid_from = 0) {
  return {.vehicle = kRed,
          .id = id,
          .valid_from = valid_from,
          .subgraph = {.labels = {}, .max_speed_mps = max_speed_mps}};
}

class ReconfigurationTest : public testing::Test {
 protected:
  AutomatonAnswer take(const AutomatonRequest& request, std::uint64_t step) {
    return reconfiguration_.take(prepare(base(), request), {step}).back();
  }
  std::optional<AutomatonAnswer> begin(std::uint64_t step) {
    const auto answer = reconfiguration_.begin_step(selector_, {step}, step * kStep);
    EXPECT_EQ(selector_.begin_step(*controller_, {step}, StepIndex{0}, {}), answer.has_value());
    return answer;
  }
  [[nodiscard]] RequestBase base() const {
    return {.subgraph = selector_.base(),
            .limits_mps = selector_.limits_mps(),
            .horizon_steps = scenario().horizon_steps,
            .search = scenario().search};
  }
  [[nodiscard]] std::optional<double> limit_mps() const {
    return controller_->subgraph().spec().max_speed_mps;
  }

  std::unique_ptr<controller::Controller> controller_ = scenario::make_controller(scenario(), kRed);
  policy::SubgraphSelector selector_{*controller_, {}};
  Reconfiguration reconfiguration_;
};

TEST_F(ReconfigurationTest, IsInForceFromTheFirstStepOfItsTimeOn) {
  const AutomatonAnswer accepted = take(slow(5, 0.6, 12 * kStep - 1), 10);
  EXPECT_EQ(accepted.outcome, RequestOutcome::kAccepted) << accepted.text;
  EXPECT_EQ(accepted.id, 5U);
  EXPECT_EQ(accepted.step, StepIndex{10});
  for (std::uint64_t step = 10; step < 12; ++step) {
    EXPECT_FALSE(begin(step));
    EXPECT_EQ(limit_mps(), std::nullopt);
  }
  const std::optional<AutomatonAnswer> in_force = begin(12);
  ASSERT_TRUE(in_force);
  EXPECT_EQ(in_force->outcome, RequestOutcome::kInForce);
  EXPECT_EQ(in_force->step, StepIndex{12});
  EXPECT_EQ(controller_->subgraph().spec().name, "B, at most 0.6 m/s");
  EXPECT_EQ(limit_mps(), 0.6);
  EXPECT_FALSE(begin(13)) << "reported once";
}

TEST_F(ReconfigurationTest, ALaterRequestCountsWhicheverComesFirst) {
  EXPECT_EQ(take(slow(7, 0.6), 1).outcome, RequestOutcome::kAccepted);
  EXPECT_EQ(take(slow(6, 0.5), 1).outcome, RequestOutcome::kStale);
  EXPECT_EQ(take(slow(7, 0.6), 1).outcome, RequestOutcome::kStale) << "received twice";
  ASSERT_TRUE(begin(2));
  EXPECT_EQ(limit_mps(), 0.6);
  EXPECT_EQ(take(slow(8, 0.5), 3).outcome, RequestOutcome::kAccepted);
  EXPECT_EQ(take(slow(9, 0.7), 3).outcome, RequestOutcome::kAccepted);
  ASSERT_TRUE(begin(3));
  EXPECT_EQ(limit_mps(), 0.7);
}

// Its asker need not wait for it.
TEST_F(ReconfigurationTest, AnAcceptedRequestThatALaterOneTakesThePlaceOfIsToldSo) {
  EXPECT_EQ(take(slow(1, 0.6, 9 * kStep), 1).outcome, RequestOutcome::kAccepted);
  const auto answers = reconfiguration_.take(prepare(base(), slow(2, 0.5)), {2});
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers[0].id, 1U);
  EXPECT_EQ(answers[0].outcome, RequestOutcome::kStale);
  EXPECT_EQ(answers[1].id, 2U);
  EXPECT_EQ(answers[1].outcome, RequestOutcome::kAccepted);
}

TEST_F(ReconfigurationTest, ARefusedRequestLeavesWhatIsInForceAndWhatWaits) {
  EXPECT_EQ(take(slow(1, 0.6), 1).outcome, RequestOutcome::kAccepted);
  ASSERT_TRUE(begin(1));
  EXPECT_EQ(take(slow(2, 0.5, 5 * kStep), 2).outcome, RequestOutcome::kAccepted);
  const AutomatonAnswer refused = take(slow(3, 0.1), 2);
  EXPECT_EQ(refused.outcome, RequestOutcome::kRefused);
  EXPECT_NE(refused.text.find("speed limit 0.1 m/s, must be >= 0.4"), std::string::npos);
  EXPECT_FALSE(begin(3));
  EXPECT_EQ(limit_mps(), 0.6);
  ASSERT_TRUE(begin(5));
  EXPECT_EQ(limit_mps(), 0.5);
}

// Not from the last request, so a late joiner needs only the last one.
TEST_F(ReconfigurationTest, EveryRequestStartsFromTheScenariosSubgraph) {
  EXPECT_EQ(take(slow(1, 0.6), 1).outcome, RequestOutcome::kAccepted);
  ASSERT_TRUE(begin(1));
  EXPECT_EQ(take({.vehicle = kRed, .id = 2, .valid_from = 0, .subgraph = {}}, 2).outcome,
            RequestOutcome::kAccepted);
  ASSERT_TRUE(begin(2));
  EXPECT_EQ(controller_->subgraph().spec(), scenario().subgraph->spec());
}

TEST_F(ReconfigurationTest, NewWeightsAreInForceOnAnAutomatonThatHoldsThem) {
  WeightDesign weights(scenario().subgraph->shared_automaton(), [] {
    return maneuver_design::read_configuration_of(scenario().automaton_file);
  });
  const AutomatonRequest request{
      .vehicle = kRed,
      .id = 1,
      .valid_from = 0,
      .subgraph = {.labels = {}, .weights = {{"J2", 0.7}, {"J1", 0.3}}, .max_speed_mps = 0.7}};
  const PreparedRequest prepared = prepare(base(), request, &weights);
  EXPECT_EQ(reconfiguration_.take(prepared, {1}).back().outcome, RequestOutcome::kAccepted)
      << prepared.refusal;
  const std::optional<AutomatonAnswer> in_force = begin(1);
  ASSERT_TRUE(in_force);
  EXPECT_EQ(controller_->subgraph().spec().name, "B, weights J1 0.3 J2 0.7, at most 0.7 m/s");
  for (const TrimId from : controller_->subgraph().trims()) {
    for (const automaton::Edge& edge : controller_->subgraph().successors(from)) {
      EXPECT_TRUE(edge.to == from || edge.maneuver->label == "J1 0.3 J2 0.7");
    }
  }
  AutomatonRequest unknown = request;
  unknown.id = 2;
  unknown.subgraph = {.labels = {}, .weights = {{"J9", 1.0}}};
  const AutomatonAnswer refused =
      reconfiguration_.take(prepare(base(), unknown, &weights), {2}).back();
  EXPECT_EQ(refused.outcome, RequestOutcome::kRefused);
  EXPECT_NE(refused.text.find("'J9', must be one of J1"), std::string::npos) << refused.text;
  EXPECT_FALSE(begin(2));
  EXPECT_EQ(controller_->subgraph().spec().name, "B, weights J1 0.3 J2 0.7, at most 0.7 m/s");
}

}  // namespace
}  // namespace hlc::high_level_controller::reconfiguration_test
