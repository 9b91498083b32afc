#include "planner/apps/priority_files.hpp"

#include <unistd.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "planner/common/csv.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kMillisecondsPerSecond = 1e3;

Json content_of(const scenario::Scenario& scenario, const PriorityPlan& plan,
                std::size_t num_runs) {
  return {{"scenario", scenario.name},
          {"profile", scenario.profile.name},
          {"subgraph", scenario.subgraph->spec().name},
          {"steps", scenario.steps},
          {"step_s", scenario.subgraph->automaton().step_s},
          {"horizon_steps", scenario.horizon_steps},
          {"max_levels", scenario.profile.strategies.priorities.max_levels},
          {"strategies", plan.strategies},
          {"cars", plan.cars},
          {"draws", plan.draws},
          {"runs", num_runs}};
}

std::string runs_csv(const std::vector<PriorityRun>& runs) {
  std::string text =
      "run,cars,strategy,draw,steps,planned,vehicle_steps,driven_m,deadlock_step,compared_steps,"
      "cost_m2,optimal_order_m2,worse_steps\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto& [cars, strategy, draw, trial] = runs[i];
    text += CsvLine(i, cars, strategy, draw, trial.step_s.size(), trial.planned,
                    trial.vehicle_steps, trial.driven_m, trial.deadlock_step, trial.compared_steps,
                    trial.cost_m2, trial.optimal_order_m2, trial.worse_steps)
                .text();
  }
  return text;
}

std::string steps_csv(const std::vector<PriorityRun>& runs) {
  std::string text = "run,step,step_ms,levels\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const rollout::PriorityTrial& trial = runs[i].trial;
    for (std::size_t step = 0; step < trial.step_s.size(); ++step) {
      text +=
          CsvLine(i, step, kMillisecondsPerSecond * trial.step_s[step], trial.levels[step]).text();
    }
  }
  return text;
}

std::string gaps_csv(const std::vector<PriorityRun>& runs) {
  std::string text = "run,vehicles,cost_m2,bound_m2\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (const coordination::JointGap& gap : runs[i].trial.gaps) {
      if (!gap.is_known) continue;
      text += CsvLine(i, gap.vehicles.size(), gap.cost_m2, gap.bound_m2).text();
    }
  }
  return text;
}

}  // namespace

void prepare_priority_folder(const fs::path& folder) {
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (!fs::is_directory(folder, error) || access(folder.c_str(), W_OK | X_OK) != 0) {
    throw std::invalid_argument("--out = " + one_line(folder.string()) +
                                ", must be a folder that can be written");
  }
}

void write_priority_files(const fs::path& folder, const EvaluationOrigin& origin,
                          const scenario::Scenario& scenario, const PriorityPlan& plan,
                          const std::vector<PriorityRun>& runs) {
  write_file(folder / "runs.csv", runs_csv(runs));
  write_file(folder / "steps.csv", steps_csv(runs));
  write_file(folder / "gaps.csv", gaps_csv(runs));
  write_file(folder / "campaign.json",
             campaign_json("priorities", origin, content_of(scenario, plan, runs.size())));
}

}  // namespace hlc::apps
