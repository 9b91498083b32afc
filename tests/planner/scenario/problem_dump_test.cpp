// Every planning step of a run can be replayed from its file.
#include "planner/scenario/problem_dump.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <ostream>
#include <random>
#include <set>

#include "planner/automaton/requested_subgraph.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/problem_file.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::scenario::problem_dump_test {
namespace {

namespace fs = std::filesystem;

const std::string kFolder = test::source_folder() + "/launch_scripts/scenarios/";

/// What one step of a vehicle came to.
struct Decision {
  coordination::Report report;
  std::vector<TrimId> trims;  ///< after each step; empty unless the new plan is in force
};

search::SearchResult solved(const ProblemFile& file, const automaton::ReachableSets& reachable,
                            search::Engine engine) {
  search::SearchOptions options = file.search;
  options.engine = engine;
  return search::make_search_engine(*file.subgraph, reachable, options)->search(file.problem);
}

std::vector<TrimId> trims_of(const search::SearchResult& result) {
  std::vector<TrimId> trims;
  for (const automaton::Maneuver* maneuver : result.maneuvers) trims.push_back(maneuver->to);
  return trims;
}

struct Drive {
  std::string name;
  ScenarioChoices choices;
  /// Below 0: every plan's areas are those of its predicted drive, so that some meet what the
  /// search kept clear of, and a second search follows.
  double tolerated_drift_share{controller::DeviationRules{}.tolerated_drift_share};
};
void PrintTo(const Drive& one, std::ostream* out) { *out << one.name; }

class ProblemDumpTest : public testing::TestWithParam<Drive> {
 protected:
  const test::TemporaryFolder folder_;
};

TEST_P(ProblemDumpTest, EveryDecisionIsSolvedAgainAlike) {
  const Scenario scenario = read_scenario(GetParam().choices);
  ProblemDump dump(folder_ / "made" / "on_the_way", scenario.automaton_file,
                   scenario.subgraph->spec());
  std::vector<std::unique_ptr<controller::Controller>> controllers;
  std::vector<Pose> starts;
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    controller::ControllerOptions options = make_controller(scenario, vehicle.id)->options();
    options.deviation.tolerated_drift_share = GetParam().tolerated_drift_share;
    controllers.push_back(std::make_unique<controller::Controller>(options, scenario.subgraph,
                                                                   vehicle.path, vehicle.corridor));
    starts.push_back(vehicle.start);
  }
  rollout::Rollout rollout(std::move(controllers), starts);
  std::map<std::string, Decision> decisions;  // by the begin of the file's name
  std::size_t num_lane_entries = 0;
  for (std::size_t i = 0; i < scenario.steps; ++i) {
    for (const coordination::Report& report : rollout.step()) {
      Decision decision{.report = report, .trims = {}};
      for (const auto& controller : rollout.controllers()) {
        if (controller->options().vehicle != report.vehicle) continue;
        dump.write(*controller);
        num_lane_entries += controller->entry_problems().size();
        for (std::size_t j = 0; j < scenario.horizon_steps; ++j) {
          if (report.status != coordination::StepStatus::kPlanned) break;
          decision.trims.push_back(
              controller->plan_in_force().trim_at({report.step.value + 2 + j}));
        }
      }
      char name[64];
      std::snprintf(name, sizeof(name), "vehicle_%u_step_%010llu", unsigned{report.vehicle.value},
                    static_cast<unsigned long long>(report.step.value));
      decisions[name] = decision;
    }
  }

