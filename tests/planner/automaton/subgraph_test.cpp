#include "planner/automaton/subgraph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc {
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
  EXPECT_FALSE(subgraph.is_on(pi(3)));
  EXPECT_TRUE(subgraph.successors(pi(3)).empty());
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
      EXPECT_EQ(edge.maneuver->label, edge.to == trim ? kOwnStepLabel : "J2");
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
  wrong.label = "J9";
  EXPECT_EQ(refusal(wrong), "subgraph 'B': the automaton holds no edge 1 -> 3 with label 'J9'");
}

TEST(Subgraph, RefusesTrimsThatAreUnknownOrListedTwiceOrNeverStand) {
  SubgraphSpec wrong = spec("B");
  wrong.trims = {pi(1), pi(13)};
  EXPECT_EQ(refusal(wrong), "subgraph 'B': trim 13, allowed 1 ... 12");
  wrong.trims = {pi(1), pi(7), pi(1)};
  EXPECT_EQ(refusal(wrong), "subgraph 'B': trim 1 is listed twice");
  wrong.trims = {pi(6), pi(7)};
  EXPECT_EQ(refusal(wrong), "subgraph 'B': no trim of speed 0 among its trims");
}

TEST(Subgraph, KeepsTheAutomatonAlive) {
  auto automaton = build_shared_automaton(paper_configuration());
  const std::weak_ptr<const UniversalAutomaton> watch = automaton;
  const Subgraph subgraph(std::move(automaton), spec("B"));
  ASSERT_FALSE(watch.expired());
  EXPECT_EQ(subgraph.successors(pi(1)).front().maneuver->label, kOwnStepLabel);
}

}  // namespace
}  // namespace hlc
