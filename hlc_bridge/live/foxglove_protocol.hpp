#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/view/live_scene.hpp"

/// Foxglove's websocket protocol (https://github.com/foxglove/ws-protocol, version 1), as far as a
/// server needs it that only sends.
namespace hlc::live {

/// Names of the subprotocol that a client may ask for; the first of them that it names is taken.
/// Empty: it names none.
[[nodiscard]] std::string subprotocol_among(std::string_view offered);

/// First message of the server. @param session  another one for every process
[[nodiscard]] std::string server_info(const std::string& session);
/// The second: channels with the ids 0, 1, ...
[[nodiscard]] std::string advertisement(const std::vector<view::SceneChannel>& channels);
/// A message of a channel for one subscription, binary. @param time  of the run
[[nodiscard]] std::string message_data(std::uint32_t subscription, Nanoseconds time,
                                       std::string_view text);

/// Which channels a client has subscribed to: changed by what it sends.
class Subscriptions {
 public:
  /// @param num_channels  advertised
  explicit Subscriptions(std::size_t num_channels) : num_channels_(num_channels) {}

  /// Takes a text message of the client.
  /// @return a status message for it if something in it is not understood or not known, else empty
  [[nodiscard]] std::string take(std::string_view message);

  /// Channels by the client's ids.
  [[nodiscard]] const std::map<std::uint32_t, std::size_t>& channels() const { return channels_; }

 private:
  /// @return what is wrong; empty: nothing
  [[nodiscard]] std::string subscribe(const nlohmann::json& subscriptions);
  void unsubscribe(const nlohmann::json& ids);

  std::size_t num_channels_;
  std::map<std::uint32_t, std::size_t> channels_;
};

}  // namespace hlc::live
