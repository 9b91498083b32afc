#include "tests/hlc_bridge/dds/mutated_datagram.hpp"

#include <array>
#include <cstdint>
#include <cstring>

namespace hlc::dds {
namespace {

// Those of the standard, some that it does not have, security's and statistics.
constexpr std::array<unsigned char, 19> kKinds{0x01, 0x06, 0x07, 0x08, 0x09, 0x0c, 0x0d,
                                               0x0e, 0x0f, 0x12, 0x13, 0x15, 0x16, 0x30,
                                               0x31, 0x32, 0x34, 0x80, 0xff};
constexpr std::array<std::uint32_t, 12> kWords{
    0, 1, 2, 31, 255, 256, 0xffff, 0x10000000, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff};

template <class Container>
auto& any_of(Container& container, std::mt19937_64& random) {
  return container[random() % container.size()];
}

void change_byte(Bytes& datagram, std::mt19937_64& random) {
  any_of(datagram, random) = static_cast<unsigned char>(random());
}

void change_word(Bytes& datagram, std::mt19937_64& random) {
  if (datagram.size() < kHeaderBytes + 4) return;
  const std::size_t words = (datagram.size() - kHeaderBytes) / 4;
  const std::uint32_t word = any_of(kWords, random);
  std::memcpy(&datagram[kHeaderBytes + 4 * (random() % words)], &word, 4);
}

void change_submessage(Bytes& datagram, std::mt19937_64& random) {
  const std::vector<std::size_t> places = submessages(datagram);
  if (places.empty()) return;
  const std::size_t at = any_of(places, random);
  switch (random() % 3) {
    case 0:
      datagram[at] = any_of(kKinds, random);
      break;
    case 1:
      datagram[at + 1] ^= static_cast<unsigned char>(1U << random() % 8);
      break;
    default:
      datagram[at + 2 + random() % 2] = static_cast<unsigned char>(random());
  }
}

// Where heartbeats, acknowledgements, gaps and data have theirs, or their count.
void change_sequence_number(Bytes& datagram, std::mt19937_64& random) {
  const std::vector<std::size_t> places = submessages(datagram);
  if (places.empty()) return;
  const std::size_t at = any_of(places, random) + 12 + 4 * (random() % 5);
  const std::array<std::uint32_t, 2> number{any_of(kWords, random), any_of(kWords, random)};
  if (at + sizeof number <= datagram.size()) std::memcpy(&datagram[at], &number, sizeof number);
}

void cut(Bytes& datagram, std::mt19937_64& random) {
  datagram.resize(kHeaderBytes + random() % (datagram.size() - kHeaderBytes + 1));
}

void insert(Bytes& datagram, const Bytes& pieces, std::mt19937_64& random) {
  std::vector<std::size_t> places = submessages(datagram);
  places.push_back(datagram.size());
  datagram.insert(datagram.begin() + static_cast<long>(any_of(places, random)), pieces.begin(),
                  pieces.end());
}

}  // namespace

std::vector<std::size_t> submessages(const Bytes& datagram) {
  std::vector<std::size_t> places;
  for (std::size_t at = kHeaderBytes; at + 4 <= datagram.size();) {
    places.push_back(at);
    const bool is_little_endian = (datagram[at + 1] & 1U) != 0;
    const std::size_t low = datagram[at + (is_little_endian ? 2 : 3)];
    const std::size_t high = datagram[at + (is_little_endian ? 3 : 2)];
    at += 4 + low + 256 * high;
  }
  return places;
}

Bytes statistics_submessage() {
  Bytes bytes(4 + 56, 0);
  bytes[0] = 0x80;
  bytes[1] = 1;   // little-endian
  bytes[2] = 56;  // bytes that follow
  return bytes;
}

Bytes mutated(Bytes datagram, const std::vector<Bytes>& others, std::mt19937_64& random) {
  if (random() % 3 == 0) return datagram;
  for (std::uint64_t changes = 1 + random() % 4; changes > 0; --changes) {
    switch (random() % 7) {
      case 0:
        change_byte(datagram, random);
        break;
      case 1:
        change_word(datagram, random);
        break;
      case 2:
        change_submessage(datagram, random);
        break;
      case 3:
      case 4:
        change_sequence_number(datagram, random);
        break;
      case 5:
        cut(datagram, random);
        break;
      default: {
        const Bytes& other = any_of(others, random);
        const bool is_statistics = random() % 2 == 0;
        insert(datagram,
               is_statistics ? statistics_submessage()
                             : Bytes(other.begin() + kHeaderBytes, other.end()),
               random);
      }
    }
  }
  return datagram;
}

}  // namespace hlc::dds
