#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "hlc_bridge/live/answer.hpp"
#include "hlc_bridge/live/boost_beast.hpp"
#include "hlc_bridge/live/history.hpp"

namespace hlc::live {

/// What all connections of a server have in common; outlives them.
struct Site {
  const History& history;
  Audience audience;
  std::chrono::milliseconds patience;
  /// Takes over a connection that becomes a websocket of this subprotocol.
  std::function<void(boost::beast::tcp_stream stream, http::request<http::empty_body> request,
                     const std::string& subprotocol)>
      open_websocket;
};

/// One client: a request and its answer. Every wait ends after the site's patience, except that of
/// a client that has all events for the next one.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, const Site& site) : site_(site), stream_(std::move(socket)) {}

  void start();
  /// To be called when the history may have grown, and repeatedly: a client that is silent and has
  /// gone shows only when something is sent.
  void send_events();
  [[nodiscard]] bool is_closed() const { return state_ == State::kClosed; }

 private:
  enum class State { kRequest, kAnswer, kEvents, kClosed };

  void answer(error_code error);
  void send(const Answer& answer);
  /// Shows the client that nothing follows, and reads until it closes: data that was not read
  /// would destroy the answer on its way.
  void finish();
  void discard();
  void close() { state_ = State::kClosed; }

  const Site& site_;
  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  std::string answer_;
  std::array<char, 4096> discarded_{};
  State state_{State::kRequest};
  std::size_t position_{};
  bool is_writing_{};
  std::chrono::steady_clock::time_point written_at_;
};

}  // namespace hlc::live
