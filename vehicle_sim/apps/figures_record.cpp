#include "vehicle_sim/apps/figures_record.hpp"

#include <utility>

namespace hlc::apps {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
struct Column {
  const char* key;
  Value campaign::RunFigures::*value;
};

constexpr Column<std::optional<double>> kMaybe[] = {
    {"lap_s", &campaign::RunFigures::lap_s},
    {"error_mean_mm", &campaign::RunFigures::error_mean_mm},
    {"error_std_mm", &campaign::RunFigures::error_std_mm},
    {"driven_error_mean_mm", &campaign::RunFigures::driven_error_mean_mm},
    {"driven_error_std_mm", &campaign::RunFigures::driven_error_std_mm},
    {"effort_per_m", &campaign::RunFigures::effort_per_m},
    {"comfort_per_m", &campaign::RunFigures::comfort_per_m},
    {"above_limit_share", &campaign::RunFigures::above_limit_share},
    {"clearly_above_limit_share", &campaign::RunFigures::clearly_above_limit_share},
    {"above_limit_max_mps", &campaign::RunFigures::above_limit_max_mps}};

constexpr Column<double> kOfAll[] = {
    {"generated_max", &campaign::RunFigures::generated_max},
    {"generated_sum_max", &campaign::RunFigures::generated_sum_max},
    {"expanded_max", &campaign::RunFigures::expanded_max},
    {"expanded_sum_max", &campaign::RunFigures::expanded_sum_max},
    {"deviation_max_mm", &campaign::RunFigures::deviation_max_mm},
    {"longest_wait_s", &campaign::RunFigures::longest_wait_s}};

constexpr Column<std::size_t> kCounts[] = {
    {"fallback_steps", &campaign::RunFigures::fallback_steps},
    {"collisions", &campaign::RunFigures::collisions},
    {"switches", &campaign::RunFigures::switches},
    {"stuck_vehicles", &campaign::RunFigures::stuck_vehicles}};

constexpr Column<double> kTimes[] = {
    {"planning_mean_ms", &campaign::RunFigures::planning_mean_ms},
    {"planning_std_ms", &campaign::RunFigures::planning_std_ms},
    {"planning_max_ms", &campaign::RunFigures::planning_max_ms},
    {"exceeding_step_share", &campaign::RunFigures::exceeding_step_share},
    {"step_p99_ms", &campaign::RunFigures::step_p99_ms},
    {"step_max_ms", &campaign::RunFigures::step_max_ms},
    {"wall_s", &campaign::RunFigures::wall_s},
    {"wall_planning_s", &campaign::RunFigures::wall_planning_s},
    {"wall_coordination_s", &campaign::RunFigures::wall_coordination_s},
    {"wall_vehicles_s", &campaign::RunFigures::wall_vehicles_s}};

}  // namespace

Json figures_record(const campaign::RunFigures& figures) {
  Json record;
  for (const auto& [key, value] : kMaybe) {
    record[key] = figures.*value ? Json(*(figures.*value)) : Json(nullptr);
  }
  for (const auto& [key, value] : kOfAll) record[key] = figures.*value;
  for (const auto& [key, value] : kCounts) record[key] = figures.*value;
  record["subgraph_shares"] = figures.subgraph_shares;
  if (figures.wall_s > 0.0) {
    for (const auto& [key, value] : kTimes) record[key] = figures.*value;
  }
  return record;
}

campaign::RunFigures read_figures(const Json& record, campaign::RunFigures heading) {
  campaign::RunFigures figures = std::move(heading);
  for (const auto& [key, value] : kMaybe) {
    if (!record.at(key).is_null()) figures.*value = record.at(key).get<double>();
  }
  for (const auto& [key, value] : kOfAll) figures.*value = record.at(key).get<double>();
  for (const auto& [key, value] : kCounts) figures.*value = record.at(key).get<std::size_t>();
  figures.subgraph_shares = record.at("subgraph_shares").get<std::map<std::string, double>>();
  if (record.contains("wall_s")) {
    for (const auto& [key, value] : kTimes) figures.*value = record.at(key).get<double>();
  }
  return figures;
}

campaign::RunFigures figures_of_record(const Json& record, campaign::RunFigures heading) {
  campaign::RunFigures figures = std::move(heading);
  const Json& failure = record.at("failure");
  if (record.contains("figures") || failure.is_null()) {
    figures = read_figures(record.at("figures"), std::move(figures));
  }
  if (!failure.is_null()) figures.failure = failure.get<std::string>();
  return figures;
}

}  // namespace hlc::apps
