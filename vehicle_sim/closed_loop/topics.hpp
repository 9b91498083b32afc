#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <variant>

#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "planner/coordination/messages.hpp"

/// Messages between processes in memory, and their topics: those of hlc_bridge/dds/topics.hpp that
/// the processes of a run use.
namespace hlc::closed_loop {

using Message =
    std::variant<VehicleState, VehicleStateList, TrajectoryCommand, ReadyStatus, SystemTrigger,
                 Parameter, ParameterRequest, StopRequest, coordination::Traffic,
                 coordination::Prediction, coordination::Outcome, ReportRecord, RunState>;
/// Delivered to many readers, written once.
using SharedMessage = std::shared_ptr<const Message>;

/// Networks. The local one connects a vehicle's controller with its middleware.
enum class Domain : std::uint8_t { kLab, kControllers, kLocal };
inline constexpr std::size_t kNumDomains = 3;

enum class TopicId : std::uint8_t {
  kVehicleState,
  kVehicleCommand,
  kReadyStatus,
  kSystemTrigger,
  kParameter,
  kParameterRequest,
  kStopRequest,
  kStateList,
  kCommand,
  kControllerReady,
  kForwardedTrigger,
  kTraffic,
  kPrediction,
  kOutcome,
  kReport,
  kRunState,
};

struct Topic {
  TopicId id{};
  std::uint8_t vehicle{};  ///< of topics of one vehicle and of its local domain; else 0
  friend auto operator<=>(const Topic&, const Topic&) = default;
};

/// Settings of the endpoints (endpoint_qos.hpp).
enum class Transport : std::uint8_t {
  kLoopback,  ///< on one machine: every topic is reliable
  kLab,       ///< over the lab's network: some are not, and little is kept
};

struct TopicRules {
  Domain domain{};
  std::size_t depth{};  ///< messages of one writer that are kept until they have arrived; 0: none
  bool is_kept_late{};  ///< late joiners get the kept messages
  [[nodiscard]] constexpr bool is_reliable() const { return depth > 0; }
};

[[nodiscard]] constexpr TopicRules rules_of(TopicId id, Transport transport) {
  const bool is_lab = transport == Transport::kLab;
  const auto depth = [is_lab](std::size_t lab, std::size_t loopback) {
    return is_lab ? lab : loopback;
  };
  switch (id) {
    case TopicId::kVehicleState:
      return {.domain = Domain::kLab, .depth = depth(0, 64)};
    case TopicId::kVehicleCommand:
    case TopicId::kStopRequest:
      return {.domain = Domain::kLab, .depth = depth(0, 16)};
    case TopicId::kReadyStatus:
    case TopicId::kParameterRequest:
      return {.domain = Domain::kLab, .depth = depth(1, 16)};
    case TopicId::kSystemTrigger:
      return {.domain = Domain::kLab, .depth = depth(1, 512)};
    case TopicId::kParameter:
      return {.domain = Domain::kLab, .depth = depth(1, 256)};
    case TopicId::kStateList:
    case TopicId::kCommand:
      return {.domain = Domain::kLocal, .depth = depth(0, 16)};
    case TopicId::kControllerReady:
      return {.domain = Domain::kLocal, .depth = depth(1, 16)};
    case TopicId::kForwardedTrigger:
      return {.domain = Domain::kLocal, .depth = depth(1, 512)};
    case TopicId::kTraffic:
    case TopicId::kPrediction:
    case TopicId::kOutcome:
      return {.domain = Domain::kControllers, .depth = 8};
    case TopicId::kReport:
      return {.domain = Domain::kControllers, .depth = 10'000, .is_kept_late = true};
    case TopicId::kRunState:
      return {.domain = Domain::kControllers, .depth = 1, .is_kept_late = true};
  }
  return {};
}

}  // namespace hlc::closed_loop
