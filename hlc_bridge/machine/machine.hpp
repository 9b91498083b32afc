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

/// Who is on a domain: part of a machine's presence event.
struct Participants {
  std::set<std::string> alive;
  std::set<std::string> lost;  ///< were there and are not any more
};

/// With whom one endpoint of the process is matched: part of a machine's presence event.
struct Matched {
  std::size_t count{};          ///< endpoints of others
  std::set<std::string> names;  ///< participants that they belong to
};

/// What Machine::awaited returns while no event but an urgent one lets advance do anything.
inline constexpr std::size_t kOnlyUrgent = std::numeric_limits<std::size_t>::max();

/// What a process decides: a value that is fed events and says what to do next. It knows no clock,
/// thread, socket, file or logger.
///
///     on(event)      something came: a message, a change of presence, a signal
///     advance(now)   what to do now, in this order
///     wake_up()      when advance must be called though nothing came
///     awaited()      events without which advance has nothing to do, at least 1 (urgent ones
///     aside,
///                    Shell::post_urgent). In logical time most messages bring only a part of what
///                    a process waits for, and to wake the thread for each would cost a good part
///                    of the run's speed. A hint: advance may be called at any time.
///     exit_code()    once it is there, the process ends
///
/// `Event` and `Action` are variants; an event StopSignal is among the events. After an advance the
/// wake-up lies in the future, or advance is called again at once.
template <class M>
concept Machine = requires(M machine, const M& fixed, typename M::Event event, Instant now) {
  machine.on(std::move(event));
  { machine.advance(now) } -> std::same_as<std::vector<typename M::Action>>;
  { fixed.wake_up() } -> std::same_as<WakeUp>;
  { fixed.awaited() } -> std::same_as<std::size_t>;
  { fixed.exit_code() } -> std::same_as<std::optional<int>>;
  requires std::constructible_from<typename M::Event, StopSignal>;
};

/// The earlier of two times of which either may be missing.
[[nodiscard]] constexpr std::optional<Nanoseconds> earlier(std::optional<Nanoseconds> a,
                                                           std::optional<Nanoseconds> b) {
  if (!a || !b) return a ? a : b;
  return *a < *b ? a : b;
}

}  // namespace hlc::machine
