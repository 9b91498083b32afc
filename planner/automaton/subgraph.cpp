#include "planner/automaton/subgraph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/automaton/trim_format.hpp"
#include "planner/vehicle/lateral_acceleration.hpp"
#include "planner/vehicle/path_curvature.hpp"

namespace hlc::automaton {
namespace {

constexpr double kRounding_mps = 1e-6;  // of the states of maneuvers (maneuver_check)
template <class T>
bool holds(const std::vector<T>& list, const T& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

template <class T>
bool holds_twice(const std::vector<T>& list, const T& value) {
  return std::count(list.begin(), list.end(), value) > 1;
}

/// True if constant inputs that make the change within one step are within the limits. Without a
/// friction circle and a limit on the curvature there are no other limits: v and delta are linear
/// in the inputs.
bool are_in_reach(const Trim& a, const Trim& b, const vehicle::VehicleParameters& vehicle,
                  const vehicle::VehicleLimits& limits, double step_s) {
  constexpr double kRounding = 1.0 + 1e-9;
  const double speed_mps = limits.acceleration_mps2 * step_s * kRounding;
  const double steering_rad = limits.steering_rate_radps * step_s * kRounding;
  if (std::abs(b.speed_mps - a.speed_mps) > speed_mps ||
      std::abs(b.steering_rad - a.steering_rad) > steering_rad) {
    return false;
  }
  const vehicle::Input input{(b.speed_mps - a.speed_mps) / step_s,
                             (b.steering_rad - a.steering_rad) / step_s};
  constexpr int kSamples = 100;
  for (int i = 0; i <= kSamples; ++i) {
    const double share = static_cast<double>(i) / kSamples;
    const vehicle::State state{{},
                               std::lerp(a.speed_mps, b.speed_mps, share),
                               std::lerp(a.steering_rad, b.steering_rad, share)};
    if (!vehicle::is_within_friction(state, input, vehicle, limits) ||
        !vehicle::is_within_curvature(state, input, vehicle, limits)) {
      return false;
    }
  }
  return true;
}

bool is_disabled(const SubgraphSpec& spec, const TrimPair& edge, const std::string& label) {
  return std::any_of(
      spec.disabled_edges.begin(), spec.disabled_edges.end(), [&](const DisabledEdges& disabled) {
        return disabled.edge == edge && (!disabled.label || *disabled.label == label);
      });
}

const std::vector<std::string>& declared_labels(const SubgraphSpec& spec, const TrimPair& edge) {
  for (const EdgeLabels& one : spec.edges) {
    if (one.edge == edge) return one.labels;
  }
  return spec.labels;
}

/// The maneuvers out of each trim, in the automaton's order.
using ManeuversFrom = std::vector<std::vector<const Maneuver*>>;

ManeuversFrom maneuvers_from(const UniversalAutomaton& automaton) {
  ManeuversFrom result(automaton.trims.size());
  for (const Maneuver& maneuver : automaton.maneuvers) {
    result[maneuver.from.index].push_back(&maneuver);
  }
  return result;
}

const Maneuver* find(const std::vector<const Maneuver*>& maneuvers, TrimId to,
                     const std::string& label) {
  for (const Maneuver* maneuver : maneuvers) {
    if (maneuver->to == to && maneuver->label == label) return maneuver;
  }
  return nullptr;
}

/// Candidates for exit edges, in order of preference.
struct ExitChoice {
  bool under_speed_limit;  ///< only of a subgraph with a limit: not faster than both their trims
  bool any_label;
};
constexpr ExitChoice kExitChoices[] = {{true, false}, {true, true}, {false, false}, {false, true}};

bool speeds_up(const Maneuver& maneuver, const std::vector<Trim>& trims) {
  const double faster_mps =
      std::max(trims[maneuver.from.index].speed_mps, trims[maneuver.to.index].speed_mps);
  return top_speed_mps(maneuver) > faster_mps + kRounding_mps;
}

bool allows(const ExitChoice& choice, const Maneuver& maneuver, const SubgraphSpec& spec,
            const std::vector<Trim>& trims) {
  const TrimPair pair{maneuver.from, maneuver.to};
  if (!choice.any_label && !holds(declared_labels(spec, pair), maneuver.label)) return false;
  if (is_disabled(spec, pair, maneuver.label)) return false;
  return !choice.under_speed_limit || !speeds_up(maneuver, trims);
}

/// A disabled equilibrium can be held, too.
void add_standing_if_disabled(bool is_enabled, const Trim& trim, TrimId id,
                              const std::vector<const Maneuver*>& maneuvers,
                              std::vector<Edge>& edges) {
  if (is_enabled || !trim.is_equilibrium()) return;
  if (const Maneuver* standing = find(maneuvers, id, kSelfLoopLabel)) {
    edges.push_back({id, standing});
  }
}

/// @return true if there are any
bool sort_by_target(std::vector<Edge>& edges) {
  std::stable_sort(edges.begin(), edges.end(),
                   [](const Edge& a, const Edge& b) { return a.to < b.to; });
  return !edges.empty();
}

}  // namespace

std::vector<TrimPair> rule_edges(EdgeRule rule, const std::vector<Trim>& trims,
                                 const std::vector<TrimId>& on,
                                 const vehicle::VehicleParameters& vehicle,
                                 const vehicle::VehicleLimits& limits, double step_s) {
  const auto has_edge = [&](std::size_t i, std::size_t j) {
    const Trim& a = trims[on[i].index];
    const Trim& b = trims[on[j].index];
    if (i == j) return true;
    if (rule == EdgeRule::kReachable) return are_in_reach(a, b, vehicle, limits, step_s);
    return i == j + 1 || j == i + 1 || a.is_equilibrium() || b.is_equilibrium();
  };
  std::vector<TrimPair> edges;
  for (std::size_t i = 0; i < on.size(); ++i) {
    for (std::size_t j = 0; j < on.size(); ++j) {
      if (has_edge(i, j)) edges.push_back({on[i], on[j]});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::vector<std::string> labels_of(const SubgraphSpec& spec, const TrimPair& edge) {
  if (edge.from == edge.to) {
    return is_disabled(spec, edge, kSelfLoopLabel) ? std::vector<std::string>{}
                                                   : std::vector<std::string>{kSelfLoopLabel};
  }
  std::vector<std::string> labels;
  for (const std::string& label : declared_labels(spec, edge)) {
    if (!is_disabled(spec, edge, label)) labels.push_back(label);
  }
  return labels;
}

Subgraph::Subgraph(std::shared_ptr<const UniversalAutomaton> automaton, SubgraphSpec spec)
    : automaton_(std::move(automaton)), spec_(std::move(spec)) {
  check_spec();
  switch_trims_on();
  switch_edges_on();
  measure_distances();
  add_exits();
  list_permitted();
}

void Subgraph::fail(const std::string& reason) const {
  throw std::invalid_argument("subgraph '" + spec_.name + "': " + reason);
}

void Subgraph::check_trim(TrimId trim) const {
  if (trim.index < automaton_->trims.size()) return;
  fail(fmt::format("trim {}, must be in 1 ... {}", trim, automaton_->trims.size()));
}

void Subgraph::check_labels(const std::vector<std::string>& labels) const {
  if (labels.empty()) fail("no label");
  for (const std::string& label : labels) {
    if (holds_twice(labels, label)) fail("label '" + label + "' is listed twice");
  }
}

void Subgraph::check_spec() const {
  const auto stands = [this](TrimId trim) {
    return automaton_->trims[trim.index].is_equilibrium();
  };
  for (const TrimId trim : spec_.trims) {
    check_trim(trim);
    if (holds_twice(spec_.trims, trim)) fail(fmt::format("trim {} is listed twice", trim));
  }
  if (std::none_of(spec_.trims.begin(), spec_.trims.end(), stands)) {
    fail("no trim of speed 0 among its trims");
  }
  check_labels(spec_.labels);
  for (const EdgeLabels& one : spec_.edges) {
    check_trim(one.edge.from);
    check_trim(one.edge.to);
    check_labels(one.labels);
    if (one.edge.from == one.edge.to) fail(fmt::format("labels for a self-loop, {}", one.edge));
  }
  for (const DisabledEdges& disabled : spec_.disabled_edges) {
    check_trim(disabled.edge.from);
    check_trim(disabled.edge.to);
    if (disabled.edge.from == disabled.edge.to && stands(disabled.edge.from)) {
      fail(fmt::format("edge {} is disabled, but standing must be possible", disabled.edge));
    }
  }
}

bool Subgraph::is_too_fast(double speed_mps) const {
  return spec_.max_speed_mps && speed_mps > *spec_.max_speed_mps + kRounding_mps;
}

/// Fills trims_, is_enabled_ and standstill_.
void Subgraph::switch_trims_on() {
  const std::vector<Trim>& trims = automaton_->trims;
  is_enabled_.assign(trims.size(), false);
  for (const TrimId trim : spec_.trims) {
    if (is_too_fast(trims[trim.index].speed_mps)) continue;
    is_enabled_[trim.index] = true;
    trims_.push_back(trim);
  }
  standstill_ = *std::find_if(trims_.begin(), trims_.end(),
                              [&trims](TrimId trim) { return trims[trim.index].is_equilibrium(); });
}

/// The labels of an edge between enabled trims; from a trim to itself those of the maneuvers that
/// the speed limit admits, or that of its self-loop.
std::vector<std::string> Subgraph::held_labels(
    const TrimPair& edge, const std::vector<const Maneuver*>& maneuvers) const {
  std::vector<std::string> labels = labels_of(spec_, edge);
  if (edge.from != edge.to || labels.empty()) return labels;
  std::vector<std::string> optimised;
  for (const std::string& label : spec_.labels) {
    const Maneuver* maneuver = find(maneuvers, edge.to, label);
    if (maneuver != nullptr && !is_too_fast(top_speed_mps(*maneuver))) optimised.push_back(label);
  }
  return optimised.empty() ? labels : optimised;
}

/// Fills successors_ of the enabled trims.
void Subgraph::switch_edges_on() {
  const std::vector<TrimPair> pairs =
      rule_edges(spec_.rule, automaton_->trims, spec_.trims, automaton_->vehicle,
                 automaton_->limits, automaton_->step_s);
  for (const EdgeLabels& one : spec_.edges) {
    if (!std::binary_search(pairs.begin(), pairs.end(), one.edge)) {
      fail(fmt::format("labels for edge {}, which is not an edge of its rule", one.edge));
    }
  }
  const ManeuversFrom held = maneuvers_from(*automaton_);
  successors_.resize(automaton_->trims.size());
  for (const TrimPair& pair : pairs) {
    if (!is_enabled(pair.from) || !is_enabled(pair.to)) continue;
    for (const std::string& label : held_labels(pair, held[pair.from.index])) {
      const Maneuver* maneuver = find(held[pair.from.index], pair.to, label);
      if (maneuver == nullptr) {
        fail(fmt::format("the automaton holds no edge {} with label '{}'", pair, label));
      }
      if (is_too_fast(top_speed_mps(*maneuver))) continue;
      successors_[pair.from.index].push_back({pair.to, maneuver});
    }
  }
}

/// The distance by way of the nearest successor, if that is less than the distance of the trim.
/// @return true if it is
bool Subgraph::shorten_distance(TrimId trim) {
  std::size_t& distance = distance_to_standstill_[trim.index];
  const std::size_t before = distance;
  for (const Edge& edge : successors_[trim.index]) {
    const std::size_t via = distance_to_standstill_[edge.to.index];
    if (via != kNever) distance = std::min(distance, via + 1);
  }
  return distance < before;
}

void Subgraph::measure_distances() {
  const std::vector<Trim>& trims = automaton_->trims;
  distance_to_standstill_.assign(trims.size(), kNever);
  for (std::size_t i = 0; i < trims.size(); ++i) {
    if (trims[i].is_equilibrium()) distance_to_standstill_[i] = 0;
  }
  for (bool is_shorter = true; is_shorter;) {
    is_shorter = false;
    for (const TrimId trim : trims_) is_shorter |= shorten_distance(trim);
  }
  for (const TrimId trim : trims_) {
    if (distance_to_standstill_[trim.index] == kNever) {
      fail(fmt::format("no way from trim {} to a trim of speed 0", trim));
    }
  }
}

/// The maneuvers out of a trim into a trim that is nearer to the enabled trims, by the labels and
/// speeds that rule 2 of Subgraph prefers; none if there is no way out.
std::vector<Edge> Subgraph::exits_among(const std::vector<const Maneuver*>& maneuvers,
                                        const std::vector<bool>& is_nearer) const {
  std::vector<Edge> exits;
  for (const ExitChoice& choice : kExitChoices) {
    if (choice.under_speed_limit && !spec_.max_speed_mps) continue;
    for (const Maneuver* maneuver : maneuvers) {
      if (!is_nearer[maneuver->to.index]) continue;
      if (allows(choice, *maneuver, spec_, automaton_->trims)) {
        exits.push_back({maneuver->to, maneuver});
      }
    }
    if (!exits.empty()) break;
  }
  return exits;
}

/// Fills successors_ and distances of the disabled trims, and start_trims_.
void Subgraph::add_exits() {
  const std::vector<Trim>& trims = automaton_->trims;
  const ManeuversFrom held = maneuvers_from(*automaton_);
  // Trims by exit distance: the enabled trims are left at once, then ring after ring.
  std::vector<bool> is_nearer = is_enabled_;
  std::vector<TrimId> ring;
  do {
    ring.clear();
    for (std::size_t i = 0; i < trims.size(); ++i) {
      if (is_nearer[i]) continue;
      successors_[i] = exits_among(held[i], is_nearer);
      if (!successors_[i].empty()) ring.push_back({i});
    }
    for (const TrimId trim : ring) {
      is_nearer[trim.index] = true;
      shorten_distance(trim);
    }
  } while (!ring.empty());

  for (std::size_t i = 0; i < trims.size(); ++i) {
    add_standing_if_disabled(is_enabled_[i], trims[i], {i}, held[i], successors_[i]);
    if (sort_by_target(successors_[i])) start_trims_.push_back({i});
  }
}

void Subgraph::list_permitted() {
  std::size_t farthest = 0;
  for (const TrimId trim : start_trims_) {
    farthest = std::max(farthest, distance_to_standstill_[trim.index]);
  }
  // With one step more than the farthest trim's distance, every edge is permitted.
  permitted_.assign(farthest + 1, std::vector<std::vector<Edge>>(successors_.size()));
  for (std::size_t steps_left = 1; steps_left <= farthest; ++steps_left) {
    for (const TrimId trim : start_trims_) {
      for (const Edge& edge : successors_[trim.index]) {
        if (distance_to_standstill_[edge.to.index] + 1 <= steps_left) {
          permitted_[steps_left][trim.index].push_back(edge);
        }
      }
    }
  }
}

bool Subgraph::is_enabled(TrimId trim) const { return is_enabled_.at(trim.index); }

std::span<const Edge> Subgraph::successors(TrimId trim) const { return successors_.at(trim.index); }

std::span<const Edge> Subgraph::successors(TrimId trim, std::size_t steps_left) const {
  return steps_left < permitted_.size() ? permitted_[steps_left].at(trim.index) : successors(trim);
}

std::size_t Subgraph::distance_to_standstill(TrimId trim) const {
  return distance_to_standstill_.at(trim.index);
}

void check_driving(const Subgraph& subgraph, std::size_t horizon_steps) {
  const auto fail = [&subgraph](TrimId trim, const std::string& what) {
    throw std::invalid_argument(
        fmt::format("subgraph '{}': trim {}{}", subgraph.spec().name, trim, what));
  };
  std::vector<bool> is_reached(subgraph.automaton().trims.size());
  std::vector<TrimId> to_visit{subgraph.standstill()};
  is_reached[subgraph.standstill().index] = true;
  while (!to_visit.empty()) {
    const TrimId trim = to_visit.back();
    to_visit.pop_back();
    for (const Edge& edge : subgraph.successors(trim)) {
      if (is_reached[edge.to.index]) continue;
      is_reached[edge.to.index] = true;
      to_visit.push_back(edge.to);
    }
  }
  for (const TrimId trim : subgraph.trims()) {
    if (!is_reached[trim.index]) fail(trim, " cannot be reached from standstill");
    const std::size_t steps = subgraph.distance_to_standstill(trim);
    if (steps > horizon_steps) {
      fail(trim, fmt::format(" needs {} steps to standstill, must be <= the horizon of {}", steps,
                             horizon_steps));
    }
  }
}

}  // namespace hlc::automaton
