#include "planner/automaton/subgraph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::automaton {
namespace {

SubgraphSpec spec(const std::string& name) {
  for (const SubgraphSpec& candidate : paper_configuration().subgraphs) {
    if (candidate.name == name) {
      return candidate;
    }
  }
  throw std::logic_error("no subgraph " + name);
}

struct EdgeCount {
  std::size_t all{};
  std::size_t maneuvers{};
};

EdgeCount count_edges(const Subgraph& subgraph) {
  EdgeCount count;
  for (const TrimId trim : subgraph.spec().trims) {
    for (const Edge& edge : subgraph.successors(trim)) {
      ++count.all;
      count.maneuvers += edge.to == trim ? 0U : 1U;
    }
  }
  return count;
}

std::string refusal(const SubgraphSpec& wrong,
                    std::shared_ptr<const UniversalAutomaton> automaton = paper_automaton()) {
  try {
    const Subgraph subgraph(std::move(automaton), wrong);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Subgraph, BHas54EdgesOf12TrimsAnd42OfThemAreManeuvers) {
  const EdgeCount count = count_edges(Subgraph(paper_automaton(), spec("B")));
  EXPECT_EQ(count.all, 54U);
  EXPECT_EQ(count.maneuvers, 42U);
}

TEST(Subgraph, DConnectsNeighboursOfTheReducedSet) {
  const Subgraph subgraph(paper_automaton(), spec("D"));
  EXPECT_EQ(count_edges(subgraph).maneuvers, 26U);
  std::vector<TrimId> reached;
  for (const Edge& edge : subgraph.successors(pi(4))) {
    reached.push_back(edge.to);
  }
  EXPECT_EQ(reached, (std::vector<TrimId>{pi(1), pi(2), pi(4), pi(6)}));
  EXPECT_FALSE(subgraph.is_enabled(pi(3)));
}

TEST(Subgraph, EdgesLeadToTheirManeuversSortedByTarget) {
  const Subgraph subgraph(paper_automaton(), spec("B"));
  for (const TrimId trim : subgraph.spec().trims) {
    const auto edges = subgraph.successors(trim);
    EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end(),
                               [](const Edge& a, const Edge& b) { return a.to < b.to; }));
    for (const Edge& edge : edges) {
      EXPECT_EQ(edge.maneuver->from, trim);
      EXPECT_EQ(edge.maneuver->to, edge.to);
      EXPECT_EQ(edge.maneuver->label, edge.to == trim ? kSelfLoopLabel : "J2");
    }
  }
}

TEST(Subgraph, EveryMovingTrimIsOneStepFromStandstill) {
  const Subgraph subgraph(paper_automaton(), spec("B"));
  EXPECT_EQ(subgraph.standstill(), pi(1));
  EXPECT_EQ(subgraph.distance_to_standstill(pi(1)), 0U);
  for (std::size_t number = 2; number <= 12; ++number) {
    EXPECT_EQ(subgraph.distance_to_standstill(pi(number)), 1U);
  }
}

TEST(Subgraph, RefusesAnEdgeThatTheAutomatonDoesNotHold) {
  SubgraphSpec wrong = spec("B");
  wrong.trims = {pi(1), pi(3), pi(5)};
  EXPECT_EQ(refusal(wrong), "subgraph 'B': the automaton holds no edge 3 -> 5 with label 'J2'");
  wrong.labels = {"J9"};
  EXPECT_EQ(refusal(wrong), "subgraph 'B': the automaton holds no edge 1 -> 3 with label 'J9'");
}

TEST(Subgraph, RefusesTrimsThatAreUnknownOrListedTwiceOrNeverStand) {
  SubgraphSpec wrong = spec("B");
  wrong.trims = {pi(1), pi(13)};
  EXPECT_EQ(refusal(wrong), "subgraph 'B': trim 13, must be in 1 ... 12");
  wrong.trims = {pi(1), pi(7), pi(1)};
  EXPECT_EQ(refusal(wrong), "subgraph 'B': trim 1 is listed twice");
  wrong.trims = {pi(6), pi(7)};
  EXPECT_EQ(refusal(wrong), "subgraph 'B': no trim of speed 0 among its trims");
}

