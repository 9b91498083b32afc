#include "hlc_bridge/result/trace_hash.hpp"

#include <array>
#include <bit>
#include <cstdint>

#include "planner/common/sha256.hpp"

namespace hlc::result {
namespace {

constexpr std::uint64_t kMissingBits = 0x7ff8000000000000ULL;

/// Little-endian bytes.
void add(Sha256& hash, std::uint64_t bits) {
  std::array<char, 8> bytes{};
  for (char& byte : bytes) {
    byte = static_cast<char>(bits & 0xffU);
    bits >>= 8U;
  }
  hash.add({bytes.data(), bytes.size()});
}

void add(Sha256& hash, const Pose& pose) {
  for (const double value : {pose.x_m, pose.y_m, pose.heading_rad}) {
    add(hash, std::bit_cast<std::uint64_t>(value));
  }
}

}  // namespace

std::string trace_sha256(std::span<const StepRecord> rows) {
  Sha256 hash;
  for (const StepRecord& row : rows) {
    add(hash, row.record.report.planned_pose);
    if (row.driven) {
      add(hash, *row.driven);
    } else {
      for (int i = 0; i < 3; ++i) {
        add(hash, kMissingBits);
      }
    }
  }
  return hash.hex();
}

}  // namespace hlc::result
