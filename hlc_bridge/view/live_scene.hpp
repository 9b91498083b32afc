#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
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
/// once, then `scene/cars` and `scene/plans`, and `reports` with what controllers did in a step.
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
  /// Of the channels about which something was taken since the last call, in their order. Each has
  /// the newest of every vehicle, so that the last message of a channel is all that a viewer needs.
  [[nodiscard]] std::vector<SceneMessage> updates();

 private:
  /// The newest of a vehicle; drawn only when it is asked for, since states come far more often.
  struct Vehicle {
    const result::VehicleDescription* description{};
    std::optional<VehicleState> state;
    std::optional<ReportRecord> report;
  };

  [[nodiscard]] Vehicle* find(std::uint8_t id);
  [[nodiscard]] SceneMessage cars() const;
  void add_steps(std::vector<SceneMessage>& messages) const;

  FinishedRun run_;
  Scene scene_;
  std::map<std::uint8_t, Vehicle> vehicles_;
  bool has_sent_map_{};
  bool has_new_state_{};
  bool has_new_report_{};
};

}  // namespace hlc::view
