#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/coordination/messages.hpp"
#include "planner/right_of_way/conflict_map.hpp"
#include "planner/right_of_way/grant.hpp"

namespace hlc::right_of_way {

/// Vehicles that stand in one cell each, at the ends of their authorities, and take turns
/// (way_on.hpp). A value; the arguments must outlive it.
class Queues {
 public:
  /// @param holders  as the step began: each is to pass the next three stretches of conflict cells
  ///                 from the end of what it held then
  /// @param ahead_m  ends of their authorities now
  Queues(const ConflictMap& map, std::span<const Holder> holders, std::span<const double> ahead_m,
         std::span<const Blocked> blocked);

  /// Indices of the vehicles that are stuck when no further turn is possible, fewest of several
  /// orders of turns.
  [[nodiscard]] std::vector<std::size_t> stuck() const;
  /// How many vehicles are in a circle, or wait for one, once all have closed up.
  [[nodiscard]] std::size_t num_in_circles() const;

  /// Whether turns in which others enter none of these cells lead to a vehicle's passing its next
  /// stretch, and no more vehicles are stuck after further turns than without that.
  /// @pre the next cell of the vehicle is a conflict cell
  [[nodiscard]] bool passes_if_reserved(std::size_t who, const std::vector<bool>& cells) const;

 private:
  static constexpr std::uint16_t kNobody = 0xffff;

  struct Car {
    std::size_t route{};
    std::int64_t at{};      ///< its cell, counted on over the end of the route
    std::int64_t target{};  ///< the first cell behind what it is to pass
    std::int64_t last{};    ///< it goes no farther, so that turns end

    [[nodiscard]] bool has_passed() const { return at >= target; }
  };

  struct Reservation {
    std::size_t who;
    std::vector<bool> cells;  ///< of the map, which others do not enter
  };

  void take_turns(const std::vector<std::size_t>& order);
  bool takes_turns_until_free(std::size_t who, const std::vector<std::size_t>& order);
  bool take_turn(const std::vector<std::size_t>& order, bool has_passed);
  void close_up();
  bool goes_on(std::size_t who);
  void pass(std::size_t who);
  template <class Visit>
  bool visit_in_the_way(std::size_t who, const Visit& visit) const;
  [[nodiscard]] bool is_way_free(std::size_t who) const;
  [[nodiscard]] bool may_enter(std::size_t who) const;
  [[nodiscard]] bool is_blocked(std::size_t route, std::size_t index) const;
  [[nodiscard]] std::uint32_t cell_of(const Car& car) const;
  [[nodiscard]] std::vector<std::size_t> left() const;

  const ConflictMap* map_;
  std::span<const Blocked> blocked_;
  std::vector<Car> cars_;
  std::vector<std::uint16_t> holders_;  ///< of each cell of the map
  std::optional<Reservation> reserved_;
};

}  // namespace hlc::right_of_way