  const automaton::ReachableSets reachable(*scenario.subgraph, scenario.horizon_steps);
  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> counts;
  std::size_t with_incumbent = 0;
  std::size_t num_searches = 0;
  const std::set<fs::path> files{fs::directory_iterator(folder_ / "made" / "on_the_way"), {}};
  for (const fs::path& path : files) {
    SCOPED_TRACE(path.filename());
    const ProblemFile file = read_problem_file(path, scenario.subgraph);
    if (path.stem().string().find("_lane_entry_") != std::string::npos) {
      EXPECT_NE(solved(file, reachable, file.search.engine).status,
                search::SearchStatus::kFallback);
      continue;
    }
    ++num_searches;
    if (!file.problem.incumbent.empty()) ++with_incumbent;
    const std::string step = path.stem().string().substr(0, path.stem().string().find("_search"));
    const Decision& decision = decisions.at(step);
    const search::SearchResult again = solved(file, reachable, file.search.engine);
    counts[step].first += again.generated;
    counts[step].second += again.expanded;
    const int number =
        std::stoi(path.stem().string().substr(step.size() + std::string("_search_").size()));
    const bool is_last =
        !files.contains(path.parent_path() / fmt::format("{}_search_{}.json", step, number + 1));
    if (decision.report.status == coordination::StepStatus::kPlanned && is_last) {
      EXPECT_EQ(again.cost, decision.report.cost_m2);
      EXPECT_EQ(trims_of(again), decision.trims);
    }
    if (file.search.cost_to_go != search::CostToGo::kReachable) continue;
    for (const search::Engine engine :
         {search::Engine::kBestFirst, search::Engine::kBranchAndBound}) {
      const search::SearchResult other = solved(file, reachable, engine);
      EXPECT_EQ(other.status, again.status);
      EXPECT_NEAR(other.cost, again.cost, 1e-9);
    }
  }
  EXPECT_EQ(counts.size(), decisions.size()) << "every step of a free drive is searched";
  for (const auto& [step, count] : counts) {
    EXPECT_EQ(count.first, decisions.at(step).report.generated) << step;
    EXPECT_EQ(count.second, decisions.at(step).report.expanded) << step;
  }
  EXPECT_EQ(with_incumbent, scenario.profile.name == "2022" ? 0U : num_searches);
  EXPECT_EQ(files.size(), num_searches + num_lane_entries);
  const bool has_lanes = !scenario.vehicles.front().corridor.bounds().empty();
  EXPECT_EQ(num_lane_entries > 0, has_lanes) << "cars departed without a problem";
  if (GetParam().tolerated_drift_share < 0.0) {
    EXPECT_GT(num_searches, counts.size()) << "steps with a second search";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Drives, ProblemDumpTest,
    testing::Values(
        Drive{"ThreeCars", {.file = kFolder + "paper_three_cars.yaml", .steps = 30}},
        Drive{"RulesOf2022",
              {.file = kFolder + "paper_three_cars.yaml", .profile = "2022", .steps = 30}},
        Drive{"Circle", {.file = kFolder + "circle.yaml", .steps = 40, .cars = 10}, -1.0}),
    [](const auto& drive) { return drive.param.name; });

/// The base's automaton with its J2 maneuvers also as those of weights, as if designed for them.
std::shared_ptr<const automaton::UniversalAutomaton> with_weights(
    const automaton::Subgraph& base, const std::vector<CriterionWeight>& weights) {
  auto larger = std::make_shared<automaton::UniversalAutomaton>(base.automaton());
  for (automaton::Maneuver maneuver : base.automaton().maneuvers) {
    if (maneuver.label != "J2") continue;
    maneuver.label = automaton::label_of(weights);
    larger->maneuvers.push_back(std::move(maneuver));
  }
  return larger;
}

std::shared_ptr<const automaton::Subgraph> random_subgraph(const Scenario& scenario,
                                                           std::mt19937_64& random) {
  const std::vector<CriterionWeight> weights{{"J1", 0.3}, {"J2", 0.7}};
  const std::vector<SubgraphRequest> requests{{},
                                              {.labels = {"J1"}},
                                              {.labels = {"J3"}, .max_speed_mps = 0.6},
                                              {.max_speed_mps = 0.4, .disable_trims = {{2}}},
                                              {.weights = weights}};
  const SubgraphRequest& request = requests[random() % requests.size()];
  return automaton::requested_subgraph(
      *scenario.subgraph, request, scenario.horizon_steps,
      request.weights.empty() ? nullptr : with_weights(*scenario.subgraph, weights));
}

TEST(ProblemDump, EveryDecisionAfterRequestsIsSolvedAgainAlikeByItsFilesAlone) {
  const Scenario scenario = read_scenario({.file = kFolder + "on_request.yaml"});
  std::size_t num_after_requests = 0;
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(3); ++seed) {
    std::mt19937_64 random(seed);
    const test::TemporaryFolder folder;
    ProblemDump dump(folder.path(), scenario.automaton_file, scenario.subgraph->spec());
    rollout::Rollout rollout = rollout::make_rollout(scenario);
    for (std::size_t step = 0; step < 40; ++step) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", step " << step);
      controller::Controller& controller = *rollout.controllers().front();
      if (step > 4 && random() % 3 == 0) controller.switch_to(random_subgraph(scenario, random));
      const coordination::Report report = rollout.step().front();
      dump.write(controller);
      std::uint64_t generated = 0;
      std::uint64_t expanded = 0;
      for (std::size_t number = 1; number <= controller.problems().size(); ++number) {
        const ProblemFile file = read_problem_file(
            folder / fmt::format("vehicle_{}_step_{:010}_search_{}.json", report.vehicle.value,
                                 report.step.value, number));
        const automaton::ReachableSets reachable(*file.subgraph, file.problem.horizon_steps());
        const search::SearchResult again = solved(file, reachable, file.search.engine);
        generated += again.generated;
        expanded += again.expanded;
        const fs::path& of = file.automaton_file.parent_path();
        num_after_requests += of == folder.path() ? 1U : 0U;
      }
      EXPECT_EQ(generated, report.generated);
      EXPECT_EQ(expanded, report.expanded);
    }
  }
  EXPECT_GT(num_after_requests, 10U);
}

TEST(ProblemDump, SeveralOfThemMayWriteIntoOneFolder) {
  const Scenario scenario = read_scenario({.file = kFolder + "on_request.yaml"});
  const test::TemporaryFolder folder;
  std::map<fs::path, double> limits_mps;
  for (const double limit_mps : {0.4, 0.6}) {
    ProblemDump dump(folder.path(), scenario.automaton_file, scenario.subgraph->spec());
    rollout::Rollout rollout = rollout::make_rollout(scenario);
    controller::Controller& controller = *rollout.controllers().front();
    controller.switch_to(automaton::requested_subgraph(
        *scenario.subgraph, {.max_speed_mps = limit_mps}, scenario.horizon_steps));
    for (std::size_t step = 0; step < (limit_mps < 0.5 ? 1U : 2U); ++step) {
      static_cast<void>(rollout.step());
    }
    dump.write(controller);
    limits_mps[folder / fmt::format("vehicle_1_step_{:010}_search_1.json",
                                    controller.last_step().value)] = limit_mps;
  }
  ASSERT_EQ(limits_mps.size(), 2U);
  for (const auto& [file, limit_mps] : limits_mps) {
    EXPECT_EQ(read_problem_file(file).subgraph->spec().max_speed_mps, limit_mps) << file;
  }
}

TEST(ProblemDumpErrors, AFolderThatCannotBeMadeIsNamed) {
  try {
    const ProblemDump dump("/proc/nowhere", "paper.yaml", {});
    FAIL() << "made";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()),
              "folder of the planning problems = /proc/nowhere, must be a folder that can be "
              "created and written to");
  }
}

}  // namespace
}  // namespace hlc::scenario::problem_dump_test
