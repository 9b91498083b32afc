#include "planner/maneuver_design/automaton_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/automaton/maneuver_check.hpp"
#include "planner/maneuver_design/criteria.hpp"
#include "planner/maneuver_design/shooting.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/support/folders.hpp"

namespace hlc::maneuver_design {
namespace {

TEST(AutomatonBuilder, BuildsEveryTrimsStepAnd50ManeuversForThePaper) {
  const auto automaton = automaton::paper_automaton();
  std::size_t self_loops = 0;
  std::size_t maneuvers = 0;
  for (const automaton::Maneuver& maneuver : automaton->maneuvers) {
    ++(maneuver.from == maneuver.to ? self_loops : maneuvers);
  }
  EXPECT_EQ(self_loops, 12U);
  EXPECT_EQ(maneuvers, 50U);  // 42 of the chain, 8 more for D
  for (const auto& [from, to] : {std::pair{2U, 4U}, {4U, 6U}, {8U, 10U}, {10U, 12U}}) {
    EXPECT_NE(automaton->find(automaton::pi(from), automaton::pi(to), "J2"), nullptr);
    EXPECT_NE(automaton->find(automaton::pi(to), automaton::pi(from), "J2"), nullptr);
  }
}

TEST(AutomatonBuilder, EveryManeuverObeysTheModelMeetsItsTrimsAndTheLimits) {
  const auto automaton = automaton::paper_automaton();
  const vehicle::VehicleLimits& limits = automaton->limits;
  for (const automaton::Maneuver& maneuver : automaton->maneuvers) {
    SCOPED_TRACE(testing::Message() << maneuver.from.index + 1 << " -> " << maneuver.to.index + 1);
    const automaton::Trim& from = automaton->trims[maneuver.from.index];
    const automaton::Trim& to = automaton->trims[maneuver.to.index];
    ASSERT_EQ(maneuver.states.size(), maneuver.inputs.size() + 1);
    EXPECT_EQ(maneuver.duration_s, automaton->step_s);
    EXPECT_EQ(maneuver.displacement, maneuver.states.back().pose);
    EXPECT_EQ(maneuver.states.front(), (vehicle::State{{}, from.speed_mps, from.steering_rad}));
    EXPECT_NEAR(maneuver.states.back().speed_mps, to.speed_mps, 1e-12);
    EXPECT_NEAR(maneuver.states.back().steering_rad, to.steering_rad, 1e-12);

    // Integrated again, with finer steps.
    constexpr int kFiner = 10;
    vehicle::State state = maneuver.states.front();
    const double step_s =
        maneuver.duration_s / static_cast<double>(kFiner * maneuver.inputs.size());
    for (std::size_t k = 0; k < maneuver.inputs.size(); ++k) {
      const vehicle::Input& input = maneuver.inputs[k];
      EXPECT_LE(std::abs(input.acceleration_mps2), limits.acceleration_mps2);
      EXPECT_LE(std::abs(input.steering_rate_radps), limits.steering_rate_radps);
      for (int i = 0; i < kFiner; ++i) {
        state = vehicle::integrated(state, input, step_s, automaton->vehicle);
      }
      EXPECT_LT((vehicle::to_vector(state) - vehicle::to_vector(maneuver.states[k + 1])).norm(),
                1e-7);
      EXPECT_LE(state.speed_mps, limits.speed_max_mps);
      EXPECT_GE(state.speed_mps, limits.speed_min_mps - 1e-12);
      EXPECT_LE(std::abs(state.steering_rad), limits.steering_max_rad);
    }
  }
}

TEST(AutomatonBuilder, ATrimsOwnStepIsTheExactArc) {
  const auto automaton = automaton::paper_automaton();
  for (std::size_t i = 0; i < automaton->trims.size(); ++i) {
    const automaton::Trim& trim = automaton->trims[i];
    const automaton::Maneuver* step = automaton->find(TrimId{i}, TrimId{i}, "J2");
    ASSERT_NE(step, nullptr);
    EXPECT_EQ(step->displacement, vehicle::trim_motion({}, trim.speed_mps, trim.steering_rad,
                                                       automaton->step_s, automaton->vehicle));
    for (const vehicle::State& state : step->states) {
      EXPECT_EQ(state.speed_mps, trim.speed_mps);
      EXPECT_EQ(state.steering_rad, trim.steering_rad);
    }
  }
}

// First-order optimality with end conditions alone active: the gradient with respect to the inputs
// of one kind is the same in every interval (it equals the end condition's multiplier).
TEST(AutomatonBuilder, EveryManeuverIsAStationaryPointOfItsCriterion) {
  const auto automaton = automaton::paper_automaton();
  for (const automaton::Maneuver& maneuver : automaton->maneuvers) {
    if (maneuver.from == maneuver.to) {
      continue;
    }
    const auto cost = make_criterion(maneuver.label, automaton::paper_configuration().vehicle);
    const Shot shot = shoot(maneuver.states.front(), maneuver.inputs, maneuver.duration_s, *cost,
                            automaton->vehicle, WithGradient::kYes);
    for (const Eigen::Vector2d& gradient : shot.gradient) {
      EXPECT_LT((gradient - shot.gradient.front()).norm(), 1e-9 * (1.0 + gradient.norm()));
    }
  }
}

TEST(AutomatonBuilder, EveryManeuverOfTheShippedConfigurationObeysItsRulesAndIsOptimal) {
  const AutomatonConfiguration& c = automaton::shipped_configuration();
  const automaton::UniversalAutomaton automaton = build_automaton(c);
  ASSERT_EQ(automaton.maneuvers.size(), 12U + 3U * 50U);
  for (const automaton::Maneuver& maneuver : automaton.maneuvers) {
    SCOPED_TRACE(testing::Message() << maneuver.label << ", " << maneuver.from.index + 1 << " -> "
                                    << maneuver.to.index + 1);
    EXPECT_EQ(automaton::validate(maneuver, automaton), "");
    if (maneuver.from == maneuver.to) continue;
    // Started where it is, the solver finds nothing to change.
    SolverOptions options;
    options.start = maneuver.inputs;
    const auto cost = make_criterion(maneuver.label, c.vehicle);
    const ManeuverSolution again =
        solve(problem_between(c.trims[maneuver.from.index], c.trims[maneuver.to.index], c), *cost,
              options);
    ASSERT_EQ(again.status, ManeuverStatus::kOptimal) << again.reason;
    EXPECT_LT(again.first_order_residual, 1e-5);
    EXPECT_LT((again.states.back().pose.position_m() - maneuver.displacement.position_m()).norm(),
              1e-9);
  }
}

TEST(AutomatonBuilder, MirroredTrimsHaveMirroredManeuvers) {
  const automaton::UniversalAutomaton automaton =
      build_automaton(automaton::shipped_configuration());
  const auto mirrored = [](TrimId trim) {  // the paper's trims 2 ... 12 are symmetric about 7
    return trim.index == 0 ? trim : TrimId{12 - trim.index};
  };
  constexpr double kSame = 1e-10;
  for (const automaton::Maneuver& maneuver : automaton.maneuvers) {
    SCOPED_TRACE(testing::Message() << maneuver.label << ", " << maneuver.from.index + 1 << " -> "
                                    << maneuver.to.index + 1);
    const automaton::Maneuver* other =
        automaton.find(mirrored(maneuver.from), mirrored(maneuver.to), maneuver.label);
    ASSERT_NE(other, nullptr);
    for (std::size_t k = 0; k < maneuver.states.size(); ++k) {
      const vehicle::State& a = maneuver.states[k];
      const vehicle::State& b = other->states[k];
      EXPECT_NEAR(a.pose.x_m, b.pose.x_m, kSame);
      EXPECT_NEAR(a.pose.y_m, -b.pose.y_m, kSame);
      EXPECT_NEAR(a.pose.heading_rad, -b.pose.heading_rad, kSame);
      EXPECT_NEAR(a.speed_mps, b.speed_mps, kSame);
      EXPECT_NEAR(a.steering_rad, -b.steering_rad, kSame);
    }
  }
}

// Standing, the steering costs nothing: many maneuvers are equally good.
TEST(AutomatonBuilder, MirroredTrimsHaveMirroredManeuversToTheLastBitAlsoWhereManyAreEquallyGood) {
  AutomatonConfiguration c = automaton::shipped_configuration();
  c.criteria = {{"stopping_distance", {}, false}, {"J1", {}, false}};
  for (std::size_t criterion = 0; criterion < c.criteria.size(); ++criterion) {
    const automaton::Maneuver left = design(c, {{automaton::pi(1), automaton::pi(10)}, criterion});
    const automaton::Maneuver right = design(c, {{automaton::pi(1), automaton::pi(4)}, criterion});
    for (std::size_t k = 0; k < left.inputs.size(); ++k) {
      EXPECT_EQ(left.inputs[k].acceleration_mps2, right.inputs[k].acceleration_mps2);
      EXPECT_EQ(left.inputs[k].steering_rate_radps, -right.inputs[k].steering_rate_radps);
    }
    EXPECT_EQ(left.displacement.x_m, right.displacement.x_m);
    EXPECT_EQ(left.displacement.y_m, -right.displacement.y_m);
    EXPECT_EQ(left.displacement.heading_rad, -right.displacement.heading_rad);
    EXPECT_LT(left.inputs.size(), left.states.size());
  }
}

TEST(AutomatonBuilder, ManyManeuversAtOnceAreTheSameToTheLastBitAsOneByOne) {
  AutomatonConfiguration c = automaton::shipped_configuration();
  c.criteria = {{"J1", {}, false}, {"middle", {{"J1", 0.3}, {"J2", 0.7}}, true}};
  c.limits.curvature_max_per_m = 4.9;  // a bound of the path to either side
  std::vector<DesignTask> tasks;
  for (std::size_t criterion = 0; criterion < c.criteria.size(); ++criterion) {
    for (const TrimPair& edge : {TrimPair{automaton::pi(2), automaton::pi(3)},
                                 {automaton::pi(6), automaton::pi(7)},
                                 {automaton::pi(7), automaton::pi(1)},
                                 {automaton::pi(8), automaton::pi(7)},
                                 {automaton::pi(12), automaton::pi(11)}}) {
      tasks.push_back({edge, criterion});
    }
  }
  std::size_t calls = 0;
  const std::vector<automaton::Maneuver> many = design(c, tasks, [&calls] { ++calls; });
  EXPECT_EQ(calls, tasks.size());
  ASSERT_EQ(many.size(), tasks.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "task " << i);
    const automaton::Maneuver one = design(c, tasks[i]);
    EXPECT_EQ(many[i].from, one.from);
    EXPECT_EQ(many[i].to, one.to);
    EXPECT_EQ(many[i].label, one.label);
    EXPECT_EQ(many[i].inputs, one.inputs);
    EXPECT_EQ(many[i].states, one.states);
    EXPECT_EQ(many[i].displacement, one.displacement);
    EXPECT_EQ(many[i].swept_area_m, one.swept_area_m);
    EXPECT_EQ(many[i].lane_area_m, one.lane_area_m);
    EXPECT_EQ(many[i].criteria, one.criteria);
  }
}

TEST(AutomatonBuilder, APointOfAFrontLiesBetweenItsEndsAtItsShare) {
  AutomatonConfiguration c = automaton::shipped_configuration();
  LabelledCriterion middle;
  middle.label = "middle";
  middle.front_point = FrontPoint{"J1", "J2", 0.25};
  c.criteria = {{"J1", {}, false}, {"J2", {}, false}, middle};
  for (const TrimPair& edge : {TrimPair{automaton::pi(7), automaton::pi(8)},
                               {automaton::pi(1), automaton::pi(12)},
                               {automaton::pi(5), automaton::pi(1)}}) {
    const auto value = [](const automaton::Maneuver& maneuver, const std::string& name) {
      return std::ranges::find(maneuver.criteria, name, &CriterionValue::name)->value;
    };
    const automaton::Maneuver far = design(c, {edge, 0});
    const automaton::Maneuver soft = design(c, {edge, 1});
    const automaton::Maneuver between = design(c, {edge, 2});
    EXPECT_EQ(between.label, "middle");
    const double bound = value(soft, "J2") + 0.25 * (value(far, "J2") - value(soft, "J2"));
    EXPECT_NEAR(value(between, "J2"), bound, 1e-6 * bound) << "the bound is active";
    EXPECT_LT(value(between, "J1"), value(soft, "J1"));
    EXPECT_GT(value(between, "J1"), value(far, "J1"));
  }
}

TEST(AutomatonBuilder, IntervalsThatAreTooLongForTheModelAreRefused) {
  AutomatonConfiguration c = read_automaton_configuration(
      test::source_folder() + "/launch_scripts/automata/pareto_example.yaml");
  c.intervals = 10;
  try {
    static_cast<void>(build_automaton(c));
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(" with 10 intervals"), std::string::npos)
        << error.what();
  }
}

