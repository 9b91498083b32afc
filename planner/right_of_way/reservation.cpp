#include "planner/right_of_way/reservation.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "planner/right_of_way/queues.hpp"

namespace hlc::right_of_way {
namespace {

constexpr std::uint32_t kFrom_steps = 50;
constexpr std::uint32_t kUntil_steps = 150;

bool may_reserve(const coordination::LaneClaim& claim) {
  return claim.waiting_steps >= kFrom_steps && claim.waiting_steps < kUntil_steps;
}

/// The end of an extension from `before` to `ahead_m` that enters none of these cells.
double end_outside_m(const ConflictMap& map, const coordination::LaneClaim& before, double ahead_m,
                     const std::vector<bool>& cells) {
  const auto is_in = [&](std::int64_t at) {
    return cells[map.cell(before.route, map.index_of(before.route, at))];
  };
  const std::int64_t from = map.count_at(before.route, before.place_m + before.ahead_m);
  const std::int64_t to = map.count_at(before.route, before.place_m + ahead_m);
  if (is_in(from)) return ahead_m;  // it leaves them
  std::optional<std::int64_t> end;
  for (std::int64_t at = from + 1; at <= to; ++at) {
    if (is_in(at)) {
      return end ? static_cast<double>(*end) * map.cell_m(before.route) - before.place_m
                 : before.ahead_m;
    }
    if (!map.is_conflict(before.route, map.index_of(before.route, at))) end = at;
  }
  return ahead_m;
}

}  // namespace

Reserved reserve(const ConflictMap& map, std::span<const Holder> holders,
                 std::span<const double> ahead_m, std::span<const Blocked> blocked,
                 const GrantOrder& order) {
  Reserved all{.ahead_m = {ahead_m.begin(), ahead_m.end()}, .vehicle = {}, .kept_out = {}};
  std::vector<std::size_t> turns(holders.size());
  for (std::size_t who = 0; who < turns.size(); ++who) turns[who] = who;
  sort_by(order, holders, turns);
  for (auto turn = turns.begin(); turn != turns.end(); ++turn) {
    const coordination::LaneClaim& claim = holders[*turn].claim;
    const bool is_granted_more = ahead_m[*turn] > claim.ahead_m;
    if (!may_reserve(claim) || is_granted_more) continue;
    const std::vector<bool> cells = overlapping_next_stretch(map, claim);
    Reserved reserved{.ahead_m = all.ahead_m, .vehicle = holders[*turn].vehicle, .kept_out = {}};
    for (auto later = turn + 1; later != turns.end(); ++later) {
      const double end_m = end_outside_m(map, holders[*later].claim, ahead_m[*later], cells);
      if (end_m == ahead_m[*later]) continue;
      reserved.ahead_m[*later] = end_m;
      reserved.kept_out.push_back(*later);
    }
    if (Queues(map, holders, reserved.ahead_m, blocked).passes_if_reserved(*turn, cells)) {
      return reserved;
    }
  }
  return all;
}

}  // namespace hlc::right_of_way
