#include "planner/road/corridor.hpp"

#include <cmath>
#include <utility>

namespace hlc {

Corridor::Corridor(std::vector<Piece> pieces, double route_length_m)
    : pieces_(std::move(pieces)), route_length_m_(route_length_m) {}

std::vector<Segment> Corridor::boundary_m(double from_s_m, double to_s_m) const {
  std::vector<Segment> boundary;
  boundary.reserve(pieces_.size());
  if (route_length_m_ <= 0.0) {
    for (const Piece& piece : pieces_) {
      if (piece.from_s_m <= to_s_m && piece.to_s_m >= from_s_m) boundary.push_back(piece.segment);
    }
    return boundary;
  }
  // On a closed route the piece lies at [from, to] + k * length for every integer k. The smallest k
  // for which it does not end before the window is the one that can meet it. With the window's
  // begin in [0, length), k is small: no division.
  const double turns_m = std::floor(from_s_m / route_length_m_) * route_length_m_;
  const double from = from_s_m - turns_m;
  const double to = to_s_m - turns_m;
  for (const Piece& piece : pieces_) {
    double shift = 0.0;
    while (piece.to_s_m + shift < from) shift += route_length_m_;
    while (piece.to_s_m + shift - route_length_m_ >= from) shift -= route_length_m_;
    if (piece.from_s_m + shift <= to) boundary.push_back(piece.segment);
  }
  return boundary;
}

}  // namespace hlc
