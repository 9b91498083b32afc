#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace hlc::test {

/// How many seeds a property test tries: so many in the short form, ten times as many in the long
/// one (environment variable HLC_TEST_LONG; `run_tests.sh --long` sets it).
[[nodiscard]] inline std::uint64_t num_seeds(std::uint64_t short_form) {
  static const bool is_long = std::getenv("HLC_TEST_LONG") != nullptr;
  return is_long ? 10 * short_form : short_form;
}

/// Under a sanitizer code takes five to ten times as long, and what is looked for there, bad
/// accesses and undefined behaviour, depends on the paths through the code, not on many examples
/// of each: a costly test takes every kThinning-th example.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr std::uint32_t kThinning = 5;
#else
inline constexpr std::uint32_t kThinning = 1;
#endif

/// The same for tests that take half a minute and more under a sanitizer: a fifth there, at least
/// one.
[[nodiscard]] inline std::uint64_t num_costly_seeds(std::uint64_t short_form) {
  return std::max<std::uint64_t>(num_seeds(short_form) / kThinning, 1);
}

}  // namespace hlc::test
