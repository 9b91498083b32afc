#pragma once

#include <cstdint>
#include <string>

#include "hlc_bridge/messages/messages.hpp"
#include "planner/automaton/subgraph_request.hpp"
#include "planner/coordination/messages.hpp"

namespace hlc {

/// Requests another subgraph of a vehicle's controller. The last request of a vehicle counts.
struct AutomatonRequest {
  VehicleId vehicle;
  /// Increases from request to request, whatever its sender: the time of the request [ns].
  std::uint64_t id{};
  /// The subgraph is in force from the first step that begins then or later; 0: from the next one.
  Nanoseconds valid_from{};
  SubgraphRequest subgraph;
};

enum class RequestOutcome : std::uint8_t {
  kAccepted,  ///< it will be in force
  kInForce,   ///< planned on from this step on
  kRefused,   ///< the former subgraph stays
  kStale,     ///< a later request counts
};

/// What a controller did with a request.
struct AutomatonAnswer {
  VehicleId vehicle;
  std::uint64_t id{};  ///< of the request
  RequestOutcome outcome{};
  StepIndex step;    ///< in force from this step on; otherwise the step in which it was answered
  std::string text;  ///< name of the subgraph, or why it is not in force
};

}  // namespace hlc
