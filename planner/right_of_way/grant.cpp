#include "planner/right_of_way/grant.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "planner/right_of_way/stretch.hpp"

namespace hlc::right_of_way {
namespace {

using CellNumber = std::int64_t;  ///< counted on over the end of a route

class Grants {
 public:
  Grants(const ConflictMap& map, std::span<const Holder> holders, std::span<const Blocked> blocked)
      : map_(map), holders_(holders), blocked_(blocked), num_holders_(map.num_cells()) {
    for (const Holder& holder : holders) ahead_m_.push_back(holder.claim.ahead_m);
    for (std::size_t who = 0; who < holders.size(); ++who) count(who, 1);
  }

  void extend(std::size_t who, double look_ahead_m) {
    const double end_m = reach_m(who, look_ahead_m);
    count(who, -1);
    ahead_m_[who] = end_m;
    count(who, 1);
  }

  /// How far the authority of a holder reaches if it is extended, and nobody else's.
  [[nodiscard]] double reach_m(std::size_t who, double look_ahead_m) {
    count(who, -1);  // its own are free for it
    const std::vector<std::uint32_t> behind = places_behind(who);
    for (const std::uint32_t cell : behind) --num_holders_[cell];
    coordination::LaneClaim claim = holders_[who].claim;
    claim.ahead_m = ahead_m_[who];
    const double end_m = reach_m(claim, look_ahead_m);
    for (const std::uint32_t cell : behind) ++num_holders_[cell];
    count(who, 1);
    return end_m;
  }

  /// The same of a claim that is none of the holders'.
  [[nodiscard]] double reach_m(const coordination::LaneClaim& claim, double look_ahead_m) const {
    const double cell_m = map_.cell_m(claim.route);
    double ahead_m = claim.ahead_m;
    for (;;) {
      const CellNumber next = map_.count_at(claim.route, claim.place_m + ahead_m) + 1;
      if (static_cast<double>(next) * cell_m > claim.place_m + look_ahead_m) break;
      const std::optional<CellNumber> end = end_of_stretch(
          map_, claim.route, next, [&](std::size_t cell) { return is_free(claim.route, cell); });
      if (!end) break;
      ahead_m = static_cast<double>(*end) * cell_m - claim.place_m;
    }
    return ahead_m;
  }

  /// The same of one that was last received with this claim, and may have moved since: for it the
  /// places are free that it may have come to overlap, since it may be ahead of them.
  [[nodiscard]] double reach_of_missing_m(coordination::LaneClaim claim, double moved_m,
                                          double look_ahead_m) {
    const double farthest_place_m = claim.place_m + std::min(claim.ahead_m, moved_m);
    std::vector<std::size_t> under;
    for (CellNumber cell = map_.count_at(claim.route, claim.place_m);
         cell <= map_.count_at(claim.route, farthest_place_m); ++cell) {
      under.push_back(map_.index_of(claim.route, cell));
    }
    std::vector<std::uint32_t> passed;
    for (const std::size_t other : holders_of_overlapping(claim.route, under)) {
      passed.push_back(place_of(other));
    }
    for (const std::uint32_t cell : passed) --num_holders_[cell];
    claim.ahead_m = std::max(claim.ahead_m, moved_m);
    const double end_m = reach_m(claim, look_ahead_m + moved_m);
    for (const std::uint32_t cell : passed) ++num_holders_[cell];
    return end_m;
  }

  [[nodiscard]] const std::vector<double>& ahead_m() const { return ahead_m_; }

  [[nodiscard]] std::vector<VehicleId> withheld_by(std::size_t who) const {
    const std::size_t route = holders_[who].claim.route;
    const std::vector<std::size_t> next = next_stretch(who);
    std::vector<VehicleId> vehicles;
    const std::vector<std::uint32_t> behind = places_behind(who);
    for (const std::size_t other : holders_of_overlapping(route, next)) {
      const bool is_behind =
          held_by(other).size() == 1 && std::ranges::find(behind, place_of(other)) != behind.end();
      if (other != who && !is_behind) vehicles.push_back(holders_[other].vehicle);
    }
    for (const Blocked& one : blocked_) {
      const auto blocks = [&](std::size_t cell) {
        return intersects(map_.area_m(route, cell), one.area_m);
      };
      const bool is_named = !vehicles.empty() && vehicles.back() == one.vehicle;
      if (!one.vehicle || is_named || std::ranges::none_of(next, blocks)) continue;
      vehicles.push_back(*one.vehicle);
    }
    return vehicles;
  }

