#include "hlc_bridge/hlc/subgraph_preparation.hpp"

#include <gtest/gtest.h>

#include "tests/support/test_automaton.hpp"

namespace hlc {
namespace {

AutomatonRequest slow(std::uint64_t id, double max_speed_mps) {
  return {.vehicle = {1},
          .id = id,
          .valid_from = 0,
          .subgraph = {.labels = {}, .max_speed_mps = max_speed_mps}};
}

class SubgraphPreparationTest : public testing::Test {
 protected:
  std::shared_ptr<const Subgraph> base_ =
      std::make_shared<const Subgraph>(test::make_test_subgraph());
  SubgraphPreparation preparation_{base_, 8};
};

TEST_F(SubgraphPreparationTest, PreparesInOrderWithTablesForOneStepMoreThanTheHorizon) {
  preparation_.ask(slow(1, 0.6));
  preparation_.ask(slow(2, 0.1));
  preparation_.ask(slow(3, 0.5));
  preparation_.wait();
  const std::vector<PreparedRequest> prepared = preparation_.take();
  ASSERT_EQ(prepared.size(), 3U);
  EXPECT_EQ(prepared[0].request.id, 1U);
  ASSERT_TRUE(prepared[0].subgraph);
  EXPECT_EQ(prepared[0].subgraph->spec().max_speed_mps, 0.6);
  EXPECT_EQ(prepared[0].reachable->max_steps(), 9U);
  EXPECT_FALSE(prepared[1].subgraph);
  EXPECT_FALSE(prepared[1].refusal.empty());
  EXPECT_EQ(prepared[2].subgraph->spec().max_speed_mps, 0.5);
  EXPECT_TRUE(preparation_.take().empty());
}

TEST_F(SubgraphPreparationTest, EndsWhateverIsStillAsked) {
  for (std::uint64_t id = 1; id <= 100; ++id) preparation_.ask(slow(id, 0.6));
}

}  // namespace
}  // namespace hlc
