#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/messages/time_grid.hpp"
#include "vehicle_sim/closed_loop/simulated_network.hpp"

namespace hlc::closed_loop {

enum class FaultKind : std::uint8_t {
  kLose,      ///< a share of the messages is lost in transit; reliable topics send them again
  kWithhold,  ///< a share of the messages never arrives, not even on reliable topics
  kDelay,     ///< messages take up to `amount` longer
  kRepeat,    ///< a share of the messages comes twice
  kReorder,   ///< a share of the messages comes up to `amount` later, and others do not wait for it
  kFlood,     ///< copies of valid messages arrive, `amount` a second on every topic; not drawn
  kCut,       ///< no messages and no signs of life pass
  kKill,      ///< the process is killed, and restarted at the end
  kFreeze,    ///< the process is suspended until the end
  kStep,      ///< the process's real-time clock is set by `amount`, and back at the end
  kDrift,     ///< its clocks run faster or slower by `amount` ns in a second until the end
};

/// End of a fault that does not pass.
inline constexpr Nanoseconds kForGood = std::numeric_limits<Nanoseconds>::max();

/// A temporary fault, or one that ends kForGood. Times are true times since the beginning of the
/// run.
struct Fault {
  FaultKind kind{};
  Nanoseconds begin{};
  Nanoseconds end{};
  std::string process;  ///< kKill ... kDrift; of the others the writer's, empty: any
  std::string peer;     ///< of the others the reader's, empty: any
  double share{};
  std::int64_t amount{};
  friend bool operator==(const Fault&, const Fault&) = default;
};

/// By name, for flags: "lose", "withhold", ...
[[nodiscard]] const char* to_string(FaultKind kind);
/// All kinds that are drawn, in the order of their declaration.
[[nodiscard]] std::span<const FaultKind> all_fault_kinds();
/// "2.150 s ... 3.200 s: cut middleware_1 -> vehicle_raspberry_1"
[[nodiscard]] std::string to_string(const Fault& fault);

/// How the faults of a run lie in time.
enum class FaultStyle : std::uint8_t {
  kScattered,  ///< anywhere in the run
  kBurst,      ///< three to eight that begin within 1.5 s
  kLossy,      ///< links that lose 10 ... 30 % all the time, and some scattered faults
  kRestart,    ///< processes that are killed and come back soon, while messages to them are lost
  kBorder,     ///< messages that are stale, come twice or overtake others by about a step or two
  /// Controllers that lose much of what others of them send, or one of another all, or each of
  /// each; or one that all others lose while it is suspended, and that comes back
  kSilence,
};

struct FaultPlanSettings {
  FaultStyle style{};
  std::vector<std::uint8_t> vehicle_ids;
  std::vector<FaultKind> kinds;                  ///< of which faults are drawn; empty: none are
  Nanoseconds first{};                           ///< no fault begins earlier
  Nanoseconds last{20 * kNanosecondsPerSecond};  ///< all are over by then
  std::size_t most_faults{6};
};

/// Faults of a seed, at least one, by time of their begin. Faults of one process that exclude each
/// other (killed while frozen) are left out.
///
/// Distribution: processes (controllers, middlewares, vehicles, lab control) are killed or
/// suspended for 10 ms ... 8 s, networks are disturbed for 50 ms ... 6 s, cuts separate two
/// processes, or one from all, in one direction or both. Clocks of controllers and middlewares are
/// set by up to 300 ms, which is more than a step; those of the vehicles by up to 2 ms only: a
/// vehicle whose clock differs from the others' is not where its plan predicts, and only the safety
/// margin (10 mm) covers the difference.
[[nodiscard]] std::vector<Fault> draw_faults(std::uint64_t seed, const FaultPlanSettings& settings);

/// The end of the last one, of those that do not pass the begin; 0 without faults.
[[nodiscard]] Nanoseconds end_of(std::span<const Fault> faults);

}  // namespace hlc::closed_loop
