#include "hlc_bridge/hlc/weight_design.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "planner/automaton/requested_subgraph.hpp"
#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/scenario/lab_file.hpp"
#include "tests/support/folders.hpp"

namespace hlc::high_level_controller::weight_design_test {
namespace {

using testing::HasSubstr;
using Weights = std::vector<CriterionWeight>;

const std::string kLaunchScripts = test::source_folder() + "/launch_scripts/";
const Weights kWeights{{"J1", 0.3}, {"J2", 0.7}};
const std::string kLabel = "J1 0.3 J2 0.7";

maneuver_design::AutomatonConfiguration shipped(const std::string& name) {
  return maneuver_design::read_automaton_configuration(kLaunchScripts + "automata/" + name);
}

/// What a run on the paper's B builds.
const maneuver_design::AutomatonConfiguration& paper_b() {
  static const maneuver_design::AutomatonConfiguration configuration = [] {
    const maneuver_design::AutomatonConfiguration whole = shipped("paper.yaml");
    const auto is_b = [](const automaton::SubgraphSpec& spec) { return spec.name == "B"; };
    return maneuver_design::needed_by(*std::ranges::find_if(whole.subgraphs, is_b), whole);
  }();
  return configuration;
}

const automaton::Subgraph& base() {
  static const automaton::Subgraph subgraph(maneuver_design::build_shared_automaton(paper_b()),
                                            paper_b().subgraphs.front());
  return subgraph;
}

automaton::SubgraphSpec spec_for(const Weights& weights, std::vector<TrimId> disable_trims = {}) {
  return automaton::requested_spec(
      base(), {.labels = {}, .weights = weights, .disable_trims = disable_trims});
}

/// All but standstill and the two that are driven straight on or nearly so: quick to solve.
std::vector<TrimId> all_but_three() {
  std::vector<TrimId> trims;
  for (std::size_t trim = 1; trim < 12; ++trim) {
    if (trim != 5 && trim != 6) trims.push_back({trim});
  }
  return trims;
}

/// Designs for the paper's B, and how often it asked what the automaton was built from.
class WeightDesignTest : public testing::Test {
 protected:
  std::shared_ptr<const automaton::UniversalAutomaton> automaton_for(
      const Weights& weights, std::vector<TrimId> disable_trims = {}) {
    return design_.automaton_for(spec_for(weights, std::move(disable_trims)), weights);
  }