  /// Holders whose cells overlap this one's, or those of another one of these; itself included.
  [[nodiscard]] std::vector<std::size_t> connected_with(std::size_t who) const {
    std::vector<std::size_t> connected{who};
    for (std::size_t i = 0; i < connected.size(); ++i) {
      const std::size_t route = holders_[connected[i]].claim.route;
      for (const std::size_t other : holders_of_overlapping(route, places_of(connected[i]))) {
        if (std::ranges::find(connected, other) == connected.end()) connected.push_back(other);
      }
    }
    return connected;
  }

 private:
  /// Cells of the places that overlap this vehicle's place and lie behind it.
  [[nodiscard]] std::vector<std::uint32_t> places_behind(std::size_t who) const {
    std::vector<std::uint32_t> cells;
    const std::uint32_t own = place_of(who);
    for (std::size_t other = 0; other < holders_.size(); ++other) {
      const std::uint32_t cell = place_of(other);
      if (other == who || !std::ranges::binary_search(overlaps_of(who, 0), cell)) continue;
      const bool is_ahead = std::pair(way_past_m(cell, who), holders_[who].vehicle) <
                            std::pair(way_past_m(own, other), holders_[other].vehicle);
      if (is_ahead) cells.push_back(cell);
    }
    return cells;
  }
  [[nodiscard]] std::uint32_t place_of(std::size_t who) const {
    const std::size_t route = holders_[who].claim.route;
    return map_.cell(route, map_.index_of(route, first_of(who)));
  }
  /// Of the cell that is this far from the one at its place.
  [[nodiscard]] std::span<const std::uint32_t> overlaps_of(std::size_t who, CellNumber on) const {
    const std::size_t route = holders_[who].claim.route;
    return map_.overlaps(route, map_.index_of(route, first_of(who) + on));
  }
  /// How far the vehicle drives until it is in a cell that does not overlap this one.
  [[nodiscard]] double way_past_m(std::uint32_t cell, std::size_t who) const {
    const coordination::LaneClaim& claim = holders_[who].claim;
    const auto whole_route = static_cast<CellNumber>(map_.num_cells(claim.route));
    CellNumber on = 0;
    while (on < whole_route && std::ranges::binary_search(overlaps_of(who, on), cell)) ++on;
    return static_cast<double>(first_of(who) + on) * map_.cell_m(claim.route) - claim.place_m;
  }
  [[nodiscard]] CellNumber first_of(std::size_t who) const {
    const coordination::LaneClaim& claim = holders_[who].claim;
    return map_.count_at(claim.route, claim.place_m);
  }
  [[nodiscard]] CellNumber last_of(std::size_t who) const {
    const coordination::LaneClaim& claim = holders_[who].claim;
    return map_.count_at(claim.route, claim.place_m + ahead_m_[who]);
  }
  /// Indices on its route of the cells that it holds.
  [[nodiscard]] std::vector<std::size_t> places_of(std::size_t who) const {
    const std::size_t route = holders_[who].claim.route;
    const auto whole_route = static_cast<CellNumber>(map_.num_cells(route));
    const CellNumber end = std::min(last_of(who) + 1, first_of(who) + whole_route);
    std::vector<std::size_t> places;
    for (CellNumber cell = first_of(who); cell < end; ++cell) {
      places.push_back(map_.index_of(route, cell));
    }
    return places;
  }
  [[nodiscard]] std::vector<std::uint32_t> held_by(std::size_t who) const {
    const std::size_t route = holders_[who].claim.route;
    std::vector<std::uint32_t> cells;
    for (const std::size_t place : places_of(who)) cells.push_back(map_.cell(route, place));
    return cells;
  }

