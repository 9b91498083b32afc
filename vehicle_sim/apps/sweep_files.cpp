#include "vehicle_sim/apps/sweep_files.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "hlc_bridge/record/program.hpp"
#include "planner/common/demand.hpp"
#include "planner/common/text_file.hpp"
#include "vehicle_sim/apps/figures_record.hpp"
#include "vehicle_sim/apps/input_files.hpp"
#include "vehicle_sim/apps/row_tables.hpp"

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

/// Numbers from 1, as in the setting `trims`.
Json numbers(const std::vector<TrimId>& trims) {
  Json list = Json::array();
  for (const TrimId trim : trims) list.push_back(trim.index + 1);
  return list;
}

/// The trims of the configuration's subgraphs, and which trims move.
Json trims_of(const campaign::Sweep& sweep) {
  Json offered = Json::object();
  for (const automaton::SubgraphSpec& spec : sweep.offered_subgraphs()) {
    offered[spec.name] = numbers(spec.trims);
  }
  return {{"offered", std::move(offered)}, {"moving", numbers(sweep.moving_trims())}};
}

/// What was swept, for campaign.json.
Json content_of(const campaign::Sweep& sweep) {
  const campaign::SweepPlan& plan = sweep.plan();
  Json content{{"file", plan.file.filename().string()},
               {"scenarios", Json::array()},
               {"subgraphs", plan.subgraphs},
               {"starts", plan.starts},
               {"combinations", sweep.combinations().size()},
               {"automata", sweep.num_automata()},
               {"settings", Json::array()},
               {"tables", Json::array()},
               {"trims", trims_of(sweep)}};
  for (const auto& file : plan.scenarios) content["scenarios"].push_back(file.stem().string());
  for (const campaign::SweepAxis& axis : plan.axes) {
    Json values = Json::array();
    for (const campaign::SweepValue& value : axis.values) values.push_back(value.text);
    content["settings"].push_back({{"name", axis.setting}, {"values", std::move(values)}});
  }
  for (const std::vector<std::size_t>& table : plan.tables) {
    Json names = Json::array();
    for (const std::size_t axis : table) names.push_back(plan.axes[axis].setting);
    content["tables"].push_back(std::move(names));
  }
  return content;
}

/// Of runs.csv, with `set.` before the names: a setting may be named like a column.
std::vector<std::string> setting_columns(const campaign::SweepPlan& plan) {
  std::vector<std::string> names{"combination"};
  for (const campaign::SweepAxis& axis : plan.axes) names.push_back("set." + axis.setting);
  return names;
}

std::vector<std::string> setting_values(const campaign::Sweep& sweep, std::size_t run) {
  const std::size_t number = sweep.runs()[run].combination;
  std::vector<std::string> values{std::to_string(number)};
  for (const campaign::SweepAxis& axis : sweep.plan().axes) {
    values.push_back(value_of(sweep.plan(), sweep.combinations()[number], axis.setting)->text);
  }
  return values;
}

}  // namespace

SweepFiles::SweepFiles(std::filesystem::path folder, const campaign::Sweep& sweep)
    : sweep_(sweep), log_(std::move(folder), heading_of(sweep).dump()) {
  log_.check(sweep.runs().size(), [this](std::size_t run, const Json& record) {
    static_cast<void>(figures_of(sweep_, run, record));
  });
  log_.check_outputs({"campaign.json", "runs.csv"});
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

void SweepFiles::finish(const EvaluationOrigin& origin) const {
  HLC_DEMAND(log_.size() == sweep_.runs().size(), log_.size(), sweep_.runs().size());
  std::vector<RunRow> rows;
  for (const auto& [run, line] : log_.records()) {
    const Json record = Json::parse(line);
    rows.push_back({.run = run,
                    .settings = setting_values(sweep_, run),
                    .figures = figures_of(sweep_, run, record),
                    .was_driven = record.contains("figures")});
  }
  write_file(log_.folder() / "runs.csv", runs_csv(setting_columns(sweep_.plan()), rows, false));
  write_file(log_.folder() / "campaign.json", campaign_json("sweep", origin, content_of(sweep_)));
}

}  // namespace hlc::apps
