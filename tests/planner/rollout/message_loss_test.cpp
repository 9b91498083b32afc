// Whatever subset of a step's messages is lost, the plans in force are free of collision pair by
// pair.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <string>

#include "planner/coordination/priorities/strategies.hpp"
#include "planner/rollout/rollout.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plans_in_force.hpp"

namespace hlc::rollout {
namespace {

using test::plans_in_force_are_free;

const controller::ControllerStrategies kStrict{.coordination = controller::kStrictCoordination};
const controller::ControllerStrategies kCooperative{.coordination =
                                                        controller::kCooperativeCoordination};
const controller::ControllerStrategies kRandomOrder{
    .priorities = {.strategy = &coordination::kRandomPriorities},
    .coordination = controller::kCooperativeCoordination};
const controller::ControllerStrategies kOrderByPlans{
    .priorities = {.strategy = &coordination::kBestOrder},
    .coordination = controller::kCooperativeCoordination};
const controller::ControllerStrategies kAgreed{.coordination = controller::kAgreedCoordination};

std::shared_ptr<const automaton::Subgraph> paper_subgraph() {
  static const auto subgraph = std::make_shared<const automaton::Subgraph>(
      automaton::paper_automaton(), automaton::paper_configuration().subgraphs.front());
  return subgraph;
}

struct ThreeCars {
  controller::ControllerStrategies strategies;
  std::array<double, 3> distances_m{1.0, 1.0, 1.0};
  controller::Rounds rounds{};
};

/// Of car i + 1: on a straight line through the origin, `distances_m` before it.
Pose start_of(std::size_t i, const ThreeCars& cars) {
  const double direction =
      2.0 * std::numbers::pi * static_cast<double>(i) / 3.0 + 0.1 * static_cast<double>(i);
  const Point position = -cars.distances_m[i] * Point(std::cos(direction), std::sin(direction));
  return {position.x(), position.y(), direction};
}

std::unique_ptr<controller::Controller> controller_of(std::size_t i, const ThreeCars& cars) {
  static const controller::PreparedSubgraph kPrepared = [] {
    const controller::ControllerOptions options;
    return controller::prepare_subgraph(paper_subgraph(), options.horizon_steps, options.search);
  }();
  const Pose start = start_of(i, cars);
  const Point ahead(std::cos(start.heading_rad), std::sin(start.heading_rad));
  controller::ControllerOptions options{.vehicle = {static_cast<std::uint8_t>(i + 1)},
                                        .strategies = cars.strategies};
  options.search.max_expansions = 20'000;
  if (cars.rounds == controller::Rounds::kTwo) {
    options.others = [cars](VehicleId vehicle) {
      ThreeCars others = cars;
      others.rounds = controller::Rounds::kSequential;
      return controller_of(vehicle.value - 1U, others);
    };
  }
  return std::make_unique<controller::Controller>(
      options, kPrepared,
      std::vector<road::DrivableRoute>{
          {.name = "",
           .path = road::ReferencePath({start.position_m(), 2.0 * ahead}, false),
           .corridor = {}}});
}

Rollout three_cars_that_meet(const ThreeCars& cars) {
  std::vector<std::unique_ptr<controller::Controller>> controllers;
  std::vector<Pose> starts;
  for (std::size_t i = 0; i < 3; ++i) {
    controllers.push_back(controller_of(i, cars));
    starts.push_back(start_of(i, cars));
  }
  Rollout rollout(std::move(controllers), starts);
  rollout.exchange_in(cars.rounds);
  return rollout;
}

Rollout three_cars_that_meet(const controller::ControllerStrategies& strategies,
                             const std::array<double, 3>& distances_m = {1.0, 1.0, 1.0}) {
  return three_cars_that_meet(ThreeCars{.strategies = strategies, .distances_m = distances_m});
}

/// Bit of a message in a pattern: 6 for traffic and 6 for what follows, one for each ordered pair
/// of the vehicles 1, 2, 3.
unsigned bit_of(const controller::Delivery& delivery) {
  const unsigned from = delivery.from.value - 1U;
  const unsigned to = delivery.to.value - 1U;
  const unsigned pair = 2U * from + (to > from ? to - 1U : to);
  return delivery.kind == controller::MessageKind::kTraffic ? pair : 6U + pair;
}

void lose_pattern(Rollout& rollout, std::uint32_t pattern, StepIndex step) {
  rollout.lose([pattern, step](const controller::Delivery& delivery) {
    return delivery.step == step && (pattern >> bit_of(delivery) & 1U) != 0U;
  });
}

constexpr unsigned kGuessSeeds = 60;
constexpr std::uint32_t kShortStride = 1021;

struct LossCase {
  std::string name;
  controller::ControllerStrategies strategies;
  int steps_before;
  controller::Rounds rounds{};
};

class LossOfOneStep : public testing::TestWithParam<LossCase> {};

// Which vehicles keep their plan and which change it, over all patterns, shows that the step is a
// hard one. In the next step a random pattern is lost.
TEST_P(LossOfOneStep, NoPatternLeadsToPlansThatMeet) {
  Rollout before = three_cars_that_meet(
      ThreeCars{.strategies = GetParam().strategies, .rounds = GetParam().rounds});
  for (int i = 0; i < GetParam().steps_before; ++i) static_cast<void>(before.step());
  ASSERT_TRUE(plans_in_force_are_free(before));

  constexpr unsigned kSeed = 1;
  std::mt19937 random(kSeed);
  std::map<std::string, int> outcomes;
  constexpr std::uint32_t kPatterns =
      1U << 12U;  // traffic, and predictions or outcomes; strict needs no third round
  for (std::uint32_t pattern = 0; pattern < kPatterns; pattern += test::kThinning) {
    const std::uint32_t next_pattern = static_cast<std::uint32_t>(random()) % kPatterns;
    Rollout rollout = before.clone();
    rollout.exchange_in(GetParam().rounds);
    lose_pattern(rollout, pattern, rollout.next_step());
    std::string outcome;
    for (const coordination::Report& report : rollout.step()) {
      outcome += report.status == coordination::StepStatus::kPlanned ? 'n' : 'o';
    }
    ++outcomes[outcome];
    ASSERT_TRUE(plans_in_force_are_free(rollout)) << "pattern " << pattern;
    lose_pattern(rollout, next_pattern, rollout.next_step());
    static_cast<void>(rollout.step());
    ASSERT_TRUE(plans_in_force_are_free(rollout))
        << "pattern " << next_pattern << " after " << pattern << ", seed " << kSeed;
    static_cast<void>(rollout.step());
    ASSERT_TRUE(plans_in_force_are_free(rollout))
        << "a step after " << pattern << " and " << next_pattern << ", seed " << kSeed;
  }
  EXPECT_EQ(outcomes.size(), 8U) << "every mixture of old and new plans should occur";
}

INSTANTIATE_TEST_SUITE_P(
    Rules, LossOfOneStep,
    testing::Values(LossCase{"Strict3", kStrict, 3}, LossCase{"Strict5", kStrict, 5},
                    LossCase{"Cooperative3", kCooperative, 3},
                    LossCase{"Cooperative5", kCooperative, 5},
                    LossCase{"TwoRounds3", kCooperative, 3, controller::Rounds::kTwo},
                    LossCase{"TwoRounds5", kCooperative, 5, controller::Rounds::kTwo},
                    LossCase{"RandomPriorities3", kRandomOrder, 3},
                    LossCase{"BestOrder3", kOrderByPlans, 3, controller::Rounds::kTwo}),
    [](const auto& tested) { return tested.param.name; });

/// All pairs of patterns of two consecutive steps: 4096^2 in the long form, evenly spread ones
/// otherwise.
class LossOfTwoSteps : public testing::TestWithParam<LossCase> {};

TEST_P(LossOfTwoSteps, NoPairOfPatternsLeadsToPlansThatMeet) {
  constexpr std::uint32_t kPatterns = 1U << 12U;
  const bool is_long = test::num_seeds(1) > 1;
  const std::uint32_t stride = is_long ? 1 : kShortStride * test::kThinning;
  const ThreeCars cars{.strategies = GetParam().strategies, .rounds = GetParam().rounds};
  Rollout before = three_cars_that_meet(cars);
  for (int i = 0; i < GetParam().steps_before; ++i) static_cast<void>(before.step());
  for (std::uint32_t first = 0; first < kPatterns; ++first) {
    Rollout after_first = before.clone();
    after_first.exchange_in(GetParam().rounds);
    lose_pattern(after_first, first, after_first.next_step());
    static_cast<void>(after_first.step());
    ASSERT_TRUE(plans_in_force_are_free(after_first)) << "pattern " << first;
    for (std::uint32_t second = first % stride; second < kPatterns; second += stride) {
      Rollout rollout = after_first.clone();
      rollout.exchange_in(GetParam().rounds);
      lose_pattern(rollout, second, rollout.next_step());
      static_cast<void>(rollout.step());
      ASSERT_TRUE(plans_in_force_are_free(rollout)) << "patterns " << first << ", " << second;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Rules, LossOfTwoSteps,
    testing::Values(LossCase{"Strict4", kStrict, 4}, LossCase{"Cooperative4", kCooperative, 4},
                    LossCase{"TwoRounds4", kCooperative, 4, controller::Rounds::kTwo}),
    [](const auto& tested) { return tested.param.name; });

class RandomLoss : public testing::TestWithParam<controller::Rounds> {};

TEST_P(RandomLoss, OverManyStepsNeverLeadsToPlansThatMeet) {
  for (unsigned seed = 0; seed < test::num_costly_seeds(20); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::bernoulli_distribution is_lost(0.02 + 0.02 * (seed % 20));
    Rollout rollout =
        three_cars_that_meet(ThreeCars{.strategies = kCooperative, .rounds = GetParam()});
    rollout.lose([&](const controller::Delivery&) { return is_lost(random); });
    for (int i = 0; i < 40; ++i) {
      static_cast<void>(rollout.step());
      ASSERT_TRUE(plans_in_force_are_free(rollout)) << "step " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rounds, RandomLoss,
                         testing::Values(controller::Rounds::kSequential, controller::Rounds::kTwo),
                         [](const auto& tested) {
                           return tested.param == controller::Rounds::kTwo ? "Two" : "Sequential";
                         });

class NamesOfOthers : public testing::TestWithParam<LossCase> {};

// On open ground nothing but others makes a vehicle keep its plan.
TEST_P(NamesOfOthers, AreInEveryReportOfAFallback) {
  using enum coordination::FallbackReason;
  std::map<coordination::FallbackReason, int> steps;
  for (unsigned seed = 0; seed < test::num_costly_seeds(20); ++seed) {
    std::mt19937 random(seed);
    std::bernoulli_distribution is_lost(0.15);
    Rollout rollout = three_cars_that_meet(
        ThreeCars{.strategies = GetParam().strategies, .rounds = GetParam().rounds});
    rollout.lose([&](const controller::Delivery&) { return is_lost(random); });
    for (int i = 0; i < 40; ++i) {
      std::vector<coordination::Report> reports = rollout.step();
      for (std::size_t j = 0; j < reports.size(); ++j) {
        coordination::Report& report = reports[j];
        rollout.controllers()[j]->note_causes(report);
        ++steps[report.reason];
        ASSERT_EQ(report.blocked_by.empty(), report.reason == kNone)
            << "seed " << seed << ", step " << i << ", " << to_string(report.reason);
        ASSERT_EQ(std::ranges::count(report.blocked_by, report.vehicle), 0);
        ASSERT_TRUE(std::ranges::is_sorted(report.blocked_by));
      }
    }
  }
  EXPECT_GT(steps[kInfeasible], 0);
  EXPECT_GT(steps[kMissing], 0);
  EXPECT_EQ(steps[kNeighbour] > 0, GetParam().strategies.coordination.commit.needs_votes);
}

INSTANTIATE_TEST_SUITE_P(
    Rules, NamesOfOthers,
    testing::Values(LossCase{"Strict", kStrict, 0}, LossCase{"Cooperative", kCooperative, 0},
                    LossCase{"TwoRounds", kCooperative, 0, controller::Rounds::kTwo},
                    LossCase{"Agreed", kAgreed, 0}),
    [](const auto& tested) { return tested.param.name; });

// With two rounds a controller that misses traffic computes other plans for the others than these
// do. All outcomes arrive, so that nothing but their digests shows it.
TEST(Loss, NoWrongGuessOfAnothersPlanLeadsToPlansThatMeet) {
  for (unsigned seed = 0; seed < test::num_costly_seeds(kGuessSeeds); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> distance(0.6, 1.4);
    std::bernoulli_distribution is_lost(0.05 + 0.05 * (seed % 5));
    Rollout rollout = three_cars_that_meet(
        ThreeCars{.strategies = seed % 2 == 0 ? kCooperative : kStrict,
                  .distances_m = {distance(random), distance(random), distance(random)},
                  .rounds = controller::Rounds::kTwo});
    rollout.lose([&](const controller::Delivery& delivery) {
      return delivery.kind == controller::MessageKind::kPrediction ||
             (delivery.kind == controller::MessageKind::kTraffic && is_lost(random));
    });
    for (int i = 0; i < 25; ++i) {
      static_cast<void>(rollout.step());
      ASSERT_TRUE(plans_in_force_are_free(rollout)) << "step " << i;
    }
  }
}

// Both are alive, see each other standing and receive nothing: neither may consider the other a
// standing obstacle, or both drive off at once.
TEST(Loss, TwoThatDoNotHearEachOtherForLongDoNotMeet) {
  for (unsigned seed = 0; seed < test::num_costly_seeds(3); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> distance(0.6, 1.4);
    const std::array<double, 3> distances{distance(random), distance(random), distance(random)};
    Rollout rollout = three_cars_that_meet(kCooperative, distances);
    rollout.lose([](const controller::Delivery&) { return true; });
    for (int i = 0; i < 40; ++i) {
      static_cast<void>(rollout.step());
      ASSERT_TRUE(plans_in_force_are_free(rollout)) << "step " << i;
    }
  }
}

// One vehicle receives everything and the others receive nothing from it: the others may take it
// for a standing obstacle only when it has agreed to nothing new for long enough.
TEST(Loss, AVehicleThatIsHeardByNobodyIsNotHit) {
  for (std::uint8_t mute = 1; mute <= 3; ++mute) {
    for (std::uint64_t from = 2; from < 8; ++from) {
      SCOPED_TRACE("vehicle " + std::to_string(mute) + " mute from step " + std::to_string(from));
      Rollout rollout = three_cars_that_meet(kCooperative);
      rollout.lose([&](const controller::Delivery& delivery) {
        return delivery.from.value == mute && delivery.step.value >= from;
      });
      for (int i = 0; i < 60; ++i) {
        static_cast<void>(rollout.step());
        ASSERT_TRUE(plans_in_force_are_free(rollout)) << "step " << i;
      }
    }
  }
}

TEST(Loss, WithoutLossTheStrictRuleNeverFallsBack) {
  Rollout rollout = three_cars_that_meet(kCooperative);
  for (int i = 0; i < 40; ++i) {
    for (const coordination::Report& report : rollout.step()) {
      ASSERT_EQ(report.status, coordination::StepStatus::kPlanned)
          << "step " << i << ", vehicle " << int{report.vehicle.value} << ", "
          << coordination::to_string(report.reason);
    }
  }
}

// The control for the tests above: the authors' rule assumes that all receive a fallback, so
// outcomes must not get lost.
TEST(Loss, TheAgreedRuleLetsPlansMeetIfOutcomesAreLost) {
  bool met = false;
  for (unsigned seed = 0; seed < 200 && !met; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> distance(0.6, 1.4);
    const std::array<double, 3> distances{distance(random), distance(random), distance(random)};
    std::bernoulli_distribution is_lost(0.2);
    Rollout rollout = three_cars_that_meet(kAgreed, distances);
    rollout.lose([&](const controller::Delivery& delivery) {
      return delivery.kind == controller::MessageKind::kOutcome && is_lost(random);
    });
    for (int step = 0; step < 20 && !met; ++step) {
      static_cast<void>(rollout.step());
      met = !plans_in_force_are_free(rollout);
    }
  }
  EXPECT_TRUE(met);
}

}  // namespace
}  // namespace hlc::rollout
