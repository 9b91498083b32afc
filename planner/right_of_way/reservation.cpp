#include "planner/right_of_way/reservation.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "planner/right_of_way/queues.hpp"
#include "planner/right_of_way/stretch.hpp"

namespace hlc::right_of_way {
namespace {

/// For how long a vehicle has stood for which road may be reserved.
constexpr std::uint32_t kFrom_steps = 50;
constexpr std::uint32_t kUntil_steps = 150;

std::int64_t end_of(const ConflictMap& map, const coordination::LaneClaim& claim) {
  return map.count_at(claim.route, claim.place_m + claim.ahead_m);
}

bool may_reserve(const ConflictMap& map, const coordination::LaneClaim& claim, double granted_m) {
  const bool is_held_up = claim.waiting_steps >= kFrom_steps &&
                          claim.waiting_steps < kUntil_steps && granted_m <= claim.ahead_m;
  return is_held_up &&
         map.is_conflict(claim.route, map.index_of(claim.route, end_of(map, claim) + 1));
}

/// The end of an extension from `before` to `ahead_m` that enters none of these cells.
double end_outside_m(const ConflictMap& map, const coordination::LaneClaim& before, double ahead_m,
                     const std::vector<bool>& cells) {
  const auto is_in = [&](std::int64_t at) {
    return cells[map.cell(before.route, map.index_of(before.route, at))];
  };
  const std::int64_t from = end_of(map, before);
  const std::int64_t to = map.count_at(before.route, before.place_m + ahead_m);
  if (is_in(from)) return ahead_m;  // it leaves them
  double end_m = before.ahead_m;
  for (std::int64_t at = from + 1; at <= to; ++at) {
    if (is_in(at)) return end_m;
    if (map.is_conflict(before.route, map.index_of(before.route, at))) continue;
    end_m = static_cast<double>(at) * map.cell_m(before.route) - before.place_m;
  }
  return ahead_m;
}

}  // namespace

std::vector<bool> overlapping_next_stretch(const ConflictMap& map,
                                           const coordination::LaneClaim& claim) {
  std::vector<bool> cells(map.num_cells());
  const auto add = [&](std::size_t index) {
    for (const std::uint32_t cell : map.overlaps(claim.route, index)) cells[cell] = true;
    return true;
  };
  static_cast<void>(end_of_stretch(map, claim.route, end_of(map, claim) + 1, add));
  return cells;
}

Reserved reserve(const ConflictMap& map, std::span<const Holder> holders,
                 std::span<const double> ahead_m, std::span<const Blocked> blocked,
                 const GrantOrder& order) {
  Reserved nothing{.ahead_m = {ahead_m.begin(), ahead_m.end()}, .vehicle = {}, .kept_out = {}};
  std::vector<std::size_t> turns(holders.size());
  std::iota(turns.begin(), turns.end(), std::size_t{0});
  sort_by(order, holders, turns);
  for (auto turn = turns.begin(); turn != turns.end(); ++turn) {
    const Holder& waiting = holders[*turn];
    if (!may_reserve(map, waiting.claim, ahead_m[*turn])) continue;
    const std::vector<bool> cells = overlapping_next_stretch(map, waiting.claim);
    Reserved reserved = nothing;
    reserved.vehicle = waiting.vehicle;
    for (auto later = turn + 1; later != turns.end(); ++later) {
      const double end_m = end_outside_m(map, holders[*later].claim, ahead_m[*later], cells);
      if (end_m == ahead_m[*later]) continue;
      reserved.ahead_m[*later] = end_m;
      reserved.kept_out.push_back(*later);
    }
    if (reserved.kept_out.empty()) continue;
    const Queues queues(map, holders, reserved.ahead_m, blocked);
    if (queues.passes_if_reserved(*turn, cells)) return reserved;
  }
  return nothing;
}

}  // namespace hlc::right_of_way
