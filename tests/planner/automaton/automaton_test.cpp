#include "planner/automaton/automaton.hpp"

#include <gtest/gtest.h>

#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::automaton {
namespace {

TEST(Automaton, DrivenYawDiffersFromThePlannedHeadingAsMeasured) {
  const vehicle::VehicleParameters vehicle;
  const vehicle::IdentifiedVehicle identified;
  EXPECT_NEAR(yaw_minus_heading_rad(0.60, vehicle, identified), 0.141, 5e-4);
  EXPECT_NEAR(yaw_minus_heading_rad(-0.60, vehicle, identified), -0.128, 5e-4);
  EXPECT_NEAR(yaw_minus_heading_rad(0.48, vehicle, identified), 0.102, 5e-4);
  EXPECT_NEAR(yaw_minus_heading_rad(-0.48, vehicle, identified), -0.076, 5e-4);
}

TEST(Automaton, FindsAnEdgeByItsEndsAndLabel) {
  const auto automaton = paper_automaton();
  const Maneuver* maneuver = automaton->find(pi(7), pi(8), "J2");
  ASSERT_NE(maneuver, nullptr);
  EXPECT_EQ(maneuver->from, pi(7));
  EXPECT_EQ(maneuver->to, pi(8));
  EXPECT_EQ(maneuver->label, "J2");
  EXPECT_EQ(automaton->find(pi(7), pi(8), "J7"), nullptr);
  EXPECT_EQ(automaton->find(pi(5), pi(9), "J2"), nullptr);
}

TEST(Automaton, FindsATrimsOwnStepUnderEveryLabel) {
  const auto automaton = paper_automaton();
  const Maneuver* step = automaton->find(pi(7), pi(7), "J2");
  ASSERT_NE(step, nullptr);
  EXPECT_EQ(step->label, kSelfLoopLabel);
  EXPECT_EQ(automaton->find(pi(7), pi(7), "J7"), step);
}

TEST(Automaton, StateAtMeetsTheStatesAtTheIntervalBounds) {
  const auto automaton = paper_automaton();
  for (const Maneuver& maneuver : automaton->maneuvers) {
    const auto intervals = static_cast<double>(maneuver.inputs.size());
    for (std::size_t k = 0; k < maneuver.states.size(); ++k) {
      const double time_s = maneuver.duration_s * static_cast<double>(k) / intervals;
      const vehicle::State state = state_at(maneuver, time_s, automaton->vehicle);
      EXPECT_LT((vehicle::to_vector(state) - vehicle::to_vector(maneuver.states[k])).norm(), 1e-12);
    }
  }
}

TEST(Automaton, StateAtMovesAsTheModelSays) {
  const auto automaton = paper_automaton();
  constexpr double kStep_s = 1e-4;
  for (const Maneuver& maneuver : automaton->maneuvers) {
    for (std::size_t k = 0; k < maneuver.inputs.size(); ++k) {
      const double middle_s = maneuver.duration_s * (static_cast<double>(k) + 0.5) /
                              static_cast<double>(maneuver.inputs.size());
      const auto at = [&](double time_s) {
        return vehicle::to_vector(state_at(maneuver, time_s, automaton->vehicle));
      };
      const vehicle::StateVector difference =
          (at(middle_s + kStep_s) - at(middle_s - kStep_s)) / (2.0 * kStep_s);
      const vehicle::StateVector model =
          vehicle::derivative(at(middle_s), maneuver.inputs[k], automaton->vehicle);
      EXPECT_LT((difference - model).norm(), 1e-4);
    }
  }
}

TEST(Automaton, StateAtStaysAtTheEndsOutsideTheDuration) {
  const auto automaton = paper_automaton();
  const Maneuver* maneuver = automaton->find(pi(1), pi(12), "J2");
  ASSERT_NE(maneuver, nullptr);
  EXPECT_EQ(state_at(*maneuver, -1.0, automaton->vehicle), maneuver->states.front());
  EXPECT_LT((vehicle::to_vector(state_at(*maneuver, 1.0, automaton->vehicle)) -
             vehicle::to_vector(maneuver->states.back()))
                .norm(),
            1e-15);
}

}  // namespace
}  // namespace hlc::automaton
