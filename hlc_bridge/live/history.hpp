#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <utility>

namespace hlc::live {

/// All portions of a run's messages, encoded once for all clients as events (Server-Sent Events). A
/// client is a position in it, so clients need no queues of their own.
class History {
 public:
  /// @param session  distinguishes this history from that of another process on the same port: no
  /// hyphen, no line break
  explicit History(std::string session) : session_(std::move(session)) {}

  /// @param messages  a JSON array without line breaks
  /// @pre has_ended() is false
  void append(const std::string& messages);
  /// Nothing follows.
  void end() { has_ended_ = true; }

  [[nodiscard]] std::size_t size() const { return events_.size(); }
  [[nodiscard]] std::size_t num_bytes() const { return num_bytes_; }
  [[nodiscard]] bool has_ended() const { return has_ended_; }
  /// With its id. The reference stays valid. @pre position < size()
  [[nodiscard]] const std::string& event(std::size_t position) const { return events_[position]; }

  /// Where a client continues that has received this event; 0, the begin, for an id of another
  /// session or none.
  [[nodiscard]] std::size_t position_after(std::string_view event_id) const;

 private:
  std::string session_;
  std::deque<std::string> events_;
  std::size_t num_bytes_{};
  bool has_ended_{};
};

}  // namespace hlc::live
