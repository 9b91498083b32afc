#include "planner/policy/prepared_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_automaton.hpp"

namespace hlc::prepared_choice_test {
namespace {

constexpr std::size_t kHorizonSteps = 8;
const std::vector<double> kLimits{0.4, 0.6};

class PreparedChoiceTest : public testing::Test {
 protected:
  [[nodiscard]] PreparedChoice choice(const SubgraphRequest& request,
                                      std::span<const double> limits_mps = kLimits) const {
    return {base_, request, limits_mps, kHorizonSteps, {}};
  }

  PreparedSubgraph base_ = prepare_subgraph(
      std::make_shared<const Subgraph>(
          test::make_test_subgraph({test::kSlow, test::kFast}, test::kAllTrims)),
      kHorizonSteps, {});
};

std::optional<double> limit_of(const PreparedSubgraph& prepared) {
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
  const SubgraphRequest request{.labels = {"fast"}, .trims_off = {{1}}};
  const SubgraphSpec& limited = choice(request).under(0.6).subgraph->spec();
  EXPECT_EQ(limited.labels, request.labels);
  EXPECT_THAT(limited.trims, testing::Not(testing::Contains(TrimId{1})));
  EXPECT_EQ(limited.max_speed_mps, 0.6);
}

TEST_F(PreparedChoiceTest, ALimitThatCannotBeIsNamed) {
  const std::vector<double> too_low{0.3};
  try {
    static_cast<void>(choice({}, too_low));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(),
                testing::StartsWith("in the zone of 0.3 m/s: speed limit 0.3 m/s, allowed"));
  }
}

}  // namespace
}  // namespace hlc::prepared_choice_test
