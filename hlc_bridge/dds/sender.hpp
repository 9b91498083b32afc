#pragma once

#include <functional>
#include <string>
#include <utility>

#include "hlc_bridge/dds/transport.hpp"
#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::dds {

/// Name of the process (messages/node_names.hpp) that alone may publish a message. Empty function:
/// any may.
///
/// A reader drops, counts and logs messages of others (SenderCheck). On loopback and on the
/// controllers' domain every participant is one of ours, and only one of that name counts. On the
/// lab's transport, whose programs all have one name, others count while no participant of that
/// name is on the domain.
///
/// Limit: a participant may take any name. That keeps out programs that err, not those that lie.
template <class Message>
using SenderOf = std::function<std::string(const Message&)>;

/// The controller of the vehicle that the message names.
inline constexpr auto kItsController = [](const auto& message) {
  if constexpr (requires { message.vehicle_id; }) {
    return controller_name(message.vehicle_id);
  } else if constexpr (requires { message.report; }) {
    return controller_name(message.report.vehicle.value);
  } else {
    return controller_name(message.vehicle.value);
  }
};

/// For SenderOf: whatever the message.
[[nodiscard]] inline auto only(std::string name) {
  return [name = std::move(name)](const auto& /*message*/) { return name; };
}

/// The same, but anyone on the lab's transport: what the lab's control centre publishes, too, even
/// while ours is on the domain.
template <class Message>
[[nodiscard]] SenderOf<Message> only_on_loopback(Transport transport, std::string name) {
  if (transport == Transport::kLab) return {};
  return only(std::move(name));
}

}  // namespace hlc::dds
