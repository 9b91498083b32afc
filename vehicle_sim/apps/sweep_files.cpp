#include "vehicle_sim/apps/sweep_files.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "hlc_bridge/record/program.hpp"
#include "planner/common/demand.hpp"
#include "planner/common/text_file.hpp"
#include "vehicle_sim/apps/figures_record.hpp"
#include "vehicle_sim/apps/input_files.hpp"
#include "vehicle_sim/campaign/sweep_csv.hpp"
#include "vehicle_sim/campaign/sweep_report.hpp"
#include "vehicle_sim/campaign/sweep_tables.hpp"

namespace hlc::apps {
namespace {

using Json = nlohmann::ordered_json;

Json heading_of(const campaign::Sweep& sweep) {
  Json json;
  json["sweep"] = sweep.plan().file.filename().string();
  json["files"] = input_files(sweep.files());
  json["revision"] = program_revision();
  json["program"] = this_program_sha256();
  return json;
}

campaign::RunFigures figures_of(const campaign::Sweep& sweep, std::size_t run, const Json& record) {
  return figures_of_record(record, sweep.heading_of(run));
}

}  // namespace

SweepFiles::SweepFiles(std::filesystem::path folder, const campaign::Sweep& sweep)
    : sweep_(sweep), log_(std::move(folder), heading_of(sweep).dump()) {
  log_.check(sweep.runs().size(), [this](std::size_t run, const Json& record) {
    static_cast<void>(figures_of(sweep_, run, record));
  });
  log_.check_outputs({"sweep.csv", "tables.csv", "sweep.md"});
}

void SweepFiles::add(std::size_t run, const campaign::SweepResult& result) {
  const campaign::RunFigures& figures = result.figures;
  Json record;
  record["run"] = run;
  record["failure"] = figures.failure.empty() ? Json() : Json(figures.failure);
  if (!result.trace_sha256.empty()) {
    record["figures"] = figures_record(figures);
    record["trace_sha256"] = result.trace_sha256;
  }
  log_.append(run, record.dump());
}

std::vector<campaign::RunFigures> SweepFiles::figures() const {
  HLC_DEMAND(log_.size() == sweep_.runs().size(), log_.size(), sweep_.runs().size());
  std::vector<campaign::RunFigures> result;
  for (const auto& [run, line] : log_.records()) {
    result.push_back(figures_of(sweep_, run, Json::parse(line)));
  }
  return result;
}

void SweepFiles::finish(const campaign::EvaluationOrigin& origin) const {
  const std::vector<campaign::RunFigures> runs = figures();
  write_file(log_.folder() / "sweep.csv", campaign::sweep_csv(sweep_, runs));
  write_file(log_.folder() / "tables.csv", campaign::sweep_tables_csv(sweep_, runs));
  write_file(log_.folder() / "sweep.md", campaign::sweep_markdown(sweep_, runs, origin));
}

}  // namespace hlc::apps
