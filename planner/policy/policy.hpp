#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "planner/automaton/subgraph_request.hpp"
#include "planner/controller/report.hpp"
#include "planner/policy/policy_settings.hpp"

namespace hlc {

/// What a policy goes by before step k.
struct PolicyView {
  double time_s{};                    ///< since the controller's first step
  const Report* last{};               ///< of step k - 1; none in the first step
  std::optional<double> battery_v{};  ///< none if it is not known
};

/// Has an opinion on which subgraph to plan on. One object per vehicle; it may remember.
class Policy {
 public:
  virtual ~Policy() = default;

  /// What it would ask for from this step on; none: it has no opinion. Called once per step.
  [[nodiscard]] virtual std::optional<SubgraphRequest> wish(const PolicyView& view) = 0;

  /// All that it may ever ask for: that is prepared before the first step.
  [[nodiscard]] virtual std::vector<SubgraphRequest> choices() const = 0;
};

/// The policies that need nothing but the view.
/// @return nullptr for settings of another kind
[[nodiscard]] std::unique_ptr<Policy> make_rule_policy(const PolicySettings& settings);

}  // namespace hlc
