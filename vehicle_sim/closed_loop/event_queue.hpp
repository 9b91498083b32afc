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

enum class EventKind : std::uint8_t {
  kArrival,    ///< of `message` on channel `detail`
  kDiscovery,  ///< `node` discovers or loses `other` on domain `detail`
  kWakeUp,     ///< of the process `node`, unless it has been rescheduled (`generation`)
  kStart,      ///< of the process number `detail`
  kAlarm,      ///< number `detail` of the caller
};

struct Event {
  EventKind what{};
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
    if (free_.empty()) {
      free_.push_back(static_cast<std::uint32_t>(events_.size()));
      events_.emplace_back();
    }
    const std::uint32_t place = free_.back();
    free_.pop_back();
    events_[place] = std::move(event);
    heap_.push_back({std::max(at, now_), count_++, place});
    std::ranges::push_heap(heap_, later);
  }

  /// The next one; it becomes the present. @pre not empty
  [[nodiscard]] Event take() {
    HLC_DEMAND(!heap_.empty());
    std::ranges::pop_heap(heap_, later);
    const Entry entry = heap_.back();
    heap_.pop_back();
    now_ = entry.at;
    free_.push_back(entry.place);
    return std::move(events_[entry.place]);
  }
  /// Events so far.
  [[nodiscard]] std::uint64_t count() const { return count_; }

  explicit EventQueue(Nanoseconds start) : now_(start) {}

 private:
  struct Entry {  // small: a heap moves its entries
    Nanoseconds at{};
    std::uint64_t number{};
    std::uint32_t place{};
  };
  static bool later(const Entry& a, const Entry& b) {
    return a.at != b.at ? a.at > b.at : a.number > b.number;
  }

  Nanoseconds now_;
  std::uint64_t count_{};
  std::vector<Entry> heap_;
  std::vector<Event> events_;  ///< by place
  std::vector<std::uint32_t> free_;
};

}  // namespace hlc::closed_loop
