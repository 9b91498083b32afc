#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc {

/// Makes maneuvers for weights of criteria that nobody declared before the run: plain weighted sums
/// of the criteria of planner/maneuver_design/criteria.hpp, solved as the declared ones are, with
/// one bound more: nothing is faster than the fastest maneuver of the scenario's automaton, since
/// everybody reckons with that where a vehicle is that is not heard (planner/coordination/missing).
/// No thread, no clock.
class WeightDesign {
 public:
  /// Says what the automaton was built from, or throws why it cannot. Asked once, when weights are
  /// asked for first.
  using Source = std::function<AutomatonConfiguration()>;

  /// @param automaton  the scenario's
  /// @param lab        what its vehicles can follow; absent: anything
  WeightDesign(std::shared_ptr<const UniversalAutomaton> automaton, Source source,
               std::optional<LabLimits> lab = {});

  /// An automaton that holds all of the scenario's maneuvers and those of these weights, under
  /// label_of(weights), between the trims where `spec` has edges of that label. The last kMaxKept
  /// weights are remembered: what was made for them is not made again.
  /// @param stop  asked before every maneuver
  /// @throws std::exception saying in one line what is wrong: an unknown criterion, one that is
  /// there twice, a weight that is negative or not finite, none above 0; no configuration, or one
  /// that says something else than the automaton; the edge without a maneuver of these weights, and
  /// why
  [[nodiscard]] std::shared_ptr<const UniversalAutomaton> automaton_for(
      const SubgraphSpec& spec, const std::vector<CriterionWeight>& weights,
      const std::stop_token& stop = {});

  /// What the others and the lab rely on: nothing that is on is faster than the fastest maneuver of
  /// the scenario's automaton, and the lab's vehicles can follow it.
  /// @throws std::invalid_argument naming maneuver, value and bound
  void check(const Subgraph& subgraph) const;

  static constexpr std::size_t kMaxKept = 8;

 private:
  [[nodiscard]] const AutomatonConfiguration& configuration();
  [[nodiscard]] std::shared_ptr<const UniversalAutomaton> known(const std::string& label) const;
  void keep(const std::string& label, std::shared_ptr<const UniversalAutomaton> automaton);

  std::shared_ptr<const UniversalAutomaton> automaton_;
  Source source_;
  std::optional<LabLimits> lab_;
  double top_speed_mps_;
  std::optional<AutomatonConfiguration> configuration_;
  /// By label, the one that was asked for last in front.
  std::deque<std::pair<std::string, std::shared_ptr<const UniversalAutomaton>>> kept_;
};

}  // namespace hlc
