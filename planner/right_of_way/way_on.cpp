#include "planner/right_of_way/way_on.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "planner/right_of_way/queues.hpp"

namespace hlc::right_of_way {
namespace {

/// Of an extension to `ahead_m` what lies before its first conflict cell; none: it has none.
std::optional<double> before_stretch_m(const ConflictMap& map,
                                       const coordination::LaneClaim& before, double ahead_m) {
  const std::int64_t first = map.count_at(before.route, before.place_m + before.ahead_m) + 1;
  const std::int64_t last = map.count_at(before.route, before.place_m + ahead_m);
  for (std::int64_t cell = first; cell <= last; ++cell) {
    if (!map.is_conflict(before.route, map.index_of(before.route, cell))) continue;
    if (cell == first) return before.ahead_m;
    return static_cast<double>(cell - 1) * map.cell_m(before.route) - before.place_m;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Taken> leave_a_way_on(const ConflictMap& map, std::span<const Holder> holders,
                                  std::span<const double> ahead_m, std::span<const Blocked> blocked,
                                  const GrantOrder& order) {
  std::vector<coordination::LaneClaim> before;
  std::vector<std::size_t> entering;
  std::vector<Taken> taken;
  for (std::size_t who = 0; who < holders.size(); ++who) {
    before.push_back(holders[who].claim);
    const std::optional<double> stretch_m = before_stretch_m(map, before.back(), ahead_m[who]);
    taken.push_back({.ahead_m = stretch_m.value_or(ahead_m[who])});
    if (stretch_m) entering.push_back(who);
  }
  if (entering.empty()) return taken;
  std::vector<coordination::LaneClaim> claims = before;
  for (std::size_t who = 0; who < claims.size(); ++who) claims[who].ahead_m = taken[who].ahead_m;
  const auto stuck = [&] { return Queues::stuck({map, claims, before, blocked}); };
  std::optional<std::size_t> num_stuck;  // as it is, once that matters
  sort_by(order, holders, entering);
  for (const std::size_t who : entering) {
    claims[who].ahead_m = ahead_m[who];
    const std::vector<std::size_t> stuck_then = stuck();
    if (!stuck_then.empty() && !num_stuck) {
      claims[who].ahead_m = taken[who].ahead_m;
      num_stuck = stuck().size();
      claims[who].ahead_m = ahead_m[who];
    }
    if (stuck_then.empty() || stuck_then.size() <= *num_stuck) {
      taken[who].ahead_m = ahead_m[who];
      num_stuck = stuck_then.size();
      continue;
    }
    claims[who].ahead_m = taken[who].ahead_m;
    for (const std::size_t one : stuck_then) {
      if (one != who) taken[who].declined_for.push_back(holders[one].vehicle);
    }
  }
  return taken;
}

}  // namespace hlc::right_of_way
