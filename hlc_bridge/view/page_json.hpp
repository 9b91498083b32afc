#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner/geometry/pose.hpp"

/// Numbers of page_messages.hpp: whole ones of a unit, columns and lines of differences.
namespace hlc::view {

using Json = nlohmann::ordered_json;

inline constexpr double kUnit_m = 1e-4;
inline constexpr double kUnit_rad = 1e-3;
inline constexpr double kUnit_mps = 1e-3;

/// @return 0 for a value that is not finite or beyond kLargestCoordinate_m
[[nodiscard]] std::int64_t whole(double value, double unit);

/// A column of differences.
class Differences {
 public:
  void add(std::int64_t value) {
    values_.push_back(value - last_);
    last_ = value;
  }
  void add(double value, double unit) { add(whole(value, unit)); }
  [[nodiscard]] Json json() const { return values_; }

 private:
  std::vector<std::int64_t> values_;
  std::int64_t last_{};
};

/// Columns x, y and yaw.
class Poses {
 public:
  void add(const Pose& pose) {
    x_.add(pose.x_m, kUnit_m);
    y_.add(pose.y_m, kUnit_m);
    yaw_.add(pose.heading_rad, kUnit_rad);
  }
  [[nodiscard]] Json json() const {
    return {{"x", x_.json()}, {"y", y_.json()}, {"yaw", yaw_.json()}};
  }

 private:
  Differences x_;
  Differences y_;
  Differences yaw_;
};

/// x and y in turn.
template <class Points>
[[nodiscard]] Json line_json(const Points& points_m) {
  std::vector<std::int64_t> values;
  std::int64_t last_x = 0;
  std::int64_t last_y = 0;
  for (const Point& point : points_m) {
    const std::int64_t x = whole(point.x(), kUnit_m);
    const std::int64_t y = whole(point.y(), kUnit_m);
    values.push_back(x - last_x);
    values.push_back(y - last_y);
    last_x = x;
    last_y = y;
  }
  return values;
}

/// Bytes that are not UTF-8 are replaced.
[[nodiscard]] inline std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace hlc::view
