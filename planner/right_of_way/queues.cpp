#include "planner/right_of_way/queues.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <random>
#include <utility>

#include "planner/right_of_way/stretch.hpp"

namespace hlc::right_of_way {
namespace {

/// How many stretches each vehicle is to pass. With fewer, states were entered in which every turn
/// closes a circle: twenty cars that drive exactly along tours of the lab's road (draws of 800 s)
/// came into one in one draw of 12 with one stretch, one of 16 with two, none of 32 with three.
constexpr int kStretches = 3;
/// With one order, three of ten runs of twenty controllers on such tours ended in a circle, with 16
/// none of 13.
constexpr std::size_t kOrders = 16;
/// Few, since they may be tried for every vehicle that waits.
constexpr std::size_t kOrdersIfReserved = 4;
/// How far a vehicle goes on behind them at most, to make room for others; for the µCar. Not tuned.
constexpr double kMakesRoom_m = 6.0;

/// The first cell behind the next stretches of conflict cells.
std::int64_t behind_next_stretches(const ConflictMap& map, const coordination::LaneClaim& claim) {
  const auto is_conflict = [&](std::int64_t cell) {
    return map.is_conflict(claim.route, map.index_of(claim.route, cell));
  };
  const auto whole_route = static_cast<std::int64_t>(map.num_cells(claim.route));
  std::int64_t cell = map.count_at(claim.route, claim.place_m + claim.ahead_m) + 1;
  const std::int64_t end = cell + whole_route;
  for (int i = 0; i < kStretches; ++i) {
    while (cell < end && !is_conflict(cell)) ++cell;
    while (cell < end && is_conflict(cell)) ++cell;
  }
  return cell;
}

/// Indices of so many vehicles; number 0 is ascending.
std::vector<std::size_t> order_of_turns(std::size_t num_vehicles, std::size_t number) {
  std::vector<std::size_t> order(num_vehicles);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(number);
  for (std::size_t i = order.size(); number > 0 && i > 1; --i) {  // the same with every library
    std::swap(order[i - 1], order[random() % i]);
  }
  return order;
}

}  // namespace

Queues::Queues(const ConflictMap& map, std::span<const Holder> holders,
               std::span<const double> ahead_m, std::span<const Blocked> blocked)
    : map_(&map), blocked_(blocked), holders_(map.num_cells(), kNobody) {
  for (std::size_t who = 0; who < holders.size(); ++who) {
    const coordination::LaneClaim& claim = holders[who].claim;
    Car& car = cars_.emplace_back();
    car.route = claim.route;
    car.at = map.count_at(claim.route, claim.place_m + ahead_m[who]);
    car.target = behind_next_stretches(map, claim);
    car.last = std::max(car.at, car.target) +
               static_cast<std::int64_t>(map.scale() * kMakesRoom_m / map.cell_m(claim.route));
    holders_[cell_of(car)] = static_cast<std::uint16_t>(who);
  }
}

std::vector<std::size_t> Queues::stuck() const {
  std::vector<std::size_t> fewest(cars_.size());
  std::iota(fewest.begin(), fewest.end(), std::size_t{0});
  for (std::size_t number = 0; number < kOrders && !fewest.empty(); ++number) {
    Queues queues = *this;
    queues.take_turns(order_of_turns(cars_.size(), number));
    std::vector<std::size_t> stuck = queues.left();
    if (stuck.size() < fewest.size()) fewest = std::move(stuck);
  }
  return fewest;
}

void Queues::take_turns(const std::vector<std::size_t>& order) {
  do {
    close_up();
  } while (!left().empty() && (take_turn(order, false) || take_turn(order, true)));
}

bool Queues::passes_if_reserved(std::size_t who, const std::vector<bool>& cells) const {
  std::optional<std::size_t> num_stuck;
  for (std::size_t number = 0; number < kOrdersIfReserved; ++number) {
    const std::vector<std::size_t> order = order_of_turns(cars_.size(), number);
    Queues queues = *this;
    queues.reserved_ = Reservation{.who = who, .cells = cells};
    if (!queues.takes_turns_until_free(who, order)) continue;
    queues.pass(who);
    queues.reserved_.reset();
    queues.take_turns(order);
    const std::size_t num_left = queues.left().size();
    if (num_left > 0 && !num_stuck) num_stuck = stuck().size();
    if (num_left == 0 || num_left <= *num_stuck) return true;
  }
  return false;
}

bool Queues::takes_turns_until_free(std::size_t who, const std::vector<std::size_t>& order) {
  while (!is_way_free(who)) {
    close_up();
    if (!is_way_free(who) && !take_turn(order, false) && !take_turn(order, true)) return false;
  }
  return true;
}

/// Those that have passed their stretches go on only to make room.
bool Queues::take_turn(const std::vector<std::size_t>& order, bool has_passed) {
  for (const std::size_t who : order) {
    const Car& car = cars_[who];
    if (car.has_passed() != has_passed || car.at >= car.last || !is_way_free(who)) continue;
    pass(who);
    return true;
  }
  return false;
}

void Queues::close_up() {
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t who = 0; who < cars_.size(); ++who) {
      while (cars_[who].at < cars_[who].last && goes_on(who)) moved = true;
    }
  }
}

