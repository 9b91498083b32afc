#include "hlc_bridge/view/foxglove_channels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "hlc_bridge/view/foxglove_schemas.hpp"
#include "hlc_bridge/view/report_messages.hpp"
#include "hlc_bridge/view/scene.hpp"

namespace hlc::view {
namespace {

constexpr Nanoseconds kFrameTime = 40'000'000;

using Frames = std::map<Nanoseconds, Json>;  ///< entities by time

Json& frame_at(Nanoseconds time, Frames& frames) {
  return frames.try_emplace(time, Json::array()).first->second;
}

mcap::JsonChannel scene_channel(const char* topic, Frames&& frames) {
  mcap::JsonChannel channel{
      .topic = topic, .type = kSceneUpdate, .schema = scene_schema(), .messages = {}};
  for (auto& [time, entities] : frames) {
    channel.messages.emplace_back(time, scene_update(std::move(entities)));
  }
  return channel;
}

/// All cars at the same times: after a jump in time viewers have no message but the last one of the
/// topic.
Frames cars(const FinishedRun& run, const Scene& scene) {
  std::set<Nanoseconds> times;
  for (const auto& [id, drive] : run.drives) {
    for (const result::DrivenSample& sample : drive) {
      times.insert(sample.t / kFrameTime * kFrameTime);
    }
  }
  Frames frames;
  for (const result::VehicleDescription* vehicle : scene.vehicles()) {
    const auto drive = run.drives.find(vehicle->id.value);
    if (drive == run.drives.end()) continue;
    for (const Nanoseconds time : times) {
      const std::optional<Pose> pose = result::driven_pose_at(drive->second, time);
      if (pose) frame_at(time, frames).push_back(scene.car(*vehicle, *pose, time));
    }
  }
  return frames;
}

Frames plans(const FinishedRun& run, const Scene& scene, Nanoseconds begin) {
  Frames frames;
  for (const result::VehicleDescription* vehicle : scene.vehicles()) {
    for (const result::StepRecord& row : run.rows) {
      if (row.record.report.vehicle != vehicle->id) continue;
      const Nanoseconds time = begin + row.step * run.facts.period;
      frame_at(time, frames).push_back(scene.plan(*vehicle, row.record.report, time));
    }
  }
  return frames;
}

int level_number(const std::string& level) {
  static const std::map<std::string, int> kLevels{
      {"debug", 1}, {"info", 2}, {"warning", 3}, {"error", 4}, {"critical", 5}};
  const auto found = kLevels.find(level);
  return found == kLevels.end() ? 0 : found->second;
}

mcap::JsonChannel reports_channel(const FinishedRun& run, Nanoseconds begin) {
  Frames frames;
  for (const result::StepRecord& row : run.rows) {
    const Nanoseconds time = begin + row.step * run.facts.period;
    const auto drive = run.drives.find(row.record.report.vehicle.value);
    const std::optional<double> speed_mps =
        drive == run.drives.end() ? std::nullopt : result::driven_speed_mps_at(drive->second, time);
    frame_at(time, frames).push_back(report_json(row.record, speed_mps));
  }
  mcap::JsonChannel channel{
      .topic = "reports", .type = kReportsType, .schema = reports_schema(), .messages = {}};
  for (auto& [time, reports] : frames) {
    channel.messages.emplace_back(time, reports_message(std::move(reports)));
  }
  return channel;
}

mcap::JsonChannel log_channel(const FinishedRun& run, Nanoseconds recorded_from,
                              Nanoseconds begin) {
  mcap::JsonChannel channel{.topic = "log", .type = kLog, .schema = log_schema(), .messages = {}};
  Nanoseconds time = recorded_from;
  for (const result::LoggedLine& line : run.log) {
    if (line.run_s) {
      const std::int64_t since_begin = 1'000'000 * std::llround(1e3 * *line.run_s);
      time = static_cast<Nanoseconds>(std::max(static_cast<std::int64_t>(begin) + since_begin,
                                               static_cast<std::int64_t>(recorded_from)));
    }
    channel.messages.emplace_back(time, text_of({{"timestamp", time_json(time)},
                                                 {"level", level_number(line.level)},
                                                 {"message", line.text},
                                                 {"name", line.process},
                                                 {"file", ""},
                                                 {"line", 0}}));
  }
  return channel;
}

}  // namespace

std::vector<mcap::JsonChannel> foxglove_channels(const FinishedRun& run,
                                                 std::optional<Nanoseconds> recorded_from) {
  const Nanoseconds begin = run.facts.first_step.value_or(0) * run.facts.period;
  const Nanoseconds first = recorded_from.value_or(begin);
  const Scene scene(run);
  return {scene_channel("scene/map", {{first, scene.map(first)}}),
          scene_channel("scene/cars", cars(run, scene)),
          scene_channel("scene/plans", plans(run, scene, begin)), reports_channel(run, begin),
          log_channel(run, first, begin)};
}

}  // namespace hlc::view
