#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "planner/geometry/pose.hpp"

namespace hlc {

/// Points of the plane by their number, in squares: for finding those near a place without looking
/// at all of them.
class NearPoints {
 public:
  /// @param radius_m  of every later question, > 0
  explicit NearPoints(double radius_m) : radius_m_(radius_m) {}

  /// Numbers count from 0 in the order of the calls.
  void add(const Point& point_m) {
    squares_[key(column(point_m.x()), column(point_m.y()))].push_back(
        static_cast<std::uint32_t>(count_++));
  }

  /// Calls `note(number)` for every point within the radius of the place, and for some others, in
  /// an order that depends on the place and the points only.
  template <class Note>
  void visit(const Point& place_m, Note note) const {
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto square = squares_.find(key(column(place_m.x()) + dx, column(place_m.y()) + dy));
        if (square == squares_.end()) continue;
        for (const std::uint32_t number : square->second) note(number);
      }
    }
  }

 private:
  [[nodiscard]] std::int64_t column(double value_m) const {
    return static_cast<std::int64_t>(std::floor(value_m / radius_m_));
  }
  /// Two squares may share a key: then some more points are visited.
  [[nodiscard]] static std::int64_t key(std::int64_t x, std::int64_t y) { return x * 1000003 + y; }

  double radius_m_;
  std::size_t count_{};
  std::unordered_map<std::int64_t, std::vector<std::uint32_t>> squares_;
};

}  // namespace hlc
