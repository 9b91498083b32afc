#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "planner/controller/prepared_subgraph.hpp"
#include "planner/joint_search/joint_problem.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/search/search_engine.hpp"

namespace hlc::rollout {

/// Draws joint problems on a scenario's roads, for experiments: vehicles as they come to meet.
///
/// Each has driven alone for up to kMostSteps steps on one of the scenario's routes, from standing
/// at a random place of it, so that its pose, trim, reference and incumbent are those of a vehicle
/// on its way. In a problem all are less than kNear_m away from the first one, their standing areas
/// do not overlap, and their optima without each other conflict: each with another one's, directly
/// or over others. Whether there is a joint plan at all is not asked. Right of way does not apply.
class JointDraws {
 public:
  /// @param scenario  its routes must be closed
  /// @param search    of each vehicle; the cost-to-go must be admissible
  JointDraws(scenario::Scenario scenario, const search::SearchOptions& search, std::uint64_t seed);

  /// @return nothing if none of kMostDraws draws conflicts
  [[nodiscard]] std::optional<joint_search::JointProblem> draw(std::size_t num_vehicles);

  [[nodiscard]] const controller::PreparedSubgraph& on() const { return on_; }

  /// That problems are composed of; fewer if most places leave a vehicle no plan.
  static constexpr std::size_t kVehicles = 400;
  static constexpr std::size_t kMostSteps = 20;
  static constexpr double kNear_m = 1.0;
  static constexpr std::size_t kMostDraws = 100'000;

 private:
  struct Vehicle {
    search::HorizonProblem problem;
    ConvexPolygon standing_m;            ///< at the start of the problem
    std::vector<ConvexPolygon> areas_m;  ///< of its optimum
  };

  [[nodiscard]] std::optional<Vehicle> drive_alone(scenario::Scenario& scenario);
  [[nodiscard]] std::vector<const Vehicle*> near_each_other(std::size_t num_vehicles);

  controller::PreparedSubgraph on_;
  std::unique_ptr<search::SearchEngine> engine_;
  std::mt19937_64 random_;
  std::vector<Vehicle> vehicles_;
};

}  // namespace hlc::rollout
