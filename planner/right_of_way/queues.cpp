#include "planner/right_of_way/queues.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>

namespace hlc::right_of_way {
namespace {

/// How many stretches each vehicle is to pass. Of twenty cars that drive exactly along tours of the
/// lab's road (draws of 800 s), one draw of 12 came into a state without a further turn with one
/// stretch, one of 16 with two, none of 32 with three.
constexpr int kStretches = 3;
/// Orders of turns that are tried: without regard to circles, which costs little, then with it.
/// With one of each, three of ten runs of cars on such tours ended in a circle.
constexpr std::size_t kQuickOrders = 12;
constexpr std::size_t kCarefulOrders = 3;
/// How far a vehicle may have to go on behind them to make room for others; for the µCar.
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

}  // namespace

Queues::Queues(const ConflictMap& map, std::span<const coordination::LaneClaim> claims,
               std::span<const coordination::LaneClaim> from, std::span<const Blocked> blocked)
    : map_(&map), blocked_(blocked), holders_(map.num_cells(), kNobody) {
  for (std::size_t who = 0; who < claims.size(); ++who) {
    const coordination::LaneClaim& claim = claims[who];
    Car& car = cars_.emplace_back();
    car.route = claim.route;
    car.at = map.count_at(claim.route, claim.place_m + claim.ahead_m);
    car.target = behind_next_stretches(map, from[who]);
    car.last = std::max(car.at, car.target) +
               static_cast<std::int64_t>(map.scale() * kMakesRoom_m / map.cell_m(claim.route));
    holders_[cell_of(car)] = static_cast<std::uint16_t>(who);
  }
}

bool Queues::all_get_on() const {
  for (std::size_t order = 0; order < kQuickOrders; ++order) {
    Queues queues = *this;
    queues.take_turns(true, order);
    if (!queues.is_any_left()) return true;
  }
  return false;
}

std::vector<std::size_t> Queues::stuck() const {
  if (all_get_on()) return {};
  std::vector<std::size_t> all(cars_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (has_circle()) return all;
  std::vector<std::size_t> fewest = all;
  for (std::size_t order = 0; order < kCarefulOrders && !fewest.empty(); ++order) {
    Queues careful = *this;
    careful.take_turns(false, order);
    std::vector<std::size_t> stuck = all;
    std::erase_if(stuck, [&](std::size_t who) { return careful.cars_[who].has_passed(); });
    if (stuck.size() < fewest.size()) fewest = std::move(stuck);
  }
  return fewest;
}

void Queues::take_turns(bool closes_circles, std::size_t order) {
  order_.resize(cars_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::mt19937_64 random(order);
  for (std::size_t i = order_.size(); order > 0 && i > 1; --i) {  // the same with every library
    std::swap(order_[i - 1], order_[random() % i]);
  }
  do {
    close_up();
  } while (is_any_left() && (take_turn(closes_circles, false) || take_turn(closes_circles, true)));
}

/// Those that have passed their stretches go on only to make room.
bool Queues::take_turn(bool closes_circles, bool has_passed) {
  for (const std::size_t who : order_) {
    const Car& car = cars_[who];
    if (car.has_passed() != has_passed || car.at >= car.last || !is_way_free(who)) continue;
    if (!closes_circles && closes_circle(who)) continue;
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

bool Queues::closes_circle(std::size_t who) const {
  Queues then = *this;
  then.pass(who);
  return then.has_circle();
}

/// Whoever has only such in its way as can get out of it can move one day, too; if some are left,
/// they are a circle, with those that wait for them. What is no vehicle does not wait for anybody:
/// a car behind it is stuck, but in no circle.
bool Queues::has_circle() const {
  Queues closed_up = *this;
  closed_up.close_up();
  std::vector<bool> can_move(cars_.size());
  std::size_t left = cars_.size();
  for (bool found = true; found;) {
    found = false;
    for (std::size_t who = 0; who < cars_.size(); ++who) {
      if (can_move[who]) continue;
      const bool is_in_circle = closed_up.visit_in_the_way(
          who, [&](std::uint16_t other) { return other != kNobody && !can_move[other]; });
      if (is_in_circle) continue;
      can_move[who] = true;
      found = true;
      --left;
    }
  }
  return left > 0;
}

void Queues::pass(std::size_t who) {
  Car& car = cars_[who];
  holders_[cell_of(car)] = kNobody;
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
  const auto whole_route = static_cast<std::int64_t>(map_->num_cells(car.route));
  for (std::int64_t at = car.at + 1; at < car.at + whole_route; ++at) {
    const std::size_t index = map_->index_of(car.route, at);
    if (is_blocked(car.route, index) && visit(kNobody)) return true;
    for (const std::uint32_t cell : map_->overlaps(car.route, index)) {
      const std::uint16_t other = holders_[cell];
      if (other != kNobody && other != who && visit(other)) return true;
    }
    if (!map_->is_conflict(car.route, index)) return false;
  }
  return visit(kNobody);  // a route on which it may stop nowhere
}

bool Queues::is_way_free(std::size_t who) const {
  return !visit_in_the_way(who, [](std::uint16_t) { return true; });
}

bool Queues::is_blocked(std::size_t route, std::size_t index) const {
  return std::ranges::any_of(blocked_, [&](const Blocked& one) {
    return intersects(map_->area_m(route, index), one.area_m);
  });
}

std::uint32_t Queues::cell_of(const Car& car) const {
  return map_->cell(car.route, map_->index_of(car.route, car.at));
}

bool Queues::is_any_left() const { return !std::ranges::all_of(cars_, &Car::has_passed); }

}  // namespace hlc::right_of_way
