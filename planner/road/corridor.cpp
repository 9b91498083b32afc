#include "planner/road/corridor.hpp"

#include <cmath>
#include <utility>

namespace hlc {

Corridor::Corridor(std::vector<Piece> pieces, double route_length_m)
    : pieces_(std::move(pieces)), route_length_m_(route_length_m) {}

std::vector<Segment> Corridor::boundary_m(double from_s_m, double to_s_m) const {
  // On a closed route the piece lies at [from, to] + k * length for every integer k. The smallest k
  // for which it does not end before the window is the one that can meet it.
  const auto shift_m = [&](const Piece& piece) {
    return route_length_m_ > 0.0
               ? std::ceil((from_s_m - piece.to_s_m) / route_length_m_) * route_length_m_
               : 0.0;
  };
  std::vector<Segment> boundary;
  for (const Piece& piece : pieces_) {
    const double shift = shift_m(piece);
    if (piece.from_s_m + shift <= to_s_m && piece.to_s_m + shift >= from_s_m) {
      boundary.push_back(piece.segment);
    }
  }
  return boundary;
}

}  // namespace hlc
