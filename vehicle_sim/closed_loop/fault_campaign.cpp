#include "vehicle_sim/closed_loop/fault_campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>
#include <stdexcept>

#include "planner/scenario/starts.hpp"
#include "vehicle_sim/closed_loop/seeded_random.hpp"
#include "vehicle_sim/closed_loop/shrink.hpp"

namespace hlc::closed_loop {
namespace {

/// Faults of a run in real time come while cars drive, some already at the start; a run in logical
/// time lasts some seconds of true time only. On the circle all have met and stand by then.
constexpr Nanoseconds kLastFault = 14 * kNanosecondsPerSecond;
constexpr Nanoseconds kLastFaultOnCircle = 7 * kNanosecondsPerSecond;
constexpr Nanoseconds kLastLogicalFault = 6 * kNanosecondsPerSecond;

FaultStyle any_style(SeededRandom& random) {
  constexpr std::array kStyles{FaultStyle::kScattered, FaultStyle::kBurst,  FaultStyle::kLossy,
                               FaultStyle::kRestart,   FaultStyle::kBorder, FaultStyle::kSilence};
  return kStyles[random.below(kStyles.size())];
}

/// In half of the runs.
std::optional<DifferentController> any_difference(const std::vector<std::uint8_t>& vehicle_ids,
                                                  SeededRandom& random) {
  constexpr std::array kDifferences{Difference::kSequential, Difference::kOtherBasis,
                                    Difference::kOtherBits};
  if (random.chance(0.5)) return std::nullopt;
  const std::uint8_t vehicle = vehicle_ids[random.below(vehicle_ids.size())];
  return DifferentController{.vehicle = vehicle,
                             .difference = kDifferences[random.below(kDifferences.size())]};
}

scenario::Scenario drawn_scenario(const std::filesystem::path& file, std::size_t cars) {
  scenario::Scenario scenario = scenario::read_scenario({.file = file, .cars = cars});
  if (scenario.candidates.empty())
    throw std::invalid_argument(file.string() + ": no key draw, must be there to run with faults");
  if (!scenario.guests.empty())
    throw std::invalid_argument(file.string() + ": guests, must be absent to run with faults");
  return scenario;
}

}  // namespace

scenario::Scenario with_cars(scenario::Scenario scenario, std::size_t cars) {
  const std::size_t routes = scenario.vehicles.size();
  if (cars < routes) {
    scenario.vehicles.erase(scenario.vehicles.begin() + static_cast<std::ptrdiff_t>(cars),
                            scenario.vehicles.end());
  }
  for (std::size_t i = routes; i < cars; ++i) {
    scenario::ScenarioVehicle vehicle = scenario.vehicles[i % routes];
    vehicle.id = {static_cast<std::uint8_t>(i + 1)};
    vehicle.name += "_" + std::to_string(i + 1);
    scenario.vehicles.push_back(std::move(vehicle));
  }
  return scenario;
}

FaultCampaign::FaultCampaign(FaultCampaignSettings settings) : settings_(std::move(settings)) {
  const bool is_drawn = !settings_.scenario.empty();
  const std::size_t most = is_drawn ? kMostDrawnCars : kMostCars;
  if (settings_.cars != 0 && (settings_.cars < kFewestCars || settings_.cars > most)) {
    throw std::invalid_argument(
        fmt::format("--cars = {}, must be 0 or in {} ... {}", settings_.cars, kFewestCars, most));
  }
  const std::filesystem::path& folder = settings_.scenario_folder;
  const std::size_t most_cars = std::max(settings_.cars, kMostCars);
  const scenario::Scenario roads =
      is_drawn ? drawn_scenario(settings_.scenario, most_cars)
               : scenario::read_scenario({.file = folder / "paper_three_cars.yaml"});
  const controller::PreparedSubgraph on_roads = scenario::prepare_subgraph_of(roads);
  for (std::size_t cars = kFewestCars; cars <= most_cars; ++cars) {
    if (settings_.cars != 0 && settings_.cars != cars) continue;
    Scenarios scenarios{.circle = {},
                        .roads = {.scenario = with_cars(roads, cars), .subgraph = on_roads}};
    if (!is_drawn) {
      scenario::Scenario on_circle =
          scenario::read_scenario({.file = folder / "circle.yaml", .cars = cars});
      controller::PreparedSubgraph prepared = scenario::prepare_subgraph_of(on_circle);
      scenarios.circle = {.scenario = std::move(on_circle), .subgraph = std::move(prepared)};
    }
    scenarios_.emplace(cars, std::move(scenarios));
  }
}

FaultCase FaultCampaign::draw(std::uint64_t seed) const {
  SeededRandom random(mixed(seed, 7));
  FaultCase the_case{.seed = seed};
  auto chosen = scenarios_.begin();
  std::advance(chosen, static_cast<std::ptrdiff_t>(random.below(scenarios_.size())));
  const std::optional<Prepared>& circle = chosen->second.circle;
  const bool is_on_roads = random.chance(0.7) || !circle;
  const Prepared& drawn = is_on_roads ? chosen->second.roads : *circle;
  the_case.scenario =
      is_on_roads ? scenario::with_random_starts(drawn.scenario, random.next()) : drawn.scenario;
  FaultRunSettings& run = the_case.run;
  run.lab.prepared = drawn.subgraph;
  run.lab.seed = seed;
  run.lab.is_logical = random.chance(0.2);
  // Logical time is for one machine.
  run.lab.transport =
      !run.lab.is_logical && random.chance(0.5) ? Transport::kLab : Transport::kLoopback;
  FaultPlanSettings plan{.style = any_style(random),
                         .kinds = settings_.kinds,
                         .last = is_on_roads ? kLastFault : kLastFaultOnCircle};
  if (run.lab.is_logical) plan.last = kLastLogicalFault;
  for (const scenario::ScenarioVehicle& vehicle : the_case.scenario.vehicles) {
    plan.vehicle_ids.push_back(vehicle.id.value);
  }
  run.faults = draw_faults(random.next(), plan);
  the_case.scenario.profile.strategies.priorities.strategy = settings_.priorities;
  if (settings_.has_two_rounds || settings_.priorities->search != nullptr) {
    the_case.scenario.rounds = controller::Rounds::kTwo;
    run.lab.different = any_difference(plan.vehicle_ids, random);
  }
  return the_case;
}

FaultCase FaultCampaign::draw(std::uint64_t seed, const std::vector<std::size_t>& kept) const {
  FaultCase the_case = draw(seed);
  std::vector<Fault> faults;
  for (const std::size_t index : kept) {
    if (index >= the_case.run.faults.size()) {
      throw std::invalid_argument("fault " + std::to_string(index) + ", must be < " +
                                  std::to_string(the_case.run.faults.size()));
    }
    faults.push_back(the_case.run.faults[index]);
  }
  the_case.run.faults = std::move(faults);
  return the_case;
}

Shrunk FaultCampaign::shrink(std::uint64_t seed) const {
  std::vector<std::size_t> all(draw(seed).run.faults.size());
  std::iota(all.begin(), all.end(), std::size_t{});
  Shrunk result;
  result.kept = shrunk<std::size_t>(std::move(all), [&](const std::vector<std::size_t>& kept) {
    return !run(draw(seed, kept)).violations.empty();
  });
  result.the_case = draw(seed, result.kept);
  result.result = run(result.the_case);
  return result;
}

std::string describe(const FaultCase& the_case) {
  std::string text = "seed " + std::to_string(the_case.seed) + ": " + the_case.scenario.name +
                     ", " + std::to_string(the_case.scenario.vehicles.size()) + " cars, " +
                     (the_case.run.lab.is_logical ? "logical" : "real") + " time, endpoints of " +
                     (the_case.run.lab.transport == Transport::kLab ? "the lab" : "loopback") +
                     "\n";
  if (the_case.run.lab.different) text += "  " + to_string(*the_case.run.lab.different) + "\n";
  for (const Fault& fault : the_case.run.faults) text += "  " + to_string(fault) + "\n";
  return text;
}

void FaultTotals::add(const FaultRunResult& result) {
  ++runs;
  if (!result.violations.empty()) ++failed;
  car_steps += result.car_steps;
  planned += result.planned;
  unreachable += result.unreachable;
  smallest_distance_m = std::min(smallest_distance_m, result.smallest_distance_m);
}

std::string describe(const FaultTotals& totals) {
  std::array<char, 240> text{};
  std::snprintf(text.data(), text.size(),
                "%llu runs, %llu failed, %llu car-steps, %llu with a new plan, %llu out of reach, "
                "cars came as close as %.3f m",
                static_cast<unsigned long long>(totals.runs),
                static_cast<unsigned long long>(totals.failed),
                static_cast<unsigned long long>(totals.car_steps),
                static_cast<unsigned long long>(totals.planned),
                static_cast<unsigned long long>(totals.unreachable), totals.smallest_distance_m);
  return text.data();
}

std::vector<FaultKind> fault_kinds_of(const std::vector<std::string>& names) {
  std::vector<FaultKind> kinds;
  for (const FaultKind kind : all_fault_kinds()) {
    if (names.empty() || std::ranges::find(names, to_string(kind)) != names.end()) {
      kinds.push_back(kind);
    }
  }
  return kinds;
}

}  // namespace hlc::closed_loop
