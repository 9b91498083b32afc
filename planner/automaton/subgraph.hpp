#pragma once

#include <compare>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/automaton/automaton.hpp"

namespace hlc::automaton {

/// The rule for edges between the trims of a subgraph, beside each trim's self-loop.
enum class EdgeRule {
  kChain,  ///< every equilibrium trim to and from every trim, and neighbours in their order
  /// All pairs that the bounds on acceleration and steering rate permit in one step. With a
  /// friction circle or a limit on the curvature: those that constant inputs connect within it.
  kReachable,
};

/// Disabled edges: those from one trim to another with that label, or with every label.
struct DisabledEdges {
  TrimPair edge;
  std::optional<std::string> label;
  friend bool operator==(const DisabledEdges&, const DisabledEdges&) = default;
};

/// Labels of the edges from one trim to another, instead of those of the subgraph.
struct EdgeLabels {
  TrimPair edge;
  std::vector<std::string> labels;
  friend bool operator==(const EdgeLabels&, const EdgeLabels&) = default;
};

/// The enabled part of a universal automaton.
///
/// The rule defines which pairs of the declared trims have edges; between two trims there is one
/// edge for each label. `disabled_edges` and `max_speed_mps` remove some of these.
struct SubgraphSpec {
  std::string name;                 ///< "A" ... "D" of the paper
  std::vector<std::string> labels;  ///< of the maneuvers between different trims: {"J2"}
  std::vector<TrimId> trims;        ///< declared trims, in order; must hold an equilibrium
  EdgeRule rule{EdgeRule::kChain};
  /// Removes the trims that are faster, and the maneuvers that are faster *anywhere*: a J1 maneuver
  /// between trims of 0.8 m/s reaches 2 m/s. One that ends in a trim at the limit exceeds it by the
  /// rounding of its last state: 1e-6 m/s are tolerated.
  std::optional<double> max_speed_mps{};
  std::vector<DisabledEdges> disabled_edges{};
  std::vector<EdgeLabels> edges{};
  friend bool operator==(const SubgraphSpec&, const SubgraphSpec&) = default;
};

/// The pairs of a rule among the trims `on`, self-loops included, sorted.
/// @pre every element of `on` is an index into `trims`
[[nodiscard]] std::vector<TrimPair> rule_edges(EdgeRule rule, const std::vector<Trim>& trims,
                                               const std::vector<TrimId>& on,
                                               const vehicle::VehicleParameters& vehicle,
                                               const vehicle::VehicleLimits& limits, double step_s);

/// The labels of the edges from one trim to another, without disabled ones.
[[nodiscard]] std::vector<std::string> labels_of(const SubgraphSpec& spec, const TrimPair& edge);

/// One enabled edge: a maneuver, or a trim's self-loop. The step from a trim to itself is its
/// self-loop, unless the automaton holds such steps that are optimal for the subgraph's labels and
/// within its speed limit: then it is these.
struct Edge {
  TrimId to;
  const Maneuver* maneuver{};
};

/// A view on a universal automaton: the part that the planner plans on. It points into the
/// automaton, keeps it alive and copies nothing of it; for the paper's automaton it is made in 0.01
/// ms.
///
/// A trim is *enabled* if it is declared and not faster than the speed limit. Every enabled trim
/// can reach an equilibrium along enabled edges.
///
/// **Switching to another subgraph between two steps.** Whatever subgraphs follow each other, the
/// vehicle always has a plan, and if no new one is ever found it stands within the horizon:
///
/// 1. A plan holds maneuvers of the *universal* automaton, which owns them, enabled or not. So the
///    plan in force stays valid to its end, an equilibrium, even if its trims or maneuvers have
///    just been disabled: it is the fallback. Its areas were checked when it was made.
/// 2. Planning starts from a trim of the plan in force, which may be disabled now. Such a trim has
///    *exit edges*: let its exit distance be the fewest edges of the universal automaton, of any
///    label but without those in `disabled_edges`, that lead to an enabled trim. Its exit edges are
///    those that lead one nearer; with the labels of the subgraph, or, if there are none, with any
///    label. Under a speed limit those of any label that are not faster than both their trims come
///    first: a vehicle that has to slow down does not speed up before. So a vehicle that is too
///    fast for the subgraph is slowed down over as many steps as it needs, and disabled trims are
///    left on the shortest way. The speed limit does not hold on that way: it cannot.
/// 3. An equilibrium trim can be held forever, enabled or not: it keeps its self-loop. So standing
///    is always a plan, unless the automaton holds steps of standstill that move, which take its
///    place (maneuver_design::SelfLoops::kOptimisedAll): then it is the fallback alone.
/// 4. A trim without any way out gives no new plan; the fallback is driven.
///
/// The distance to standstill counts the exit edges, too. Once a plan has been found from a
/// disabled trim, one is found in every later step, too, as long as nothing is switched and no new
/// obstacle appears: the rest of that plan, followed by standing, consists of edges of this
/// subgraph.
class Subgraph {
 public:
  /// @throws std::invalid_argument naming the edge that the automaton does not hold, a trim from
  /// which no equilibrium can be reached, or another error of `spec`
  Subgraph(std::shared_ptr<const UniversalAutomaton> automaton, SubgraphSpec spec);