  /// Those that hold a cell that overlaps one of these, in their order.
  [[nodiscard]] std::vector<std::size_t> holders_of_overlapping(
      std::size_t route, const std::vector<std::size_t>& places) const {
    std::vector<bool> overlaps(map_.num_cells());
    for (const std::size_t place : places) {
      for (const std::uint32_t one : map_.overlaps(route, place)) overlaps[one] = true;
    }
    const auto is_overlapping = [&](std::uint32_t cell) { return overlaps[cell]; };
    std::vector<std::size_t> found;
    for (std::size_t who = 0; who < holders_.size(); ++who) {
      if (std::ranges::any_of(held_by(who), is_overlapping)) found.push_back(who);
    }
    return found;
  }

  void count(std::size_t who, int by) {
    for (const std::uint32_t cell : held_by(who)) num_holders_[cell] += by;
  }

  /// Cells that would be granted next, all of them or none.
  [[nodiscard]] std::vector<std::size_t> next_stretch(std::size_t who) const {
    std::vector<std::size_t> cells;
    static_cast<void>(
        end_of_stretch(map_, holders_[who].claim.route, last_of(who) + 1, [&](std::size_t cell) {
          cells.push_back(cell);
          return true;
        }));
    return cells;
  }

  /// For a vehicle whose own cells are not counted.
  [[nodiscard]] bool is_free(std::size_t route, std::size_t cell) const {
    const bool is_held = std::ranges::any_of(
        map_.overlaps(route, cell), [&](std::uint32_t one) { return num_holders_[one] > 0; });
    if (is_held) return false;
    const ConvexPolygon& area_m = map_.area_m(route, cell);
    return std::ranges::none_of(blocked_,
                                [&](const Blocked& one) { return intersects(area_m, one.area_m); });
  }

  const ConflictMap& map_;
  std::span<const Holder> holders_;
  std::span<const Blocked> blocked_;
  std::vector<double> ahead_m_;
  std::vector<int> num_holders_;  ///< of each cell of the map
};

}  // namespace

std::vector<double> grant(const ConflictMap& map, std::span<const Holder> holders,
                          std::span<const Blocked> blocked, double look_ahead_m,
                          const GrantOrder& order) {
  std::vector<std::size_t> turns(holders.size());
  std::iota(turns.begin(), turns.end(), std::size_t{0});
  sort_by(order, holders, turns);
  Grants grants(map, holders, blocked);
  for (const std::size_t who : turns) grants.extend(who, look_ahead_m);
  return grants.ahead_m();
}

std::optional<std::vector<Holder>> cautious_grant(const ConflictMap& map,
                                                  std::span<const Holder> holders,
                                                  std::span<const Missing> missing,
                                                  std::span<const Blocked> blocked,
                                                  double look_ahead_m, VehicleId own) {
  Grants held(map, holders, {});
  std::vector<Holder> reaches(holders.begin(), holders.end());
  for (std::size_t i = 0; i < holders.size(); ++i) {
    reaches[i].claim.ahead_m = held.reach_m(i, look_ahead_m);
  }
  for (const Missing& one : missing) {
    Holder& last = reaches.emplace_back(one.last);
    last.claim.ahead_m = held.reach_of_missing_m(last.claim, one.moved_m, look_ahead_m);
  }
  const auto who =
      static_cast<std::size_t>(std::ranges::find(reaches, own, &Holder::vehicle) - reaches.begin());
  const auto is_missing = [&](std::size_t i) { return i >= holders.size(); };
  if (std::ranges::none_of(Grants(map, reaches, {}).connected_with(who), is_missing)) return {};
  reaches[who] = holders[who];
  reaches[who].claim.ahead_m = Grants(map, reaches, blocked).reach_m(who, look_ahead_m);
  return reaches;
}

std::vector<VehicleId> withheld_by(const ConflictMap& map, std::span<const Holder> holders,
                                   std::span<const Blocked> blocked, std::size_t who) {
  return Grants(map, holders, blocked).withheld_by(who);
}

}  // namespace hlc::right_of_way
