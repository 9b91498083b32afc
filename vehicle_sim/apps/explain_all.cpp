#include "vehicle_sim/apps/explain_all.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "hlc_bridge/apps/finished_run.hpp"
#include "hlc_bridge/record/explanation_file.hpp"
#include "planner/apps/progress_line.hpp"
#include "planner/common/text_file.hpp"
#include "vehicle_sim/apps/fork_folder.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::apps {
namespace {

/// Fills in the texts. @return rows of the run driven again
std::vector<result::StepRecord> explain(const record::RunFolder& run,
                                        std::vector<result::Explanation>& explanations) {
  closed_loop::ExperimentOptions options = options_of_run(run);
  const ProgressLine progress("explaining", explanations.size());
  std::size_t done = 0;
  options.after_step = [&](const controller::Controller& controller,
                           const policy::SubgraphSelector& chosen,
                           const coordination::Report& report) {
    const std::uint64_t step = report.step.value - *run.facts.first_step;
    const auto one = std::ranges::find_if(explanations, [&](const result::Explanation& wanted) {
      return wanted.step == step && wanted.vehicle == report.vehicle;
    });
    if (one == explanations.end()) return;
    one->text =
        explanation(explained_step(run, step, {.report = report, .ahead_m = ahead_m(controller)},
                                   answers_of(controller, chosen, report, run.scenario.policy)));
    progress.show(++done);
  };
  const closed_loop::Experiment experiment = closed_loop::drive_experiment(run.scenario, options);
  return result::step_records(experiment.reports, experiment.drives, experiment.facts);
}

}  // namespace

std::vector<VehicleId> others_in(std::span<const result::StepRecord> rows, std::uint64_t step,
                                 VehicleId own) {
  std::vector<VehicleId> others;
  for (const result::StepRecord& row : rows) {
    const VehicleId vehicle = row.record.report.vehicle;
    if (row.step == step && vehicle != own) others.push_back(vehicle);
  }
  return others;
}

ExplainedStep explained_step(const record::RunFolder& run, std::uint64_t step, StepOutcome outcome,
                             StepAnswers answers) {
  const VehicleId vehicle = outcome.report.vehicle;
  return {.name = scenario::vehicle_of(run.scenario, vehicle).name,
          .step = step,
          .step_s = run.description.step_s,
          .outcome = std::move(outcome),
          .others = others_in(run.rows, step, vehicle),
          .without_one = {},
          .without_all = {},
          .choice = std::move(answers.choice),
          .limits = std::move(answers.limits),
          .alone = std::move(answers.alone)};
}

std::size_t explain_all(record::RunFolder run) {
  const std::uint64_t recorded = record::recorded_steps(run);
  std::vector<result::Explanation> explanations =
      result::steps_to_explain(result::rows_before(run.rows, recorded));
  check_same_until(recorded, run, explain(run, explanations));
  write_file(record::explanations_file(run.folder), record::explanations_csv(explanations));
  write_page(std::move(run));
  return explanations.size();
}

}  // namespace hlc::apps
