#include "planner/controller/set_off.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "planner/controller/self_loop.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::controller::set_off_test {
namespace {

constexpr StepIndex kNext{5};

/// Stands for so many steps from t(first) on, then moves for two.
coordination::Plan sets_off_after(std::size_t steps, StepIndex first = kNext) {
  const automaton::UniversalAutomaton& automaton = *automaton::paper_automaton();
  const automaton::Maneuver& standing = self_loop(automaton, {0});
  std::vector<const automaton::Maneuver*> maneuvers(steps, &standing);
  maneuvers.push_back(automaton.find({0}, {6}, "J2"));
  maneuvers.push_back(automaton.find({6}, {0}, "J2"));
  return coordination::Plan({1}, Pose{}, standing).continued(first, maneuvers);
}

coordination::Plan stands() { return {{1}, Pose{}, self_loop(*automaton::paper_automaton(), {0})}; }

TEST(SetOff, IsPutOffByAPlanThatMovesLaterOrNever) {
  for (std::size_t was = 0; was < 4; ++was) {
    for (std::size_t is = 0; is < 6; ++is) {
      EXPECT_EQ(puts_off(sets_off_after(is), sets_off_after(was), kNext), is > was)
          << was << ' ' << is;
    }
    EXPECT_TRUE(puts_off(stands(), sets_off_after(was), kNext)) << was;
  }
}

TEST(SetOff, IsNotPutOffIfThePlanInForceStandsForGood) {
  EXPECT_FALSE(puts_off(sets_off_after(3), stands(), kNext));
  EXPECT_FALSE(puts_off(stands(), stands(), kNext));
}

TEST(SetOff, IsNotPutOffByAVehicleThatDrives) {
  const coordination::Plan driving = sets_off_after(0, {kNext.value - 1});
  ASSERT_GT(driving.end(), kNext);
  EXPECT_FALSE(puts_off(stands(), driving, kNext));
}

}  // namespace
}  // namespace hlc::controller::set_off_test
