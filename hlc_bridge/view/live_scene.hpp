#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/view/page_messages.hpp"
#include "hlc_bridge/view/scene.hpp"

namespace hlc::view {

/// A kind of messages in JSON.
struct SceneChannel {
  std::string topic;
  std::string type;
  std::string schema;  ///< JSON schema
};

/// The newest message of one of LiveScene::channels().
struct SceneMessage {
  std::size_t channel{};
  Nanoseconds time{};  ///< of the run
  std::string text;
};

/// A run under way as a scene, for viewers that draw it by themselves (scene.hpp): `scene/map`
/// once, then `scene/cars` and `scene/plans`, and `report` with what a controller did in a step. A
/// plan is a step behind, because the next report shows what is driven.
///
/// Plain data: the caller takes messages from DDS, and updates by its clock.
class LiveScene {
 public:
  /// @param run  as for LiveMessages
  explicit LiveScene(FinishedRun run);
  LiveScene(const LiveScene&) = delete;  // the scene refers to the run
  LiveScene& operator=(const LiveScene&) = delete;

  [[nodiscard]] static const std::vector<SceneChannel>& channels();

  void take(const ReportRecord& record);
  void take(const VehicleState& state);
  /// About what was taken since the last call, by channel; of each vehicle the newest.
  [[nodiscard]] std::vector<SceneMessage> updates();

 private:
  FinishedRun run_;
  Scene scene_;
  std::map<std::uint8_t, result::StepRecord> rows_;  ///< the last one of each vehicle
  std::map<std::uint8_t, std::pair<Json, Nanoseconds>> new_cars_;
  std::map<std::uint8_t, std::pair<Json, Nanoseconds>> new_plans_;
  std::map<std::uint8_t, std::pair<Json, Nanoseconds>> new_reports_;
  bool has_sent_map_{};
};

}  // namespace hlc::view
