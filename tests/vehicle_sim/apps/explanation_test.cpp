#include "vehicle_sim/apps/explanation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hlc::apps {
namespace {

using coordination::FallbackReason;
using coordination::PlanQuality;
using coordination::StepStatus;
using testing::HasSubstr;
using testing::Not;

StepOutcome planned(double ahead_m) {
  return {.report = {.vehicle = {3},
                     .step = {60},
                     .status = StepStatus::kPlanned,
                     .subgraph = "B",
                     .quality = PlanQuality::kOptimal,
                     .coupled = {{1}, {2}}},
          .ahead_m = ahead_m};
}

StepOutcome kept(FallbackReason reason, std::vector<VehicleId> blocked_by) {
  StepOutcome outcome = planned(0.4);
  outcome.report.status = StepStatus::kFallback;
  outcome.report.reason = reason;
  outcome.report.blocked_by = std::move(blocked_by);
  return outcome;
}

ExplainedStep step_with(StepOutcome outcome) {
  return {.name = "green",
          .step = 57,
          .step_s = 0.2,
          .outcome = std::move(outcome),
          .others = {{1}, {2}, {4}},
          .without_one = {},
          .without_all = {}};
}

TEST(Explanation, NamesVehicleStepTimeAndWhatItDid) {
  const std::string text = explanation(step_with(planned(0.93)));
  EXPECT_THAT(text, HasSubstr("vehicle 3       green, step 57 (11.4 s), subgraph B\n"));
  EXPECT_THAT(text, HasSubstr("a new plan 0.93 m ahead, the best possible"));
  EXPECT_THAT(text, HasSubstr("messages of all others: vehicles 1, 2, 4"));
  EXPECT_THAT(text, HasSubstr("may come near: vehicles 1, 2; planned before all of them"));
}

TEST(Explanation, NamesWhatThePlanBeginsWithAndTheNextBest) {
  ExplainedStep explained = step_with(planned(0.93));
  explained.choice = {.first = "J2 to trim 8", .next_best = "trim 7 kept", .extra_m2 = 0.031};
  EXPECT_THAT(explanation(explained),
              HasSubstr(" it begins with J2 to trim 8; next best: trim 7 kept, +0.031 m^2\n"));
  explained.choice->next_best.clear();
  EXPECT_THAT(explanation(explained), HasSubstr("; no plan begins with another maneuver\n"));
}

TEST(Explanation, NamesTheReasonOfAFallbackAndWhoCausedIt) {
  const auto words = [](FallbackReason reason, std::vector<VehicleId> by) {
    return explanation(step_with(kept(reason, std::move(by))));
  };
  EXPECT_THAT(words(FallbackReason::kConflict, {{2}}),
              HasSubstr("kept its plan, 0.40 m ahead: the new plan meets that of vehicle 2\n"));
  EXPECT_THAT(words(FallbackReason::kInfeasible, {{1}, {4}}),
              HasSubstr("no other plan is possible because of vehicles 1, 4"));
  EXPECT_THAT(words(FallbackReason::kInfeasible, {}), HasSubstr("in its lanes"));
  EXPECT_THAT(words(FallbackReason::kMissing, {{1}}),
              HasSubstr("messages are missing because of vehicle 1"));
}

TEST(Explanation, HasTheProofAndTheGapOfAPlan) {
  StepOutcome outcome = planned(0.5);
  outcome.report.quality = PlanQuality::kBudget;
  outcome.report.gap_m2 = 0.0125;
  EXPECT_THAT(explanation(step_with(outcome)), HasSubstr("at most 0.0125 m^2 above the best"));
}

TEST(Explanation, NamesThoseWithoutWhichItWouldHaveBeenOtherwise) {
  ExplainedStep explained = step_with(planned(0.0));
  explained.outcome.report.waiting = {.vehicles = {{2}}, .since = {51}};
  explained.without_one = {{.gone = {{1}}, .outcome = planned(0.0)},
                           {.gone = {{2}}, .outcome = planned(0.8)},
                           {.gone = {{4}}, .outcome = planned(0.0)}};
  explained.without_all = {.gone = {{1}, {2}, {4}}, .outcome = planned(1.1)};
  const std::string text = explanation(explained);
  EXPECT_THAT(text, HasSubstr("did             a new plan: it stands"));
  EXPECT_THAT(text, HasSubstr("vehicle 3, waiting for 2 for 2.0 s"));
  EXPECT_THAT(text, HasSubstr("alone           a new plan 1.10 m ahead"));
  EXPECT_THAT(text, HasSubstr("without 2       a new plan 0.80 m ahead"));
  EXPECT_THAT(text, HasSubstr("the same without 1, 4, each alone"));
}

ExplainedStep::Limit limit(std::string name, double ahead_m, double extra_m2) {
  return {.name = std::move(name), .note = {}, .ahead_m = ahead_m, .extra_m2 = extra_m2};
}

TEST(Explanation, NamesTheLimitsThatCostSomethingAndThoseThatDidNot) {
  ExplainedStep explained = step_with(planned(0.5));
  explained.limits = {limit("", 0.5, 0.0), limit("", 0.7, -0.2),
                      limit("the lane boundary", 0.5, -0.012),
                      limit("the end of its right of way", 0.93, -0.3),
                      limit("zone 1 of policy mixed (at most 0.6 m/s)", 0.5, 0.0)};
  explained.limits[0].vehicle = VehicleId{1};
  explained.limits[1].vehicle = VehicleId{2};
  explained.limits[3].note = "the road ahead is held by vehicle 4";
  const std::string text = explanation(explained);
  EXPECT_THAT(text, HasSubstr("\nwithout the areas of 2   a new plan 0.70 m ahead, -0.2 m^2\n"));
  EXPECT_THAT(text,
              HasSubstr("\nwithout the lane boundary   a new plan 0.50 m ahead, -0.012 m^2\n"));
  EXPECT_THAT(text, HasSubstr("\nwithout the end of its right of way   a new plan 0.93 m ahead, "
                              "-0.3 m^2\n                the road ahead is held by vehicle 4\n"));
  EXPECT_THAT(text,
              HasSubstr("the same without the areas of 1, zone 1 of policy mixed (at most 0.6 "
                        "m/s), each alone\n"));
}

TEST(Explanation, OfAFallbackNamesTheLimitsWithoutWhichThereIsAPlan) {
  ExplainedStep explained = step_with(kept(FallbackReason::kInfeasible, {}));
  explained.limits = {{.name = "the lane boundary", .note = {}, .ahead_m = 0.3, .extra_m2 = {}},
                      {.name = "zone 1", .note = {}, .ahead_m = {}, .extra_m2 = {}}};
  const std::string text = explanation(explained);
  EXPECT_THAT(text, HasSubstr("\nwithout the lane boundary   a new plan 0.30 m ahead\n"));
  EXPECT_THAT(text, HasSubstr("the same without zone 1\n"));
}

TEST(Explanation, OfAVehicleThatIsAloneHasNoOthers) {
  ExplainedStep explained = step_with(planned(0.5));
  explained.others.clear();
  explained.outcome.report.coupled.clear();
  const std::string text = explanation(explained);
  EXPECT_THAT(text, HasSubstr("no other vehicle"));
  EXPECT_THAT(text, Not(HasSubstr("alone")));
}

}  // namespace
}  // namespace hlc::apps
