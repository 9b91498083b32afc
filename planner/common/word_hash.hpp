#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

namespace hlc {

/// A hash of a sequence of 64-bit words, to find out whether two programs have the same data: two
/// sequences that differ have the same hash with a probability of about 2^-64. Not for data that
/// somebody chooses with intent (Sha256); a hundred times as fast as that.
///
///     h <- mix(h + w + 0x9e3779b97f4a7c15) for each word w, h = 0 at first,
///
/// mix being the finalizer of SplitMix64, a bijection of 64-bit words. Numbers are hashed by their
/// bits: 0.0 and -0.0 differ.
class WordHash {
 public:
  void add(std::uint64_t word) {
    std::uint64_t z = hash_ + word + 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    hash_ = z ^ (z >> 31U);
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    for (const char letter : text) add(std::uint64_t{static_cast<unsigned char>(letter)});
  }

  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_{};
};

}  // namespace hlc
