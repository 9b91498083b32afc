#include "planner/automaton/lateral_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::automaton {
namespace {

constexpr double kStep_s = 0.2;

double lateral_step_of(const std::vector<TrimId>& trims) {
  SubgraphSpec spec = paper_configuration().subgraphs.front();
  spec.trims = trims;
  return lateral_step_m(Subgraph(paper_automaton(), spec));
}

double curvature_per_m(double steering_rad) {
  return vehicle::curvature_per_m(steering_rad, paper_automaton()->vehicle);
}

TEST(LateralStep, IsHowFarHalfTheWidestGapBetweenSteeringsLeadsAsideInAStep) {
  // Straight on at 0.8 m/s, and 0.12 rad to the left at 0.8 m/s.
  const double way_m = 0.8 * kStep_s;
  const double gap_per_m = curvature_per_m(0.12);
  EXPECT_NEAR(lateral_step_of({pi(1), pi(7), pi(8)}), 0.5 * (gap_per_m / 2.0) * way_m * way_m,
              1e-12);
  // With 0.36 rad at 0.6 m/s beside them the second gap is wider.
  const double slow_m = 0.6 * kStep_s;
  const double second_per_m = curvature_per_m(0.36) - gap_per_m;
  EXPECT_NEAR(lateral_step_of({pi(1), pi(7), pi(8), pi(10)}),
              0.5 * (second_per_m / 2.0) * slow_m * slow_m, 1e-12);
}

TEST(LateralStep, OfThePapersSubgraphsIsFiveToSixMillimetres) {
  for (const SubgraphSpec& spec : paper_configuration().subgraphs) {
    const double lateral_m = lateral_step_m(Subgraph(paper_automaton(), spec));
    EXPECT_NEAR(lateral_m, spec.name == "B" ? 0.0051 : 0.0060, 0.0001) << spec.name;
  }
}

TEST(LateralStep, IsZeroWithOneSteering) { EXPECT_EQ(lateral_step_of({pi(1), pi(7)}), 0.0); }

}  // namespace
}  // namespace hlc::automaton
