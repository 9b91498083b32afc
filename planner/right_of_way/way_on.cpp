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

std::vector<coordination::LaneClaim> claims_to(std::span<const Holder> holders,
                                               std::span<const double> ahead_m) {
  std::vector<coordination::LaneClaim> claims;
  for (std::size_t who = 0; who < holders.size(); ++who) {
    claims.push_back(holders[who].claim);
    claims.back().ahead_m = ahead_m[who];
  }
  return claims;
}

}  // namespace

std::vector<Taken> leave_a_way_on(const ConflictMap& map, std::span<const Holder> holders,
                                  std::span<const double> ahead_m, std::span<const Blocked> blocked,
                                  const GrantOrder& order) {
  std::vector<coordination::LaneClaim> before;
  std::vector<Taken> taken;
  std::vector<std::size_t> entering;
  for (std::size_t who = 0; who < holders.size(); ++who) {
    before.push_back(holders[who].claim);
    taken.push_back({.ahead_m = ahead_m[who], .declined_for = {}});
    if (before_stretch_m(map, before.back(), ahead_m[who])) entering.push_back(who);
  }
  std::vector<coordination::LaneClaim> ends = claims_to(holders, ahead_m);
  if (entering.empty() || Queues(map, ends, before, blocked).all_get_on()) return taken;
  for (const std::size_t who : entering) {
    ends[who].ahead_m = *before_stretch_m(map, before[who], ahead_m[who]);
  }
  std::size_t num_stuck = Queues(map, ends, before, blocked).stuck().size();
  sort_by(order, holders, entering);
  for (const std::size_t who : entering) {
    const double less_m = std::exchange(ends[who].ahead_m, ahead_m[who]);
    const std::vector<std::size_t> stuck = Queues(map, ends, before, blocked).stuck();
    if (stuck.size() <= num_stuck) {
      num_stuck = stuck.size();
      continue;
    }
    ends[who].ahead_m = taken[who].ahead_m = less_m;
    for (const std::size_t one : stuck) {
      if (one != who) taken[who].declined_for.push_back(holders[one].vehicle);
    }
  }
  return taken;
}

}  // namespace hlc::right_of_way
