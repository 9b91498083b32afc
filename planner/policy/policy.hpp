#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "planner/automaton/subgraph_request.hpp"
#include "planner/controller/controller.hpp"
#include "planner/policy/policy_settings.hpp"

namespace hlc {

/// What a policy goes by before step k.
struct PolicyView {
  double time_s{};                    ///< since the experiment's first step
  const Report* last{};               ///< of step k - 1; none in the first step
  std::optional<double> battery_v{};  ///< none if it is not known
};

/// What a request means for a controller where it is now: with the speed limits that hold there.
using PreparedFor =
    std::function<const PreparedSubgraph&(const SubgraphRequest& request, const Controller&)>;

/// Has an opinion on which subgraph to plan on. One object per vehicle; it may remember.
class Policy {
 public:
  virtual ~Policy() = default;

  /// What it would ask for from this step on; none: it has no opinion. Called once per step.
  [[nodiscard]] virtual std::optional<SubgraphRequest> propose(const PolicyView& view) = 0;

  /// All that it may ever ask for: that is prepared before the first step.
  [[nodiscard]] virtual std::vector<SubgraphRequest> choices() const = 0;

  /// True if it has to look ahead after a step.
  [[nodiscard]] virtual bool looks_ahead() const { return false; }
  /// Called after a step in which its opinion may be asked for in the next one, when nobody waits
  /// for the vehicle any more. @pre the controller is not in the middle of a step
  virtual void look_ahead(const Controller& /*controller*/, const PreparedFor& /*prepared*/) {}
};

[[nodiscard]] std::unique_ptr<Policy> make_policy(const PolicySettings& settings);

}  // namespace hlc
