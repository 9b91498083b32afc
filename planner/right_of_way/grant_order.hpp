#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/coordination/messages.hpp"

namespace hlc::right_of_way {

/// What one vehicle holds: the cells of its route from its place to the end of its authority.
/// Within it, the vehicle may stop anywhere.
struct Holder {
  VehicleId vehicle;
  coordination::LaneClaim claim;
  friend bool operator==(const Holder&, const Holder&) = default;
};

/// Whose authority is extended first (grant.hpp). A rule is one function.
struct GrantOrder {
  std::string_view name;
  /// True if a comes before b: a strict weak order, a pure function of what the two announced.
  /// Vehicles that are alike in it follow by their ids.
  bool (*is_before)(const Holder& a, const Holder& b);
  /// Who waits comes before who does not. Only then may a vehicle decline what it is granted
  /// (way_on.hpp): otherwise it might be granted the same again and again, and nobody else.
  bool puts_waiting_first{false};
};

/// Sorts indices of `holders` by the order. @pre each is one of them
void sort_by(const GrantOrder& order, std::span<const Holder> holders,
             std::vector<std::size_t>& indices);

/// Who has waited longest, then who is nearest to the end of its authority.
extern const GrantOrder kLongestWait;
/// Who is nearest to the end of its authority, however long others have waited.
extern const GrantOrder kNearestEnd;

/// All, kLongestWait, the default, first. A further rule is one more entry.
[[nodiscard]] std::span<const GrantOrder* const> grant_orders();
/// nullptr: there is none of this name.
[[nodiscard]] const GrantOrder* grant_order(std::string_view name);
[[nodiscard]] std::vector<std::string> grant_order_names();

}  // namespace hlc::right_of_way
