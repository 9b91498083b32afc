#pragma once

#include <compare>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "planner/automaton/automaton.hpp"

namespace hlc {

/// What of a universal automaton is switched on.
struct SubgraphSpec {
  std::string name;           ///< "A" ... "D" of the paper
  std::string label;          ///< label of the maneuvers between different trims: "J2"
  std::vector<TrimId> trims;  ///< the trims that are on, in order; must hold an equilibrium
  /// Rule `chain`: every equilibrium trim to and from every trim, and neighbours in the order of
  /// `trims`; every trim to itself.
};

/// An edge by its ends.
struct TrimPair {
  TrimId from;
  TrimId to;
  friend auto operator<=>(const TrimPair&, const TrimPair&) = default;
};

/// The edges of rule `chain` (see SubgraphSpec) among the trims `on`, own steps included, sorted.
/// @pre every element of `on` is an index into `trims`
[[nodiscard]] std::vector<TrimPair> chain_edges(const std::vector<Trim>& trims,
                                                const std::vector<TrimId>& on);

/// One switched-on edge: a maneuver, or a trim's own step.
struct Edge {
  TrimId to;
  const Maneuver* maneuver{};
};

/// A view on a universal automaton: what the planner plans on. Keeps the automaton alive. Copies
/// are cheap enough for one per controller, not for one per vertex.
class Subgraph {
 public:
  /// @throws std::invalid_argument naming the edge that the automaton does not hold, a trim from
  /// which no
  ///         equilibrium can be reached, or an unknown trim.
  Subgraph(std::shared_ptr<const UniversalAutomaton> automaton, SubgraphSpec spec);

  [[nodiscard]] const UniversalAutomaton& automaton() const { return *automaton_; }
  /// The same, to be kept.
  [[nodiscard]] const std::shared_ptr<const UniversalAutomaton>& shared_automaton() const {
    return automaton_;
  }
  [[nodiscard]] const SubgraphSpec& spec() const { return spec_; }
  [[nodiscard]] bool is_on(TrimId trim) const;
  /// Edges out of `trim`, sorted by target.
  [[nodiscard]] std::span<const Edge> successors(TrimId trim) const;
  /// Fewest steps from `trim` to an equilibrium; 0 for an equilibrium.
  [[nodiscard]] std::size_t distance_to_standstill(TrimId trim) const;
  /// The first equilibrium trim that is on.
  [[nodiscard]] TrimId standstill() const { return standstill_; }

 private:
  std::shared_ptr<const UniversalAutomaton> automaton_;
  SubgraphSpec spec_;
  TrimId standstill_;
  std::vector<std::vector<Edge>> successors_;
  std::vector<std::size_t> distance_to_standstill_;
};

}  // namespace hlc