TEST(AutomatonBuilder, TheSameConfigurationGivesTheSameAutomatonBitForBit) {
  const automaton::UniversalAutomaton again = build_automaton(automaton::paper_configuration());
  ASSERT_EQ(again.maneuvers.size(), automaton::paper_automaton()->maneuvers.size());
  for (std::size_t i = 0; i < again.maneuvers.size(); ++i) {
    const automaton::Maneuver& a = again.maneuvers[i];
    const automaton::Maneuver& b = automaton::paper_automaton()->maneuvers[i];
    EXPECT_EQ(a.label, b.label);
    EXPECT_EQ(a.inputs, b.inputs);
    EXPECT_EQ(a.states, b.states);
    EXPECT_EQ(a.swept_area_m, b.swept_area_m);
    EXPECT_EQ(a.lane_area_m, b.lane_area_m);
  }
}

double value_of(const std::string& name, const std::vector<CriterionValue>& values) {
  for (const CriterionValue& value : values) {
    if (value.name == name) return value.value;
  }
  throw std::logic_error("no value of " + name);
}

TEST(AutomatonBuilder, ManeuversCarryTheValuesOfAllCriteria) {
  const auto automaton = automaton::paper_automaton();
  for (const automaton::Maneuver& maneuver : automaton->maneuvers) {
    ASSERT_EQ(maneuver.criteria.size(), criterion_names().size());
    const automaton::Trim& from = automaton->trims[maneuver.from.index];
    const automaton::Trim& to = automaton->trims[maneuver.to.index];
    const double dv = to.speed_mps - from.speed_mps;
    const double ddelta = to.steering_rad - from.steering_rad;
    const double closed_form = (dv * dv + ddelta * ddelta) / automaton->step_s;
    EXPECT_NEAR(value_of("J2", maneuver.criteria), closed_form, 1e-9 * (1.0 + closed_form));
    EXPECT_NEAR(value_of("travel_time", maneuver.criteria), automaton->step_s, 1e-12);
    EXPECT_LE(value_of("J1", maneuver.criteria), 0.0);
  }
  // Straight on at v: J1 is the integral of -(v t)^2 from the step's own start.
  const automaton::Maneuver* straight = automaton->find(automaton::pi(7), automaton::pi(7), "J2");
  EXPECT_NEAR(value_of("J1", straight->criteria), -0.64 * 0.008 / 3.0, 1e-12);
}

