#include "planner/right_of_way/grant_order.hpp"

#include <algorithm>
#include <array>

namespace hlc::right_of_way {
namespace {

bool is_nearer_to_its_end(const Holder& a, const Holder& b) {
  return a.claim.ahead_m < b.claim.ahead_m;
}

bool has_waited_longer(const Holder& a, const Holder& b) {
  if (a.claim.waiting_steps != b.claim.waiting_steps) {
    return a.claim.waiting_steps > b.claim.waiting_steps;
  }
  return is_nearer_to_its_end(a, b);
}

}  // namespace

constinit const GrantOrder kLongestWait{
    .name = "longest_wait", .is_before = &has_waited_longer, .puts_waiting_first = true};
constinit const GrantOrder kNearestEnd{.name = "nearest_end", .is_before = &is_nearer_to_its_end};

void sort_by(const GrantOrder& order, std::span<const Holder> holders,
             std::vector<std::size_t>& indices) {
  std::ranges::sort(indices, [&](std::size_t a, std::size_t b) {
    if (order.is_before(holders[a], holders[b])) return true;
    if (order.is_before(holders[b], holders[a])) return false;
    return holders[a].vehicle < holders[b].vehicle;
  });
}

std::span<const GrantOrder* const> grant_orders() {
  static constexpr std::array kAll{&kLongestWait, &kNearestEnd};
  return kAll;
}

const GrantOrder* grant_order(std::string_view name) {
  const auto all = grant_orders();
  const auto found = std::ranges::find(all, name, &GrantOrder::name);
  return found == all.end() ? nullptr : *found;
}

std::vector<std::string> grant_order_names() {
  std::vector<std::string> names;
  for (const GrantOrder* one : grant_orders()) names.emplace_back(one->name);
  return names;
}

}  // namespace hlc::right_of_way
