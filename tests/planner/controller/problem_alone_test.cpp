#include "planner/controller/problem_alone.hpp"

#include <gtest/gtest.h>

#include <random>

#include "planner/controller/controller_options.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/planner/right_of_way/routes.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::controller::problem_alone_test {
namespace {

/// The paper's subgraph with a speed limit, or without.
automaton::Subgraph limited(std::optional<double> max_speed_mps) {
  automaton::SubgraphSpec spec = automaton::paper_configuration().subgraphs.front();
  spec.max_speed_mps = max_speed_mps;
  return {automaton::paper_automaton(), spec};
}

std::vector<double> speeds_mps(std::optional<double> limit_mps, double reference_speed_mps) {
  RouteTracker tracker(std::make_shared<const std::vector<road::DrivableRoute>>(
      1, right_of_way::circle({0.0, 0.0}, 2.0)));
  tracker.select_route({2.0, 0.0, 1.57}, {});
  ControllerOptions options;
  options.reference_speed_mps = reference_speed_mps;
  return reference_alone({}, tracker, tracker.s_m().value(), limited(limit_mps), options, 1e9)
      .speeds_mps;
}

TEST(ReferenceAlone, IsNotFasterThanTheSubgraphsLimit) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(50); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> speed_mps(0.65, 1.2);  // trims are at 0.6 m/s and more
    const double reference_mps = speed_mps(random);
    const double limit_mps = speed_mps(random);
    EXPECT_EQ(speeds_mps(limit_mps, reference_mps),
              speeds_mps(std::nullopt, std::min(limit_mps, reference_mps)));
  }
}

/// |c|^2 of the first reference point.
double weight(std::optional<double> held_up_weight, bool is_held_up) {
  RouteTracker tracker(std::make_shared<const std::vector<road::DrivableRoute>>(
      1, right_of_way::circle({0.0, 0.0}, 2.0)));
  tracker.select_route({2.0, 0.0, 1.57}, {});
  ControllerOptions options;
  options.contouring_weight = 30.0;
  options.held_up_contouring_weight = held_up_weight;
  const search::HorizonProblem problem =
      problem_alone({}, tracker, tracker.route().corridor, 2.0, limited(std::nullopt), options,
                    {.is_held_up = is_held_up});
  return problem.contouring.empty() ? 0.0 : problem.contouring.front().squaredNorm();
}

TEST(ProblemAlone, HasAWeightOfItsOwnWhereTheVehicleIsHeldUp) {
  EXPECT_NEAR(weight(std::nullopt, false), 30.0, 1e-9);
  EXPECT_NEAR(weight(std::nullopt, true), 30.0, 1e-9) << "the same";
  EXPECT_NEAR(weight(150.0, false), 30.0, 1e-9);
  EXPECT_NEAR(weight(150.0, true), 150.0, 1e-9);
  EXPECT_EQ(weight(0.0, true), 0.0);
}

}  // namespace
}  // namespace hlc::controller::problem_alone_test
