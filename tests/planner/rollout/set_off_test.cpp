// A standing car sets off when its former plan was going to.
#include "planner/controller/set_off.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/rollout/rollout.hpp"
#include "tests/planner/scenario/changed_scenario.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::rollout::set_off_test {
namespace {

/// With the twelve trims of the paper, whose errors across the path are larger.
scenario::Scenario few_trims(std::uint64_t seed) {
  return test::changed_scenario("lab_cars", "",
                                {{"ucar_traffic_49", "paper"}, {"subgraph: J2", "subgraph: D"}},
                                {.cars = 10, .seed = seed});
}

constexpr int kSteps = 1500;

/// How often one of ten cars puts off setting off, though it might be because of another car.
std::size_t num_put_off(std::uint64_t seed) {
  Rollout rollout = make_rollout(few_trims(seed));
  std::vector<coordination::Plan> former;
  std::size_t count = 0;
  for (int k = 0; k < kSteps; ++k) {
    const StepIndex next = rollout.next_step();
    static_cast<void>(rollout.step());
    for (std::size_t i = 0; i < rollout.controllers().size(); ++i) {
      const coordination::Plan& plan = rollout.controllers()[i]->plan_in_force();
      if (former.size() <= i) {
        former.push_back(plan);
        continue;
      }
      count += controller::puts_off(plan, former[i], {next.value + 1}) ? 1U : 0U;
      former[i] = plan;
    }
  }
  return count;
}

// Draws 1, 2 and 3: 7 times in all; if a standing car takes every new plan, 284 times.
TEST(SetOff, IsHardlyEverPutOffByOneOfTenCars) {
  std::size_t count = 0;
  const std::uint64_t num_draws = test::num_costly_seeds(3);
  for (std::uint64_t seed = 1; seed <= num_draws; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const std::size_t of_run = num_put_off(seed);
    EXPECT_LT(of_run, 30U);
    count += of_run;
  }
  EXPECT_LT(count, 10 * num_draws);
}

}  // namespace
}  // namespace hlc::rollout::set_off_test
