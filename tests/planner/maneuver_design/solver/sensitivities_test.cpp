#include "planner/maneuver_design/solver/sensitivities.hpp"

#include <gtest/gtest.h>

#include <random>

#include "planner/maneuver_design/effort.hpp"
#include "planner/maneuver_design/shooting.hpp"

namespace hlc::maneuver_design {
namespace {

TEST(Sensitivities, AreTheDerivativesOfTheStatesByInputsAndDuration) {
  constexpr unsigned kSeed = 72;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const vehicle::VehicleParameters vehicle;
  const vehicle::State start{{}, 2.0, 0.1};
  constexpr double kStep = 1e-5;
  const auto states_of = [&](const std::vector<vehicle::Input>& inputs, double duration_s) {
    return shoot(start, inputs, duration_s, Effort{}, vehicle, WithGradient::kNo).states;
  };
  for (int run = 0; run < 5; ++run) {
    std::vector<vehicle::Input> inputs(8);
    for (vehicle::Input& u : inputs) {
      u = {12.0 * unit(random), 4.0 * unit(random)};
    }
    const auto exact = sensitivities(states_of(inputs, 0.2), inputs, 0.2, vehicle);
    ASSERT_EQ(exact.size(), 9U);
    const auto compare = [&](Eigen::Index column, const std::vector<vehicle::State>& above,
                             const std::vector<vehicle::State>& below) {
      for (std::size_t k = 0; k < exact.size(); ++k) {
        const vehicle::StateVector slope =
            (vehicle::to_vector(above[k]) - vehicle::to_vector(below[k])) / (2.0 * kStep);
        EXPECT_LT((exact[k].col(column) - slope).norm(), 1e-6 * (1.0 + slope.norm()))
            << "state " << k << ", column " << column;
      }
    };
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const auto changed = [&](double a, double rate) {
        std::vector<vehicle::Input> copy = inputs;
        copy[i].acceleration_mps2 += a;
        copy[i].steering_rate_radps += rate;
        return states_of(copy, 0.2);
      };
      const auto column = static_cast<Eigen::Index>(2 * i);
      compare(column, changed(kStep, 0.0), changed(-kStep, 0.0));
      compare(column + 1, changed(0.0, kStep), changed(0.0, -kStep));
    }
    compare(16, states_of(inputs, 0.2 + kStep), states_of(inputs, 0.2 - kStep));
  }
}

}  // namespace
}  // namespace hlc::maneuver_design
