// The program `fuzz`: libFuzzer's flags, and --target=NAME or --write_samples=FOLDER.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "planner/common/text_file.hpp"
#include "tests/fuzz/target.hpp"

namespace {

using hlc::fuzz::Target;

const Target* target = nullptr;

/// A counter for each place in the program, by its address: GCC calls a function at every branch,
/// libFuzzer, which refuses that of its own, looks at counters.
std::array<std::uint8_t, std::size_t{1} << 16U> counters{};

void write_samples(const std::filesystem::path& folder, const std::vector<Target>& targets) {
  for (const Target& one : targets) {
    std::filesystem::create_directories(folder / one.name);
    std::size_t number = 0;
    for (const std::string& bytes : one.samples()) {
      hlc::write_file(folder / one.name / fmt::format("{}", ++number), bytes);
    }
    fmt::print("{}\n", one.name);
  }
}

}  // namespace

// The names are the compiler's and libFuzzer's, and the attribute is GCC's.
// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming)
// NOLINTBEGIN(clang-diagnostic-unknown-attributes)
extern "C" {

void __sanitizer_cov_8bit_counters_init(std::uint8_t* begin, std::uint8_t* end);

/// In place of the one without the prefix (the linker's --wrap).
__attribute__((no_sanitize_coverage, no_sanitize("address", "undefined"))) void
__wrap___sanitizer_cov_trace_pc() {
  const auto address = reinterpret_cast<std::uintptr_t>(__builtin_return_address(0));
  ++*(counters.data() + ((address * 0x9E3779B97F4A7C15U) >> 48U));
}

// GCC's, which libFuzzer does not have.
__attribute__((no_sanitize_coverage)) void __sanitizer_cov_trace_cmpf(float /*a*/, float /*b*/) {}
__attribute__((no_sanitize_coverage)) void __sanitizer_cov_trace_cmpd(double /*a*/, double /*b*/) {}

int LLVMFuzzerInitialize(int* argc, char*** argv) {
  static const std::vector<Target> kTargets = hlc::fuzz::all_targets();
  for (int i = 1; i < *argc; ++i) {
    const std::string flag = (*argv)[i];
    if (flag.starts_with("--write_samples=")) {
      write_samples(flag.substr(flag.find('=') + 1), kTargets);
      std::exit(0);
    }
    if (!flag.starts_with("--target=")) continue;
    const auto found = std::ranges::find(kTargets, flag.substr(flag.find('=') + 1), &Target::name);
    if (found != kTargets.end()) target = &*found;
  }
  if (target == nullptr) {
    fmt::print(stderr, "fuzz: --target=NAME or --write_samples=FOLDER must be given\n");
    std::exit(2);
  }
  __sanitizer_cov_8bit_counters_init(counters.data(), counters.data() + counters.size());
  return 0;
}

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  hlc::fuzz::read(*target, {reinterpret_cast<const char*>(bytes), size});
  return 0;
}

}  // extern "C"
// NOLINTEND(clang-diagnostic-unknown-attributes)
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)
