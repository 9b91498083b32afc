#pragma once

#include <span>
#include <vector>

#include "planner/geometry/polygon.hpp"

namespace hlc::road {

enum class Side { kLeft, kRight };

/// The drivable area along a route as its boundary: straight pieces left and right of the route,
/// each with its range of the route's arc length. Where a neighbour lane begins or ends, a piece
/// closes the step across. A footprint that crosses no piece and starts inside stays inside; the
/// two ends of an open route are open.
class Corridor {
 public:
  struct Piece {
    Segment segment;
    /// May be below 0 or above the route's length: s is meant modulo the length
    double from_s_m{};
    double to_s_m{};  ///< >= from_s_m
  };

  /// One side of the area as a line along the route, and for each of its points the arc length on
  /// the route's path, not descending. On a closed route the last point is the first one again, a
  /// length later.
  struct Bound {
    Side side{};
    std::vector<Point> points_m;
    std::vector<double> s_m;
  };

  Corridor() = default;  ///< no boundary: the whole plane is drivable
  /// @param route_length_m  arc length after which s repeats; 0 for an open route
  Corridor(std::vector<Piece> pieces, double route_length_m);
  /// The pieces are those of the bounds.
  /// @param ground_m  the map: beyond it the area must not be widened (placement.hpp)
  Corridor(std::vector<Bound> bounds, double route_length_m, const Box& ground_m);

  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  /// Empty for a corridor made of pieces.
  [[nodiscard]] const std::vector<Bound>& bounds() const { return bounds_; }
  [[nodiscard]] const Box& ground_m() const { return ground_m_; }
  [[nodiscard]] double route_length_m() const { return route_length_m_; }
  /// The pieces with s in [from_s_m, to_s_m] (wrapped on a closed route), each once, in the order
  /// of pieces(): only pieces along the way count, a strand of the same route that passes close by
  /// does not. s is that of a point on the route: for a footprint, extend the window by its half
  /// length and some centimetres on both sides. @pre from_s_m <= to_s_m
  [[nodiscard]] std::vector<Segment> boundary_m(double from_s_m, double to_s_m) const;

 private:
  static constexpr std::size_t kBlock = 16;

  /// A piece's [from, to]; on a closed route moved by whole lengths so that its end lies in
  /// [0, length).
  struct Window {
    double from_s_m;
    double to_s_m;
  };
  void list_windows();

  std::vector<Piece> pieces_;
  std::vector<Window> windows_;  ///< of all pieces
  std::vector<Window> blocks_;   ///< hulls of kBlock windows each: every step checks them all
  std::vector<Bound> bounds_;
  double route_length_m_{};
  Box ground_m_;
};

}  // namespace hlc::road
