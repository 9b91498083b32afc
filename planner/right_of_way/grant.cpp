#include "planner/right_of_way/grant.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

namespace hlc::right_of_way {
namespace {

using CellNumber = std::int64_t;  ///< counted on over the end of a route

class Grants {
 public:
  Grants(const ConflictMap& map, std::span<const Holder> holders, std::span<const Blocked> blocked)
      : map_(map), holders_(holders), blocked_(blocked) {
    for (const Holder& holder : holders) ahead_m_.push_back(holder.claim.ahead_m);
  }

  void extend(std::size_t who, double look_ahead_m) {
    const coordination::LaneClaim& claim = holders_[who].claim;
    const double cell_m = map_.cell_m(claim.route);
    for (;;) {
      const CellNumber next = cell_of(claim.route, claim.place_m + ahead_m_[who]) + 1;
      if (static_cast<double>(next) * cell_m > claim.place_m + look_ahead_m) return;
      const std::optional<CellNumber> end = end_of_stretch(who, next);
      if (!end) return;
      ahead_m_[who] = static_cast<double>(*end) * cell_m - claim.place_m;
    }
  }

  [[nodiscard]] const std::vector<double>& ahead_m() const { return ahead_m_; }

  [[nodiscard]] std::vector<VehicleId> withheld_by(std::size_t who) const {
    const std::size_t route = holders_[who].claim.route;
    const std::vector<std::size_t> next = next_stretch(who);
    std::vector<VehicleId> vehicles;
    for (std::size_t other = 0; other < holders_.size(); ++other) {
      const auto holds = [&](std::size_t cell) { return is_held_by(other, route, cell); };
      if (other != who && std::ranges::any_of(next, holds)) {
        vehicles.push_back(holders_[other].vehicle);
      }
    }
    for (const Blocked& one : blocked_) {
      const auto blocks = [&](std::size_t cell) {
        return intersects(map_.area_m(route, cell), one.area_m);
      };
      const bool is_named = !vehicles.empty() && vehicles.back() == one.vehicle;
      if (!is_named && std::ranges::any_of(next, blocks)) vehicles.push_back(one.vehicle);
    }
    return vehicles;
  }

 private:
  [[nodiscard]] CellNumber cell_of(std::size_t route, double s_m) const {
    return std::llround(s_m / map_.cell_m(route));
  }
  [[nodiscard]] std::size_t on_route(std::size_t route, CellNumber cell) const {
    const auto count = static_cast<CellNumber>(map_.num_cells(route));
    return static_cast<std::size_t>((cell % count + count) % count);
  }

  /// Cells that would be granted next, all of them or none.
  [[nodiscard]] std::vector<std::size_t> next_stretch(std::size_t who) const {
    const coordination::LaneClaim& claim = holders_[who].claim;
    CellNumber cell = cell_of(claim.route, claim.place_m + ahead_m_[who]) + 1;
    std::vector<std::size_t> cells{on_route(claim.route, cell)};
    while (map_.is_conflict(claim.route, cells.back()) &&
           cells.size() < map_.num_cells(claim.route)) {
      cells.push_back(on_route(claim.route, ++cell));
    }
    return cells;
  }

  /// The cell where a stretch that begins with `first` ends, if all of it is free.
  [[nodiscard]] std::optional<CellNumber> end_of_stretch(std::size_t who, CellNumber first) const {
    const std::size_t route = holders_[who].claim.route;
    const auto whole_route = static_cast<CellNumber>(map_.num_cells(route));
    for (CellNumber cell = first; cell < first + whole_route; ++cell) {
      if (!is_free(who, on_route(route, cell))) return std::nullopt;
      if (!map_.is_conflict(route, on_route(route, cell))) return cell;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool is_free(std::size_t who, std::size_t cell) const {
    const std::size_t route = holders_[who].claim.route;
    for (std::size_t other = 0; other < holders_.size(); ++other) {
      if (other != who && is_held_by(other, route, cell)) return false;
    }
    const ConvexPolygon& area_m = map_.area_m(route, cell);
    return std::ranges::none_of(blocked_,
                                [&](const Blocked& one) { return intersects(area_m, one.area_m); });
  }

  /// Whether the other vehicle holds a cell that overlaps this one.
  [[nodiscard]] bool is_held_by(std::size_t other, std::size_t route, std::size_t cell) const {
    const auto cells = map_.overlaps(route, cell, holders_[other].claim.route);
    return std::ranges::any_of(cells, [&](std::size_t one) { return holds(other, one); });
  }

  [[nodiscard]] bool holds(std::size_t who, std::size_t cell) const {
    const coordination::LaneClaim& claim = holders_[who].claim;
    const CellNumber from = cell_of(claim.route, claim.place_m);
    const CellNumber to = cell_of(claim.route, claim.place_m + ahead_m_[who]);
    const auto behind_from =
        static_cast<CellNumber>(on_route(claim.route, static_cast<CellNumber>(cell) - from));
    return behind_from <= to - from;
  }

  const ConflictMap& map_;
  std::span<const Holder> holders_;
  std::span<const Blocked> blocked_;
  std::vector<double> ahead_m_;
};

}  // namespace

std::vector<double> grant(const ConflictMap& map, std::span<const Holder> holders,
                          std::span<const Blocked> blocked, double look_ahead_m) {
  std::vector<std::size_t> order(holders.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    const auto key = [&](std::size_t i) {
      const coordination::LaneClaim& claim = holders[i].claim;
      return std::tuple(-static_cast<std::int64_t>(claim.waiting_steps), claim.ahead_m,
                        holders[i].vehicle);
    };
    return key(a) < key(b);
  });
  Grants grants(map, holders, blocked);
  for (const std::size_t who : order) grants.extend(who, look_ahead_m);
  return grants.ahead_m();
}

std::vector<VehicleId> withheld_by(const ConflictMap& map, std::span<const Holder> holders,
                                   std::span<const Blocked> blocked, std::size_t who) {
  return Grants(map, holders, blocked).withheld_by(who);
}

}  // namespace hlc::right_of_way
