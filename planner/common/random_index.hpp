#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>

namespace hlc {

/// Uniform in 0 ... size - 1, and the same on every machine: the standard fixes every bit of
/// std::mt19937_64, but not those of its distributions and of std::shuffle. @pre size >= 1
[[nodiscard]] inline std::size_t random_index(std::mt19937_64& random, std::size_t size) {
  constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t end = kLargest - kLargest % size;  // a multiple: no index is favoured
  std::uint64_t number = random();
  while (number >= end) number = random();
  return number % size;
}

}  // namespace hlc
