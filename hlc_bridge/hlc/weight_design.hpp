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

namespace hlc::high_level_controller {

/// Designs maneuvers for weights of criteria that were not declared before the run: plain weighted
/// sums of the criteria of planner/maneuver_design/criteria.hpp, solved as the declared ones are,
/// with one more bound: no maneuver is faster than the fastest of the scenario's automaton, since
/// the others use that speed to bound where a silent vehicle can be (planner/coordination/missing).
/// No thread, no clock.
class WeightDesign {
 public:
  /// Returns the configuration that the automaton was built from, or throws the reason why it
  /// cannot. Called once, when weights are first requested.
  using Source = std::function<maneuver_design::AutomatonConfiguration()>;

  /// @param automaton  the scenario's
  /// @param lab        limits of its vehicles; absent: none
  WeightDesign(std::shared_ptr<const automaton::UniversalAutomaton> automaton, Source source,
               std::optional<vehicle::LabLimits> lab = {});

  /// An automaton with all of the scenario's maneuvers and those of these weights, under
  /// label_of(weights), between the trims where `spec` has edges of that label. The automata of the
  /// last kMaxKept weights are kept and not made again.
  /// @param stop  checked before every maneuver
  /// @throws std::exception with the reason in one line: an unknown criterion, one that is listed
  /// twice, a weight that is negative or not finite, none above 0; no configuration, or one that
  /// differs from the automaton's; the edge without a maneuver of these weights, and why
  [[nodiscard]] std::shared_ptr<const automaton::UniversalAutomaton> automaton_for(
      const automaton::SubgraphSpec& spec, const std::vector<CriterionWeight>& weights,
      const std::stop_token& stop = {});

  /// Checks what the others and the lab rely on: no enabled maneuver is faster than the fastest one
  /// of the scenario's automaton, and the lab's vehicles can follow it.
  /// @throws std::invalid_argument naming maneuver, value and bound
  void check(const automaton::Subgraph& subgraph) const;

  static constexpr std::size_t kMaxKept = 8;

 private:
  [[nodiscard]] const maneuver_design::AutomatonConfiguration& configuration();
  [[nodiscard]] std::shared_ptr<const automaton::UniversalAutomaton> known(
      const std::string& label) const;
  void keep(const std::string& label,
            std::shared_ptr<const automaton::UniversalAutomaton> automaton);

  std::shared_ptr<const automaton::UniversalAutomaton> automaton_;
  Source source_;
  std::optional<vehicle::LabLimits> lab_;
  double top_speed_mps_;
  std::optional<maneuver_design::AutomatonConfiguration> configuration_;
  /// By label, the most recently requested first.
  std::deque<std::pair<std::string, std::shared_ptr<const automaton::UniversalAutomaton>>> kept_;
};

}  // namespace hlc::high_level_controller
