#include "vehicle_sim/apps/drive_campaign.hpp"

#include <fmt/format.h>

#include <exception>
#include <optional>
#include <string>

#include "vehicle_sim/apps/clocks.hpp"
#include "vehicle_sim/apps/missing_runs.hpp"
#include "vehicle_sim/run_folder/run_folder.hpp"

namespace hlc::apps {
namespace {

std::filesystem::path folder_of_run(const EvaluationFiles& files, std::size_t run) {
  return files.folder() / "runs" / fmt::to_string(run);
}

}  // namespace

void drive_campaign(const campaign::Campaign& campaign, const DriveChoices& choices,
                    EvaluationFiles& files) {
  const auto is_done = [&](std::size_t run) {
    return files.has(run) &&
           (!choices.keep_runs || run_folder::is_whole_run_folder(folder_of_run(files, run)));
  };
  const auto drive = [&](std::size_t run) {
    std::optional<campaign::DrivenRun> driven;
    std::optional<campaign::CampaignResult> result;
    std::string failure;
    try {
      driven = campaign.drive(run, machine_clocks());
      result = campaign.result_of(*driven);
    } catch (const std::exception& error) {
      failure = error.what();
    }
    // Outside the try block: a folder or record that cannot be written is no failure of the run.
    if (choices.keep_runs && driven) {
      run_folder::write_run_folder(folder_of_run(files, run), driven->scenario,
                                   campaign.plan().noise_seed, driven->experiment);
    }
    if (result) {
      files.add(run, *result);
    } else {
      files.add_failure(run, failure);
    }
  };
  for_each_number(missing_runs(runs_of(choices.shard, campaign.runs().size()), is_done), "run",
                  choices.jobs, drive);
}

}  // namespace hlc::apps
