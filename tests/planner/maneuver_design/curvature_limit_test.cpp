#include "planner/maneuver_design/curvature_limit.hpp"

#include <gtest/gtest.h>

#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/vehicle/path_curvature.hpp"
#include "tests/planner/maneuver_design/gradient_check.hpp"
#include "tests/support/folders.hpp"

namespace hlc::maneuver_design {
namespace {

using Side = CurvatureLimit::Side;

TEST(CurvatureLimit, IsNearZeroWhereThePathBendsByJustTheLimit) {
  const vehicle::VehicleParameters vehicle;
  const double limit_per_m = vehicle::curvature_per_m(0.5, vehicle);
  const vehicle::StateVector left = vehicle::to_vector({{}, 0.8, 0.5});
  const vehicle::StateVector right = vehicle::to_vector({{}, 0.8, -0.5});
  EXPECT_NEAR(CurvatureLimit(Side::kLeft, limit_per_m, vehicle).value(left, {}), 0.0, 1e-3);
  EXPECT_NEAR(CurvatureLimit(Side::kRight, limit_per_m, vehicle).value(right, {}), 0.0, 1e-3);
  EXPECT_LT(CurvatureLimit(Side::kLeft, limit_per_m, vehicle).value(right, {}), -1.5);
  EXPECT_LT(CurvatureLimit(Side::kRight, limit_per_m, vehicle).value(left, {}), -1.5);
  EXPECT_GT(CurvatureLimit(Side::kLeft, limit_per_m, vehicle).value(left, {0.0, 1.0}), 0.1);
}

TEST(CurvatureLimit, HasAnExactGradient) {
  expect_exact_gradient(CurvatureLimit(Side::kLeft, 3.75, vehicle::VehicleParameters{}), 7);
  expect_exact_gradient(CurvatureLimit(Side::kRight, 3.75, vehicle::VehicleParameters{}), 8);
}

AutomatonConfiguration lab() {
  return read_automaton_configuration(test::source_folder() + "/launch_scripts/automata/lab.yaml");
}

TEST(CurvatureLimit, IsKeptByEveryManeuverOfTheLabsAutomatonAndBindsInSome) {
  const AutomatonConfiguration configuration = lab();
  const automaton::UniversalAutomaton automaton = build_automaton(configuration);
  double largest_share = 0.0;
  for (const automaton::Maneuver& m : automaton.maneuvers) {
    for (std::size_t k = 0; k < m.inputs.size(); ++k) {
      for (const vehicle::State& state : {m.states[k], m.states[k + 1]}) {
        EXPECT_TRUE(vehicle::is_within_curvature(state, m.inputs[k], automaton.vehicle,
                                                 configuration.limits));
        const vehicle::CourseRate rate =
            vehicle::course_rate(vehicle::to_vector(state), m.inputs[k], automaton.vehicle);
        largest_share =
            std::max(largest_share, std::abs(rate.value_radps) /
                                        (*configuration.limits.curvature_max_per_m *
                                         vehicle::turning_speed(state.speed_mps).value_mps));
      }
    }
  }
  EXPECT_GT(largest_share, 0.999);
}

TEST(CurvatureLimit, NamesWhatItDoesNotAllow) {
  AutomatonConfiguration configuration = lab();
  configuration.subgraphs.front().disabled_edges.clear();
  try {
    static_cast<void>(build_automaton(configuration));
    FAIL() << "from standstill into the tightest turn the way is too short";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("maneuver 1 -> 2 (J2): curvature of 3.75 1/m"),
              std::string::npos)
        << error.what();
  }
}

TEST(CurvatureLimit, RefusesATrimBeyondIt) {
  AutomatonConfiguration configuration = lab();
  configuration.trims[1].steering_rad = -0.60;
  EXPECT_THROW(static_cast<void>(build_automaton(configuration)), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::maneuver_design
