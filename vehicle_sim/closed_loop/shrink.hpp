#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace hlc::closed_loop {

/// A minimal subset of `items` for which `fails` still holds: none of it can be removed (delta
/// debugging: halves first, then single items). Calls `fails` O(n^2) times at most.
/// @param fails  the same answer for the same items; true for all of them
template <class Item>
[[nodiscard]] std::vector<Item> shrunk(std::vector<Item> items,
                                       const std::function<bool(const std::vector<Item>&)>& fails) {
  for (std::size_t size = std::max<std::size_t>(items.size() / 2, 1);; size /= 2) {
    for (std::size_t from = 0; from < items.size();) {
      std::vector<Item> rest = items;
      const auto begin = rest.begin() + static_cast<std::ptrdiff_t>(from);
      const std::size_t left_out = std::min(size, items.size() - from);
      rest.erase(begin, begin + static_cast<std::ptrdiff_t>(left_out));
      if (fails(rest)) {
        items = std::move(rest);
        if (size == 1) from = 0;  // without it others may be removable
      } else {
        from += size;
      }
    }
    if (size <= 1) return items;
  }
}

}  // namespace hlc::closed_loop
