#include "hlc_bridge/live/foxglove_protocol.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <ranges>

#include "planner/common/text_file.hpp"

namespace hlc::live {
namespace {

using Json = nlohmann::json;

constexpr std::uint8_t kMessageData = 1;
constexpr int kWarning = 1;
constexpr std::size_t kMostSubscriptions = 1000;

std::string status(const std::string& text) {
  const Json json{{"op", "status"}, {"level", kWarning}, {"message", text}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

template <class T>
void append(std::string& bytes, T number) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    bytes.push_back(static_cast<char>(number >> (8 * i) & 0xFF));
  }
}

/// A member that is a whole number of 32 bits; nothing for another one.
std::optional<std::uint32_t> id_in(const Json& object, const char* name) {
  const auto member = object.is_object() ? object.find(name) : object.end();
  if (member == object.end() || !member->is_number_unsigned()) return std::nullopt;
  const auto number = member->get<std::uint64_t>();
  if (number > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

const Json* array_in(const Json& message, const char* name) {
  const auto member = message.find(name);
  return member != message.end() && member->is_array() ? &*member : nullptr;
}

}  // namespace

std::string subprotocol_among(std::string_view offered) {
  for (std::string name : split(offered, ',')) {
    std::erase(name, ' ');
    if (name == "foxglove.websocket.v1" || name == "foxglove.sdk.v1") return name;
  }
  return {};
}

std::string server_info(const std::string& session) {
  const Json json{{"op", "serverInfo"},
                  {"name", "view"},
                  {"capabilities", Json::array()},
                  {"sessionId", session}};
  return json.dump();
}

std::string advertisement(const std::vector<view::SceneChannel>& channels) {
  Json json{{"op", "advertise"}, {"channels", Json::array()}};
  for (std::size_t id = 0; id < channels.size(); ++id) {
    json["channels"].push_back({{"id", id},
                                {"topic", channels[id].topic},
                                {"encoding", "json"},
                                {"schemaName", channels[id].type},
                                {"schemaEncoding", "jsonschema"},
                                {"schema", channels[id].schema}});
  }
  return json.dump();
}

std::string message_data(std::uint32_t subscription, Nanoseconds time, std::string_view text) {
  std::string bytes;
  bytes.reserve(1 + sizeof subscription + sizeof time + text.size());
  append(bytes, kMessageData);
  append(bytes, subscription);
  append(bytes, time);
  bytes.append(text);
  return bytes;
}

std::string Subscriptions::subscribe(const Json& subscriptions) {
  for (const Json& one : subscriptions) {
    const auto id = id_in(one, "id");
    const auto channel = id_in(one, "channelId");
    if (!id || !channel || *channel >= num_channels_ || channels_.size() >= kMostSubscriptions) {
      return fmt::format("a subscription's channelId must be in 0 ... {}, of at most {}",
                         num_channels_ - 1, kMostSubscriptions);
    }
    channels_[*id] = *channel;
  }
  return {};
}

void Subscriptions::unsubscribe(const Json& ids) {
  for (const Json& id : ids) {
    std::erase_if(channels_, [&id](const auto& one) { return id == one.first; });
  }
}

std::string Subscriptions::take(std::string_view message) {
  const Json json = Json::parse(message, nullptr, false);
  const auto op = json.is_object() ? json.find("op") : json.end();
  const auto is_op = [&](const char* name) { return op != json.end() && *op == name; };
  if (!json.is_object() || (!is_op("subscribe") && !is_op("unsubscribe"))) {
    return status("op must be subscribe or unsubscribe");
  }
  const char* const list = is_op("subscribe") ? "subscriptions" : "subscriptionIds";
  const Json* const entries = array_in(json, list);
  if (entries == nullptr) return status(fmt::format("{} must be an array", list));
  if (is_op("unsubscribe")) {
    unsubscribe(*entries);
    return {};
  }
  const std::string fault = subscribe(*entries);
  return fault.empty() ? fault : status(fault);
}

}  // namespace hlc::live
