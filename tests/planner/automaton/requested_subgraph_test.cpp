#include "planner/automaton/requested_subgraph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "planner/maneuver_design/automaton_builder.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::automaton::subgraph_request_test {
namespace {

using testing::HasSubstr;

constexpr std::size_t kHorizonSteps = 8;

/// The paper's B: twelve trims, J2; on an automaton with all edges of all labels.
const Subgraph& base() {
  static const Subgraph subgraph = [] {
    maneuver_design::AutomatonConfiguration configuration = shipped_configuration();
    configuration.edges = maneuver_design::EdgeChoice::kAll;
    const auto is_b = [](const SubgraphSpec& spec) { return spec.name == "B"; };
    return Subgraph(maneuver_design::build_shared_automaton(configuration),
                    *std::ranges::find_if(configuration.subgraphs, is_b));
  }();
  return subgraph;
}

std::shared_ptr<const Subgraph> requested(const SubgraphRequest& request) {
  return requested_subgraph(base(), request, kHorizonSteps);
}

std::string refusal(const SubgraphRequest& request) {
  try {
    static_cast<void>(requested(request));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

/// Numbered from 1, as in the paper.
TrimId trim(std::size_t number) { return {number - 1}; }

std::vector<TrimId> on(const Subgraph& subgraph) {
  return {subgraph.trims().begin(), subgraph.trims().end()};
}

TEST(SubgraphRequest, AnEmptyOneAsksForTheScenariosOwn) {
  EXPECT_EQ(requested({})->spec(), base().spec());
}

TEST(SubgraphRequest, ChangesLabelsTrimsEdgesAndSpeed) {
  const auto subgraph = requested({.labels = {"J1"},
                                   .max_speed_mps = {},
                                   .enable_trims = {},
                                   .disable_trims = {trim(2), trim(12)},
                                   .enable_edges = {},
                                   .disable_edges = {{trim(6), trim(7)}}});
  EXPECT_EQ(on(*subgraph).size(), 10U);
  EXPECT_FALSE(subgraph->is_enabled(trim(2)));
  EXPECT_FALSE(subgraph->is_enabled(trim(12)));
  std::size_t moves = 0;
  for (const TrimId from : subgraph->trims()) {
    for (const Edge& edge : subgraph->successors(from)) {
      EXPECT_FALSE(from == trim(6) && edge.to == trim(7));
      if (edge.to == from) continue;
      EXPECT_EQ(edge.maneuver->label, "J1");
      ++moves;
    }
  }
  EXPECT_GT(moves, 20U);
  EXPECT_EQ(subgraph->spec().name, "B, label J1, without trims 2, 12, without edges 6 -> 7");

  const auto slow = requested({.labels = {}, .max_speed_mps = 0.6});
  for (const TrimId one : slow->trims()) {
    for (const Edge& edge : slow->successors(one)) {
      EXPECT_LE(top_speed_mps(*edge.maneuver), 0.6 + 1e-6);
    }
  }
  EXPECT_TRUE(slow->is_enabled(trim(4)));
  EXPECT_FALSE(slow->is_enabled(trim(7)));
}

// The order is that of the declaration: chains go by it.
TEST(SubgraphRequest, ATrimThatComesBackStandsWhereItWas) {
  SubgraphSpec without = base().spec();
  std::erase(without.trims, trim(7));
  const Subgraph smaller(base().shared_automaton(), without);
  const auto subgraph = requested_subgraph(
      smaller, {.labels = {}, .max_speed_mps = {}, .enable_trims = {trim(7)}}, kHorizonSteps);
  EXPECT_EQ(subgraph->spec().trims, base().spec().trims);
}

TEST(SubgraphRequest, RefusesWhatCannotBeInOneLine) {
  EXPECT_THAT(refusal({.labels = {"J7"}}), HasSubstr("label 'J7', must be one of J1, J2, J3"));
  EXPECT_THAT(refusal({.labels = {"J1", "J1"}}), HasSubstr("label 'J1' is listed twice"));
  EXPECT_THAT(refusal({.labels = {}, .max_speed_mps = 0.3}),
              HasSubstr("speed limit 0.3 m/s, must be >= 0.4"));
  EXPECT_THAT(refusal({.labels = {}, .max_speed_mps = std::nan("")}), HasSubstr("speed limit nan"));
  EXPECT_THAT(refusal({.labels = {}, .max_speed_mps = INFINITY}), HasSubstr("speed limit inf"));
  SubgraphRequest request;
  request.disable_trims = {trim(1)};
  EXPECT_THAT(refusal(request), HasSubstr("no trim of speed 0"));
  request.disable_trims = {trim(13)};
  EXPECT_THAT(refusal(request), HasSubstr("trim 13, must be in 1 ... 12"));
  request.disable_trims = {trim(3), trim(3)};
  EXPECT_THAT(refusal(request), HasSubstr("trim 3: must be enabled"));
  request = {};
  request.enable_trims = {trim(3)};
  EXPECT_THAT(refusal(request), HasSubstr("trim 3: must be disabled"));
  request = {};
  request.enable_edges = {{trim(2), trim(3)}};
  EXPECT_THAT(refusal(request), HasSubstr("edge 2 -> 3: must be disabled"));
  request = {};
  request.disable_edges = {{trim(1), trim(1)}};
  EXPECT_THAT(refusal(request), HasSubstr("standing must be possible"));
  request = {};
  for (std::size_t number = 2; number <= 12; ++number) {
    request.disable_edges.push_back({trim(number), trim(1)});
  }
  EXPECT_THAT(refusal(request), HasSubstr("no way from trim"));
  request = {};
  request.labels = {"two\nlines"};
  EXPECT_EQ(std::ranges::count(refusal(request), '\n'), 0);
}

// Whatever is asked for is refused in one line, or can be driven and is what was asked for.
TEST(SubgraphRequest, RandomOnesAreRefusedOrCanBeDriven) {
  const unsigned seed = 71;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random{seed};
  const auto draw = [&](std::size_t last) {
    return std::uniform_int_distribution<std::size_t>{0, last}(random);
  };
  std::size_t accepted = 0;
  const std::uint64_t requests = test::num_seeds(2000);
  for (std::uint64_t i = 0; i < requests; ++i) {
    SubgraphRequest request;
    const char* const labels[] = {"J1", "J2", "J3"};
    if (draw(1) == 0) request.labels = {labels[draw(2)]};
    if (draw(2) == 0) request.max_speed_mps = 0.1 * static_cast<double>(draw(24));
    for (std::size_t k = draw(3); k > 0; --k) request.disable_trims.push_back({draw(12)});
    for (std::size_t k = draw(3); k > 0; --k)
      request.disable_edges.push_back({{draw(11)}, {draw(11)}});
    SCOPED_TRACE(testing::Message() << "request " << i);
    try {
      const auto subgraph = requested(request);
      ++accepted;
      EXPECT_NO_THROW(check_driving(*subgraph, kHorizonSteps));
      for (const TrimId one : request.disable_trims) EXPECT_FALSE(subgraph->is_enabled(one));
      for (const TrimId from : subgraph->trims()) {
        for (const Edge& edge : subgraph->successors(from)) {
          const bool is_disabled =
              std::ranges::find(request.disable_edges, TrimPair{from, edge.to}) !=
              request.disable_edges.end();
          EXPECT_FALSE(is_disabled);
          EXPECT_TRUE(!request.max_speed_mps ||
                      top_speed_mps(*edge.maneuver) <= *request.max_speed_mps + 1e-6);
          EXPECT_TRUE(request.labels.empty() || edge.to == from ||
                      edge.maneuver->label == request.labels.front());
        }
      }
    } catch (const std::invalid_argument& error) {
      const std::string line = error.what();
      EXPECT_FALSE(line.empty());
      EXPECT_EQ(std::ranges::count(line, '\n'), 0);
    }
  }
  EXPECT_GT(accepted, requests / 10);
  EXPECT_LT(accepted, 9 * requests / 10);
}

}  // namespace
}  // namespace hlc::automaton::subgraph_request_test
