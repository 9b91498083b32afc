#include "vehicle_sim/apps/evaluation_files.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "hlc_bridge/record/program.hpp"
#include "hlc_bridge/record/summary_file.hpp"
#include "vehicle_sim/apps/evaluation_results.hpp"
#include "vehicle_sim/apps/figures_record.hpp"
#include "vehicle_sim/apps/input_files.hpp"

namespace hlc::apps {
namespace {

using Json = nlohmann::ordered_json;

Json heading_of(const campaign::Campaign& campaign) {
  const campaign::CampaignPlan& plan = campaign.plan();
  Json json;
  json["format"] = kRowFormat;
  json["runs"] = campaign.runs().size();
  json["scenarios"] = Json::array();
  for (const auto& file : plan.scenarios) json["scenarios"].push_back(file.filename().string());
  json["files"] = input_files(campaign.files());
  json["profiles"] = plan.profiles;
  json["subgraphs"] = plan.subgraphs;
  json["policies"] = plan.policies;
  json["starts"] = plan.starts;
  json["seed"] = plan.seed;
  json["steps"] = plan.steps ? Json(*plan.steps) : Json(nullptr);
  if (plan.cars) json["cars"] = *plan.cars;
  if (plan.routes) json["routes"] = *plan.routes;
  json["noise_seed"] = plan.noise_seed ? Json(*plan.noise_seed) : Json(nullptr);
  json["revision"] = program_revision();
  json["program"] = this_program_sha256();
  return json;
}

}  // namespace

EvaluationFiles::EvaluationFiles(std::filesystem::path folder, const campaign::Campaign& campaign)
    : campaign_(campaign), log_(std::move(folder), heading_of(campaign).dump()) {
  log_.check(campaign.runs().size(),
             [](std::size_t, const Json& record) { static_cast<void>(figures_of_row(record)); });
  log_.check_outputs(result_files());
}

void EvaluationFiles::add(std::size_t run, const campaign::CampaignResult& result) {
  Json record;
  record["run"] = run;
  const campaign::RunFigures heading = campaign_.heading_of(run);
  record["start"] = heading.start;
  record["policy"] = heading.policy;
  record["failure"] = result.fault.empty() ? Json(nullptr) : Json(result.fault);
  result::RunSummary complete = result.summary;
  complete.revision = program_revision();
  complete.host = record::this_host();
  record.update(Json::parse(record::summary_json(complete)));
  record["figures"] = figures_record(campaign::with_figures(heading, result));
  log_.append(run, record.dump());
}

void EvaluationFiles::add_failure(std::size_t run, const std::string& reason) {
  const campaign::RunFigures heading = campaign_.heading_of(run);
  Json record;
  record["run"] = run;
  record["start"] = heading.start;
  record["policy"] = heading.policy;
  record["failure"] = reason;
  record["scenario"] = heading.scenario;
  record["profile"] = heading.profile;
  record["subgraph"] = heading.subgraph;
  log_.append(run, record.dump());
}

}  // namespace hlc::apps
