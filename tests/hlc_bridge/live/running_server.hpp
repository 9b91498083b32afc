#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hlc_bridge/live/server.hpp"

namespace hlc::live {

/// A server on a thread of its own; ends with this object.
class RunningServer {
 public:
  explicit RunningServer(std::chrono::milliseconds patience = std::chrono::seconds{20},
                         std::uint16_t port = 0, const std::string& session = "1")
      : history_(session),
        newest_(session),
        server_({.port = port, .patience = patience}, history_, newest_),
        thread_([this] { server_.run(std::chrono::milliseconds{2}, [this] { tick(); }); }) {}
  ~RunningServer() {
    end();
    thread_.join();
  }
  RunningServer(const RunningServer&) = delete;
  RunningServer& operator=(const RunningServer&) = delete;

  void append(const std::string& messages) {
    const std::lock_guard lock{mutex_};
    next_.push_back(messages);
  }
  void append(view::SceneMessage message) {
    const std::lock_guard lock{mutex_};
    next_scene_.push_back(std::move(message));
  }
  void end() { ends_ = true; }

  [[nodiscard]] std::uint16_t port() const { return server_.port(); }
  [[nodiscard]] std::size_t num_clients() const { return num_clients_; }
  [[nodiscard]] std::size_t num_events() const { return num_events_; }

 private:
  void tick() {
    num_clients_ = server_.num_clients();
    if (history_.has_ended()) return;
    const std::lock_guard lock{mutex_};
    for (const std::string& messages : std::exchange(next_, {})) history_.append(messages);
    for (view::SceneMessage& message : std::exchange(next_scene_, {})) {
      newest_.take(std::move(message));
    }
    num_events_ = history_.size();
    if (ends_) history_.end();
  }

  History history_;
  NewestMessages newest_;
  std::mutex mutex_;
  std::vector<std::string> next_;               ///< guarded by mutex_
  std::vector<view::SceneMessage> next_scene_;  ///< guarded by mutex_
  std::atomic<std::size_t> num_clients_{};
  std::atomic<std::size_t> num_events_{};
  std::atomic<bool> ends_{};
  Server server_;
  std::thread thread_;
};

}  // namespace hlc::live
