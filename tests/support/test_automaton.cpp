#include "tests/support/test_automaton.hpp"

#include <utility>

namespace hlc::test {
namespace {

constexpr std::size_t kIntervals = 10;

automaton::Maneuver make_maneuver(const automaton::UniversalAutomaton& automaton, TrimId from,
                                  TrimId to, const LabelledSurge& label) {
  const double surge_mps2 = label.surge_mps2;
  const automaton::Trim& begin = automaton.trims[from.index];
  const automaton::Trim& end = automaton.trims[to.index];
  const double interval_s = automaton.step_s / kIntervals;
  const bool self_loop = from == to;

  automaton::Maneuver maneuver;
  maneuver.from = from;
  maneuver.to = to;
  maneuver.label = self_loop ? automaton::kSelfLoopLabel : label.label;
  maneuver.duration_s = automaton.step_s;
  vehicle::State state{{}, begin.speed_mps, begin.steering_rad};
  maneuver.states.push_back(state);
  for (std::size_t i = 0; i < kIntervals; ++i) {
    vehicle::Input input{(end.speed_mps - begin.speed_mps) / automaton.step_s,
                         (end.steering_rad - begin.steering_rad) / automaton.step_s};
    if (!self_loop) {
      input.acceleration_mps2 += i < kIntervals / 2 ? surge_mps2 : -surge_mps2;
    }
    state = vehicle::integrated(state, input, interval_s, automaton.vehicle);
    maneuver.inputs.push_back(input);
    maneuver.states.push_back(state);
  }
  maneuver.displacement = state.pose;

  std::vector<Point> swept_m;
  std::vector<Point> lane_m;
  for (const vehicle::State& sample : maneuver.states) {
    const auto grown =
        footprint_area(automaton.vehicle.footprint, sample.pose, automaton.vehicle.safety_margin_m);
    const auto bare = footprint_area(automaton.vehicle.footprint, sample.pose);
    swept_m.insert(swept_m.end(), grown.vertices_m.begin(), grown.vertices_m.end());
    lane_m.insert(lane_m.end(), bare.vertices_m.begin(), bare.vertices_m.end());
  }
  maneuver.swept_area_m = convex_hull(std::move(swept_m));
  maneuver.lane_area_m = convex_hull(std::move(lane_m));
  return maneuver;
}

}  // namespace

std::vector<automaton::Trim> paper_trims() {
  return {{0.0, 0.0}, {0.4, -0.60}, {0.5, -0.48}, {0.6, -0.36}, {0.7, -0.24}, {0.8, -0.12},
          {0.8, 0.0}, {0.8, 0.12},  {0.7, 0.24},  {0.6, 0.36},  {0.5, 0.48},  {0.4, 0.60}};
}

std::shared_ptr<automaton::UniversalAutomaton> make_test_automaton(
    const std::vector<automaton::Trim>& trims, const std::vector<LabelledSurge>& labels) {
  auto automaton = std::make_shared<automaton::UniversalAutomaton>();
  automaton->trims = trims;
  for (std::size_t from = 0; from < trims.size(); ++from) {
    for (std::size_t to = 0; to < trims.size(); ++to) {
      for (const LabelledSurge& label : labels) {
        automaton->maneuvers.push_back(make_maneuver(*automaton, {from}, {to}, label));
        if (from == to) break;
      }
    }
  }
  return automaton;
}

std::shared_ptr<const automaton::UniversalAutomaton> make_test_automaton(double surge_mps2) {
  return make_test_automaton(paper_trims(), {{kTestLabel, surge_mps2}});
}

automaton::Subgraph make_test_subgraph(
    std::shared_ptr<const automaton::UniversalAutomaton> automaton,
    const std::vector<std::size_t>& trims) {
  automaton::SubgraphSpec spec{.name = "test", .labels = {kTestLabel}, .trims = {}};
  for (const std::size_t number : trims) {
    spec.trims.push_back({number - 1});
  }
  return {std::move(automaton), std::move(spec)};
}

automaton::Subgraph make_test_subgraph(const std::vector<LabelledSurge>& labels,
                                       const std::vector<std::size_t>& trims,
                                       std::optional<double> max_speed_mps) {
  automaton::SubgraphSpec spec{
      .name = "test", .labels = {}, .trims = {}, .max_speed_mps = max_speed_mps};
  for (const LabelledSurge& label : labels) spec.labels.push_back(label.label);
  for (const std::size_t number : trims) spec.trims.push_back({number - 1});
  return {make_test_automaton(paper_trims(), labels), std::move(spec)};
}

automaton::Subgraph make_test_subgraph(double surge_mps2) {
  return make_test_subgraph(make_test_automaton(surge_mps2), kAllTrims);
}

}  // namespace hlc::test
