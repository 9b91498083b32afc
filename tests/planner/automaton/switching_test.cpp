// Whatever subgraphs follow each other, there is always a plan that ends in standstill
// (subgraph.hpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <stdexcept>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::automaton {
namespace {

constexpr std::size_t kHorizonSteps = 8;
constexpr std::size_t kMaxDistance = 1000;

using Random = std::mt19937_64;

bool toss(Random& random, double probability) {
  return std::bernoulli_distribution(probability)(random);
}

std::size_t pick(Random& random, std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

/// Eighteen trims, three of them equilibria, of which maneuvers are missing at random.
std::shared_ptr<const UniversalAutomaton> random_automaton(Random& random) {
  static const auto full = [] {
    std::vector<Trim> trims = test::paper_trims();
    trims.insert(trims.end(),
                 {{0.0, 0.4}, {0.0, -0.4}, {1.2, 0.0}, {1.6, 0.0}, {2.0, 0.0}, {2.4, 0.0}});
    return test::make_test_automaton(trims, {{"slow", 0.0}, {"mid", 2.0}, {"fast", 8.0}});
  }();
  auto automaton = std::make_shared<UniversalAutomaton>(*full);
  const double held = std::uniform_real_distribution<double>(0.05, 0.6)(random);
  std::erase_if(automaton->maneuvers,
                [&](const Maneuver& m) { return m.from != m.to && !toss(random, held); });
  return automaton;
}

/// A spec that may or may not make sense: what is not held is disabled.
SubgraphSpec random_spec(const UniversalAutomaton& automaton, Random& random) {
  SubgraphSpec spec{.name = "random", .labels = {}, .trims = {}};
  std::vector<std::string> labels{"slow", "mid", "fast"};
  std::ranges::shuffle(labels, random);
  labels.resize(1 + pick(random, 3));
  spec.labels = labels;
  const double on = std::uniform_real_distribution<double>(0.1, 1.0)(random);
  for (std::size_t i = 0; i < automaton.trims.size(); ++i) {
    if (toss(random, on)) spec.trims.push_back({i});
  }
  std::ranges::shuffle(spec.trims, random);
  spec.rule = toss(random, 0.5) ? EdgeRule::kChain : EdgeRule::kReachable;
  if (toss(random, 0.3)) {
    spec.max_speed_mps = std::uniform_real_distribution<double>(0.3, 3.0)(random);
  }
  for (std::size_t from = 0; from < automaton.trims.size(); ++from) {
    for (std::size_t to = 0; to < automaton.trims.size(); ++to) {
      const bool is_own = from == to;
      for (const std::string& label : is_own ? std::vector<std::string>{kSelfLoopLabel} : labels) {
        const bool is_held = automaton.find({from}, {to}, label) != nullptr;
        const bool may_go = !is_own || !automaton.trims[from].is_equilibrium();
        if (!is_held || (may_go && toss(random, 0.05))) {
          spec.disabled_edges.push_back({{{from}, {to}}, label});
        }
      }
    }
  }
  if (toss(random, 0.3)) {  // no way out of one trim
    const TrimId shut{pick(random, automaton.trims.size())};
    std::erase(spec.trims, shut);
    for (std::size_t to = 0; to < automaton.trims.size(); ++to) {
      if (to != shut.index) spec.disabled_edges.push_back({{shut, {to}}, std::nullopt});
    }
  }
  return spec;
}

std::vector<std::unique_ptr<const Subgraph>> random_subgraphs(
    const std::shared_ptr<const UniversalAutomaton>& automaton, std::size_t count, Random& random) {
  std::vector<std::unique_ptr<const Subgraph>> subgraphs;
  for (int tries = 0; subgraphs.size() < count && tries < 100000; ++tries) {
    try {
      subgraphs.push_back(std::make_unique<Subgraph>(automaton, random_spec(*automaton, random)));
    } catch (const std::invalid_argument&) {
      continue;  // no way to standstill, no equilibrium, ...
    }
  }
  return subgraphs;
}

bool is_disabled(const SubgraphSpec& spec, const Maneuver& m) {
  return std::ranges::any_of(spec.disabled_edges, [&](const DisabledEdges& disabled) {
    return disabled.edge == TrimPair{m.from, m.to} &&
           (!disabled.label || *disabled.label == m.label);
  });
}

/// Fewest held edges to an enabled trim, found by relaxation over all maneuvers.
std::vector<std::size_t> exit_distances(const Subgraph& subgraph) {
  const UniversalAutomaton& automaton = subgraph.automaton();
  std::vector<std::size_t> distance(automaton.trims.size(), kMaxDistance);
  for (const TrimId trim : subgraph.trims()) distance[trim.index] = 0;
  for (std::size_t sweep = 0; sweep < automaton.trims.size(); ++sweep) {
    for (const Maneuver& m : automaton.maneuvers) {
      if (is_disabled(subgraph.spec(), m)) continue;
      distance[m.from.index] = std::min(distance[m.from.index], distance[m.to.index] + 1);
    }
  }
  return distance;
}

/// The properties of a single subgraph by subgraph.hpp.
void check_edges(const Subgraph& subgraph) {
  const UniversalAutomaton& automaton = subgraph.automaton();
  const std::vector<std::size_t> exit_distance = exit_distances(subgraph);
  for (std::size_t i = 0; i < automaton.trims.size(); ++i) {
    const TrimId trim{i};
    const bool is_equilibrium = automaton.trims[i].is_equilibrium();
    const auto edges = subgraph.successors(trim);
    const bool is_start =
        std::ranges::find(subgraph.start_trims(), trim) != subgraph.start_trims().end();
    ASSERT_EQ(is_start, !edges.empty());
    ASSERT_EQ(is_start, is_equilibrium || exit_distance[i] < kMaxDistance);
    bool can_stand = false;
    std::size_t nearest = kMaxDistance;
    for (const Edge& edge : edges) {
      ASSERT_EQ(edge.maneuver->from, trim);
      ASSERT_EQ(edge.maneuver->to, edge.to);
      ASSERT_FALSE(is_disabled(subgraph.spec(), *edge.maneuver));
      can_stand = can_stand || edge.to == trim;
      nearest = std::min(nearest, subgraph.distance_to_standstill(edge.to));
      if (subgraph.is_enabled(trim)) {
        ASSERT_TRUE(subgraph.is_enabled(edge.to));
        if (subgraph.spec().max_speed_mps) {
          ASSERT_LE(top_speed_mps(*edge.maneuver), *subgraph.spec().max_speed_mps);
        }
      } else if (edge.to != trim) {
        ASSERT_EQ(exit_distance[edge.to.index] + 1, exit_distance[i]);
      }
    }
    if (is_equilibrium) {
      ASSERT_TRUE(can_stand);
      ASSERT_EQ(subgraph.distance_to_standstill(trim), 0U);
    } else if (is_start) {
      ASSERT_EQ(subgraph.distance_to_standstill(trim), nearest + 1);
    }
  }
}

/// A vehicle's plan: what is left to drive, then standing.
struct Drive {
  std::vector<const Maneuver*> left;
  TrimId end;

  [[nodiscard]] TrimId trim() const { return left.empty() ? end : left.front()->from; }
};

/// A random plan of the horizon's length that the subgraph permits.
Drive random_plan(const Subgraph& subgraph, TrimId start, Random& random) {
  Drive plan{{}, start};
  for (std::size_t steps_left = kHorizonSteps; steps_left > 0; --steps_left) {
    const auto edges = subgraph.successors(plan.end, steps_left);
    if (edges.empty()) throw std::logic_error("a permitted path came to a dead end");
    plan.left.push_back(edges[pick(random, edges.size())].maneuver);
    plan.end = plan.left.back()->to;
  }
  return plan;
}

bool is_permitted(const Subgraph& subgraph, const Maneuver* maneuver, std::size_t steps_left) {
  const auto edges = subgraph.successors(maneuver->from, steps_left);
  return std::ranges::any_of(edges, [&](const Edge& edge) { return edge.maneuver == maneuver; });
}

/// A plan one step later, and standing for the step that is left: again a plan of this subgraph.
void check_rest_is_a_plan(const Subgraph& subgraph, const Drive& plan) {
  std::size_t steps_left = kHorizonSteps;
  for (std::size_t j = 1; j < plan.left.size(); ++j) {
    ASSERT_TRUE(is_permitted(subgraph, plan.left[j], steps_left));
    --steps_left;
  }
  const Maneuver* stand = subgraph.automaton().find(plan.end, plan.end, kSelfLoopLabel);
  ASSERT_TRUE(is_permitted(subgraph, stand, steps_left));
}

void check_drive(const UniversalAutomaton& automaton, const Drive& drive) {
  ASSERT_LE(drive.left.size(), kHorizonSteps);
  TrimId trim = drive.trim();
  for (const Maneuver* maneuver : drive.left) {
    ASSERT_GE(maneuver, automaton.maneuvers.data());
    ASSERT_LT(maneuver, automaton.maneuvers.data() + automaton.maneuvers.size());
    ASSERT_EQ(maneuver->from, trim);
    trim = maneuver->to;
  }
  ASSERT_EQ(trim, drive.end);
  ASSERT_TRUE(automaton.trims[drive.end.index].is_equilibrium());
}

TEST(Switching, AfterManyRandomSwitchesThereIsAlwaysAPlanThatEndsInStandstill) {
  const std::uint64_t automata = test::num_costly_seeds(50);
  constexpr int kSwitches = 2000;
  std::uint64_t from_disabled = 0;
  std::uint64_t from_far_disabled = 0;
  std::uint64_t from_disabled_equilibrium = 0;
  std::uint64_t without_way_out = 0;
  std::uint64_t cut_off_plans = 0;
  for (unsigned seed = 0; seed < automata; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const auto automaton = random_automaton(random);
    const auto subgraphs = random_subgraphs(automaton, 40, random);
    ASSERT_GE(subgraphs.size(), 10U);
    for (const auto& subgraph : subgraphs) ASSERT_NO_FATAL_FAILURE(check_edges(*subgraph));

    Drive drive{{}, subgraphs.front()->standstill()};
    std::size_t fallbacks = 0;
    for (int k = 0; k < kSwitches; ++k) {
      const Subgraph& subgraph = *subgraphs[pick(random, subgraphs.size())];
      if (!drive.left.empty()) drive.left.erase(drive.left.begin());
      const TrimId start = drive.trim();
      const bool is_disabled = !subgraph.is_enabled(start);
      const bool stands = automaton->trims[start.index].is_equilibrium();
      const std::size_t distance = subgraph.distance_to_standstill(start);
      from_disabled_equilibrium += is_disabled && stands ? 1U : 0U;
      without_way_out += distance == Subgraph::kNever ? 1U : 0U;
      // Whatever is in the way, a search may find nothing.
      const bool finds = distance <= kHorizonSteps && toss(random, 0.6);
      if (finds) {
        from_disabled += is_disabled && !stands ? 1U : 0U;
        from_far_disabled += is_disabled && distance >= 3 ? 1U : 0U;
        drive = random_plan(subgraph, start, random);
        fallbacks = 0;
        ASSERT_NO_FATAL_FAILURE(check_rest_is_a_plan(subgraph, drive));
      } else {
        ++fallbacks;
        cut_off_plans +=
            !drive.left.empty() && !is_permitted(subgraph, drive.left.front(), kHorizonSteps) ? 1U
                                                                                              : 0U;
      }
      ASSERT_NO_FATAL_FAILURE(check_drive(*automaton, drive));
      ASSERT_TRUE(fallbacks < kHorizonSteps || automaton->trims[start.index].is_equilibrium());
    }
  }
  // The switches must be hard enough to be informative.
  EXPECT_GT(from_disabled, 20 * automata);
  EXPECT_GT(from_far_disabled, automata);
  EXPECT_GT(from_disabled_equilibrium, 20 * automata);
  EXPECT_GT(without_way_out, 2 * automata / 5);
  EXPECT_GT(cut_off_plans, 20 * automata);
}

}  // namespace
}  // namespace hlc::automaton