TEST(Subgraph, RefusesLabelsAndEdgesThatMakeNoSense) {
  SubgraphSpec wrong = spec("B");
  wrong.labels = {};
  EXPECT_EQ(refusal(wrong), "subgraph 'B': no label");
  wrong.labels = {"J2", "J2"};
  EXPECT_EQ(refusal(wrong), "subgraph 'B': label 'J2' is listed twice");
  wrong = spec("B");
  wrong.disabled_edges = {{{pi(1), pi(1)}, std::nullopt}};
  EXPECT_EQ(refusal(wrong), "subgraph 'B': edge 1 -> 1 is disabled, but standing must be possible");
  wrong.disabled_edges = {{{pi(7), pi(1)}, std::nullopt},
                          {{pi(7), pi(6)}, std::nullopt},
                          {{pi(7), pi(8)}, std::nullopt}};
  EXPECT_EQ(refusal(wrong), "subgraph 'B': no way from trim 7 to a trim of speed 0");
  wrong = spec("B");
  wrong.edges = {{{pi(3), pi(5)}, {"J2"}}};
  EXPECT_EQ(refusal(wrong),
            "subgraph 'B': labels for edge 3 -> 5, which is not an edge of its rule");
}

TEST(Subgraph, RuleReachableConnectsWhatTheLimitsAllowInOneStep) {
  const std::vector<Trim> trims{{0.0, 0.0}, {1.0, 0.0}, {2.4, 0.0}, {2.5, 0.0}, {1.0, 0.62}};
  const std::vector<TrimId> on{{0}, {1}, {2}, {3}, {4}};
  vehicle::VehicleLimits limits;  // 12 m/s^2 and 6.2 rad/s: 2.4 m/s and 1.24 rad within 0.2 s
  const auto edges = rule_edges(EdgeRule::kReachable, trims, on, {}, limits, 0.2);
  for (const TrimId from : on) {
    for (const TrimId to : on) {
      const double change = std::abs(trims[from.index].speed_mps - trims[to.index].speed_mps);
      EXPECT_EQ(std::binary_search(edges.begin(), edges.end(), TrimPair{from, to}), change < 2.45);
    }
  }
  limits.steering_rate_radps = 3.0;  // 0.6 rad
  const auto slower = rule_edges(EdgeRule::kReachable, trims, on, {}, limits, 0.2);
  EXPECT_FALSE(std::binary_search(slower.begin(), slower.end(), TrimPair{{1}, {4}}));
  EXPECT_TRUE(std::binary_search(slower.begin(), slower.end(), TrimPair{{4}, {4}}));
}

TEST(Subgraph, RuleReachableKeepsWithinTheFrictionCircle) {
  // 2 m/s at 0.3 rad: 2.04 1/m * 4 m^2/s^2 = 8.1 m/s^2 across; 1 m/s more in 0.2 s: 5 m/s^2 along.
  const std::vector<Trim> trims{{1.0, 0.3}, {2.0, 0.3}, {1.0, 0.0}, {2.0, 0.0}};
  const std::vector<TrimId> on{{0}, {1}, {2}, {3}};
  vehicle::VehicleLimits limits;
  limits.friction_mps2 = 9.0;  // sqrt(8.1^2 + 5^2) = 9.6
  const auto edges = rule_edges(EdgeRule::kReachable, trims, on, {}, limits, 0.2);
  const auto has = [&edges](std::size_t from, std::size_t to) {
    return std::binary_search(edges.begin(), edges.end(), TrimPair{{from}, {to}});
  };
  EXPECT_FALSE(has(0, 1));
  EXPECT_FALSE(has(1, 0));
  EXPECT_FALSE(has(2, 1));
  EXPECT_TRUE(has(2, 3));
  EXPECT_TRUE(has(1, 3));
  EXPECT_TRUE(has(1, 1));
}

TEST(Subgraph, CheckDrivingRefusesTrimsThatStandstillIsTooFarFromOrThatNothingLeadsTo) {
  const auto automaton = paper_automaton();
  SubgraphSpec spec{"B", {"J2"}, {}};
  for (std::size_t i = 0; i < 12; ++i) spec.trims.push_back({i});
  EXPECT_NO_THROW(check_driving(Subgraph(automaton, spec), 1));
  spec.disabled_edges = {{{pi(7), pi(1)}, {}}};  // two steps now
  EXPECT_NO_THROW(check_driving(Subgraph(automaton, spec), 2));
  EXPECT_THROW(check_driving(Subgraph(automaton, spec), 1), std::invalid_argument);
  spec.disabled_edges = {{{pi(1), pi(7)}, {}}, {{pi(6), pi(7)}, {}}, {{pi(8), pi(7)}, {}}};
  EXPECT_THROW(check_driving(Subgraph(automaton, spec), 8), std::invalid_argument);
}

/// Maneuvers of label "fast" outrun their trims by about 0.8 m/s.
std::shared_ptr<const UniversalAutomaton> two_labels() {
  static const auto automaton =
      test::make_test_automaton(test::paper_trims(), {{"slow", 0.0}, {"fast", 8.0}});
  return automaton;
}

SubgraphSpec all_trims(std::vector<std::string> labels) {
  SubgraphSpec result{.name = "S", .labels = std::move(labels), .trims = {}};
  for (std::size_t number = 1; number <= 12; ++number) result.trims.push_back(pi(number));
  return result;
}

