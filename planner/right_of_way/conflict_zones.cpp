#include "planner/right_of_way/conflict_zones.hpp"

#include <cstddef>
#include <utility>

namespace hlc::right_of_way {
namespace {

/// Spreads numbers over connected conflict cells.
class Zones {
 public:
  explicit Zones(const ConflictMap& map)
      : map_(map), places_(map.num_cells()), numbers_(map.num_cells(), 0) {
    for (std::size_t route = 0; route < map.num_routes(); ++route) {
      for (std::size_t i = 0; i < map.num_cells(route); ++i) {
        places_[map.cell(route, i)] = {route, i};
      }
    }
  }

  std::vector<std::uint32_t> number() && {
    for (std::size_t route = 0; route < map_.num_routes(); ++route) {
      for (std::size_t i = 0; i < map_.num_cells(route); ++i) {
        if (is_free(map_.cell(route, i))) fill(map_.cell(route, i), ++last_);
      }
    }
    return std::move(numbers_);
  }

 private:
  struct Place {
    std::size_t route{};
    std::size_t cell{};
  };

  /// A conflict cell without a number.
  [[nodiscard]] bool is_free(std::uint32_t cell) const {
    return numbers_[cell] == 0 && map_.is_conflict(places_[cell].route, places_[cell].cell);
  }

  void fill(std::uint32_t first, std::uint32_t number) {
    numbers_[first] = number;
    std::vector<std::uint32_t> reached{first};
    while (!reached.empty()) {
      const Place from = places_[reached.back()];
      reached.pop_back();
      for (const std::uint32_t next : map_.overlaps(from.route, from.cell)) {
        if (!is_free(next)) continue;
        numbers_[next] = number;
        reached.push_back(next);
      }
    }
  }

  const ConflictMap& map_;
  std::vector<Place> places_;  ///< of each cell, by its number, one on a route
  std::vector<std::uint32_t> numbers_;
  std::uint32_t last_{};
};

}  // namespace

std::vector<std::uint32_t> conflict_zones(const ConflictMap& map) { return Zones(map).number(); }

std::uint32_t zone_behind(const ConflictMap& map, std::size_t route, double s_m) {
  const std::size_t next = map.index_of(route, map.count_at(route, s_m) + 1);
  return conflict_zones(map)[map.cell(route, next)];
}

}  // namespace hlc::right_of_way
