#include "vehicle_sim/apps/evaluation_files.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "hlc_bridge/record/program.hpp"
#include "hlc_bridge/record/summary_file.hpp"
#include "hlc_bridge/record/text_file.hpp"
#include "planner/automaton/sha256.hpp"
#include "vehicle_sim/apps/json_number.hpp"

namespace hlc {
namespace {

using Json = nlohmann::ordered_json;

Json heading_of(const Campaign& campaign) {
  const CampaignPlan& plan = campaign.plan();
  Json json;
  json["scenarios"] = Json::array();
  for (const auto& file : plan.scenarios) {
    json["scenarios"].push_back(
        {{"file", file.filename().string()}, {"sha256", sha256_of(read_file(file))}});
  }
  json["profiles"] = plan.profiles;
  json["subgraphs"] = plan.subgraphs;
  json["starts"] = plan.starts;
  json["seed"] = plan.seed;
  json["steps"] = plan.steps ? Json(*plan.steps) : Json(nullptr);
  json["noise_seed"] = plan.noise_seed ? Json(*plan.noise_seed) : Json(nullptr);
  json["revision"] = program_revision();
  return json;
}

double number_or_0(const Json& json) { return number_or_none(json).value_or(0.0); }

/// Planning times of all vehicles together: mean and standard deviation of the joint sample.
void add_planning(const Json& vehicles, RunFigures& figures) {
  double mean = 0.0;
  double square = 0.0;
  double overlong = 0.0;
  const auto count = static_cast<double>(vehicles.size());
  for (const Json& vehicle : vehicles) {
    const Json& time = vehicle.at("planning_time_ms");
    const double own_mean = number_or_0(time.at("mean"));
    const double own_std = number_or_0(time.at("std"));
    mean += own_mean / count;
    square += (own_std * own_std + own_mean * own_mean) / count;
    figures.planning_max_ms = std::max(figures.planning_max_ms, number_or_0(time.at("max")));
    overlong += number_or_0(vehicle.at("overlong_plans"));
  }
  figures.planning_mean_ms = mean;
  figures.planning_std_ms = std::sqrt(std::max(0.0, square - mean * mean));
  figures.overlong_share = overlong;
}

double largest_deviation_mm(const RunSummary& summary) {
  double largest_m = 0.0;
  for (const VehicleSummary& vehicle : summary.vehicles) {
    largest_m = std::max(largest_m, vehicle.deviation_max_m.value_or(0.0));
  }
  return 1e3 * largest_m;
}

RunFigures figures_of(const Json& record) {
  RunFigures figures{.scenario = record.at("scenario").get<std::string>(),
                     .profile = record.at("profile").get<std::string>(),
                     .subgraph = record.at("subgraph").get<std::string>(),
                     .start = record.at("start").get<std::size_t>()};
  if (!record.at("failure").is_null()) {
    figures.failure = record.at("failure").get<std::string>();
    return figures;
  }
  const Json& vehicles = record.at("vehicles");
  const Json& first = vehicles.at(0);
  figures.lap_s = number_or_none(first.at("lap_s"));
  figures.error_mean_mm = number_or_none(first.at("reference_error_mm").at("mean"));
  figures.error_std_mm = number_or_none(first.at("reference_error_mm").at("std"));
  for (const Json& vehicle : vehicles) {
    figures.generated_max =
        std::max(figures.generated_max, number_or_0(vehicle.at("generated_vertices").at("max")));
    figures.expanded_max =
        std::max(figures.expanded_max, number_or_0(vehicle.at("expanded_vertices").at("max")));
    figures.fallback_steps += vehicle.at("fallback_steps").get<std::size_t>();
  }
  figures.generated_sum_max = number_or_0(record.at("generated_vertices_sum_max"));
  figures.expanded_sum_max = number_or_0(record.at("expanded_vertices_sum_max"));
  figures.collisions = record.at("collisions").get<std::size_t>();
  add_planning(vehicles, figures);
  figures.deviation_max_mm = number_or_0(record.at("deviation_max_mm"));
  const Json& wall = record.at("wall_shares_s");
  figures.wall_s = number_or_0(record.at("wall_s"));
  figures.wall_planning_s = number_or_0(wall.at("planning"));
  figures.wall_coordination_s = number_or_0(wall.at("coordination"));
  figures.wall_vehicles_s = number_or_0(wall.at("vehicles"));
  const double plans = number_or_0(record.at("steps")) *
                       static_cast<double>(std::max<std::size_t>(1, vehicles.size()));
  figures.overlong_share = plans > 0.0 ? figures.overlong_share / plans : 0.0;
  return figures;
}

}  // namespace

EvaluationFiles::EvaluationFiles(std::filesystem::path folder, const Campaign& campaign)
    : campaign_(campaign), log_(std::move(folder), heading_of(campaign).dump()) {}

void EvaluationFiles::add(std::size_t run, const CampaignResult& result) {
  Json record;
  record["run"] = run;
  record["start"] = campaign_.runs()[run].start;
  record["failure"] = result.fault.empty() ? Json(nullptr) : Json(result.fault);
  RunSummary complete = result.summary;
  complete.revision = program_revision();
  complete.host = this_host();
  record.update(Json::parse(summary_json(complete)));
  record["deviation_max_mm"] = largest_deviation_mm(result.summary);
  record["wall_shares_s"] = {{"planning", result.wall.planning_s},
                             {"coordination", result.wall.coordination_s},
                             {"vehicles", result.wall.vehicles_s}};
  log_.append(run, record.dump());
}

void EvaluationFiles::add_failure(std::size_t run, const std::string& reason) {
  const CampaignRun& spec = campaign_.runs()[run];
  Json record;
  record["run"] = run;
  record["start"] = spec.start;
  record["failure"] = reason;
  record["scenario"] = spec.scenario.stem().string();
  record["profile"] = spec.profile;
  record["subgraph"] = spec.subgraph.value_or("");
  log_.append(run, record.dump());
}

std::vector<RunFigures> EvaluationFiles::figures() const {
  std::vector<RunFigures> result;
  for (const auto& [run, line] : log_.records()) result.push_back(figures_of(Json::parse(line)));
  return result;
}

void EvaluationFiles::finish(const EvaluationOrigin& origin) const {
  Json results;
  results["campaign"] = Json::parse(log_.heading());
  results["runs"] = Json::array();
  for (const auto& [run, line] : log_.records()) results["runs"].push_back(Json::parse(line));
  write_file(log_.folder() / "results.json", results.dump(1) + "\n");
  const std::vector<RunFigures> runs = figures();
  write_file(log_.folder() / "table.md", evaluation_markdown(runs, origin));
  write_file(log_.folder() / "table.csv", evaluation_csv(runs));
}

}  // namespace hlc
