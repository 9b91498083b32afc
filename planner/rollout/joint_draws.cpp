#include "planner/rollout/joint_draws.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "planner/common/random_index.hpp"
#include "planner/controller/self_loop.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/starts.hpp"

namespace hlc::rollout {
namespace {

constexpr std::size_t kPlaces = 1'000'000;

/// Whether all are connected over conflicts.
template <class Vehicle>
bool are_connected(const std::vector<const Vehicle*>& vehicles) {
  std::vector<std::size_t> group(vehicles.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t a = 0; a < vehicles.size(); ++a) {
    for (std::size_t b = a + 1; b < vehicles.size(); ++b) {
      if (!joint_search::meet(vehicles[a]->areas_m, vehicles[b]->areas_m)) continue;
      const std::size_t from = group[b];
      const std::size_t to = group[a];
      std::ranges::replace(group, from, to);
    }
  }
  return std::ranges::count(group, group.front()) == std::ssize(group);
}

}  // namespace

JointDraws::JointDraws(scenario::Scenario scenario, const search::SearchOptions& search,
                       std::uint64_t seed)
    : random_(seed) {
  scenario.conflicts.reset();
  scenario.search = search;
  on_ = scenario::prepare_subgraph_of(scenario);
  engine_ = search::make_search_engine(*on_.subgraph, *on_.reachable, search, on_.tables);
  if (scenario.candidates.empty()) scenario.candidates = scenario.vehicles;
  for (std::size_t draws = 0; vehicles_.size() < kVehicles && draws < 10 * kVehicles; ++draws) {
    if (auto vehicle = drive_alone(scenario)) vehicles_.push_back(*std::move(vehicle));
  }
}

std::optional<JointDraws::Vehicle> JointDraws::drive_alone(scenario::Scenario& scenario) {
  scenario.vehicles = {scenario.candidates[random_index(random_, scenario.candidates.size())]};
  const double s_m = scenario.vehicles.front().path.length_m() *
                     static_cast<double>(random_index(random_, kPlaces)) / double{kPlaces};
  scenario.vehicles = scenario::with_starts(scenario, std::vector{s_m}).vehicles;
  const scenario::ScenarioVehicle& vehicle = scenario.vehicles.front();
  std::vector<std::unique_ptr<controller::Controller>> controllers;
  controllers.push_back(scenario::make_controller(scenario, vehicle.id, on_));
  Rollout rollout(std::move(controllers), {vehicle.start});
  const std::size_t steps = 1 + random_index(random_, kMostSteps);
  for (std::size_t k = 0; k < steps; ++k) static_cast<void>(rollout.step());
  const auto problems = rollout.controllers().front()->problems();
  if (problems.empty()) return std::nullopt;
  Vehicle result{.problem = problems.front().problem};
  const search::SearchResult plan = engine_->search(result.problem);
  if (plan.maneuvers.empty()) return std::nullopt;
  result.standing_m = transformed(
      controller::self_loop(on_.subgraph->automaton(), on_.subgraph->standstill()).swept_area_m,
      result.problem.start);
  result.areas_m = joint_search::areas_of(plan, result.problem);
  return result;
}

std::vector<const JointDraws::Vehicle*> JointDraws::near_each_other(std::size_t num_vehicles) {
  std::vector<const Vehicle*> chosen;
  for (std::size_t tries = 0; tries < kVehicles && chosen.size() < num_vehicles; ++tries) {
    const Vehicle& one = vehicles_[random_index(random_, vehicles_.size())];
    const bool is_apart = std::ranges::none_of(chosen, [&](const Vehicle* other) {
      return intersects(one.standing_m, other->standing_m);
    });
    const bool is_near =
        chosen.empty() ||
        (one.problem.start.position_m() - chosen.front()->problem.start.position_m()).norm() <
            kNear_m;
    if (is_apart && is_near) chosen.push_back(&one);
  }
  return chosen;
}

std::optional<joint_search::JointProblem> JointDraws::draw(std::size_t num_vehicles) {
  if (vehicles_.empty()) return std::nullopt;
  for (std::size_t draws = 0; draws < kMostDraws; ++draws) {
    const std::vector<const Vehicle*> chosen = near_each_other(num_vehicles);
    if (chosen.size() < num_vehicles || !are_connected(chosen)) continue;
    joint_search::JointProblem problem;
    for (const Vehicle* one : chosen) {
      problem.push_back({.problem = one->problem, .engine = engine_.get()});
    }
    return problem;
  }
  return std::nullopt;
}

}  // namespace hlc::rollout
