#include "hlc_bridge/view/page_json.hpp"

#include <cmath>

namespace hlc::view {

std::int64_t whole(double value, double unit) {
  const bool is_sound = std::isfinite(value) && std::abs(value) < kLargestCoordinate_m;
  return is_sound ? std::llround(value / unit) : 0;
}

}  // namespace hlc::view
