#include "planner/right_of_way/queues.hpp"

#include <algorithm>

namespace hlc::right_of_way {
namespace {

/// How far a vehicle may have to go on behind its stretch to make room for others; for the µCar.
constexpr double kMakesRoom_m = 6.0;

/// The first cell behind the next stretch of conflict cells.
std::int64_t behind_next_stretch(const ConflictMap& map, const coordination::LaneClaim& claim) {
  const auto is_conflict = [&](std::int64_t cell) {
    return map.is_conflict(claim.route, map.index_of(claim.route, cell));
  };
  const auto whole_route = static_cast<std::int64_t>(map.num_cells(claim.route));
  std::int64_t cell = map.count_at(claim.route, claim.place_m + claim.ahead_m) + 1;
  const std::int64_t end = cell + whole_route;
  while (cell < end && !is_conflict(cell)) ++cell;
  while (cell < end && is_conflict(cell)) ++cell;
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
    car.target = behind_next_stretch(map, from[who]);
    car.last = std::max(car.at, car.target) +
               static_cast<std::int64_t>(map.scale() * kMakesRoom_m / map.cell_m(claim.route));
    holders_[cell_of(car)] = static_cast<std::uint16_t>(who);
  }
}

std::vector<std::size_t> Queues::stuck(const Queues& queues) {
  Queues quick = queues;  // nearly always somebody gets on in any order
  quick.take_turns(true);
  if (quick.left().empty()) return {};
  Queues careful = queues;
  careful.take_turns(false);
  return careful.left();
}

void Queues::take_turns(bool closes_circles) {
  do {
    close_up();
  } while (!left().empty() &&
           (take_turn(closes_circles, false) || take_turn(closes_circles, true)));
}

/// Those that have passed their stretch go on only to make room.
bool Queues::take_turn(bool closes_circles, bool has_passed) {
  for (std::size_t who = 0; who < cars_.size(); ++who) {
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
  then.close_up();
  return then.has_circle();
}

/// Whoever has only such in its way as can get out of it can move one day, too; if some are left,
/// they are a circle, with those that wait for them.
bool Queues::has_circle() const {
  std::vector<bool> can_move(cars_.size());
  std::size_t left = cars_.size();
  for (bool found = true; found;) {
    found = false;
    for (std::size_t who = 0; who < cars_.size(); ++who) {
      if (can_move[who]) continue;
      const bool is_in_circle = visit_in_the_way(
          who, [&](std::uint16_t other) { return other == kNobody || !can_move[other]; });
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

std::vector<std::size_t> Queues::left() const {
  std::vector<std::size_t> left;
  for (std::size_t who = 0; who < cars_.size(); ++who) {
    if (!cars_[who].has_passed()) left.push_back(who);
  }
  return left;
}

}  // namespace hlc::right_of_way
