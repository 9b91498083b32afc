#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/geometry/footprint.hpp"
#include "planner/geometry/pose.hpp"
#include "planner/road/placement.hpp"
#include "planner/vehicle/single_track.hpp"

namespace hlc::right_of_way {

/// How routes are cut into cells, and when two cells exclude each other.
struct ConflictRules {
  double cell_m{0.04};
  /// Added to the footprint to each side: the safety margin of 10 mm and room for a vehicle that
  /// stands a little askew. Of eight runs of twenty cars on the lab's road (300 s) two came to a
  /// standstill with 12 mm; with 14 mm one car waited for 55 s, with 16 mm none longer than 20 s.
  double across_m{0.016};
  double along_m{0.010};  ///< the same in front and behind
  /// Two routes share a lane where their poses differ by less than this ...
  double same_place_m{0.035};
  double same_heading_rad{0.25};
  /// ... and along such a lane, up to this distance, a car only follows the other.
  double following_m{0.5};
};

/// Which pieces of closed routes cannot be occupied at the same time. Each route is cut into cells
/// of equal length, of about ConflictRules::cell_m; a cell stands for the vehicle's place, its area
/// is the rectangle of a vehicle there, on its driving line, with the slip of the curve. Two cells
/// overlap if their areas do.
///
/// A cell is a *conflict cell* if it overlaps a cell of a route that crosses it or merges with it
/// there, or its own route farther on; where routes share a lane, a car only follows the other. A
/// vehicle that stands in a conflict cell may block vehicles that do not follow it: right of way
/// (grant.hpp) never lets it stop there.
class ConflictMap {
 public:
  /// @pre every path is closed
  ConflictMap(std::span<const road::DrivableRoute> routes,
              const vehicle::VehicleParameters& vehicle, const ConflictRules& rules = {});

  [[nodiscard]] std::size_t num_routes() const { return routes_.size(); }
  [[nodiscard]] std::size_t num_cells(std::size_t route) const { return routes_[route].size(); }
  [[nodiscard]] double length_m(std::size_t route) const { return lengths_m_[route]; }
  /// Length of a cell of the route.
  [[nodiscard]] double cell_m(std::size_t route) const {
    return lengths_m_[route] / static_cast<double>(routes_[route].size());
  }
  [[nodiscard]] const ConvexPolygon& area_m(std::size_t route, std::size_t cell) const {
    return routes_[route][cell].area_m;
  }
  [[nodiscard]] bool is_conflict(std::size_t route, std::size_t cell) const {
    return routes_[route][cell].is_conflict;
  }
  /// Cells of the other route that overlap this one, ascending.
  [[nodiscard]] std::span<const std::uint32_t> overlaps(std::size_t route, std::size_t cell,
                                                        std::size_t other) const {
    return routes_[route][cell].overlaps[other];
  }

 private:
  struct Cell {
    Pose pose;  ///< on the driving line, heading of the path
    ConvexPolygon area_m;
    std::vector<std::vector<std::uint32_t>> overlaps;  ///< by route
    bool is_conflict{};
  };

  struct CellName {
    std::size_t route;
    std::size_t cell;
  };

  void add_route(const road::DrivableRoute& route, const vehicle::VehicleParameters& vehicle,
                 const ConflictRules& rules);
  void relate(Cell& cell, std::size_t route, const std::vector<CellName>& near,
              const ConflictRules& rules) const;
  [[nodiscard]] std::size_t cells_apart(std::size_t route, std::size_t a, std::size_t b) const;

  std::vector<std::vector<Cell>> routes_;
  std::vector<double> lengths_m_;
  double reach_of_area_m_{};  ///< from a cell's position
};

}  // namespace hlc::right_of_way
