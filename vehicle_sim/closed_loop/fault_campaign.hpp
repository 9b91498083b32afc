#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/closed_loop/fault_run.hpp"

namespace hlc::closed_loop {

inline constexpr std::size_t kFewestCars = 3;
inline constexpr std::size_t kMostCars = 8;
inline constexpr std::size_t kMostDrawnCars = 20;

struct FaultCampaignSettings {
  std::filesystem::path scenario_folder;  ///< holds circle and paper_three_cars
  /// Of all runs, one that draws its vehicles; empty: the two of the folder.
  std::filesystem::path scenario{};
  /// kFewestCars ... kMostCars, with `scenario` kMostDrawnCars; 0: by the seed, kMostCars at most
  std::size_t cars{};
  std::vector<FaultKind> kinds;  ///< of the faults; empty: no faults
  bool has_two_rounds{};         ///< with one that differs in half of the runs
  /// Of all runs. One that compares orders has two rounds, too.
  const coordination::PriorityStrategy* priorities{&coordination::kConstantPriorities};
};

/// The case of a seed.
struct FaultCase {
  std::uint64_t seed{};
  scenario::Scenario scenario;
  FaultRunSettings run;
};

/// The seed, the scenario, and the numbered faults, each in a line.
[[nodiscard]] std::string describe(const FaultCase& the_case);

/// A failing seed, with a minimal set of its faults.
struct Shrunk {
  FaultCase the_case;
  std::vector<std::size_t> kept;  ///< indices of the faults that are left
  FaultRunResult result;
};

/// The scenario with so many cars, the first ones, or further ones on the same routes; for random
/// starts.
/// @pre vehicles are numbered from 1
[[nodiscard]] scenario::Scenario with_cars(scenario::Scenario scenario, std::size_t cars);

/// Runs with faults, one for each seed. A seed chooses
///   * the scenario: cars on a circle that all drive to the other side, or cars on the paper's
///     three routes, which merge and cross, from random starts; or a draw of `scenario`;
///   * real time or (one in five) logical time, the endpoints of the lab or of loopback;
///   * the faults (draw_faults) and their distribution in time, and every delay.
/// Scenarios are read and automata built once; then any number of threads may run.
class FaultCampaign {
 public:
  /// @throws std::invalid_argument naming the flag --cars if it is out of range;
  /// std::invalid_argument, std::runtime_error if a scenario cannot be read, draws no vehicles or
  /// has guests
  explicit FaultCampaign(FaultCampaignSettings settings);

  [[nodiscard]] FaultCase draw(std::uint64_t seed) const;
  /// With some of its faults only. @throws std::invalid_argument if there is no such fault
  [[nodiscard]] FaultCase draw(std::uint64_t seed, const std::vector<std::size_t>& kept) const;
  [[nodiscard]] static FaultRunResult run(const FaultCase& the_case, const Trace& trace = {}) {
    return run_with_faults(the_case.scenario, the_case.run, trace);
  }
  /// @pre the seed fails
  [[nodiscard]] Shrunk shrink(std::uint64_t seed) const;

 private:
  FaultCampaignSettings settings_;
  struct Prepared {
    scenario::Scenario scenario;
    controller::PreparedSubgraph subgraph;
  };
  struct Scenarios {
    std::optional<Prepared> circle;
    Prepared roads;  ///< for random starts
  };
  std::map<std::size_t, Scenarios> scenarios_;  ///< by number of cars
};

/// Sums over many runs.
struct FaultTotals {
  std::uint64_t runs{};
  std::uint64_t failed{};
  std::uint64_t car_steps{};
  std::uint64_t planned{};
  std::uint64_t unreachable{};
  double smallest_distance_m{1e9};
  void add(const FaultRunResult& result);
};
/// "100 runs, 0 failed, 12345 car-steps, ..."
[[nodiscard]] std::string describe(const FaultTotals& totals);

/// Of these names; all if there are none. @pre each is the name of a kind
[[nodiscard]] std::vector<FaultKind> fault_kinds_of(const std::vector<std::string>& names);

}  // namespace hlc::closed_loop
