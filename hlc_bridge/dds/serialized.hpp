#pragma once

#include <optional>
#include <string_view>

#include "hlc_bridge/messages/messages.hpp"
#include "planner/coordination/messages.hpp"

namespace hlc::dds {

/// A message from its bytes on the wire (PublishedMessage::cdr); nothing if they are none, or an
/// invalid one. Of VehicleStateList, Traffic, Prediction and Outcome.
template <class Message>
[[nodiscard]] std::optional<Message> message_from(std::string_view cdr);

extern template std::optional<VehicleStateList> message_from(std::string_view cdr);
extern template std::optional<coordination::Traffic> message_from(std::string_view cdr);
extern template std::optional<coordination::Prediction> message_from(std::string_view cdr);
extern template std::optional<coordination::Outcome> message_from(std::string_view cdr);

}  // namespace hlc::dds
