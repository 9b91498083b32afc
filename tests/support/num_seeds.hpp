#pragma once

#include <cstdint>
#include <cstdlib>

namespace hlc::test {

/// How many seeds a property test tries: so many in the short form, ten times as many in the long
/// one (environment variable HLC_TEST_LONG; `run_tests.sh --long` sets it).
[[nodiscard]] inline std::uint64_t num_seeds(std::uint64_t short_form) {
  static const bool is_long = std::getenv("HLC_TEST_LONG") != nullptr;
  return is_long ? 10 * short_form : short_form;
}

}  // namespace hlc::test