TEST(AutomatonBuilder, TrimsCarryTheUnitCostsOfTheCriteriaThatHaveOne) {
  const auto automaton = automaton::paper_automaton();
  ASSERT_EQ(automaton->unit_costs.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    const automaton::Trim& trim = automaton->trims[i];
    const double lateral = trim.speed_mps * trim.speed_mps *
                           vehicle::curvature_per_m(trim.steering_rad, automaton->vehicle);
    EXPECT_EQ(value_of("J2", automaton->unit_costs[i]), 0.0);
    EXPECT_NEAR(value_of("comfort", automaton->unit_costs[i]), lateral * lateral, 1e-12);
    EXPECT_THROW((void)value_of("J1", automaton->unit_costs[i]), std::logic_error);
  }
}

TEST(AutomatonBuilder, AllEdgesAreThePairsThatTheLimitsAllow) {
  AutomatonConfiguration configuration = automaton::paper_configuration();
  EXPECT_EQ(design_tasks(configuration).size(), 50U);
  configuration.edges = EdgeChoice::kAll;
  EXPECT_EQ(design_tasks(configuration).size(), 132U);
  configuration.limits.steering_rate_radps = 3.0;  // 0.6 rad in a step
  configuration.subgraphs.front().trims = {automaton::pi(1), automaton::pi(7)};
  configuration.subgraphs.resize(1);
  for (const DesignTask& task : design_tasks(configuration)) {
    EXPECT_LE(std::abs(configuration.trims[task.edge.from.index].steering_rad -
                       configuration.trims[task.edge.to.index].steering_rad),
              0.6 + 1e-9);
  }
}

