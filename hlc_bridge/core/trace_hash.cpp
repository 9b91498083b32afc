#include "hlc_bridge/core/trace_hash.hpp"

#include <openssl/evp.h>

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <stdexcept>

namespace hlc {
namespace {

constexpr std::uint64_t kMissingBits = 0x7ff8000000000000ULL;

class Sha256 {
 public:
  Sha256() : context_{EVP_MD_CTX_new(), &EVP_MD_CTX_free} {
    check(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }

  void add(std::uint64_t bits) {
    std::array<unsigned char, 8> bytes{};
    for (unsigned char& byte : bytes) {
      byte = static_cast<unsigned char>(bits & 0xffU);
      bits >>= 8U;
    }
    check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
  }

  void add(const Pose& pose) {
    for (const double value : {pose.x_m, pose.y_m, pose.heading_rad}) {
      add(std::bit_cast<std::uint64_t>(value));
    }
  }

  [[nodiscard]] std::string hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    check(EVP_DigestFinal_ex(context_.get(), digest.data(), &size) == 1);
    constexpr const char* kDigits = "0123456789abcdef";
    std::string text;
    for (unsigned int i = 0; i < size; ++i) {
      text += kDigits[digest.at(i) >> 4U];
      text += kDigits[digest.at(i) & 0xfU];
    }
    return text;
  }

 private:
  static void check(bool good) {
    if (!good) {
      throw std::runtime_error("SHA-256: the OpenSSL library refuses");
    }
  }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string trace_sha256(std::span<const StepRecord> rows) {
  Sha256 hash;
  for (const StepRecord& row : rows) {
    hash.add(row.record.report.planned_pose);
    if (row.driven) {
      hash.add(*row.driven);
    } else {
      for (int i = 0; i < 3; ++i) {
        hash.add(kMissingBits);
      }
    }
  }
  return hash.hex();
}

}  // namespace hlc
