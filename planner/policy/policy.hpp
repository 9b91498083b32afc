#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "planner/automaton/subgraph_request.hpp"
#include "planner/controller/controller.hpp"
#include "planner/policy/policy_settings.hpp"

namespace hlc::policy {

/// Inputs of a policy before step k.
struct PolicyView {
  double time_s{};                     ///< since the experiment's first step
  const coordination::Report* last{};  ///< of step k - 1; none in the first step
  std::optional<double> battery_v{};   ///< none if unknown
};

/// Switches a controller to the subgraph of a request, with the speed limits that hold at the
/// controller's current place.
using SwitchTo = std::function<void(const SubgraphRequest& request, controller::Controller&)>;

/// Proposes the subgraph to plan on. One object per vehicle; may have a state.
class Policy {
 public:
  virtual ~Policy() = default;

  /// The proposal from this step on; none: no opinion. Called once per step.
  [[nodiscard]] virtual std::optional<SubgraphRequest> propose(const PolicyView& view) = 0;

  /// All possible proposals: they are prepared before the first step.
  [[nodiscard]] virtual std::vector<SubgraphRequest> choices() const = 0;

  /// True if the policy has to look ahead after a step.
  [[nodiscard]] virtual bool looks_ahead() const { return false; }
  /// Called after a step if a proposal may be needed in the next one, when the step's messages and
  /// command are published. @pre the controller is not in the middle of a step
  virtual void look_ahead(const controller::Controller& /*controller*/,
                          const SwitchTo& /*switch_to*/) {}
};

[[nodiscard]] std::unique_ptr<Policy> make_policy(const PolicySettings& settings);

}  // namespace hlc::policy
