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
  std::vector<coordination::LaneClaim> ends;
  std::vector<std::size_t> entering;
  for (std::size_t who = 0; who < holders.size(); ++who) {
    before.push_back(holders[who].claim);
    const std::optional<double> stretch_m = before_stretch_m(map, before.back(), ahead_m[who]);
    ends.push_back(before.back());
    ends.back().ahead_m = stretch_m.value_or(ahead_m[who]);
    if (stretch_m) entering.push_back(who);
  }
  std::vector<Taken> taken(holders.size());
  std::optional<std::size_t> num_stuck;  // with `ends`, once that matters
  sort_by(order, holders, entering);
  for (const std::size_t who : entering) {
    std::vector<coordination::LaneClaim> more = ends;
    more[who].ahead_m = ahead_m[who];
    const std::vector<std::size_t> stuck = Queues(map, more, before, blocked).stuck();
    if (!stuck.empty() && !num_stuck) num_stuck = Queues(map, ends, before, blocked).stuck().size();
    if (stuck.empty() || stuck.size() <= *num_stuck) {
      ends = std::move(more);
      num_stuck = stuck.size();
      continue;
    }
    for (const std::size_t one : stuck) {
      if (one != who) taken[who].declined_for.push_back(holders[one].vehicle);
    }
  }
  for (std::size_t who = 0; who < ends.size(); ++who) taken[who].ahead_m = ends[who].ahead_m;
  return taken;
}

}  // namespace hlc::right_of_way
