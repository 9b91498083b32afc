#include "hlc_bridge/render/base64.hpp"

#include <cstdint>
#include <stdexcept>

namespace hlc::render {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string bytes_of_base64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() * 3 / 4);
  std::uint32_t bits = 0;
  int num_bits = 0;
  for (const char digit : text) {
    const std::size_t value = kDigits.find(digit);
    if (value == std::string_view::npos) {
      throw std::invalid_argument("base64: character outside the alphabet");
    }
    bits = (bits << 6U) | static_cast<std::uint32_t>(value);
    num_bits += 6;
    if (num_bits < 8) continue;
    num_bits -= 8;
    bytes += static_cast<char>((bits >> static_cast<unsigned>(num_bits)) & 0xFFU);
  }
  return bytes;
}

}  // namespace hlc::render
