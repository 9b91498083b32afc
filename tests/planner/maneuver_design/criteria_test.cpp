#include "planner/maneuver_design/criteria.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/planner/maneuver_design/gradient_check.hpp"

namespace hlc::maneuver_design {
namespace {

TEST(Criteria, EveryNameHasACriterionWithAnExactGradient) {
  ASSERT_FALSE(criterion_names().empty());
  unsigned seed = 51;
  for (const std::string& name : criterion_names()) {
    SCOPED_TRACE(name);
    expect_exact_gradient(*make_criterion(name, {}), seed++);
  }
}

TEST(Criteria, J3IsHalfTheSumOfJ1AndJ2) {
  vehicle::StateVector x;
  x << 0.3, -0.4, 1.0, 2.0, 0.1;
  const vehicle::Input u{3.0, -2.0};
  EXPECT_EQ(make_criterion("J3", {})->value(x, u), 0.5 * make_criterion("J1", {})->value(x, u) +
                                                       0.5 * make_criterion("J2", {})->value(x, u));
}

TEST(Criteria, AnUnknownNameIsRefusedWithTheKnownOnes) {
  try {
    (void)make_criterion("J0", {});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "criterion = J0, must be one of J1, J2, J3, comfort, energy, stopping_distance, "
                 "travel_time");
  }
}

}  // namespace
}  // namespace hlc::maneuver_design
