#include "planner/policy/prepared_choice.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>
namespace hlc::policy {
namespace {

/// Most edges from a trim that planning may start from to an enabled one. Every exit edge leads one
/// nearer, so any way is a shortest one.
std::size_t most_exit_steps(const automaton::Subgraph& subgraph) {
  std::size_t most = 0;
  for (const TrimId start : subgraph.start_trims()) {
    std::size_t steps = 0;
    for (TrimId at = start; !subgraph.is_enabled(at); ++steps) {
      const auto edges = subgraph.successors(at);
      const auto exit =
          std::ranges::find_if(edges, [at](const automaton::Edge& edge) { return edge.to != at; });
      if (exit == edges.end()) break;  // standing, forever
      at = exit->to;
    }
    most = std::max(most, steps);
  }
  return most;
}

double top_speed_of(const automaton::Subgraph& subgraph) {
  double top_mps = 0.0;
  for (const TrimId trim : subgraph.trims()) {
    for (const automaton::Edge& edge : subgraph.successors(trim)) {
      top_mps = std::max(top_mps, automaton::top_speed_mps(*edge.maneuver));
    }
  }
  return top_mps;
}

}  // namespace

std::shared_ptr<const automaton::Subgraph> limited_subgraph(
    const automaton::Subgraph& base, const SubgraphRequest& request, double limit_mps,
    std::size_t horizon_steps,
    const std::shared_ptr<const automaton::UniversalAutomaton>& automaton) {
  SubgraphRequest limited = request;
  limited.max_speed_mps = std::min(limit_mps, request.max_speed_mps.value_or(limit_mps));
  limited.max_speed_mps =
      std::min(*limited.max_speed_mps, base.spec().max_speed_mps.value_or(limit_mps));
  try {
    return automaton::requested_subgraph(base, limited, horizon_steps, automaton);
  } catch (const std::invalid_argument&) {
    if (limited == SubgraphRequest{.max_speed_mps = limited.max_speed_mps}) throw;
    return limited_subgraph(base, {}, limit_mps, horizon_steps);
  }
}

PreparedChoice::PreparedChoice(
    const controller::PreparedSubgraph& base, const SubgraphRequest& request,
    std::span<const double> limits_mps, std::size_t horizon_steps,
    const search::SearchOptions& search,
    const std::shared_ptr<const automaton::UniversalAutomaton>& automaton) {
  const auto prepared = [&](std::shared_ptr<const automaton::Subgraph> subgraph) {
    return controller::prepare_subgraph(std::move(subgraph), horizon_steps, search);
  };
  const bool is_base = request == SubgraphRequest{};
  const controller::PreparedSubgraph without_limit =
      is_base ? base
              : prepared(automaton::requested_subgraph(*base.subgraph, request, horizon_steps,
                                                       automaton));
  by_limit_.emplace(std::nullopt, without_limit);
  const std::optional<double> own_mps = without_limit.subgraph->spec().max_speed_mps;
  for (const double limit_mps : limits_mps) {
    const controller::PreparedSubgraph limited =
        own_mps && *own_mps <= limit_mps
            ? without_limit
            : prepared(
                  limited_subgraph(*base.subgraph, request, limit_mps, horizon_steps, automaton));
    by_limit_.emplace(limit_mps, limited);
    steps_to_slow_down_ = std::max(steps_to_slow_down_, most_exit_steps(*limited.subgraph));
  }
  top_speed_mps_ = top_speed_of(*without_limit.subgraph);
}

}  // namespace hlc::policy
