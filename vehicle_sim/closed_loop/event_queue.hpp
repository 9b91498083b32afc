#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "hlc_bridge/messages/messages.hpp"
#include "planner/common/demand.hpp"
#include "vehicle_sim/closed_loop/topics.hpp"

namespace hlc::closed_loop {

/// A start of a process: a restarted process is another node.
using NodeId = std::uint32_t;

enum class Happening : std::uint8_t {
  kArrival,  ///< of `message` on channel `detail`
  kSight,    ///< `node` may see or miss `other` on domain `detail`
  kWakeUp,   ///< of the process `node`, unless it has other plans by then (`generation`)
  kStart,    ///< of the process number `detail`
  kAlarm,    ///< number `detail` of the caller
};

struct Event {
  Happening what{};
  NodeId node{};
  NodeId other{};
  std::uint32_t detail{};
  std::uint32_t generation{};
  SharedMessage message{};
};

/// Future events, in the order of true time; at the same time in the order of their scheduling. So
/// a run depends on nothing but its inputs.
class EventQueue {
 public:
  [[nodiscard]] Nanoseconds now() const { return now_; }
  [[nodiscard]] bool empty() const { return heap_.empty(); }
  /// @pre not empty
  [[nodiscard]] Nanoseconds next_time() const { return heap_.front().at; }

  /// @param at  now if it is in the past
  void add(Nanoseconds at, Event event) {
    heap_.push_back({std::max(at, now_), count_++, std::move(event)});
    std::ranges::push_heap(heap_, later);
  }

  /// The next one; it becomes the present. @pre not empty
  [[nodiscard]] Event take() {
    HLC_DEMAND(!heap_.empty());
    std::ranges::pop_heap(heap_, later);
    Entry entry = std::move(heap_.back());
    heap_.pop_back();
    now_ = entry.at;
    return std::move(entry.event);
  }
  /// Events so far.
  [[nodiscard]] std::uint64_t count() const { return count_; }

  explicit EventQueue(Nanoseconds start) : now_(start) {}

 private:
  struct Entry {
    Nanoseconds at{};
    std::uint64_t number{};
    Event event;
  };
  static bool later(const Entry& a, const Entry& b) {
    return a.at != b.at ? a.at > b.at : a.number > b.number;
  }

  Nanoseconds now_;
  std::uint64_t count_{};
  std::vector<Entry> heap_;
};

}  // namespace hlc::closed_loop
