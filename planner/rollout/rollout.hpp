#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "planner/controller/controller.hpp"
#include "planner/controller/joint_step.hpp"
#include "planner/controller/prepared_subgraph.hpp"
#include "planner/policy/subgraph_selector.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::rollout {

/// Controllers stepped together, each with a vehicle that follows its plan perfectly: planning and
/// coordination only, for look-ahead, campaigns and tests.
class Rollout {
 public:
  /// @param controllers  one per vehicle, any order
  /// @param starts       planned pose of each at the start, standing
  Rollout(std::vector<std::unique_ptr<controller::Controller>> controllers,
          const std::vector<Pose>& starts);

  /// From the next step on every controller follows these zones and policies, and must not be
  /// switched otherwise. No battery is measured. @pre all are on the subgraphs of their scenario
  void choose_by(const policy::ReconfigurationSettings& settings);

  /// An independent copy of the vehicles in the same state; loses no messages, plans one after the
  /// other, and stays on the current subgraphs.
  [[nodiscard]] Rollout clone() const;

  /// Messages for which this is true are lost. None by default.
  void lose(std::function<bool(const controller::Delivery&)> is_lost) {
    rules_.is_lost = std::move(is_lost);
  }

  /// In which they exchange their plans; the result is the same unless messages are lost. Default:
  /// one after the other, which is the cheapest in one process. @pre kTwo: all controllers can plan
  /// for each other (ControllerOptions::others)
  void exchange_in(controller::Rounds rounds) { rules_.rounds = rounds; }

  /// One control step of all vehicles; reports by vehicle.
  std::vector<coordination::Report> step();

  [[nodiscard]] StepIndex next_step() const { return next_step_; }
  [[nodiscard]] const std::vector<std::unique_ptr<controller::Controller>>& controllers() const {
    return controllers_;
  }

 private:
  Rollout() = default;
  [[nodiscard]] std::vector<coordination::MeasuredVehicle> measure(StepIndex step) const;

  std::vector<std::unique_ptr<controller::Controller>> controllers_;
  std::vector<policy::SubgraphSelector> choices_;  ///< in the order of the controllers, or none
  controller::JointStepRules rules_;
  StepIndex next_step_{0};
};

/// All vehicles of the scenario, standing at their starts, with its policy, if it has one.
/// @throws std::invalid_argument with one line if it has guests: nobody drives them here
[[nodiscard]] Rollout make_rollout(const scenario::Scenario& scenario);
/// The same for who makes several. @param on  prepare_subgraph_of the scenario
[[nodiscard]] Rollout make_rollout(const scenario::Scenario& scenario,
                                   const controller::PreparedSubgraph& on);

}  // namespace hlc::rollout