/// The paper's configuration with one label, and self-loops that are optimal for it.
AutomatonConfiguration with_optimised_self_loops(const std::string& label,
                                                 SelfLoops self_loops = SelfLoops::kOptimised) {
  AutomatonConfiguration configuration = automaton::shipped_configuration();
  const auto subgraph = std::ranges::find_if(
      configuration.subgraphs, [&](const auto& one) { return one.labels == std::vector{label}; });
  configuration = needed_by(*subgraph, configuration);
  configuration.self_loops = self_loops;
  return configuration;
}

TEST(AutomatonBuilder, SelfLoopsOfMovingTrimsCanBeOptimalLikeEveryOtherEdge) {
  const AutomatonConfiguration configuration = with_optimised_self_loops("J1");
  const auto automaton = build_shared_automaton(configuration);
  const automaton::Subgraph subgraph(automaton, configuration.subgraphs.front());
  for (std::size_t i = 0; i < automaton->trims.size(); ++i) {
    SCOPED_TRACE(i + 1);
    const TrimId trim{i};
    const automaton::Maneuver* const held = automaton->find(trim, trim, automaton::kSelfLoopLabel);
    ASSERT_NE(held, nullptr) << "the trim itself stays";
    const automaton::Maneuver* const own = automaton->find(trim, trim, "J1");
    ASSERT_NE(own, nullptr);
    EXPECT_EQ(automaton::validate(*own, *automaton), "");
    std::vector<const automaton::Maneuver*> in_subgraph;
    for (const automaton::Edge& edge : subgraph.successors(trim)) {
      if (edge.to == trim) in_subgraph.push_back(edge.maneuver);
    }
    EXPECT_EQ(in_subgraph, std::vector{own});
    if (automaton->trims[i].is_equilibrium()) {
      EXPECT_EQ(own, held) << "standstill stands";
      continue;
    }
    EXPECT_EQ(own->label, "J1");
    EXPECT_LT(value_of("J1", own->criteria), value_of("J1", held->criteria));
    EXPECT_GT(automaton::top_speed_mps(*own), automaton->trims[i].speed_mps);
    // Half-way it is ahead of the trim: between its ends it is free.
    EXPECT_GT(automaton::state_at(*own, 0.1, automaton->vehicle).pose.x_m,
              automaton::state_at(*held, 0.1, automaton->vehicle).pose.x_m);
  }
}

