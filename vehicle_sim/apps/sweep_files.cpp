#include "vehicle_sim/apps/sweep_files.hpp"

#include <cassert>
#include <nlohmann/json.hpp>
#include <utility>

#include "hlc_bridge/record/program.hpp"
#include "hlc_bridge/record/text_file.hpp"
#include "planner/automaton/sha256.hpp"
#include "vehicle_sim/apps/json_number.hpp"
#include "vehicle_sim/campaign/sweep_report.hpp"

namespace hlc {
namespace {

using Json = nlohmann::ordered_json;

Json file_entry(const std::filesystem::path& file) {
  return {{"file", file.filename().string()}, {"sha256", sha256_of(read_file(file))}};
}

Json heading_of(const Sweep& sweep) {
  const SweepPlan& plan = sweep.plan();
  Json json;
  json["sweep"] = file_entry(plan.file);
  json["scenarios"] = Json::array();
  for (const std::filesystem::path& scenario : plan.scenarios) {
    json["scenarios"].push_back(file_entry(scenario));
  }
  json["automaton"] = file_entry(plan.automaton);
  json["revision"] = program_revision();
  return json;
}

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

/// The members of RunFigures that a record holds as numbers.
struct Column {
  const char* key;
  double RunFigures::*value;
};
constexpr Column kColumns[] = {{"generated_max", &RunFigures::generated_max},
                               {"generated_sum_max", &RunFigures::generated_sum_max},
                               {"expanded_max", &RunFigures::expanded_max},
                               {"expanded_sum_max", &RunFigures::expanded_sum_max},
                               {"deviation_max_mm", &RunFigures::deviation_max_mm}};

RunFigures figures_of(const Sweep& sweep, std::size_t run, const Json& record) {
  RunFigures figures = sweep.heading_of(run);
  if (!record.at("failure").is_null()) figures.failure = record.at("failure").get<std::string>();
  if (!record.contains("trace_sha256")) return figures;
  figures.lap_s = number_or_none(record.at("lap_s"));
  figures.error_mean_mm = number_or_none(record.at("error_mean_mm"));
  figures.error_std_mm = number_or_none(record.at("error_std_mm"));
  for (const Column& column : kColumns) {
    figures.*column.value = record.at(column.key).get<double>();
  }
  figures.fallback_steps = record.at("fallback_steps").get<std::size_t>();
  figures.collisions = record.at("collisions").get<std::size_t>();
  return figures;
}

}  // namespace

SweepFiles::SweepFiles(std::filesystem::path folder, const Sweep& sweep)
    : sweep_(sweep), log_(std::move(folder), heading_of(sweep).dump()) {}

void SweepFiles::add(std::size_t run, const SweepResult& result) {
  const RunFigures& figures = result.figures;
  Json record;
  record["run"] = run;
  record["failure"] = figures.failure.empty() ? Json() : Json(figures.failure);
  if (!result.trace_sha256.empty()) {
    record["lap_s"] = number_or_null(figures.lap_s);
    record["error_mean_mm"] = number_or_null(figures.error_mean_mm);
    record["error_std_mm"] = number_or_null(figures.error_std_mm);
    for (const Column& column : kColumns) record[column.key] = figures.*column.value;
    record["fallback_steps"] = figures.fallback_steps;
    record["collisions"] = figures.collisions;
    record["trace_sha256"] = result.trace_sha256;
  }
  log_.append(run, record.dump());
}

std::vector<RunFigures> SweepFiles::figures() const {
  assert(log_.size() == sweep_.runs().size());
  std::vector<RunFigures> result;
  for (const auto& [run, line] : log_.records()) {
    result.push_back(figures_of(sweep_, run, Json::parse(line)));
  }
  return result;
}

void SweepFiles::finish(const EvaluationOrigin& origin) const {
  const std::vector<RunFigures> runs = figures();
  write_file(log_.folder() / "sweep.csv", sweep_csv(sweep_, runs));
  write_file(log_.folder() / "sweep.md", sweep_markdown(sweep_, runs, origin));
}

}  // namespace hlc
