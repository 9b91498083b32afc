#pragma once

#include <cstddef>
#include <random>
#include <vector>

namespace hlc::dds {

using Bytes = std::vector<unsigned char>;

inline constexpr std::size_t kHeaderBytes = 20;  ///< of an RTPS datagram

/// Places of the submessages' headers.
[[nodiscard]] std::vector<std::size_t> submessages(const Bytes& datagram);

/// A statistics submessage, as the library appends one to each datagram if a program asks for it.
[[nodiscard]] Bytes statistics_submessage();

/// One of three as it is; of the others, one to four changes: bytes and words, to the bounds of
/// their types in particular; kinds, flags and lengths of submessages; the end cut off; the
/// submessages of another datagram, or statistics, at its end or in its middle.
/// @param others  not empty, all with a header
/// @pre datagram.size() >= kHeaderBytes
[[nodiscard]] Bytes mutated(Bytes datagram, const std::vector<Bytes>& others,
                            std::mt19937_64& random);

}  // namespace hlc::dds
