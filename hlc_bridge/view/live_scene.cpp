#include "hlc_bridge/view/live_scene.hpp"

#include <algorithm>
#include <utility>

namespace hlc::view {
namespace {

enum Channel : std::size_t { kMap, kCars, kPlans, kReports };

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

LiveScene::LiveScene(FinishedRun run) : run_(std::move(run)), scene_(run_) {
  for (const result::VehicleDescription* vehicle : scene_.vehicles()) {
    vehicles_[vehicle->id.value].description = vehicle;
  }
}

LiveScene::Vehicle* LiveScene::find(std::uint8_t id) {
  const auto found = vehicles_.find(id);
  return found == vehicles_.end() ? nullptr : &found->second;
}

void LiveScene::take(const ReportRecord& record) {
  Vehicle* const vehicle = find(record.report.vehicle.value);
  const StepIndex step = record.report.step;
  if (vehicle == nullptr || (vehicle->last_step && step <= *vehicle->last_step)) return;
  vehicle->last_step = step;
  vehicle->report = record;
}

void LiveScene::take(const VehicleState& state) {
  if (Vehicle* const vehicle = find(state.vehicle_id)) vehicle->state = state;
}

void LiveScene::add_cars(std::vector<SceneMessage>& messages) {
  Json cars = Json::array();
  Nanoseconds newest = 0;
  for (auto& [id, vehicle] : vehicles_) {
    const std::optional<VehicleState> state = std::exchange(vehicle.state, std::nullopt);
    if (!state) continue;
    cars.push_back(scene_.car(*vehicle.description, state->pose, state->create_stamp));
    newest = std::max(newest, state->create_stamp);
  }
  if (!cars.empty()) messages.push_back({kCars, newest, scene_update(std::move(cars))});
}

void LiveScene::add_steps(std::vector<SceneMessage>& messages) {
  Json plans = Json::array();
  Json reports = Json::array();
  Nanoseconds newest = 0;
  for (auto& [id, vehicle] : vehicles_) {
    const std::optional<ReportRecord> record = std::exchange(vehicle.report, std::nullopt);
    if (!record) continue;
    const Nanoseconds time = record->report.step.value * run_.facts.period;
    newest = std::max(newest, time);
    reports.push_back(report_json(*record));
    plans.push_back(scene_.plan(*vehicle.description, record->report, time));
  }
  if (!plans.empty()) messages.push_back({kPlans, newest, scene_update(std::move(plans))});
  if (!reports.empty()) {
    messages.push_back({kReports, newest, text_of({{"reports", std::move(reports)}})});
  }
}

std::vector<SceneMessage> LiveScene::updates() {
  std::vector<SceneMessage> messages;
  if (!std::exchange(has_sent_map_, true)) {
    messages.push_back({kMap, 0, scene_update(scene_.map(0))});
  }
  add_cars(messages);
  add_steps(messages);
  return messages;
}

}  // namespace hlc::view
