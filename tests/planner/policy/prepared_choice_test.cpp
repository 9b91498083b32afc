#include "planner/policy/prepared_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_automaton.hpp"

namespace hlc::policy::prepared_choice_test {
namespace {

constexpr std::size_t kHorizonSteps = 8;
const std::vector<double> kLimits{0.4, 0.6};

class PreparedChoiceTest : public testing::Test {
 protected:
  [[nodiscard]] PreparedChoice choice(const SubgraphRequest& request,
                                      std::span<const double> limits_mps = kLimits) const {
    return {base_, request, limits_mps, kHorizonSteps, {}};
  }

  controller::PreparedSubgraph base_ = controller::prepare_subgraph(
      std::make_shared<const automaton::Subgraph>(
          test::make_test_subgraph({test::kSlow, test::kFast}, test::kAllTrims)),
      kHorizonSteps, {});
};

std::optional<double> limit_of(const controller::PreparedSubgraph& prepared) {
  return prepared.subgraph->spec().max_speed_mps;
}

TEST_F(PreparedChoiceTest, AskedForNothingWithoutALimitItIsTheBaseItself) {
  const PreparedChoice nothing = choice({});
  EXPECT_EQ(nothing.under({}).subgraph, base_.subgraph);
  EXPECT_EQ(nothing.under({}).tables, base_.tables);
  EXPECT_EQ(limit_of(nothing.under(0.4)), 0.4);
  EXPECT_EQ(nothing.under(0.4).reachable->max_steps(), kHorizonSteps + 1);
}

// Safety never lifts what the operator has asked for.
TEST_F(PreparedChoiceTest, TheLowerOfTwoLimitsHolds) {
  const PreparedChoice slow = choice({.labels = {"slow"}, .max_speed_mps = 0.5});
  EXPECT_EQ(limit_of(slow.under({})), 0.5);
  EXPECT_EQ(limit_of(slow.under(0.4)), 0.4);
  EXPECT_EQ(limit_of(slow.under(0.6)), 0.5);
  EXPECT_EQ(slow.under(0.6).subgraph, slow.under({}).subgraph);
}

TEST_F(PreparedChoiceTest, ALimitKeepsWhatElseWasAskedFor) {
  const SubgraphRequest request{.labels = {"slow"}, .disable_trims = {{11}}};
  const automaton::SubgraphSpec limited = choice(request).under(0.6).subgraph->spec();
  EXPECT_EQ(limited.labels, request.labels);
  EXPECT_THAT(limited.trims, testing::Not(testing::Contains(TrimId{11})));
  EXPECT_EQ(limited.max_speed_mps, 0.6);
}

// Fast maneuvers outrun their trims: none of them keeps to a limit of 0.4 m/s.
TEST_F(PreparedChoiceTest, UnderALimitWithWhichTheRequestCannotBeItIsTheScenariosOwn) {
  const PreparedChoice fast = choice({.labels = {"fast"}});
  EXPECT_EQ(fast.under({}).subgraph->spec().labels, (std::vector<std::string>{"fast"}));
  const automaton::SubgraphSpec limited = fast.under(0.4).subgraph->spec();
  EXPECT_EQ(limited.labels, base_.subgraph->spec().labels);
  EXPECT_EQ(limited.max_speed_mps, 0.4);
}

TEST_F(PreparedChoiceTest, ALimitThatCannotBeAtAllIsRefused) {
  const std::vector<double> too_low{0.3};
  EXPECT_THROW(choice({}, too_low), std::invalid_argument);
  EXPECT_THROW(choice({.labels = {"fast"}}, too_low), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::policy::prepared_choice_test
