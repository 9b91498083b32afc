#include "planner/right_of_way/way_on.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

#include "planner/right_of_way/queues.hpp"
#include "planner/right_of_way/reservation.hpp"

namespace hlc::right_of_way {
namespace {

/// More are judged at so great a cost that a step would last too long; they take all.
constexpr std::size_t kMostVehicles = 30;

/// Ends between `before` and `ahead_m` from which on the next cell is a conflict cell, and
/// `ahead_m`, ascending: how much of the extension may be taken.
std::vector<double> ends_of(const ConflictMap& map, const coordination::LaneClaim& before,
                            double ahead_m) {
  const auto is_conflict = [&](std::int64_t cell) {
    return map.is_conflict(before.route, map.index_of(before.route, cell));
  };
  const std::int64_t first = map.count_at(before.route, before.place_m + before.ahead_m) + 1;
  const std::int64_t last = map.count_at(before.route, before.place_m + ahead_m);
  std::vector<double> ends_m;
  for (std::int64_t cell = first; cell <= last; ++cell) {
    if (!is_conflict(cell) || (cell > first && is_conflict(cell - 1))) continue;
    const double end_m = static_cast<double>(cell - 1) * map.cell_m(before.route) - before.place_m;
    ends_m.push_back(cell == first ? before.ahead_m : end_m);
  }
  ends_m.push_back(ahead_m);
  return ends_m;
}

/// What is to be kept small, the first one first.
struct Judged {
  std::size_t num_in_circles{};
  std::vector<std::size_t> stuck;

  [[nodiscard]] bool is_worse_than(const Judged& other) const {
    return std::pair(num_in_circles, stuck.size()) >
           std::pair(other.num_in_circles, other.stuck.size());
  }
};

Judged judged(const Queues& queues) {
  Judged result{.num_in_circles = 0, .stuck = queues.stuck()};
  if (!result.stuck.empty()) result.num_in_circles = queues.num_in_circles();
  return result;
}

void decline(std::size_t who, double end_m, std::span<const Holder> holders,
             const std::vector<std::size_t>& stuck_anyway, const std::vector<std::size_t>& stuck,
             std::vector<Taken>& taken) {
  taken[who].ahead_m = end_m;
  taken[who].declines = true;
  for (const std::size_t one : stuck) {
    const bool is_stuck_anyway = std::ranges::find(stuck_anyway, one) != stuck_anyway.end();
    if (one != who && !is_stuck_anyway) taken[who].declined_for.push_back(holders[one].vehicle);
  }
}

std::vector<Taken> all_of(std::span<const double> ahead_m) {
  std::vector<Taken> taken;
  for (const double end_m : ahead_m) {
    taken.push_back({.ahead_m = end_m, .declines = false, .declined_for = {}, .kept_out_for = {}});
  }
  return taken;
}

/// All that is granted and not reserved.
std::vector<Taken> taken_outside_reserved(const ConflictMap& map, std::span<const Holder> holders,
                                          std::span<const double> ahead_m,
                                          std::span<const Blocked> blocked,
                                          const GrantOrder& order) {
  const Reserved reserved = reserve(map, holders, ahead_m, blocked, order);
  std::vector<Taken> taken = all_of(reserved.ahead_m);
  for (const std::size_t who : reserved.kept_out) taken[who].kept_out_for = reserved.vehicle;
  return taken;
}

}  // namespace

std::vector<Taken> leave_a_way_on(const ConflictMap& map, std::span<const Holder> holders,
                                  std::span<const double> ahead_m, std::span<const Blocked> blocked,
                                  const GrantOrder& order) {
  if (!order.puts_waiting_first || holders.size() > kMostVehicles) return all_of(ahead_m);
  std::vector<Taken> taken = taken_outside_reserved(map, holders, ahead_m, blocked, order);
  std::vector<double> ends;
  std::ranges::transform(taken, std::back_inserter(ends), &Taken::ahead_m);
  std::vector<std::vector<double>> ends_m;
  std::vector<std::size_t> entering;
  for (std::size_t who = 0; who < holders.size(); ++who) {
    ends_m.push_back(ends_of(map, holders[who].claim, ends[who]));
    if (ends_m.back().size() > 1) entering.push_back(who);
  }
  if (entering.empty() || Queues(map, holders, ends, blocked).stuck().empty()) return taken;
  for (const std::size_t who : entering) ends[who] = ends_m[who].front();
  Judged best = judged({map, holders, ends, blocked});
  sort_by(order, holders, entering);
  for (const std::size_t who : entering) {
    for (std::size_t i = 1; i < ends_m[who].size(); ++i) {
      ends[who] = ends_m[who][i];
      Judged then = judged({map, holders, ends, blocked});
      if (then.is_worse_than(best)) {
        decline(who, ends_m[who][i - 1], holders, best.stuck, then.stuck, taken);
        break;
      }
      best = std::move(then);
    }
    ends[who] = taken[who].ahead_m;
  }
  return taken;
}

}  // namespace hlc::right_of_way
