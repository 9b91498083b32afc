#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "planner/policy/policy.hpp"
#include "planner/policy/prepared_choice.hpp"
#include "planner/policy/rehearsal.hpp"

namespace hlc {

/// Asks for the candidate with which a rehearsal of the next steps (rehearsal.hpp) costs least.
///
/// The rehearsals are made after a step, when its command has been sent, so their time is none of
/// the step's; what they say holds from the next step on. The last choice is kept unless another
/// one costs less by the settings' least_gain, of its amount.
class LookAhead final : public Policy {
 public:
  /// What a candidate means for a controller right now: the speed limits that hold are laid on it.
  using Prepared =
      std::function<const PreparedSubgraph&(const SubgraphRequest& candidate, const Controller&)>;

  explicit LookAhead(LookAheadSettings settings);

  std::optional<SubgraphRequest> wish(const PolicyView& view) override;
  std::vector<SubgraphRequest> choices() const override { return settings_.candidates; }

  /// @pre controller is not in the middle of a step
  void rehearse(const Controller& controller, const HeardInStep& heard, const Prepared& prepared);

 private:
  LookAheadSettings settings_;
  std::optional<std::size_t> chosen_;  ///< none before the first rehearsal
};

}  // namespace hlc
