#pragma once

#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/messages/instant.hpp"

namespace hlc::machine {

/// Event: the process is to end soon (SIGINT, SIGTERM, a call of stop).
struct StopSignal {};

/// Participants of a domain: part of a machine's presence event.
struct Participants {
  std::set<std::string> alive;
  std::set<std::string> lost;  ///< were present and are no longer
};

/// Matches of one endpoint of the process: part of a machine's presence event.
struct Matched {
  std::size_t count{};          ///< endpoints of others
  std::set<std::string> names;  ///< participants that they belong to
};

/// Returned by Machine::awaited while only an urgent event lets advance do anything.
inline constexpr std::size_t kOnlyUrgent = std::numeric_limits<std::size_t>::max();

/// The decisions of a process: a value that is fed events and returns what to do next. It knows no
/// clock, thread, socket, file or logger.
///
///     on(event)      an event: a message, a change of presence, a signal
///     advance(now)   what to do now, in this order
///     wake_up()      when advance must be called without an event
///     awaited()      number of events before advance has something to do, at least 1 (urgent ones
///                    aside, Shell::post_urgent). In logical time most messages bring only a part
///                    of what a process waits for, and waking the thread for each would slow down
///                    the run considerably. A hint: advance may be called at any time.
///     exit_code()    once it is set, the process ends
///
/// `Event` and `Action` are variants; StopSignal is among the events. After an advance the wake-up
/// lies in the future, or advance is called again at once.
template <class M>
concept Machine = requires(M machine, const M& fixed, typename M::Event event, Instant now) {
  machine.on(std::move(event));
  { machine.advance(now) } -> std::same_as<std::vector<typename M::Action>>;
  { fixed.wake_up() } -> std::same_as<WakeUp>;
  { fixed.awaited() } -> std::same_as<std::size_t>;
  { fixed.exit_code() } -> std::same_as<std::optional<int>>;
  requires std::constructible_from<typename M::Event, StopSignal>;
};

/// The earlier of two times, either of which may be missing.
[[nodiscard]] constexpr std::optional<Nanoseconds> earlier(std::optional<Nanoseconds> a,
                                                           std::optional<Nanoseconds> b) {
  if (!a || !b) return a ? a : b;
  return *a < *b ? a : b;
}

}  // namespace hlc::machine
