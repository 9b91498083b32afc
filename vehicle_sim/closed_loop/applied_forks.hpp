#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "planner/controller/joint_step.hpp"
#include "planner/policy/prepared_choice.hpp"
#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/closed_loop/fork.hpp"
#include "vehicle_sim/closed_loop/member.hpp"

namespace hlc::closed_loop {

/// The forks of an experiment, applied while it drives.
class AppliedForks {
 public:
  /// @param scenario  not owned. @pre check_forks throws nothing
  /// @throws std::invalid_argument with one line: maneuvers or a speed that the automaton has no
  /// subgraph for
  AppliedForks(std::vector<Fork> forks, const scenario::Scenario& scenario,
               const std::vector<Member>& members);

  /// Applies what changes in this step.
  /// @param from     step of the experiment, from 0
  /// @param now      the same as the controllers count
  /// @throws std::invalid_argument with one line: a change that is impossible where the vehicles
  /// are (Fork::Obstacle, Fork::Route)
  void apply(std::uint64_t from, StepIndex now, std::vector<Member>& members,
             controller::JointStepRules& rules);

  /// The vehicles left out so far.
  [[nodiscard]] const std::set<VehicleId>& gone() const { return gone_; }

 private:
  struct Step;

  void prepare_requests(const std::vector<Member>& members);

  std::vector<Fork> forks_;  ///< by step
  const scenario::Scenario* scenario_;
  std::map<std::pair<std::uint64_t, VehicleId>, std::shared_ptr<const policy::PreparedChoice>>
      requests_;  ///< by the step of the experiment from which they hold, with all changes so far
  std::set<VehicleId> gone_;
};

}  // namespace hlc::closed_loop