TEST(AutomatonBuilder, StandstillMovesIfItsSelfLoopIsOptimisedToo) {
  const AutomatonConfiguration configuration =
      with_optimised_self_loops("J1", SelfLoops::kOptimisedAll);
  const auto automaton = build_shared_automaton(configuration);
  const automaton::Subgraph subgraph(automaton, configuration.subgraphs.front());
  const TrimId standstill = subgraph.standstill();
  std::vector<std::string> labels;
  for (const automaton::Edge& edge : subgraph.successors(standstill)) {
    if (edge.to != standstill) continue;
    labels.push_back(edge.maneuver->label);
    EXPECT_EQ(automaton::validate(*edge.maneuver, *automaton), "");
    // Full throttle for half of the step, full brake for the other: a (T / 2)^2.
    const double reach_m = configuration.limits.acceleration_mps2 * 0.1 * 0.1;
    EXPECT_NEAR(edge.maneuver->displacement.x_m, reach_m, 0.1 * reach_m);
  }
  EXPECT_EQ(labels, std::vector<std::string>{"J1"});
  const automaton::Maneuver* const fallback =
      automaton->find(standstill, standstill, automaton::kSelfLoopLabel);
  ASSERT_NE(fallback, nullptr);
  EXPECT_EQ(fallback->displacement, Pose{});
}

