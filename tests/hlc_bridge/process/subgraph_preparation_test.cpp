#include "hlc_bridge/process/subgraph_preparation.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <utility>
#include <vector>

#include "hlc_bridge/time/signal.hpp"
#include "planner/maneuver_design/automaton_builder.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::process {
namespace {

AutomatonRequest slow(std::uint64_t id, double max_speed_mps) {
  return {.vehicle = {1},
          .id = id,
          .valid_from = 0,
          .subgraph = {.labels = {}, .max_speed_mps = max_speed_mps}};
}

high_level_controller::RequestBase on(const std::shared_ptr<const automaton::Subgraph>& subgraph) {
  constexpr std::size_t kHorizonSteps = 8;
  return {.subgraph = controller::prepare_subgraph(subgraph, kHorizonSteps, {}),
          .limits_mps = {},
          .horizon_steps = kHorizonSteps,
          .search = {}};
}

/// What comes back, on the test's thread.
class Prepared {
 public:
  void put(high_level_controller::PreparedRequest prepared) {
    signal_.post([&] { all_.push_back(std::move(prepared)); });
  }
  /// Waits until there are so many.
  [[nodiscard]] std::vector<high_level_controller::PreparedRequest> wait_for(std::size_t count) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes{1};
    EXPECT_TRUE(signal_.wait_until(deadline, [&] { return all_.size() >= count; }));
    return signal_.locked([this] { return all_; });
  }

 private:
  time::Signal signal_;
  std::vector<high_level_controller::PreparedRequest> all_;
};

class SubgraphPreparationTest : public testing::Test {
 protected:
  std::shared_ptr<const automaton::Subgraph> base_ =
      std::make_shared<const automaton::Subgraph>(test::make_test_subgraph());
  Prepared prepared_;
  SubgraphPreparation preparation_{
      on(base_),
      {base_->shared_automaton(), {}},
      [this](high_level_controller::PreparedRequest one) { prepared_.put(std::move(one)); }};
};

TEST_F(SubgraphPreparationTest, PreparesInOrderWithTablesForOneStepMoreThanTheHorizon) {
  preparation_.ask(slow(1, 0.6));
  preparation_.ask(slow(2, 0.1));
  preparation_.ask(slow(3, 0.5));
  const std::vector<high_level_controller::PreparedRequest> prepared = prepared_.wait_for(3);
  ASSERT_EQ(prepared.size(), 3U);
  EXPECT_EQ(prepared[0].request.id, 1U);
  ASSERT_TRUE(prepared[0].choice);
  EXPECT_EQ(prepared[0].choice->under({}).subgraph->spec().max_speed_mps, 0.6);
  EXPECT_EQ(prepared[0].choice->under({}).reachable->max_steps(), 9U);
  EXPECT_FALSE(prepared[1].choice);
  EXPECT_FALSE(prepared[1].refusal.empty());
  EXPECT_EQ(prepared[2].choice->under({}).subgraph->spec().max_speed_mps, 0.5);
}

TEST_F(SubgraphPreparationTest, EndsWhateverIsStillAsked) {
  for (std::uint64_t id = 1; id <= 100; ++id) preparation_.ask(slow(id, 0.6));
}

/// The paper's B, for which weights can be solved.
class WeightPreparationTest : public testing::Test {
 protected:
  static maneuver_design::AutomatonConfiguration configuration() {
    const maneuver_design::AutomatonConfiguration whole =
        maneuver_design::read_automaton_configuration(test::source_folder() +
                                                      "/launch_scripts/automata/paper.yaml");
    return maneuver_design::needed_by(whole.subgraphs.at(1), whole);
  }
  static AutomatonRequest weighted(std::uint64_t id, double weight) {
    return {.vehicle = {1},
            .id = id,
            .valid_from = 0,
            .subgraph = {.labels = {}, .weights = {{"J2", weight}}}};
  }

  std::shared_ptr<const automaton::Subgraph> base_ = std::make_shared<const automaton::Subgraph>(
      maneuver_design::build_shared_automaton(configuration()), configuration().subgraphs.front());
  Prepared prepared_;
  SubgraphPreparation preparation_{
      on(base_),
      {base_->shared_automaton(), [] { return configuration(); }},
      [this](high_level_controller::PreparedRequest one) { prepared_.put(std::move(one)); }};
};

TEST_F(WeightPreparationTest, WaitsForTheSolutionAndKeepsIt) {
  preparation_.ask(weighted(1, 0.7));
  preparation_.ask(weighted(2, 0.7));
  const std::vector<high_level_controller::PreparedRequest> prepared = prepared_.wait_for(2);
  ASSERT_EQ(prepared.size(), 2U);
  ASSERT_TRUE(prepared[0].choice) << prepared[0].refusal;
  const automaton::Subgraph& first = *prepared[0].choice->under({}).subgraph;
  EXPECT_EQ(first.spec().name, base_->spec().name + ", weights J2 0.7");
  EXPECT_NE(first.shared_automaton(), base_->shared_automaton());
  const automaton::Subgraph& second = *prepared[1].choice->under({}).subgraph;
  EXPECT_EQ(second.shared_automaton(), first.shared_automaton());
}

TEST_F(WeightPreparationTest, EndsInTheMiddleOfASolution) {
  for (std::uint64_t id = 1; id <= 16; ++id) {
    preparation_.ask(weighted(id, static_cast<double>(id)));
  }
}

}  // namespace
}  // namespace hlc::process
