#include "hlc_bridge/view/live_scene.hpp"

#include <algorithm>
#include <utility>

#include "hlc_bridge/view/foxglove_schemas.hpp"
#include "hlc_bridge/view/report_messages.hpp"

namespace hlc::view {
namespace {

enum Channel : std::size_t { kMap, kCars, kPlans, kReports };

}  // namespace

const std::vector<SceneChannel>& LiveScene::channels() {
  static const std::vector<SceneChannel> kChannels{
      {"scene/map", kSceneUpdate, scene_schema()},
      {"scene/cars", kSceneUpdate, scene_schema()},
      {"scene/plans", kSceneUpdate, scene_schema()},
      {"reports", kReportsType, reports_schema()},
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
  if (vehicle == nullptr) return;
  if (vehicle->report && record.report.step <= vehicle->report->report.step) return;
  vehicle->report = record;
  has_new_report_ = true;
}

void LiveScene::take(const VehicleState& state) {
  Vehicle* const vehicle = find(state.vehicle_id);
  if (vehicle == nullptr) return;
  vehicle->state = state;
  has_new_state_ = true;
}

SceneMessage LiveScene::cars() const {
  Json cars = Json::array();
  Nanoseconds newest = 0;
  for (const auto& [id, vehicle] : vehicles_) {
    if (!vehicle.state) continue;
    const Nanoseconds time = vehicle.state->create_stamp;
    newest = std::max(newest, time);
    cars.push_back(scene_.car(*vehicle.description, vehicle.state->pose, time));
  }
  return {kCars, newest, scene_update(std::move(cars))};
}

void LiveScene::add_steps(std::vector<SceneMessage>& messages) const {
  Json plans = Json::array();
  Json reports = Json::array();
  Nanoseconds newest = 0;
  for (const auto& [id, vehicle] : vehicles_) {
    if (!vehicle.report) continue;
    const Nanoseconds time = vehicle.report->report.step.value * run_.facts.period;
    newest = std::max(newest, time);
    plans.push_back(scene_.plan(*vehicle.description, vehicle.report->report, time));
    reports.push_back(report_json(
        *vehicle.report, vehicle.state ? std::optional(vehicle.state->speed_mps) : std::nullopt));
  }
  messages.push_back({kPlans, newest, scene_update(std::move(plans))});
  messages.push_back({kReports, newest, reports_message(std::move(reports))});
}

std::vector<SceneMessage> LiveScene::updates() {
  std::vector<SceneMessage> messages;
  if (!std::exchange(has_sent_map_, true)) {
    messages.push_back({kMap, 0, scene_update(scene_.map(0))});
  }
  if (std::exchange(has_new_state_, false)) messages.push_back(cars());
  if (std::exchange(has_new_report_, false)) add_steps(messages);
  return messages;
}

}  // namespace hlc::view
