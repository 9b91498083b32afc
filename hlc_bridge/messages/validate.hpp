#pragma once

#include "hlc_bridge/messages/instant.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

/// What every received message must fulfil, in one place: the machines drop what does not, so that
/// no single message, forged or damaged, takes precedence over all later ones.
namespace hlc {

/// A stamp may lie this much ahead of the receiver's clock: far more than the clocks of a lab
/// differ (they are synchronised to some ms), and as long as a command is usable, so a stamp that
/// passes takes precedence for no longer.
inline constexpr Nanoseconds kMostLead = kNanosecondsPerSecond;

/// False if `stamp` lies more than kMostLead + `period` ahead of `now`. In logical time a process
/// may be a period behind the sender; before the first tick it has no clock to compare with, and
/// every stamp is plausible.
/// @param period  ns, of the run; 0 if unknown
[[nodiscard]] constexpr bool is_plausible_stamp(Nanoseconds stamp, const Instant& now,
                                                Nanoseconds period) {
  return !now.has_begun || stamp <= now.run || stamp - now.run <= kMostLead + period;
}

}  // namespace hlc
