#include "planner/policy/prepared_choice.hpp"

#include <stdexcept>
namespace hlc {

PreparedChoice::PreparedChoice(const PreparedSubgraph& base, const SubgraphRequest& request,
                               std::span<const double> limits_mps, std::size_t horizon_steps,
                               const SearchOptions& search,
                               const std::shared_ptr<const UniversalAutomaton>& automaton) {
  const auto prepared = [&](const SubgraphRequest& one) {
    if (one == SubgraphRequest{}) return base;
    return prepare_subgraph(requested_subgraph(*base.subgraph, one, horizon_steps, automaton),
                            horizon_steps, search);
  };
  by_limit_.emplace(std::nullopt, prepared(request));
  const std::optional<double> own_mps = by_limit_.at(std::nullopt).subgraph->spec().max_speed_mps;
  for (const double limit_mps : limits_mps) {
    if (own_mps && *own_mps <= limit_mps) {
      by_limit_.emplace(limit_mps, by_limit_.at(std::nullopt));
      continue;
    }
    SubgraphRequest limited = request;
    limited.max_speed_mps = limit_mps;
    try {
      by_limit_.emplace(limit_mps, prepared(limited));
    } catch (const std::invalid_argument&) {
      by_limit_.emplace(limit_mps, prepared({.max_speed_mps = limit_mps}));
    }
  }
}

}  // namespace hlc
