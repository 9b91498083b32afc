#pragma once

#include <cstdint>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc::closed_loop {

/// One more number of a seed: the same on every machine (the finisher of splitmix64).
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t seed, std::uint64_t salt) {
  std::uint64_t z = seed + 0x9E37'79B9'7F4A'7C15ULL * (salt + 1);
  z = (z ^ (z >> 30U)) * 0xBF58'476D'1CE4'E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D0'49BB'1331'11EBULL;
  return z ^ (z >> 31U);
}

/// Random numbers of a seed, the same on every machine (the standard's distributions are not).
class SeededRandom {
 public:
  explicit SeededRandom(std::uint64_t seed) : seed_(seed) {}

  [[nodiscard]] std::uint64_t next() { return mixed(seed_, count_++); }
  /// In 0 ... count - 1. @pre count > 0
  [[nodiscard]] std::uint64_t below(std::uint64_t count) { return next() % count; }
  /// In [0, 1).
  [[nodiscard]] double share() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }
  [[nodiscard]] bool chance(double probability) { return share() < probability; }
  /// In least ... most. @pre least <= most
  [[nodiscard]] Nanoseconds between(Nanoseconds least, Nanoseconds most) {
    return least + below(most - least + 1);
  }

 private:
  std::uint64_t seed_;
  std::uint64_t count_{};
};

}  // namespace hlc::closed_loop
