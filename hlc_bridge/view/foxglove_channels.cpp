#include "hlc_bridge/view/foxglove_channels.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "hlc_bridge/view/scene.hpp"

namespace hlc::view {
namespace {

constexpr const char* kLog = "foxglove.Log";
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

Frames cars(const FinishedRun& run, const Scene& scene) {
  Frames frames;
  for (const result::VehicleDescription* vehicle : scene.vehicles()) {
    const auto drive = run.drives.find(vehicle->id.value);
    if (drive == run.drives.end()) continue;
    std::optional<Nanoseconds> last;
    for (const result::DrivenSample& sample : drive->second) {
      if (last && sample.t < *last + kFrameTime) continue;
      last = sample.t;
      frame_at(sample.t, frames).push_back(scene.car(*vehicle, sample.pose, sample.t));
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

mcap::JsonChannel log_channel(const FinishedRun& run, Nanoseconds begin) {
  mcap::JsonChannel channel{.topic = "log",
                            .type = kLog,
                            .schema = schema_text(kLog, {{"timestamp", {{"type", "object"}}},
                                                         {"level", {{"type", "integer"}}},
                                                         {"message", {{"type", "string"}}},
                                                         {"name", {{"type", "string"}}},
                                                         {"file", {{"type", "string"}}},
                                                         {"line", {{"type", "integer"}}}}),
                            .messages = {}};
  for (const result::LoggedLine& line : run.log) {
    const double time_s = line.run_s.value_or(-1.0) + 1e-9 * static_cast<double>(begin);
    if (!line.run_s || time_s < 0.0) continue;
    const auto time = static_cast<Nanoseconds>(1e9 * time_s);
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

std::vector<mcap::JsonChannel> foxglove_channels(const FinishedRun& run) {
  const Nanoseconds begin = run.facts.first_step.value_or(0) * run.facts.period;
  const Scene scene(run);
  return {scene_channel("scene/map", {{begin, scene.map(begin)}}),
          scene_channel("scene/cars", cars(run, scene)),
          scene_channel("scene/plans", plans(run, scene, begin)), log_channel(run, begin)};
}

}  // namespace hlc::view