bool Queues::goes_on(std::size_t who) {
  Car& car = cars_[who];
  const std::size_t next = map_->index_of(car.route, car.at + 1);
  if (map_->is_conflict(car.route, next) || !is_way_free(who)) return false;
  pass(who);
  return true;
}

/// Whoever has only such in its way as are in no circle is in none, either; what is no vehicle is
/// in none: a car behind it is stuck, but nobody's way depends on its turn.
std::size_t Queues::num_in_circles() const {
  Queues closed_up = *this;
  closed_up.close_up();
  std::vector<bool> is_outside(cars_.size());
  std::size_t inside = cars_.size();
  for (bool found = true; found;) {
    found = false;
    for (std::size_t who = 0; who < cars_.size(); ++who) {
      if (is_outside[who]) continue;
      const bool may_be_inside = closed_up.visit_in_the_way(
          who, [&](std::uint16_t other) { return other != kNobody && !is_outside[other]; });
      if (may_be_inside) continue;
      is_outside[who] = true;
      found = true;
      --inside;
    }
  }
  return inside;
}

void Queues::pass(std::size_t who) {
  Car& car = cars_[who];
  if (holders_[cell_of(car)] == who) holders_[cell_of(car)] = kNobody;  // two may claim one cell
  do {
    ++car.at;
  } while (map_->is_conflict(car.route, map_->index_of(car.route, car.at)));
  holders_[cell_of(car)] = static_cast<std::uint16_t>(who);
}

/// Visits what is in the way to the next cell in which it may stop, kNobody for what is no vehicle,
/// until `visit` is true. @return whether it was
template <class Visit>
bool Queues::visit_in_the_way(std::size_t who, const Visit& visit) const {
  const Car& car = cars_[who];
  bool is_found = false;
  const std::optional<std::int64_t> end =
      end_of_stretch(*map_, car.route, car.at + 1, [&](std::size_t index) {
        is_found = is_blocked(car.route, index) && visit(kNobody);
        is_found = is_found ||
                   std::ranges::any_of(map_->overlaps(car.route, index), [&](std::uint32_t cell) {
                     const std::uint16_t other = holders_[cell];
                     return other != kNobody && other != who && visit(other);
                   });
        return !is_found;
      });
  return end ? false : is_found || visit(kNobody);
}

bool Queues::is_way_free(std::size_t who) const {
  return may_enter(who) && !visit_in_the_way(who, [](std::uint16_t) { return true; });
}

/// Who is in a reserved cell may go on to leave them.
bool Queues::may_enter(std::size_t who) const {
  const Car& car = cars_[who];
  if (!reserved_ || who == reserved_->who || reserved_->cells[cell_of(car)]) return true;
  return end_of_stretch(
             *map_, car.route, car.at + 1,
             [&](std::size_t index) { return !reserved_->cells[map_->cell(car.route, index)]; })
      .has_value();
}

bool Queues::is_blocked(std::size_t route, std::size_t index) const {
  return std::ranges::any_of(blocked_, [&](const Blocked& one) {
    return intersects(map_->area_m(route, index), one.area_m);
  });
}

std::uint32_t Queues::cell_of(const Car& car) const {
  return map_->cell(car.route, map_->index_of(car.route, car.at));
}

std::vector<std::size_t> Queues::left() const {
  std::vector<std::size_t> left;
  for (std::size_t who = 0; who < cars_.size(); ++who) {
    if (!cars_[who].has_passed()) left.push_back(who);
  }
  return left;
}

}  // namespace hlc::right_of_way
