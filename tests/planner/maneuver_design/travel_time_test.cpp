#include "planner/maneuver_design/travel_time.hpp"

#include <gtest/gtest.h>

#include "planner/maneuver_design/shooting.hpp"
#include "tests/planner/maneuver_design/gradient_check.hpp"

namespace hlc::maneuver_design {
namespace {

TEST(TravelTime, AddsUpToTheDuration) {
  const std::vector<vehicle::Input> inputs{{1.0, 2.0}, {-3.0, 0.5}, {0.0, 1.0}};
  EXPECT_NEAR(shoot({{}, 1.0, 0.1}, inputs, 0.7, TravelTime{}, {}, WithGradient::kNo).cost, 0.7,
              1e-15);
}

TEST(TravelTime, HasAnExactGradient) { expect_exact_gradient(TravelTime{}, 104); }

}  // namespace
}  // namespace hlc::maneuver_design