TEST(AutomatonBuilder, UnderASpeedLimitAnOwnStepThatIsTooFastIsTheTrimItself) {
  AutomatonConfiguration configuration = automaton::shipped_configuration();
  configuration.subgraphs.front().labels = {"J1", "J2"};
  configuration = needed_by(configuration.subgraphs.front(), configuration);
  configuration.self_loops = SelfLoops::kOptimised;
  automaton::UniversalAutomaton built = build_automaton(configuration);
  // Only the fast ones are left.
  std::erase_if(built.maneuvers,
                [](const automaton::Maneuver& m) { return m.from == m.to && m.label == "J2"; });
  automaton::SubgraphSpec spec = configuration.subgraphs.front();
  spec.max_speed_mps = 0.82;
  const automaton::Subgraph subgraph(
      std::make_shared<const automaton::UniversalAutomaton>(std::move(built)), spec);
  for (const TrimId trim : subgraph.trims()) {
    std::vector<std::string> held;
    for (const automaton::Edge& edge : subgraph.successors(trim)) {
      if (edge.to == trim) held.push_back(edge.maneuver->label);
      EXPECT_LE(automaton::top_speed_mps(*edge.maneuver), 0.82 + 1e-6);
    }
    EXPECT_EQ(held, std::vector{automaton::kSelfLoopLabel}) << trim.index + 1;
  }
}

TEST(AutomatonBuilder, EveryPairIsDesignedForEveryCriterionThatIsListed) {
  const std::vector<DesignTask> tasks = design_tasks(automaton::shipped_configuration());
  EXPECT_EQ(tasks.size(), 150U);
  EXPECT_EQ(design_tasks(needed_by(automaton::shipped_configuration().subgraphs[1],
                                   automaton::shipped_configuration()))
                .size(),
            42U);
  EXPECT_EQ(design_tasks(needed_by(automaton::shipped_configuration().subgraphs[3],
                                   automaton::shipped_configuration()))
                .size(),
            26U);
}

/// The maneuver 7 -> 8 for one weighted sum of J1 and J2.
automaton::Maneuver designed_for(double j1, double j2, bool normalised) {
  AutomatonConfiguration configuration = automaton::paper_configuration();
  configuration.criteria = {{"sum", {{"J1", j1}, {"J2", j2}}, normalised}};
  return design(configuration, {{automaton::pi(7), automaton::pi(8)}, 0});
}

TEST(AutomatonBuilder, ANormalisedSumIsACompromiseAndAPlainOneIsJ2InEffect) {
  const double least_j1 = value_of("J1", designed_for(1.0, 0.0, false).criteria);
  const automaton::Maneuver softest = designed_for(0.0, 1.0, false);
  const double most_j1 = value_of("J1", softest.criteria);
  const double share_plain =
      (value_of("J1", designed_for(0.5, 0.5, false).criteria) - most_j1) / (least_j1 - most_j1);
  EXPECT_LT(share_plain, 0.01);
  double last = 0.0;
  for (const double weight : {0.2, 0.5, 0.8}) {
    const automaton::Maneuver compromise = designed_for(weight, 1.0 - weight, true);
    EXPECT_EQ(compromise.label, "sum");
    const double share = (value_of("J1", compromise.criteria) - most_j1) / (least_j1 - most_j1);
    EXPECT_GT(share, last + 0.05);
    EXPECT_LT(share, 1.0);
    EXPECT_GT(value_of("J2", compromise.criteria), value_of("J2", softest.criteria) * 1.01);
    last = share;
  }
}

TEST(AutomatonBuilder, CriteriaThatDoNotContradictEachOtherAreNotNormalised) {
  AutomatonConfiguration configuration = automaton::paper_configuration();
  configuration.criteria = {{"same", {{"J2", 1.0}, {"travel_time", 1.0}}, true}};
  const automaton::Maneuver maneuver =
      design(configuration, {{automaton::pi(7), automaton::pi(8)}, 0});
  EXPECT_NEAR(value_of("J2", maneuver.criteria), 0.072, 1e-9);
}

TEST(AutomatonBuilder, RefusesAnEdgeThatTheLimitsDoNotAllow) {
  AutomatonConfiguration configuration = automaton::paper_configuration();
  configuration.source = "slow.yaml";
  configuration.places = {};  // as if it had not been read from a file
  configuration.limits.acceleration_mps2 = 3.0;
  try {
    (void)build_automaton(configuration);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "slow.yaml: maneuver 1 -> 5 (J2): speed 0 -> 0.7 m/s in 0.2 s needs acceleration "
                 "3.5 m/s^2, must be <= 3 m/s^2; shortest feasible duration 0.233333 s");
  }
}

}  // namespace
}  // namespace hlc::maneuver_design
