#include "vehicle_sim/run_folder/run_folder.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "hlc_bridge/record/certificate_file.hpp"
#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/record/drive_file.hpp"
#include "hlc_bridge/record/facts_file.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "planner/common/text_file.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "vehicle_sim/run_folder/drive_recorder.hpp"

namespace hlc::run_folder {
namespace {

std::filesystem::path facts_file(const std::filesystem::path& folder) {
  return folder / "run.json";
}

}  // namespace

void write_configuration(const std::filesystem::path& folder, const scenario::Scenario& scenario,
                         std::optional<std::uint64_t> noise_seed) {
  record::keep_configuration(folder, scenario::files_of(scenario));
  const bool is_drawn = !scenario.candidates.empty();
  const bool is_random = scenario.random_routes_on != nullptr;
  const auto if_any = [](bool is_any, auto value) {
    return is_any ? std::optional(value) : std::nullopt;
  };
  const scenario::ScenarioChoices choices{
      .file = scenario.file,
      .profile = scenario.profile.name,
      .engine = scenario::engine_name(scenario.search),
      .priorities = std::string(scenario.profile.strategies.priorities.strategy->name),
      .subgraph = scenario.subgraph->spec().name,
      .policy = scenario.policy,
      .map_file = scenario.map_file,
      .steps = scenario.steps,
      .cars = if_any(is_drawn || !scenario.map_file, scenario.vehicles.size()),
      .seed = if_any(is_drawn || is_random, scenario.seed),
      .routes = if_any(is_random, std::string(scenario::kRandomRoutes))};
  write_file(
      folder / "configuration" / "flags.yaml",
      record::flags_yaml(choices) +
          fmt::format("noise_seed: {}\n", noise_seed ? fmt::to_string(*noise_seed) : "null"));
}

void write_run_folder(const std::filesystem::path& folder, const scenario::Scenario& scenario,
                      std::optional<std::uint64_t> noise_seed,
                      const closed_loop::Experiment& experiment) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": cannot be created");
  write_configuration(folder, scenario, noise_seed);
  write_records(folder, experiment);
}

void write_records(const std::filesystem::path& folder, const closed_loop::Experiment& experiment) {
  const auto refuse = [](const std::string& line) { throw std::runtime_error(line); };
  for (const auto& [id, drive] : experiment.drives) {
    DriveRecorder file(record::drive_file(folder, id).string(), refuse);
    for (const result::DrivenSample& sample : drive) file.write(sample);
    file.close();
  }
  record::ReportFile reports(folder / "reports.csv", refuse);
  record::CertificateFile certificates(folder / "certificates.csv", refuse);
  for (const ReportRecord& record : experiment.reports) {
    reports.append(record);
    certificates.append(record);
  }
  reports.finish();
  certificates.close();
  write_file(facts_file(folder), record::facts_json(experiment.facts));
}

// The facts are written last.
bool is_whole_run_folder(const std::filesystem::path& folder) {
  return std::filesystem::exists(facts_file(folder));
}

}  // namespace hlc::run_folder
