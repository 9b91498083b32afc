#include "vehicle_sim/apps/figures_record.hpp"

#include <utility>

namespace hlc {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
struct Column {
  const char* key;
  Value RunFigures::*value;
};

constexpr Column<std::optional<double>> kOfTheFirst[] = {
    {"lap_s", &RunFigures::lap_s},
    {"error_mean_mm", &RunFigures::error_mean_mm},
    {"error_std_mm", &RunFigures::error_std_mm},
    {"driven_error_mean_mm", &RunFigures::driven_error_mean_mm},
    {"driven_error_std_mm", &RunFigures::driven_error_std_mm}};

constexpr Column<double> kOfAll[] = {{"generated_max", &RunFigures::generated_max},
                                     {"generated_sum_max", &RunFigures::generated_sum_max},
                                     {"expanded_max", &RunFigures::expanded_max},
                                     {"expanded_sum_max", &RunFigures::expanded_sum_max},
                                     {"deviation_max_mm", &RunFigures::deviation_max_mm}};

constexpr Column<std::size_t> kCounts[] = {{"fallback_steps", &RunFigures::fallback_steps},
                                           {"collisions", &RunFigures::collisions}};

constexpr Column<double> kTimes[] = {{"planning_mean_ms", &RunFigures::planning_mean_ms},
                                     {"planning_std_ms", &RunFigures::planning_std_ms},
                                     {"planning_max_ms", &RunFigures::planning_max_ms},
                                     {"overlong_share", &RunFigures::overlong_share},
                                     {"wall_s", &RunFigures::wall_s},
                                     {"wall_planning_s", &RunFigures::wall_planning_s},
                                     {"wall_coordination_s", &RunFigures::wall_coordination_s},
                                     {"wall_vehicles_s", &RunFigures::wall_vehicles_s}};

}  // namespace

Json figures_record(const RunFigures& figures) {
  Json record;
  for (const auto& [key, value] : kOfTheFirst) {
    record[key] = figures.*value ? Json(*(figures.*value)) : Json(nullptr);
  }
  for (const auto& [key, value] : kOfAll) record[key] = figures.*value;
  for (const auto& [key, value] : kCounts) record[key] = figures.*value;
  if (figures.wall_s > 0.0) {
    for (const auto& [key, value] : kTimes) record[key] = figures.*value;
  }
  return record;
}

RunFigures read_figures(const Json& record, RunFigures heading) {
  RunFigures figures = std::move(heading);
  for (const auto& [key, value] : kOfTheFirst) {
    if (!record.at(key).is_null()) figures.*value = record.at(key).get<double>();
  }
  for (const auto& [key, value] : kOfAll) figures.*value = record.at(key).get<double>();
  for (const auto& [key, value] : kCounts) figures.*value = record.at(key).get<std::size_t>();
  if (record.contains("wall_s")) {
    for (const auto& [key, value] : kTimes) figures.*value = record.at(key).get<double>();
  }
  return figures;
}

RunFigures figures_of_record(const Json& record, RunFigures heading) {
  RunFigures figures = std::move(heading);
  const Json& failure = record.at("failure");
  if (record.contains("figures") || failure.is_null()) {
    figures = read_figures(record.at("figures"), std::move(figures));
  }
  if (!failure.is_null()) figures.failure = failure.get<std::string>();
  return figures;
}

}  // namespace hlc
