#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"

namespace hlc::maneuver_design {

/// A point of the Pareto front of two criteria (epsilon-constraint): J_minimised is least among the
/// maneuvers with J_bounded <= best + share (worst - best), where best is the optimum of J_bounded
/// and worst its value at the optimum of J_minimised. The bound differs for each pair of trims.
struct FrontPoint {
  std::string minimised;
  std::string bounded;
  double share{};  ///< 0: the optimum of J_bounded, 1: that of J_minimised
};

/// The objective of the maneuvers of one label: the criterion whose name is the label, a weighted
/// sum, or a point of a front.
struct LabelledCriterion {
  std::string label;
  std::vector<CriterionWeight> weights;  ///< of a weighted sum
  /// Each criterion of the sum is divided by its range over the front of the maneuver's own ends
  /// (see `design`).
  bool normalised{false};
  std::optional<FrontPoint> front_point{};
};

/// The edges of a universal automaton, each for every label.
enum class EdgeChoice {
  kSubgraphs,  ///< those that its subgraphs need
  kAll,        ///< all pairs of trims that the bounds on acceleration and steering rate permit
};

/// The step that a trim makes back to itself.
enum class SelfLoops {
  kTrim,       ///< the trim itself, driven for one step, whatever the label
  kOptimised,  ///< of a moving trim optimal for each label, like every other edge: the trim at both
               ///< ends, free between them. Standstill stands
  /// Of standstill, too. New plans then move wherever the label rewards it, so the rest of a plan,
  /// followed by standing, is not among them: only the fallback keeps the vehicle safe. For
  /// comparisons with the paper, which does not state its self-loops.
  kOptimisedAll,
};

/// Their names in files, in the order of the enumeration.
inline const std::vector<std::string> kSelfLoopNames = {"trim", "optimised", "optimised_all"};

/// @pre one of kSelfLoopNames
[[nodiscard]] SelfLoops self_loops_named(const std::string& name);

/// Places of keys, "file:line: key = value", for errors that only the maneuvers reveal.
struct ConfigurationPlaces {
  struct Subgraph {
    std::string trims;
    std::string max_speed_mps;  ///< empty: it has none
  };
  std::string intervals;  ///< with the default's value and the file's first line if absent
  std::vector<Subgraph> subgraphs;  ///< as many as the configuration has, or none at all
};

/// Source of a universal automaton. File: see launch_scripts/automata/paper.yaml.
struct AutomatonConfiguration {
  std::string source;  ///< file it was read from, for messages
  vehicle::VehicleParameters vehicle;
  vehicle::IdentifiedVehicle identified;
  vehicle::VehicleLimits limits;
  std::vector<automaton::Trim> trims;
  double step_s{0.2};  ///< duration of every maneuver and of a trim's self-loop
  std::size_t horizon_steps{
      8};                     ///< in so many steps every trim of a subgraph must reach standstill
  std::size_t intervals{20};  ///< of constant input, per maneuver
  EdgeChoice edges{EdgeChoice::kSubgraphs};
  SelfLoops self_loops{SelfLoops::kTrim};
  std::vector<LabelledCriterion> criteria;
  std::vector<automaton::SubgraphSpec> subgraphs;
  ConfigurationPlaces places;  ///< empty unless read from a file
};

/// Reads a configuration. Keys:
///
///     vehicle:    {wheelbase_m, rear_axle_to_cg_m, length_m, width_m,
///                  safety_margin_m (default 0.010),
///                  identified: {... (see IdentifiedVehicle), all optional}, or kinematic}
///     limits:     {acceleration_mps2, steering_rate_radps, speed_min_mps, speed_max_mps,
///                  steering_max_rad, friction_mps2 (default: no friction circle),
///                  curvature_max_per_m of the path (default: no limit)}
///     trims:      list of {speed_mps, steering_rad}, or a grid {speeds_mps: [...], steering_rad:
///                  [...]}: standstill, then every speed > 0 with every angle, without what
///                  friction circle and curvature forbid. Numbers count from 1 in this order
///     step_s      at most 100
///     horizon_steps  (default 8)
///     intervals   (default 20)
///     edges:      subgraphs (default) | all
///     own_steps:  trim (default) | optimised | optimised_all, see SelfLoops
///     criteria:   list of names (see criteria.hpp), or of
///                 {name, weights: {J1: 0.5, J2: 0.5}, normalised: true | false (default)} (true
///                 needs two weights > 0), or of {name, minimise: J1, bound: J2, share: 0.5} (a
///                 point of their front, 0 < share < 1)
///     subgraphs:  list of subgraphs, see read_subgraphs (planner/automaton/subgraph_yaml.hpp);
///                 their labels are names of `criteria`
///
/// @throws std::invalid_argument with one line, "file:line: key = value, must be ...", for whatever
/// is missing, unknown, of the wrong type or outside its range: trims must respect the limits and
/// differ, names must differ, subgraphs must hang together, and standstill must be within the
/// horizon of each of their trims.
[[nodiscard]] AutomatonConfiguration read_automaton_configuration(
    const std::filesystem::path& path);

/// True if an edge of the subgraph may have that label.
[[nodiscard]] bool uses(const automaton::SubgraphSpec& subgraph, const std::string& label);

/// The same configuration with this subgraph alone and the labels that it uses, sufficient for a
/// run that stays on one subgraph. Building it takes as long as that label does.
[[nodiscard]] AutomatonConfiguration needed_by(const automaton::SubgraphSpec& subgraph,
                                               AutomatonConfiguration configuration);

}  // namespace hlc::maneuver_design
