#include "planner/road/corridor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hlc::road {
namespace {

/// Points closer than this coincide [m]; far smaller than any gap for a footprint.
constexpr double kShortestSegment_m = 1e-6;
/// A boundary piece also counts this far before and after the arc length that it projects to [m].
constexpr double kPieceOverlap_m = 0.05;
/// Typical number of pieces along a horizon.
constexpr std::size_t kUsualPieces = 128;

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
    : pieces_(std::move(pieces)), route_length_m_(route_length_m) {
  list_windows();
}

Corridor::Corridor(std::vector<Bound> bounds, double route_length_m, const Box& ground_m)
    : bounds_(std::move(bounds)), route_length_m_(route_length_m), ground_m_(ground_m) {
  for (const Bound& bound : bounds_) append_pieces(pieces_, bound);
  list_windows();
}

void Corridor::list_windows() {
  windows_.reserve(pieces_.size());
  for (const Piece& piece : pieces_) {
    double to_s_m = piece.to_s_m;
    if (route_length_m_ > 0.0) {
      to_s_m -= std::floor(to_s_m / route_length_m_) * route_length_m_;
      if (to_s_m >= route_length_m_) to_s_m = 0.0;  // by rounding
    }
    windows_.push_back({to_s_m - (piece.to_s_m - piece.from_s_m), to_s_m});
    if ((windows_.size() - 1) % kBlock == 0) blocks_.push_back(windows_.back());
    blocks_.back().from_s_m = std::min(blocks_.back().from_s_m, windows_.back().from_s_m);
    blocks_.back().to_s_m = std::max(blocks_.back().to_s_m, windows_.back().to_s_m);
  }
}

std::vector<Segment> Corridor::boundary_m(double from_s_m, double to_s_m) const {
  std::vector<Segment> boundary;
  boundary.reserve(kUsualPieces);
  // On a closed route a window lies at [from, to] + k * length for every integer k. The smallest k
  // for which it does not end before the requested range is the only one that can meet the range: 0
  // or 1, with the begin of the range in [0, length), too.
  const bool is_closed = route_length_m_ > 0.0;
  const double turns_m = is_closed ? std::floor(from_s_m / route_length_m_) * route_length_m_ : 0.0;
  const double from = from_s_m - turns_m;
  const double to = to_s_m - turns_m;
  const double next_m = is_closed ? route_length_m_ : std::numeric_limits<double>::infinity();
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    const Window& all = blocks_[block];
    if ((all.to_s_m < from || all.from_s_m > to) && all.from_s_m + next_m > to) continue;
    const std::size_t end = std::min(windows_.size(), (block + 1) * kBlock);
    for (std::size_t i = block * kBlock; i < end; ++i) {
      const double shift = windows_[i].to_s_m < from ? next_m : 0.0;
      if (windows_[i].from_s_m + shift <= to) boundary.push_back(pieces_[i].segment);
    }
  }
  return boundary;
}

}  // namespace hlc::road
