#include "planner/road/corridor.hpp"

#include <cmath>
#include <utility>

namespace hlc {
namespace {

/// Points closer than this are one point [m]; far below what a footprint could slip through.
constexpr double kShortestSegment_m = 1e-6;
/// A boundary piece also counts this far before and after the arc length that it projects to [m].
constexpr double kPieceOverlap_m = 0.05;

void append_pieces(std::vector<Corridor::Piece>& pieces, const Corridor::Bound& bound) {
  for (std::size_t i = 0; i + 1 < bound.points_m.size(); ++i) {
    const Segment segment{.from_m = bound.points_m[i], .to_m = bound.points_m[i + 1]};
    if ((segment.to_m - segment.from_m).norm() <= kShortestSegment_m) continue;
    pieces.push_back({.segment = segment,
                      .from_s_m = bound.s_m[i] - kPieceOverlap_m,
                      .to_s_m = bound.s_m[i + 1] + kPieceOverlap_m});
  }
}

}  // namespace

Corridor::Corridor(std::vector<Piece> pieces, double route_length_m)
    : pieces_(std::move(pieces)), route_length_m_(route_length_m) {}

Corridor::Corridor(std::vector<Bound> bounds, double route_length_m, const Box& ground_m)
    : bounds_(std::move(bounds)), route_length_m_(route_length_m), ground_m_(ground_m) {
  for (const Bound& bound : bounds_) append_pieces(pieces_, bound);
}

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
