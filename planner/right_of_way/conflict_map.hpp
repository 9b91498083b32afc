#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/geometry/footprint.hpp"
#include "planner/geometry/near_points.hpp"
#include "planner/geometry/pose.hpp"
#include "planner/road/placement.hpp"
#include "planner/vehicle/single_track.hpp"

namespace hlc::right_of_way {

/// How routes are cut into cells, and when two cells exclude each other. Lengths are those for the
/// µCar; for another vehicle ConflictMap multiplies them by scale_of its footprint.
struct ConflictRules {
  double cell_m{0.04};
  /// Added to the footprint to each side: a safety margin of 10 mm and room for a vehicle that
  /// stands a little askew. Of eight runs of twenty cars on the lab's road (300 s) two came to a
  /// standstill with 12 mm; with 14 mm one car waited for 55 s, with 16 mm none longer than 20 s.
  double across_m{0.016};
  double along_m{0.010};  ///< the same in front and behind
  /// Two routes share a lane where their poses differ by less than this ...
  double same_place_m{0.035};
  double same_heading_rad{0.25};
  /// ... and along such a lane, up to this distance, a car only follows the other.
  double following_m{0.5};
  /// A cell within this distance along the lane of another one, in the same place otherwise, is
  /// that one: for long routes that drive the same lanes many times. 0: never. Half a cell is
  /// enough; `along_m` has to contain it.
  double joined_m{0.0};
  /// Cells in the same place as a conflict cell are conflict cells, too.
  bool shares_conflicts{false};
  /// A vehicle that stands needs so much more to each side, to be passed and to drive off again: a
  /// cell that overlaps another lane's cell when it is wider by this is a conflict cell, too. For
  /// automata of few trims, which stop somewhat beside their line (automaton::lateral_step_m).
  double stopping_room_m{0.0};
};

/// For routes that drive each lane many times.
inline constexpr ConflictRules kTours{
    .along_m = 0.030, .joined_m = 0.020, .shares_conflicts = true};

/// Which pieces of closed routes cannot be occupied at the same time. Each route is cut into cells
/// of equal length, of about ConflictRules::cell_m; a cell stands for the vehicle's place, its area
/// is the rectangle of a vehicle there, on its driving line, with the slip of the curve. Two cells
/// overlap if their areas do.
///
/// A cell is a *conflict cell* if, wider by ConflictRules::stopping_room_m to each side, it
/// overlaps a cell of a route that crosses it or merges with it there, or its own route farther on;
/// where routes share a lane, a car only follows the other, and where a route drives a lane again,
/// it follows itself. A vehicle that stands in a conflict cell may block vehicles that do not
/// follow it: no authority (grant.hpp) ends there.
///
/// With ConflictRules::shares_conflicts a cell in the same place as a conflict cell is one, too (as
/// one that is a conflict cell by the rule above, of any route): vehicles of all routes that share
/// a lane stop in the same places then. Else those of one route may stop one after another where a
/// vehicle passes that joins their lane and can only stop farther on, and it never joins. Fewer
/// places to stop make all of them slower.
class ConflictMap {
 public:
  /// @pre every path is closed
  ConflictMap(std::span<const road::DrivableRoute> routes,
              const vehicle::VehicleParameters& vehicle, const ConflictRules& for_the_ucar = {});

  /// Of the vehicles (scale_of).
  [[nodiscard]] double scale() const { return scale_; }
  /// ConflictRules::stopping_room_m, of these vehicles.
  [[nodiscard]] double stopping_room_m() const { return stopping_room_m_; }
  [[nodiscard]] std::size_t num_routes() const { return routes_.size(); }
  [[nodiscard]] std::size_t num_cells(std::size_t route) const { return routes_[route].size(); }
  [[nodiscard]] double length_m(std::size_t route) const { return lengths_m_[route]; }
  /// Length of a cell of the route.
  [[nodiscard]] double cell_m(std::size_t route) const {
    return lengths_m_[route] / static_cast<double>(routes_[route].size());
  }
  /// Cells of a route may be counted on over its ends: the count at an arc length, and the index in
  /// [0, num_cells) of the cell with that count.
  [[nodiscard]] std::int64_t count_at(std::size_t route, double s_m) const;
  [[nodiscard]] std::size_t index_of(std::size_t route, std::int64_t count) const;
  [[nodiscard]] const ConvexPolygon& area_m(std::size_t route, std::size_t cell) const {
    return cells_[routes_[route][cell]].area_m;
  }
  /// Middle of a vehicle that is in the cell.
  [[nodiscard]] Point place_m(std::size_t route, std::size_t cell) const {
    return cells_[routes_[route][cell]].pose.position_m();
  }
  [[nodiscard]] bool is_conflict(std::size_t route, std::size_t cell) const {
    return cells_[routes_[route][cell]].is_conflict;
  }
  /// Number of the cell among all of the map; joined cells have the same.
  [[nodiscard]] std::uint32_t cell(std::size_t route, std::size_t i) const {
    return routes_[route][i];
  }
  [[nodiscard]] std::size_t num_cells() const { return cells_.size(); }
  /// Numbers of the cells that overlap this one, itself included, ascending.
  [[nodiscard]] std::span<const std::uint32_t> overlaps(std::size_t route, std::size_t i) const {
    return cells_[cell(route, i)].overlaps;
  }

 private:
  using Numbers = std::vector<std::uint32_t>;  ///< of cells, ascending

  struct Cell {
    Pose pose;  ///< on the driving line, heading of the path
    ConvexPolygon area_m;
    ConvexPolygon stopping_area_m;  ///< wider by ConflictRules::stopping_room_m
    Numbers overlaps;
    Numbers same_place;  ///< cells that share a lane with this one here, itself included
    bool is_conflict{};
    /// Cells before and behind this one on a route, up to ConflictRules::following_m; of each way
    /// to drive through it once.
    std::vector<Numbers> lanes;
  };

  void add_route(const road::DrivableRoute& route, const vehicle::VehicleParameters& vehicle,
                 const ConflictRules& rules, NearPoints& near);
  [[nodiscard]] std::uint32_t joined(Cell cell, const ConflictRules& rules, NearPoints& near);
  void add_lanes(std::size_t route, const ConflictRules& rules);
  void relate(Cell& cell, const Numbers& near, const ConflictRules& rules) const;
  void share_conflicts();

  std::vector<Cell> cells_;
  std::vector<Numbers> routes_;  ///< in the order of driving, not ascending
  std::vector<double> lengths_m_;
  double scale_;
  double stopping_room_m_{};
  double reach_of_area_m_{};  ///< from a cell's position
};

}  // namespace hlc::right_of_way
