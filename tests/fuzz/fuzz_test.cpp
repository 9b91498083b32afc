// The short form: the same targets without libFuzzer, with changes that do not look at coverage.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "tests/fuzz/target.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::fuzz {
/// For GoogleTest.
void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }

namespace {

/// One to four changes: a byte, a number, a piece cut out, repeated, or taken from another sample.
std::string changed(std::string bytes, const std::string& other, std::mt19937_64& random) {
  for (std::uint64_t changes = 1 + random() % 4; changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = random() % bytes.size();
    const std::size_t size = 1 + random() % std::min<std::size_t>(64, bytes.size() - at);
    switch (random() % 5) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.replace(at, size, random() % 2 == 0 ? "-1e999" : "\xff\xff\xff\xff");
        break;
      case 2:
        bytes.erase(at, random() % 2 == 0 ? size : std::string::npos);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, size));
        break;
      default:
        bytes.insert(at, other.substr(random() % (other.size() + 1), size));
    }
  }
  return bytes;
}

class FuzzTarget : public testing::TestWithParam<Target> {};

TEST_P(FuzzTarget, ReadsOrRefusesChangedInputs) {
  const std::vector<std::string> samples = GetParam().samples();
  ASSERT_FALSE(samples.empty());
  for (const std::string& sample : samples) ASSERT_NO_THROW(GetParam().read(sample));
  // Seconds for each target, but for large files.
  constexpr std::size_t kBytes = 4'000'000;
  std::size_t bytes = 0;
  for (const std::string& sample : samples) bytes += sample.size();
  const std::uint64_t inputs =
      test::num_costly_seeds(std::min<std::size_t>(1000, kBytes * samples.size() / bytes));
  for (std::uint64_t seed = 0; seed < inputs; ++seed) {
    std::mt19937_64 random(seed);
    const std::string& other = samples[random() % samples.size()];
    const std::string input = changed(samples[seed % samples.size()], other, random);
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_NO_THROW(read(GetParam(), input)) << "seed " << seed;
    ASSERT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds{10}) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(All, FuzzTarget, testing::ValuesIn(all_targets()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace hlc::fuzz
