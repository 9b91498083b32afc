#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/view/live_scene.hpp"

namespace hlc::live {

/// The newest message of each channel of a scene, for all clients that draw it: who is slow misses
/// those in between.
class NewestMessages {
 public:
  /// @param session  distinguishes this process from another one on the same port
  explicit NewestMessages(std::string session)
      : session_(std::move(session)), newest_(view::LiveScene::channels().size()) {}

  struct Newest {
    std::uint64_t number{};  ///< among all messages, from 1; 0: there is none
    Nanoseconds time{};
    std::string text;
  };

  void take(view::SceneMessage message) {
    newest_.at(message.channel) = {++num_taken_, message.time, std::move(message.text)};
  }
  [[nodiscard]] const Newest& of(std::size_t channel) const { return newest_.at(channel); }
  [[nodiscard]] const std::string& session() const { return session_; }

 private:
  std::string session_;
  std::vector<Newest> newest_;
  std::uint64_t num_taken_{};
};

}  // namespace hlc::live
