#pragma once

#include "hlc_bridge/messages/instant.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "planner/geometry/polygon.hpp"

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

/// False if the id of a request for a subgraph, which is the time of the request, lies more than
/// kMostLead ahead of the real clock: every later request would be stale.
[[nodiscard]] constexpr bool is_plausible_request_id(std::uint64_t id, Nanoseconds real_now) {
  return id <= real_now || id - real_now <= kMostLead;
}

/// A corner of a received area may lie this much inside the line through its neighbours: above the
/// rounding of our own areas, rotated and far from the origin, and below every relevant length.
inline constexpr double kConvexTolerance_m = 1e-6;

/// True if tests of intersection mean anything for this received area: no corners (the empty area);
/// or three different ones and more, each coordinate finite and at most kLargestCoordinate_m,
/// counter-clockwise, once around, convex up to kConvexTolerance_m, area > 0. Repeated corners
/// count once. O(number of corners).
[[nodiscard]] bool is_valid_area(const ConvexPolygon& area);

}  // namespace hlc
