#include "planner/maneuver_design/weighted_sum.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "planner/maneuver_design/comfort.hpp"
#include "planner/maneuver_design/distance.hpp"
#include "planner/maneuver_design/effort.hpp"
#include "tests/planner/maneuver_design/gradient_check.hpp"

namespace hlc::maneuver_design {
namespace {

std::vector<WeightedCost> terms(double distance, double effort) {
  return {{distance, std::make_shared<Distance>()}, {effort, std::make_shared<Effort>()}};
}

TEST(WeightedSum, AddsUpTheTermsWithTheirWeights) {
  vehicle::StateVector x;
  x << 3.0, -4.0, 1.0, 2.0, 0.1;
  EXPECT_EQ(WeightedSum(terms(0.5, 0.25)).value(x, {1.0, -1.0}), -12.5 + 0.5);
}

TEST(WeightedSum, DependsOnThePoseIfATermThatCountsDoes) {
  EXPECT_TRUE(WeightedSum(terms(0.5, 0.5)).depends_on_pose());
  EXPECT_FALSE(WeightedSum(terms(0.0, 0.5)).depends_on_pose());
}

TEST(WeightedSum, HasAnExactGradient) {
  auto sum = terms(0.5, 0.25);
  sum.push_back({2.0, std::make_shared<Comfort>(vehicle::VehicleParameters{})});
  expect_exact_gradient(WeightedSum(sum), 108);
}

TEST(NormalisedSum, CountsEachCriterionInShareOfItsRange) {
  vehicle::StateVector x = vehicle::StateVector::Zero();
  x(0) = 2.0;
  const vehicle::Input u{1.0, 0.0};
  const WeightedSum sum = normalised_sum(terms(0.5, 0.5), {{-6.0, -2.0}, {10.0, 90.0}});
  EXPECT_EQ(sum.value(x, u), 0.5 * -4.0 / 4.0 + 0.5 * 1.0 / 80.0);
}

TEST(NormalisedSum, RefusesARangeThatIsNotPositive) {
  EXPECT_THROW((void)normalised_sum(terms(1.0, 1.0), {{0.0, 1.0}}), std::invalid_argument);
  try {
    (void)normalised_sum(terms(1.0, 1.0), {{0.0, 1.0}, {2.0, 2.0}});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "range of criterion 2 = 0.000000, must be > 0");
  }
}

}  // namespace
}  // namespace hlc::maneuver_design
