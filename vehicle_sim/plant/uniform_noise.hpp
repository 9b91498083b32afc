#pragma once

#include <cstdint>
#include <random>

namespace hlc::plant {

/// Seeded uniform noise. The standard fixes every bit of std::mt19937_64 but not of its
/// distributions, so the mapping to [-half_width, half_width) is written out: a seed means the same
/// run everywhere.
class UniformNoise {
 public:
  explicit UniformNoise(std::uint64_t seed) : generator_(seed) {}

  [[nodiscard]] double draw(double half_width) {
    constexpr double kUnit = 0x1.0p-53;  // 53 random bits fill a double's mantissa
    const double unit = static_cast<double>(generator_() >> 11U) * kUnit;
    return half_width * (2.0 * unit - 1.0);
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace hlc::plant
