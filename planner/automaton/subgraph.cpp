#include "planner/automaton/subgraph.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace hlc {
namespace {

constexpr std::size_t kUnreachable = std::numeric_limits<std::size_t>::max();

std::string printed(TrimId trim) { return std::to_string(trim.index + 1); }

void check(const SubgraphSpec& spec, const std::vector<Trim>& trims) {
  const auto fail = [&spec](const std::string& reason) {
    throw std::invalid_argument("subgraph '" + spec.name + "': " + reason);
  };
  bool has_equilibrium = false;
  for (std::size_t i = 0; i < spec.trims.size(); ++i) {
    const TrimId trim = spec.trims[i];
    if (trim.index >= trims.size()) {
      fail("trim " + printed(trim) + ", allowed 1 ... " + std::to_string(trims.size()));
    }
    if (std::find(spec.trims.begin(), spec.trims.begin() + static_cast<std::ptrdiff_t>(i), trim) !=
        spec.trims.begin() + static_cast<std::ptrdiff_t>(i)) {
      fail("trim " + printed(trim) + " is listed twice");
    }
    has_equilibrium = has_equilibrium || trims[trim.index].is_equilibrium();
  }
  if (!has_equilibrium) {
    fail("no trim of speed 0 among its trims");
  }
}

}  // namespace

std::vector<TrimPair> chain_edges(const std::vector<Trim>& trims, const std::vector<TrimId>& on) {
  std::vector<TrimPair> edges;
  for (std::size_t i = 0; i < on.size(); ++i) {
    for (std::size_t j = 0; j < on.size(); ++j) {
      const bool neighbours = i == j || i == j + 1 || j == i + 1;
      if (neighbours || trims[on[i].index].is_equilibrium() ||
          trims[on[j].index].is_equilibrium()) {
        edges.push_back({on[i], on[j]});
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

Subgraph::Subgraph(std::shared_ptr<const UniversalAutomaton> automaton, SubgraphSpec spec)
    : automaton_(std::move(automaton)), spec_(std::move(spec)) {
  const std::vector<Trim>& trims = automaton_->trims;
  check(spec_, trims);
  standstill_ = *std::find_if(spec_.trims.begin(), spec_.trims.end(),
                              [&trims](TrimId trim) { return trims[trim.index].is_equilibrium(); });

  successors_.resize(trims.size());
  for (const TrimPair& pair : chain_edges(trims, spec_.trims)) {
    const Maneuver* maneuver = automaton_->find(pair.from, pair.to, spec_.label);
    if (maneuver == nullptr) {
      throw std::invalid_argument("subgraph '" + spec_.name + "': the automaton holds no edge " +
                                  printed(pair.from) + " -> " + printed(pair.to) + " with label '" +
                                  spec_.label + "'");
    }
    successors_[pair.from.index].push_back({pair.to, maneuver});
  }

  distance_to_standstill_.assign(trims.size(), kUnreachable);
  for (const TrimId trim : spec_.trims) {
    if (trims[trim.index].is_equilibrium()) {
      distance_to_standstill_[trim.index] = 0;
    }
  }
  // A shortest path has fewer edges than there are trims.
  for (std::size_t sweep = 1; sweep < spec_.trims.size(); ++sweep) {
    for (const TrimId trim : spec_.trims) {
      for (const Edge& edge : successors_[trim.index]) {
        const std::size_t via = distance_to_standstill_[edge.to.index];
        if (via != kUnreachable) {
          distance_to_standstill_[trim.index] =
              std::min(distance_to_standstill_[trim.index], via + 1);
        }
      }
    }
  }
  for (const TrimId trim : spec_.trims) {
    if (distance_to_standstill_[trim.index] == kUnreachable) {
      throw std::invalid_argument("subgraph '" + spec_.name + "': no way from trim " +
                                  printed(trim) + " to a trim of speed 0");
    }
  }
}

bool Subgraph::is_on(TrimId trim) const {
  return std::find(spec_.trims.begin(), spec_.trims.end(), trim) != spec_.trims.end();
}

std::span<const Edge> Subgraph::successors(TrimId trim) const { return successors_.at(trim.index); }

std::size_t Subgraph::distance_to_standstill(TrimId trim) const {
  return distance_to_standstill_.at(trim.index);
}

}  // namespace hlc
