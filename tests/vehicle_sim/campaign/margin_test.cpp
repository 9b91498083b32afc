// The safety margin against what vehicles really do: every trim and switching of the paper's
// automaton driven by the simulated vehicle, and whole closed loops with a controller.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "planner/automaton/deviation.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/vehicle_sim/vehicle/closed_loop.hpp"
#include "tests/vehicle_sim/vehicle/controlled_loop.hpp"

namespace hlc::campaign::margin_test {
namespace {

using simulated_vehicle::driven_vehicle::kMillisecond;
using simulated_vehicle::driven_vehicle::Sample;
using simulated_vehicle::driven_vehicle::TrimWalk;
using Trims = std::vector<std::size_t>;

const Pose kStart{.x_m = 2.25, .y_m = 2.0, .heading_rad = 0.4};

double margin_m() { return automaton::paper_automaton()->vehicle.safety_margin_m; }

/// Largest deviations from the plan over one walk.
struct Largest {
  double footprint_m{};
  double position_m{};
  double yaw_rad{};

  void add(const Largest& other) {
    footprint_m = std::max(footprint_m, other.footprint_m);
    position_m = std::max(position_m, other.position_m);
    yaw_rad = std::max(yaw_rad, other.yaw_rad);
  }
};

Largest walked(const Trims& trims, std::uint64_t seed,
               std::optional<std::uint64_t> noise_seed = {}) {
  const automaton::UniversalAutomaton& automaton = *automaton::paper_automaton();
  const auto mapped = [&](Pose pose, double steering_rad) {
    pose.heading_rad +=
        automaton::yaw_minus_heading_rad(steering_rad, automaton.vehicle, automaton.identified);
    return pose;
  };
  const TrimWalk walk(kStart, trims, seed);
  simulated_vehicle::SimulatedVehicle vehicle(
      {.vehicle_id = 1, .start = mapped(kStart, 0.0), .noise_seed = noise_seed});
  Largest largest;
  for (const Sample& sample : simulated_vehicle::driven_vehicle::drive(
           vehicle, walk.mission(), walk.end() + 1'000 * kMillisecond)) {
    const vehicle::State planned = walk.state_at(sample.t);
    const Pose& driven = sample.tick.driven.pose;
    const double yaw_rad = mapped(planned.pose, planned.steering_rad).heading_rad;
    largest.add({.footprint_m = automaton::footprint_deviation_m(driven, planned, automaton.vehicle,
                                                                 automaton.identified),
                 .position_m = sample.error_m(),
                 .yaw_rad = std::abs(wrap_angle(driven.heading_rad - yaw_rad))});
  }
  return largest;
}

/// Along the chain of trims to `target`, `steps` - 1 steps in it, and back.
Trims held(std::size_t target, std::size_t steps) {
  Trims way{1};
  for (std::size_t at = 7; at != target; at < target ? ++at : --at) way.push_back(at);
  Trims trims = way;
  trims.insert(trims.end(), steps, target);
  trims.insert(trims.end(), way.rbegin(), way.rend());
  return trims;
}

Trims started_into(std::size_t target, std::size_t steps) {
  Trims trims{1};
  trims.insert(trims.end(), steps, target);
  trims.push_back(1);
  return trims;
}

void print(const char* what, const Largest& largest) {
  std::printf("%-34s footprint %5.1f mm, position %5.1f mm, yaw %.3f rad\n", what,
              1e3 * largest.footprint_m, 1e3 * largest.position_m, largest.yaw_rad);
}

TEST(Margin, CoversEveryTrimWithSteeringToSpareHeldOrStartedInto) {
  for (std::size_t target = 4; target <= 10; ++target) {
    for (const bool with_noise : {false, true}) {
      Largest largest;
      for (const std::size_t steps : {1U, 2U, 3U, 5U, 8U, 18U}) {
        const auto noise = with_noise ? std::optional<std::uint64_t>(steps) : std::nullopt;
        largest.add(walked(held(target, steps), target, noise));
        largest.add(walked(started_into(target, steps), target, noise));
      }
      print(("trim " + std::to_string(target) + (with_noise ? ", noise" : "")).c_str(), largest);
      EXPECT_LE(largest.footprint_m, margin_m()) << "trim " << target;
    }
  }
}

/// Any switching of subgraph B among the trims with steering to spare, standstill included.
Trims random_walk(std::uint64_t seed, std::size_t steps) {
  std::mt19937_64 random(seed);
  Trims trims{1};
  while (trims.size() < steps) {
    const std::size_t at = trims.back();
    Trims choices{at};
    if (at == 1) {
      for (std::size_t to = 4; to <= 10; ++to) choices.push_back(to);
    } else {
      if (at > 4) choices.push_back(at - 1);
      if (at < 10) choices.push_back(at + 1);
      if (random() % 5 == 0) choices.push_back(1);
    }
    trims.push_back(choices[random() % choices.size()]);
  }
  trims.push_back(1);
  return trims;
}

TEST(Margin, CoversEverySwitchingOfTrimsWithSteeringToSpare) {
  for (const bool with_noise : {false, true}) {
    Largest largest;
    for (std::uint64_t seed = 0; seed < test::num_costly_seeds(100); ++seed) {
      const Largest one =
          walked(random_walk(seed, 150), seed, with_noise ? std::optional(seed) : std::nullopt);
      EXPECT_LE(one.footprint_m, margin_m()) << "seed " << seed << ", noise " << with_noise;
      largest.add(one);
    }
    print(with_noise ? "random walks, noise" : "random walks", largest);
  }
}

// Why the controllers predict the drive of some plans.
TEST(Margin, DoesNotCoverTrimsAtTheSteeringLimit) {
  for (const std::size_t target : {2U, 3U, 11U, 12U}) {
    Largest chain;
    Largest start;
    for (const std::size_t steps : {1U, 2U, 3U, 4U, 5U, 6U, 8U, 10U, 18U}) {
      const std::string times = " in trim " + std::to_string(target) + ", " +
                                std::to_string(steps - 1) + " steps of its own";
      print(("chain" + times).c_str(), walked(held(target, steps), target));
      print(("start" + times).c_str(), walked(started_into(target, steps), target));
      chain.add(walked(held(target, steps), target));
      start.add(walked(started_into(target, steps), target));
    }
    if (target == 2 || target == 12) {
      EXPECT_GT(std::max(chain.footprint_m, start.footprint_m), margin_m());
    }
    EXPECT_LE(std::max(chain.footprint_m, start.footprint_m), 0.080);
  }
}

/// A path of arcs and straights, its curvature at most `max_curvature_per_m`, often just that.
std::vector<Point> winding_path(std::mt19937_64& random, double max_curvature_per_m) {
  constexpr double kSpacing_m = 0.02;
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::uniform_real_distribution<double> length(0.15, 0.9);
  Pose pose;
  std::vector<Point> points{pose.position_m()};
  for (int arc = 0; arc < 14; ++arc) {
    double curvature = max_curvature_per_m * unit(random);
    if (random() % 2 == 0) curvature = std::copysign(max_curvature_per_m, curvature);
    if (random() % 4 == 0) curvature = 0.0;
    const int pieces = static_cast<int>(length(random) / kSpacing_m);
    for (int i = 0; i < pieces; ++i) {
      pose = compose(pose, {kSpacing_m, 0.0, curvature * kSpacing_m});
      points.push_back(pose.position_m());
    }
  }
  return points;
}

/// One drive along a random path, some with a start askew, with bursts of steps without a new plan.
simulated_vehicle::controlled_loop::Stray drive_along(std::uint64_t seed, bool with_noise,
                                                      double late_rate) {
  static const auto subgraph = std::make_shared<const automaton::Subgraph>(
      automaton::paper_automaton(), automaton::paper_configuration().subgraphs.front());
  std::mt19937_64 random(seed);
  const double max_curvature_per_m = 3.0 + 2.0 * static_cast<double>(seed % 3);
  const road::ReferencePath path(winding_path(random, max_curvature_per_m), false);
  std::uniform_real_distribution<double> turn(-1.2, 1.2);
  const Pose start{0.0, 0.0, seed % 2 == 0 ? 0.0 : turn(random)};
  std::bernoulli_distribution begins(late_rate);
  std::size_t burst = 0;
  const auto is_late = [&] {
    if (burst == 0 && begins(random)) burst = 1 + random() % 10;
    if (burst == 0) return false;
    --burst;
    return true;
  };
  const scenario::Profile profile = scenario::profile_from_name("default");
  const scenario::Scenario scenario{
      .name = "winding path",
      .steps = 70,
      .horizon_steps = 8,
      .reference_speed_mps = 0.8,
      .profile = profile,
      .search = {.engine = profile.engine,
                 .cost_to_go = profile.cost_to_go,
                 .max_expansions = 3'000},
      .subgraph = subgraph,
      .vehicles = {{.id = {1}, .name = "car", .start = start, .path = path, .corridor = {}}}};
  return simulated_vehicle::controlled_loop::drive(
      scenario, with_noise ? std::optional(seed) : std::nullopt, is_late);
}

// Paths sharper than the vehicle can turn, so that full lock is used often; plans driven to their
// end without a new one, so that nothing helps that is not in the plan.
TEST(Margin, TheAreasThatAControllerTellsHoldItsVehicleAtEveryTick) {
  const std::uint64_t seeds = test::num_costly_seeds(30);
  simulated_vehicle::controlled_loop::Stray all;
  double largest_without_limit_m = 0.0;
  for (const bool with_noise : {false, true}) {
    for (const double late_rate : {0.0, 0.05, 0.3}) {
      for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed) + (with_noise ? ", noise" : "") +
                     ", late at a rate of " + std::to_string(late_rate));
        const simulated_vehicle::controlled_loop::Stray stray =
            drive_along(seed, with_noise, late_rate);
        EXPECT_LE(stray.outside_m, 1e-6) << "tick " << stray.outside_tick;
        EXPECT_LE(stray.beyond_reach_m, 2e-5);
        all.steps_at_limit += stray.steps_at_limit;
        all.fallback_steps += stray.fallback_steps;
        all.deviation_m = std::max(all.deviation_m, stray.deviation_m);
        if (stray.steps_at_limit == 0) {
          EXPECT_LE(stray.deviation_m, margin_m());
          largest_without_limit_m = std::max(largest_without_limit_m, stray.deviation_m);
        }
      }
    }
  }
  EXPECT_GT(all.steps_at_limit, 17 * seeds) << "the paths are to be hard";
  EXPECT_GT(all.fallback_steps, 34 * seeds) << "plans are to be driven to their end";
  EXPECT_GT(all.deviation_m, 2.0 * margin_m());
  std::printf(
      "%llu drives: %zu steps at the limit, %zu without a new plan; farthest from the plan "
      "%.1f mm, without the limit %.1f mm; never outside the announced areas\n",
      static_cast<unsigned long long>(6 * seeds), all.steps_at_limit, all.fallback_steps,
      1e3 * all.deviation_m, 1e3 * largest_without_limit_m);
}

}  // namespace
}  // namespace hlc::campaign::margin_test
