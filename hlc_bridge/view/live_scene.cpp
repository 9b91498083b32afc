#include "hlc_bridge/view/live_scene.hpp"

#include <algorithm>
#include <array>

namespace hlc::view {
namespace {

enum Channel : std::size_t { kMap, kCars, kPlans, kReports };

using Parts = std::map<std::uint8_t, std::pair<Json, Nanoseconds>>;

/// The parts of all vehicles in one array, and the newest of their times.
std::pair<Json, Nanoseconds> joined(Parts& parts) {
  Json all = Json::array();
  Nanoseconds newest = 0;
  for (auto& [id, part] : std::exchange(parts, {})) {
    all.push_back(std::move(part.first));
    newest = std::max(newest, part.second);
  }
  return {std::move(all), newest};
}

Json ids_json(const std::vector<VehicleId>& vehicles) {
  Json ids = Json::array();
  for (const VehicleId id : vehicles) ids.push_back(id.value);
  return ids;
}

Json report_json(const ReportRecord& record) {
  const coordination::Report& report = record.report;
  const Pose& pose = report.planned_pose;
  return {{"vehicle", report.vehicle.value},
          {"step", report.step.value},
          {"status", coordination::to_string(report.status)},
          {"reason", coordination::to_string(report.reason)},
          {"quality", coordination::to_string(report.quality)},
          {"planned", {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"heading_rad", pose.heading_rad}}},
          {"maneuver", report.maneuver},
          {"subgraph", report.subgraph},
          {"cost_m2", report.cost_m2},
          {"deviation_m", report.deviation_m},
          {"planning_ms", 1e-6 * static_cast<double>(record.planning_ns)},
          {"is_late", record.deadline_missed},
          {"coupled", ids_json(report.coupled)},
          {"missing", ids_json(report.missing)},
          {"waits_for", ids_json(report.waiting.vehicles)},
          {"blocked_by", ids_json(report.blocked_by)}};
}

std::string report_schema() {
  const Json number{{"type", "number"}};
  const Json text{{"type", "string"}};
  const Json numbers{{"type", "array"}, {"items", number}};
  return schema_text("hlc.Reports", {{"reports",
                                      {{"type", "array"},
                                       {"items",
                                        {{"type", "object"},
                                         {"properties",
                                          {{"vehicle", number},
                                           {"step", number},
                                           {"status", text},
                                           {"reason", text},
                                           {"cost_m2", number},
                                           {"planning_ms", number},
                                           {"waits_for", numbers},
                                           {"blocked_by", numbers}}}}}}}});
}

}  // namespace

const std::vector<SceneChannel>& LiveScene::channels() {
  static const std::vector<SceneChannel> kChannels{
      {"scene/map", kSceneUpdate, scene_schema()},
      {"scene/cars", kSceneUpdate, scene_schema()},
      {"scene/plans", kSceneUpdate, scene_schema()},
      {"reports", "hlc.Reports", report_schema()},
  };
  return kChannels;
}

LiveScene::LiveScene(FinishedRun run) : run_(std::move(run)), scene_(run_) {}

void LiveScene::take(const ReportRecord& record) {
  const auto& vehicles = scene_.vehicles();
  const auto vehicle =
      std::ranges::find(vehicles, record.report.vehicle, [](const auto* one) { return one->id; });
  if (vehicle == vehicles.end()) return;
  const std::uint8_t id = record.report.vehicle.value;
  const result::StepRecord row{.step = record.report.step.value, .record = record, .driven = {}};
  const Nanoseconds time = row.step * run_.facts.period;
  new_reports_[id] = {report_json(record), time};
  if (const auto before = rows_.find(id); before != rows_.end() && before->second.step < row.step) {
    const std::array<const result::StepRecord*, 2> rows{&before->second, &row};
    new_plans_[id] = {scene_.plan(**vehicle, rows, time), time};
  }
  rows_[id] = row;
}

void LiveScene::take(const VehicleState& state) {
  for (const result::VehicleDescription* vehicle : scene_.vehicles()) {
    if (vehicle->id.value != state.vehicle_id) continue;
    new_cars_[state.vehicle_id] = {scene_.car(*vehicle, state.pose, state.create_stamp),
                                   state.create_stamp};
  }
}

std::vector<SceneMessage> LiveScene::updates() {
  std::vector<SceneMessage> messages;
  if (!std::exchange(has_sent_map_, true)) {
    messages.push_back({kMap, 0, scene_update(scene_.map(0))});
  }
  if (!new_cars_.empty()) {
    auto [cars, time] = joined(new_cars_);
    messages.push_back({kCars, time, scene_update(std::move(cars))});
  }
  if (!new_plans_.empty()) {
    auto [plans, time] = joined(new_plans_);
    messages.push_back({kPlans, time, scene_update(std::move(plans))});
  }
  if (!new_reports_.empty()) {
    auto [reports, time] = joined(new_reports_);
    messages.push_back({kReports, time, text_of({{"reports", std::move(reports)}})});
  }
  return messages;
}

}  // namespace hlc::view
