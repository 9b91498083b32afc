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
  /// About what was taken since the last call, by channel; of each vehicle the newest.
  [[nodiscard]] std::vector<SceneMessage> updates();

 private:
  /// What was taken of a vehicle; drawn only when it is asked for, since states come far more
  /// often.
  struct Vehicle {
    const result::VehicleDescription* description{};
    std::optional<VehicleState> state;   ///< not yet sent
    std::optional<ReportRecord> report;  ///< not yet sent
    std::optional<StepIndex> last_step;  ///< of the reports taken
  };

  [[nodiscard]] Vehicle* find(std::uint8_t id);
  void add_cars(std::vector<SceneMessage>& messages);
  void add_steps(std::vector<SceneMessage>& messages);

  FinishedRun run_;
  Scene scene_;
  std::map<std::uint8_t, Vehicle> vehicles_;
  bool has_sent_map_{};
};

}  // namespace hlc::view