std::vector<std::string> labels_between(const Subgraph& subgraph, std::size_t from,
                                        std::size_t to) {
  std::vector<std::string> labels;
  for (const Edge& edge : subgraph.successors(pi(from))) {
    if (edge.to == pi(to)) labels.push_back(edge.maneuver->label);
  }
  return labels;
}

using Labels = std::vector<std::string>;

TEST(Subgraph, BetweenTwoTrimsThereIsOneEdgePerLabelInTheirOrder) {
  const Subgraph subgraph(two_labels(), all_trims({"fast", "slow"}));
  EXPECT_EQ(count_edges(subgraph).maneuvers, 84U);
  EXPECT_EQ(labels_between(subgraph, 7, 8), (Labels{"fast", "slow"}));
  EXPECT_EQ(labels_between(subgraph, 7, 7), Labels{kSelfLoopLabel});
}

TEST(Subgraph, SingleEdgesHaveOtherLabelsOrAreOff) {
  SubgraphSpec spec = all_trims({"slow", "fast"});
  spec.edges = {{{pi(7), pi(8)}, {"fast"}}};
  spec.disabled_edges = {
      {{pi(6), pi(7)}, std::nullopt}, {{pi(7), pi(6)}, "slow"}, {{pi(9), pi(9)}, {}}};
  const Subgraph subgraph(two_labels(), spec);
  EXPECT_EQ(labels_between(subgraph, 7, 8), Labels{"fast"});
  EXPECT_EQ(labels_between(subgraph, 8, 7), (Labels{"slow", "fast"}));
  EXPECT_EQ(labels_between(subgraph, 6, 7), Labels{});
  EXPECT_EQ(labels_between(subgraph, 7, 6), Labels{"fast"});
  EXPECT_EQ(labels_between(subgraph, 9, 9), Labels{});
}

TEST(Subgraph, TheAutomatonNeedNotHoldAnEdgeThatIsOff) {
  SubgraphSpec spec = paper_configuration().subgraphs.front();
  spec.trims = {pi(1), pi(3), pi(5)};
  spec.disabled_edges = {{{pi(3), pi(5)}, std::nullopt}, {{pi(5), pi(3)}, std::nullopt}};
  EXPECT_EQ(refusal(spec), "accepted");
}

TEST(Subgraph, TheSpeedLimitHoldsAlongManeuvers) {
  SubgraphSpec spec = all_trims({"slow", "fast"});
  spec.max_speed_mps = 0.75;
  const Subgraph subgraph(two_labels(), spec);
  std::size_t fast = 0;
  for (const TrimId trim : subgraph.trims()) {
    EXPECT_LE(two_labels()->trims[trim.index].speed_mps, 0.75);
    for (const Edge& edge : subgraph.successors(trim)) {
      for (const vehicle::State& state : edge.maneuver->states) EXPECT_LE(state.speed_mps, 0.75);
      fast += edge.maneuver->label == "fast" ? 1U : 0U;
    }
  }
  EXPECT_EQ(subgraph.trims().size(), 9U);  // without 6, 7, 8
  EXPECT_FALSE(subgraph.is_enabled(pi(7)));
  EXPECT_EQ(labels_between(subgraph, 5, 1), Labels{"slow"});
  EXPECT_EQ(fast, 0U);  // those from or to standstill reach 0.2 + 0.8 m/s, the others more
  EXPECT_EQ(labels_between(subgraph, 4, 5), Labels{"slow"});
}

TEST(Subgraph, ALimitThatLeavesATrimNoWayToStandstillIsRefused) {
  SubgraphSpec spec = all_trims({"fast"});
  spec.max_speed_mps = 0.9;
  EXPECT_EQ(refusal(spec, two_labels()), "subgraph 'S': no way from trim 2 to a trim of speed 0");
}

TEST(Subgraph, PermittedSuccessorsCanStandInTheStepsThatAreLeft) {
  const Subgraph subgraph(paper_automaton(), spec("B"));
  EXPECT_TRUE(subgraph.successors(pi(7), 0).empty());
  ASSERT_EQ(subgraph.successors(pi(7), 1).size(), 1U);
  EXPECT_EQ(subgraph.successors(pi(7), 1).front().to, pi(1));
  EXPECT_EQ(subgraph.successors(pi(7), 2).size(), 4U);
  EXPECT_EQ(subgraph.successors(pi(7), 99).size(), 4U);
}

