#include "hlc_bridge/middleware/due_messages.hpp"

#include <fmt/format.h>

#include <utility>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::middleware {

DueMessages::DueMessages(std::string (*name)(std::uint8_t), Nanoseconds patience,
                         std::set<std::uint8_t> silent)
    : name_{name}, patience_{patience}, silent_{std::move(silent)} {}

bool DueMessages::are_in(const std::vector<std::uint8_t>& peers, Nanoseconds now,
                         MiddlewareActions& actions) {
  std::vector<std::string> pending;
  for (const std::uint8_t peer : peers) {
    if (!silent_.contains(peer)) pending.push_back(name_(peer));
  }
  awaited_ = pending.size();
  if (pending.empty()) return true;
  if (now < deadline_) return false;
  silent_.insert(peers.begin(), peers.end());
  actions.emplace_back(
      machine::warning(fmt::format("{}: no message for {} s; no longer waiting",
                                   fmt::join(pending, ", "), patience_ / kNanosecondsPerSecond)));
  awaited_ = 0;
  return true;
}

}  // namespace hlc::middleware
