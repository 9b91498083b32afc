#include "hlc_bridge/dds/serialized.hpp"

#include <algorithm>
#include <cstdint>

#include "hlc_bridge/dds/wire.hpp"

namespace hlc::dds {

template <class Message>
std::optional<Message> message_from(std::string_view cdr) {
  TolerantType<typename Wire<Message>::PubSubType> type{false};
  SerializedPayload payload(static_cast<std::uint32_t>(cdr.size()));
  std::ranges::copy(cdr, reinterpret_cast<char*>(payload.data));
  payload.length = static_cast<std::uint32_t>(cdr.size());
  typename Wire<Message>::Type wire;
  if (!deserialize(type, payload, &wire)) return std::nullopt;
  return from_wire(wire).message;
}

template std::optional<VehicleStateList> message_from(std::string_view cdr);
template std::optional<coordination::Traffic> message_from(std::string_view cdr);
template std::optional<coordination::Prediction> message_from(std::string_view cdr);
template std::optional<coordination::Outcome> message_from(std::string_view cdr);

}  // namespace hlc::dds
