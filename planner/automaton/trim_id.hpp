#pragma once

#include <compare>
#include <cstddef>

namespace hlc {

/// Number of a trim, from 0: the paper's pi_1 is TrimId{0}. Printed and written in files from 1.
struct TrimId {
  std::size_t index{};
  friend auto operator<=>(const TrimId&, const TrimId&) = default;
};

/// An edge by its ends.
struct TrimPair {
  TrimId from;
  TrimId to;
  friend auto operator<=>(const TrimPair&, const TrimPair&) = default;
};

}  // namespace hlc
