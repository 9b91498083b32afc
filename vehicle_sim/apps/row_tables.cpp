#include "vehicle_sim/apps/row_tables.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "planner/common/csv.hpp"
#include "planner/common/demand.hpp"
#include "vehicle_sim/apps/figures_record.hpp"

namespace hlc::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kIdentity[] = {"scenario", "profile", "subgraph", "policy", "start"};

/// A figure of a vehicle: its column, and its place in the vehicle's part of summary.json.
struct VehicleColumn {
  const char* name;
  const char* place;
};

constexpr VehicleColumn kVehicleColumns[] = {{"vehicle", "/id"},
                                             {"name", "/name"},
                                             {"lap_s", "/lap_s"},
                                             {"error_mean_mm", "/reference_error_mm/mean"},
                                             {"error_std_mm", "/reference_error_mm/std"},
                                             {"driven_error_mean_mm", "/driven_error_mm/mean"},
                                             {"driven_error_std_mm", "/driven_error_mm/std"},
                                             {"tracking_error_mean_mm", "/tracking_error_mm/mean"},
                                             {"generated_mean", "/generated_vertices/mean"},
                                             {"generated_max", "/generated_vertices/max"},
                                             {"expanded_mean", "/expanded_vertices/mean"},
                                             {"expanded_max", "/expanded_vertices/max"},
                                             {"planning_mean_ms", "/planning_time_ms/mean"},
                                             {"planning_max_ms", "/planning_time_ms/max"},
                                             {"fallback_steps", "/fallback_steps"},
                                             {"deadline_misses", "/deadline_misses"},
                                             {"longest_wait_s", "/longest_wait/duration_s"}};

std::string text_of(const Json& value) {
  if (value.is_null()) return "";
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Empty if there is nothing in this place.
std::string text_at(const Json& record, const Json::json_pointer& place) {
  return record.contains(place) ? text_of(record.at(place)) : "";
}

/// The part of a row of runs.csv that follows its identity.
void add_figures(const RunRow& row, const std::vector<std::string>& keys,
                 const std::set<std::string>& subgraphs, CsvLine& line) {
  if (!row.was_driven) {
    for (std::size_t i = 0; i < keys.size() + subgraphs.size(); ++i) line.add("");
    return;
  }
  const Json record = figures_record(row.figures);
  for (const std::string& key : keys) line.add(text_at(record, Json::json_pointer("/" + key)));
  for (const std::string& name : subgraphs) {
    const auto share = row.figures.subgraph_shares.find(name);
    line.add(share == row.figures.subgraph_shares.end() ? 0.0 : share->second);
  }
}

/// The rows of one record.
std::string car_rows(const Json& record) {
  std::string text;
  const Json& stuck = record.at("stuck_vehicles");
  for (const Json& vehicle : record.at("vehicles")) {
    CsvLine line(text_of(record.at("run")));
    for (const char* name : kIdentity) line.add(text_of(record.at(name)));
    for (const VehicleColumn& column : kVehicleColumns) {
      line.add(text_at(vehicle, Json::json_pointer(column.place)));
    }
    line.add(std::ranges::find(stuck, vehicle.at("id")) != stuck.end() ? "true" : "false");
    text += line.text();
  }
  return text;
}

constexpr char kShares[] = "subgraph_shares";

/// The names of all subgraphs that any run planned on.
std::set<std::string> planned_subgraphs(const std::vector<RunRow>& rows) {
  std::set<std::string> names;
  for (const RunRow& row : rows) {
    for (const auto& [name, share] : row.figures.subgraph_shares) names.insert(name);
  }
  return names;
}

std::vector<std::string> figure_keys(bool has_times) {
  campaign::RunFigures figures;
  if (has_times) figures.wall_s = 1.0;
  const Json record = figures_record(figures);
  std::vector<std::string> keys;
  for (const auto& [key, value] : record.items()) {
    if (key != kShares) keys.push_back(key);
  }
  return keys;
}

}  // namespace

std::string runs_csv(const std::vector<std::string>& setting_names, const std::vector<RunRow>& rows,
                     bool has_times) {
  const std::vector<std::string> keys = figure_keys(has_times);
  const std::set<std::string> subgraphs = planned_subgraphs(rows);
  CsvLine heading("run");
  for (const std::string& name : setting_names) heading.add(name);
  for (const char* name : kIdentity) heading.add(name);
  heading.add("failure");
  for (const std::string& key : keys) heading.add(key);
  for (const std::string& name : subgraphs) heading.add("share." + name);
  std::string text = heading.text();
  for (const RunRow& row : rows) {
    HLC_DEMAND(row.settings.size() == setting_names.size());
    CsvLine line(row.run);
    for (const std::string& value : row.settings) line.add(value);
    const campaign::RunFigures& figures = row.figures;
    line.add(figures.scenario, figures.profile, figures.subgraph, figures.policy, figures.start,
             figures.failure);
    add_figures(row, keys, subgraphs, line);
    text += line.text();
  }
  return text;
}

std::string cars_csv(const std::vector<Json>& records) {
  CsvLine heading("run");
  for (const char* name : kIdentity) heading.add(name);
  for (const VehicleColumn& column : kVehicleColumns) heading.add(column.name);
  heading.add("is_stuck");
  std::string text = heading.text();
  for (const Json& record : records) {
    if (record.contains("vehicles")) text += car_rows(record);
  }
  return text;
}

}  // namespace hlc::apps