  std::string refusal(const Weights& weights, const std::stop_token& stop = {}) {
    return refusal_of(design_, weights, stop);
  }
  static std::string refusal_of(WeightDesign& design, const Weights& weights,
                                const std::stop_token& stop = {}) {
    try {
      static_cast<void>(design.automaton_for(spec_for(weights), weights, stop));
    } catch (const std::exception& error) {
      return error.what();
    }
    return "accepted";
  }
  static std::string fault(const WeightDesign& design, const automaton::Subgraph& subgraph) {
    try {
      design.check(subgraph);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }

  int asked_{0};
  WeightDesign design_{base().shared_automaton(), [this] {
                         ++asked_;
                         return paper_b();
                       }};
};

TEST_F(WeightDesignTest, GivesTheManeuversOfAnAutomatonThatHadTheLabelFromTheBeginning) {
  maneuver_design::AutomatonConfiguration declared = paper_b();
  declared.criteria.push_back({.label = "J1"});  // faster than the weights' are
  declared.subgraphs.front().labels = {"J1", "J2"};
  WeightDesign design(maneuver_design::build_shared_automaton(declared), [] { return paper_b(); });
  const auto automaton = design.automaton_for(spec_for(kWeights), kWeights);
  declared.criteria.push_back({.label = kLabel, .weights = kWeights});
  declared.subgraphs.front().labels.push_back(kLabel);
  const automaton::UniversalAutomaton expected = maneuver_design::build_automaton(declared);
  EXPECT_EQ(automaton->trims, expected.trims);
  ASSERT_EQ(automaton->maneuvers.size(), expected.maneuvers.size());
  for (const automaton::Maneuver& maneuver : expected.maneuvers) {
    const automaton::Maneuver* made = automaton->find(maneuver.from, maneuver.to, maneuver.label);
    ASSERT_NE(made, nullptr) << maneuver.label;
    EXPECT_EQ(made->inputs, maneuver.inputs);
    EXPECT_EQ(made->states, maneuver.states);
    EXPECT_EQ(made->displacement, maneuver.displacement);
    EXPECT_EQ(made->swept_area_m, maneuver.swept_area_m);
    EXPECT_EQ(made->lane_area_m, maneuver.lane_area_m);
    EXPECT_EQ(made->criteria, maneuver.criteria);
  }
}

TEST_F(WeightDesignTest, KnowsWhatItHasMadeByTheWeightsAlone) {
  const auto few = automaton_for(kWeights, all_but_three());
  EXPECT_EQ(automaton_for({{"J2", 0.7}, {"J1", 0.3}, {"energy", 0.0}}, all_but_three()), few);
  EXPECT_NE(automaton_for({{"J2", 0.3}, {"J1", 0.7}}, all_but_three()), few);
  EXPECT_EQ(few->find({1}, {2}, kLabel), nullptr);
  const auto all = automaton_for(kWeights);
  EXPECT_NE(all, few);
  EXPECT_NE(all->find({1}, {2}, kLabel), nullptr);
  EXPECT_EQ(automaton_for(kWeights, all_but_three()), all);
  std::set<std::tuple<TrimId, TrimId, std::string>> edges;
  for (const automaton::Maneuver& one : all->maneuvers) {
    EXPECT_TRUE(edges.emplace(one.from, one.to, one.label).second) << "made twice";
  }
  EXPECT_EQ(asked_, 1);
}

TEST_F(WeightDesignTest, ForgetsTheWeightsThatWereAskedForLongestAgo) {
  const auto with = [this](std::size_t weight) {
    return automaton_for({{"J2", static_cast<double>(weight)}}, all_but_three());
  };
  const auto first = with(1);
  const auto second = with(2);
  for (std::size_t weight = 3; weight <= WeightDesign::kMaxKept; ++weight) {
    static_cast<void>(with(weight));
  }
  EXPECT_EQ(with(1), first);
  static_cast<void>(with(WeightDesign::kMaxKept + 1));
  EXPECT_EQ(with(1), first);
  EXPECT_NE(with(2), second);
}

TEST_F(WeightDesignTest, RefusesWhatNoSumCanBeMadeOf) {
  EXPECT_THAT(refusal({{"J1", 0.3}, {"J9", 0.7}}),
              HasSubstr("weights: criterion 'J9', must be one of J1, J2, J3"));
  EXPECT_THAT(refusal({{"J1", 0.3}, {"J1", 0.7}}), HasSubstr("J1 is listed twice"));
  EXPECT_THAT(refusal({{"J1", -0.3}, {"J2", 0.7}}), HasSubstr("J1 = -0.3, must be >= 0"));
  EXPECT_THAT(refusal({{"J1", std::nan("")}}), HasSubstr("J1 = nan"));
  EXPECT_THAT(refusal({{"J1", INFINITY}}), HasSubstr("J1 = inf"));
  EXPECT_THAT(refusal({{"J1", 0.0}}), HasSubstr("all 0"));
  EXPECT_EQ(asked_, 0);
}

TEST_F(WeightDesignTest, RefusesWithoutTheConfigurationThatTheAutomatonWasBuiltFrom) {
  WeightDesign without(base().shared_automaton(), {});
  EXPECT_THAT(refusal_of(without, kWeights), HasSubstr("configuration of the automaton unknown"));
  WeightDesign unreadable(
      base().shared_automaton(), []() -> maneuver_design::AutomatonConfiguration {
        throw std::invalid_argument("built.yaml: configuration not found in its folder");
      });
  EXPECT_THAT(refusal_of(unreadable, kWeights), HasSubstr("not found in its folder"));
  WeightDesign edited(base().shared_automaton(), [] {
    maneuver_design::AutomatonConfiguration configuration = paper_b();
    configuration.limits.acceleration_mps2 *= 0.5;
    return configuration;
  });
  EXPECT_THAT(refusal_of(edited, kWeights), HasSubstr("paper.yaml differs from"));
}

TEST_F(WeightDesignTest, StopsBetweenTwoManeuvers) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THAT(refusal(kWeights, stop.get_token()), HasSubstr("the controller is stopping"));
}

// The others reckon with the highest speed of the scenario's automaton. Alone, J1 outruns the
// trims.
TEST_F(WeightDesignTest, NothingIsFasterThanTheScenariosAutomaton) {
  const Weights fast{{"J1", 1.0}};
  maneuver_design::AutomatonConfiguration declared = paper_b();
  declared.criteria = {{.label = "J1 1", .weights = fast}};
  declared.subgraphs = {spec_for(fast)};
  EXPECT_GT(automaton::top_speed_mps(maneuver_design::build_automaton(declared)), 1.5);
  constexpr double kRounding_mps = 1e-6;
  for (const Weights& weights : {kWeights, fast}) {
    const auto automaton = automaton_for(weights);
    EXPECT_LE(automaton::top_speed_mps(*automaton),
              automaton::top_speed_mps(base().automaton()) + kRounding_mps);
    EXPECT_EQ(fault(design_, automaton::Subgraph(automaton, spec_for(weights))), "");
  }
  const std::string reason =
      fault(design_, automaton::Subgraph(maneuver_design::build_shared_automaton(declared),
                                         declared.subgraphs.front()));
  EXPECT_THAT(reason, HasSubstr("(J1 1) reaches"));
  EXPECT_THAT(reason, HasSubstr("m/s, must be <= 0.8"));
}

TEST_F(WeightDesignTest, TheLabsVehiclesCanFollowWhatIsOn) {
  const vehicle::LabLimits lab =
      scenario::read_lab(kLaunchScripts + "labs/cpm_lab.yaml", paper_b().step_s);
  const WeightDesign design(base().shared_automaton(), {}, lab);
  EXPECT_THAT(fault(design, base()), HasSubstr("by the lab"));
}

TEST_F(WeightDesignTest, NamesTheEdgeThatHasNoManeuver) {
  const maneuver_design::AutomatonConfiguration lab = shipped("lab.yaml");
  const auto automaton = maneuver_design::build_shared_automaton(lab);
  automaton::SubgraphSpec spec = lab.subgraphs.front();
  spec.labels = {"J2 1"};
  spec.trims = {{0}, {1}, {11}};  // in a chain
  spec.disabled_edges = {};
  WeightDesign design(automaton, [&lab] { return lab; });
  try {
    static_cast<void>(design.automaton_for(spec, {{"J2", 1.0}}));
    FAIL() << "2 -> 12 is beyond what the vehicle can do in a step";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("maneuver"));
    EXPECT_THAT(error.what(), HasSubstr("(J2 1)"));
  }
}

}  // namespace
}  // namespace hlc::high_level_controller::weight_design_test
