#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>

#include "hlc_bridge/live/boost_beast.hpp"
#include "hlc_bridge/live/foxglove_protocol.hpp"
#include "hlc_bridge/live/newest_messages.hpp"

namespace hlc::live {

/// A client that draws the scene by itself, over a websocket. It gets the newest messages of the
/// channels to which it has subscribed, when it has taken those before. One that takes nothing, or
/// answers no ping, for the patience is dropped.
class FoxgloveClient : public std::enable_shared_from_this<FoxgloveClient> {
 public:
  /// @param messages  outlives the client
  FoxgloveClient(boost::beast::tcp_stream stream, const NewestMessages& messages,
                 std::chrono::milliseconds patience);

  /// Accepts the connection. @param subprotocol  of subprotocol_among
  void start(const http::request<http::empty_body>& request, const std::string& subprotocol);
  /// To be called when there may be newer messages.
  void send_news();
  /// When nothing follows.
  void finish();
  [[nodiscard]] bool is_closed() const { return is_closed_; }

 private:
  void read();
  void take(error_code error);
  void send(std::string bytes, bool is_binary);
  void write_next();

  struct Outgoing {
    std::string bytes;
    bool is_binary{};
  };

  const NewestMessages& messages_;
  std::chrono::milliseconds patience_;
  websocket::stream<boost::beast::tcp_stream> socket_;
  boost::beast::flat_buffer buffer_;
  Subscriptions subscriptions_;
  std::map<std::uint32_t, std::uint64_t> sent_;  ///< number of the last message by subscription
  std::deque<Outgoing> outbox_;                  ///< the first one is being written
  bool is_open_{};
  bool is_closed_{};
};

}  // namespace hlc::live