TEST(Subgraph, ATrimThatIsOffHasItsExitEdgesToTheTrimsThatAreOn) {
  const Subgraph subgraph(paper_automaton(), spec("D"));
  std::vector<TrimId> reached;
  for (const Edge& edge : subgraph.successors(pi(3))) {
    EXPECT_EQ(edge.maneuver->from, pi(3));
    reached.push_back(edge.to);
  }
  EXPECT_EQ(reached, (std::vector<TrimId>{pi(1), pi(2), pi(4)}));
  EXPECT_EQ(subgraph.distance_to_standstill(pi(3)), 1U);
  EXPECT_EQ(subgraph.start_trims().size(), 12U);
  EXPECT_EQ(subgraph.trims().size(), 8U);
}

TEST(Subgraph, ExitEdgesTakeTheSubgraphsLabelsFirstAndAnyLabelIfThereAreNone) {
  SubgraphSpec slow = all_trims({"slow"});
  slow.trims = {pi(1), pi(2)};
  const Subgraph all_held(two_labels(), slow);
  EXPECT_EQ(labels_between(all_held, 7, 1), Labels{"slow"});
  slow.disabled_edges = {
      {{pi(7), pi(1)}, "slow"}, {{pi(7), pi(2)}, "slow"}, {{pi(7), pi(2)}, "fast"}};
  const Subgraph some_off(two_labels(), slow);
  EXPECT_EQ(labels_between(some_off, 7, 1), Labels{"fast"});
  EXPECT_EQ(labels_between(some_off, 7, 2), Labels{});
}

// Fast maneuvers outrun both their trims.
TEST(Subgraph, WhoIsTooFastDoesNotSpeedUpToSlowDown) {
  const Subgraph limited =
      test::make_test_subgraph({test::kFast, test::kSlow}, test::kAllTrims, 0.6);
  const auto& trims = limited.automaton().trims;
  std::size_t exits = 0;
  for (const TrimId trim : limited.start_trims()) {
    if (limited.is_enabled(trim)) continue;
    for (const Edge& edge : limited.successors(trim)) {
      ++exits;
      EXPECT_EQ(edge.maneuver->label, test::kSlow.label);
      EXPECT_LE(top_speed_mps(*edge.maneuver), trims[trim.index].speed_mps + 1e-6);
    }
  }
  EXPECT_GT(exits, 10U);
}

TEST(Subgraph, ATrimThatIsOffMayBeSeveralExitsAway) {
  // Speeds 0, 1, 2, 3, 4 m/s; only neighbours are connected; a limit of 1 m/s.
  std::vector<Trim> trims;
  for (int i = 0; i <= 4; ++i) trims.push_back({1.0 * i, 0.0});
  const auto automaton = test::make_test_automaton(trims, {{"L", 0.0}});
  std::erase_if(automaton->maneuvers, [](const Maneuver& m) {
    return m.from.index + 1 < m.to.index || m.to.index + 1 < m.from.index;
  });
  SubgraphSpec spec{.name = "slow", .labels = {"L"}, .trims = {pi(1), pi(2)}};
  spec.max_speed_mps = 1.0;
  const Subgraph subgraph(automaton, spec);
  for (std::size_t number = 3; number <= 5; ++number) {
    ASSERT_EQ(subgraph.successors(pi(number)).size(), 1U);
    EXPECT_EQ(subgraph.successors(pi(number)).front().to, pi(number - 1));
    EXPECT_EQ(subgraph.distance_to_standstill(pi(number)), number - 1);
  }
  EXPECT_TRUE(subgraph.successors(pi(5), 3).empty());
  EXPECT_EQ(subgraph.successors(pi(5), 4).size(), 1U);
}

TEST(Subgraph, ATrimThatIsOffWithoutAWayOutIsNoStart) {
  SubgraphSpec spec = all_trims({"slow"});
  spec.trims = {pi(1)};
  spec.disabled_edges = {{{pi(7), pi(1)}, std::nullopt}};
  for (std::size_t number = 2; number <= 12; ++number) {
    spec.disabled_edges.push_back({{pi(7), pi(number)}, std::nullopt});
  }
  const Subgraph subgraph(two_labels(), spec);
  EXPECT_TRUE(subgraph.successors(pi(7)).empty());
  EXPECT_EQ(subgraph.distance_to_standstill(pi(7)), Subgraph::kNever);
  EXPECT_EQ(subgraph.start_trims().size(), 11U);
}

TEST(Subgraph, KeepsTheAutomatonAlive) {
  auto automaton = maneuver_design::build_shared_automaton(paper_configuration());
  const std::weak_ptr<const UniversalAutomaton> watch = automaton;
  const Subgraph subgraph(std::move(automaton), spec("B"));
  ASSERT_FALSE(watch.expired());
  EXPECT_EQ(subgraph.successors(pi(1)).front().maneuver->label, kSelfLoopLabel);
}

}  // namespace
}  // namespace hlc::automaton