  [[nodiscard]] const UniversalAutomaton& automaton() const { return *automaton_; }
  /// The same, shared.
  [[nodiscard]] const std::shared_ptr<const UniversalAutomaton>& shared_automaton() const {
    return automaton_;
  }
  [[nodiscard]] const SubgraphSpec& spec() const { return spec_; }
  [[nodiscard]] bool is_enabled(TrimId trim) const;
  /// The enabled trims, in the order of the declaration.
  [[nodiscard]] std::span<const TrimId> trims() const { return trims_; }
  /// The trims that planning may start from: enabled ones and those with a way out, sorted.
  [[nodiscard]] std::span<const TrimId> start_trims() const { return start_trims_; }

  /// Edges out of `trim`, sorted by target, then by label in the order of the declaration. Of a
  /// disabled trim: its exit edges (none if it has no way out).
  [[nodiscard]] std::span<const Edge> successors(TrimId trim) const;
  /// The edges that a plan may take with `steps_left` steps to go, this one included: from their
  /// targets, standstill is at most steps_left - 1 steps away.
  [[nodiscard]] std::span<const Edge> successors(TrimId trim, std::size_t steps_left) const;

  /// Fewest steps from `trim` to an equilibrium; 0 for an equilibrium; kNever for a disabled trim
  /// without a way out.
  [[nodiscard]] std::size_t distance_to_standstill(TrimId trim) const;
  static constexpr std::size_t kNever = static_cast<std::size_t>(-1);

  /// The first enabled equilibrium trim.
  [[nodiscard]] TrimId standstill() const { return standstill_; }

 private:
  [[noreturn]] void fail(const std::string& reason) const;
  void check_trim(TrimId trim) const;
  void check_labels(const std::vector<std::string>& labels) const;
  void check_spec() const;
  [[nodiscard]] bool is_too_fast(double speed_mps) const;
  void switch_trims_on();
  [[nodiscard]] std::vector<std::string> held_labels(
      const TrimPair& edge, const std::vector<const Maneuver*>& maneuvers) const;
  void switch_edges_on();
  bool shorten_distance(TrimId trim);
  void measure_distances();
  [[nodiscard]] std::vector<Edge> exits_among(const std::vector<const Maneuver*>& maneuvers,
                                              const std::vector<bool>& is_nearer) const;
  void add_exits();
  void list_permitted();

  std::shared_ptr<const UniversalAutomaton> automaton_;
  SubgraphSpec spec_;
  TrimId standstill_;
  std::vector<TrimId> trims_;
  std::vector<TrimId> start_trims_;
  std::vector<bool> is_enabled_;
  std::vector<std::vector<Edge>> successors_;
  std::vector<std::size_t> distance_to_standstill_;
  /// By steps left, then trim. An edge that is permitted with the last number of steps is so with
  /// more.
  std::vector<std::vector<std::vector<Edge>>> permitted_;
};

/// Checks what every declared subgraph must fulfil beyond Subgraph itself: each enabled trim can be
/// reached from standstill, and reaches standstill within the horizon.
/// @throws std::invalid_argument naming subgraph and trim
void check_driving(const Subgraph& subgraph, std::size_t horizon_steps);

}  // namespace hlc::automaton
