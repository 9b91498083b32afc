#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "hlc_bridge/live/history.hpp"
#include "hlc_bridge/live/newest_messages.hpp"

namespace hlc::live {

struct ServerOptions {
  std::string address{"127.0.0.1"};  ///< IPv4 or IPv6; on loopback only this machine may ask
  /// 0: any free one; none: the first free one from kFirstPort on
  std::optional<std::uint16_t> port;
  /// For a client to send its request, and to take what it is sent.
  std::chrono::milliseconds patience{10'000};
};

inline constexpr std::uint16_t kFirstPort = 8400;
inline constexpr std::uint16_t kNumPorts = 50;
inline constexpr std::size_t kMostClients = 200;  ///< further ones are refused

/// The page of a run under way for browsers (answer.hpp), over HTTP, and its scene for other
/// viewers, over websockets (foxglove_protocol.hpp); on one thread.
///
/// A client gets the history from its position on, at most some 256 kB at a time, and the next ones
/// when it has taken these. One that does not take them within `patience` is dropped: it needs no
/// memory but its socket's. A browser connects again, and continues after the last event it has.
class Server {
 public:
  /// Listens.
  /// @param history, newest  outlive the server
  /// @throws std::invalid_argument naming the flag, --listen or --port, that cannot be had
  Server(const ServerOptions& options, const History& history, const NewestMessages& newest);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// "http://127.0.0.1:8400/"
  [[nodiscard]] std::string url() const;
  [[nodiscard]] std::uint16_t port() const;
  [[nodiscard]] bool is_open_to_others() const;  ///< not on loopback
  [[nodiscard]] std::size_t num_clients() const;

  /// Serves until the history has ended and all clients have it, at most 2 s longer. Calls
  /// `on_tick` every `interval`: it may append to the history.
  void run(std::chrono::milliseconds interval, const std::function<void()>& on_tick);

 private:
  class Core;  // Boost.Asio lives behind this
  std::unique_ptr<Core> core_;
};

}  // namespace hlc::live
