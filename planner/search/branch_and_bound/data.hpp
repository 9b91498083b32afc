#pragma once

#include <cstddef>
#include <cstdint>

/// Data of BranchAndBound's kernel: plain arrays that BranchAndBound owns and fills.
///
/// This file has only aggregates, no function with a body, because the kernel's translation units
/// are compiled for different instruction sets: the linker may keep any copy of an inline function.
///
/// Arrays that are processed four (in single precision eight) at a time are padded to a multiple of
/// that. Blocks of eight floats are aligned so that no load of them spans two cache lines.
///
/// Costs are doubles. Bounds are computed from 16-bit integers, distances in a small unit
/// (TableStore). Collision tests compute with floats, relative to the plan's start or to a vertex,
/// with a tolerance above the rounding; in doubtful cases `Search::decides` gives the exact result.
namespace hlc::search::branch_and_bound {

/// Doubles, floats, and 16-bit integers, of one vector.
inline constexpr std::uint32_t kLanes = 4;
inline constexpr std::uint32_t kFloatLanes = 8;
inline constexpr std::uint32_t kShortLanes = 16;
/// Axes of a bound: directions at 0, 22.5, ... 157.5 degrees, each with an interval.
inline constexpr std::size_t kBoundAxes = 8;
/// Every second of them: axes of the reachable sets.
inline constexpr std::size_t kAxes = 4;
/// Cost of the best path as long as there is none; larger than the cost of any path.
inline constexpr double kNoPath = 1e299;
/// f of an excluded edge.
inline constexpr double kForbidden = 1e300;

/// Offset of an edge that everything is inside of.
inline constexpr float kSeparatesNothing = 1e30F;

/// Eight corners p_i of a convex polygon with the normals n_i (outward, larger component 1) and
/// offsets n_i p_i of the edges that begin there [m]. Missing corners repeat the first one, with
/// the offset kSeparatesNothing.
struct alignas(32) PolygonBlock {
  float x[kFloatLanes];
  float y[kFloatLanes];
  float normal_x[kFloatLanes];
  float normal_y[kFloatLanes];
  float offset[kFloatLanes];
};

/// Rectangle around the swept areas of a trim's edges: centre, unit vector of its first axis, half
/// the size per axis.
struct Surroundings {
  float x;
  float y;
  float along_x;
  float along_y;
  float half_along;
  float half_aside;
  /// The start of a maneuver lies inside of every area.
  bool all_hold_start;
};
/// Half the size of a rectangle that meets nothing.
inline constexpr float kNoRectangle = -1e15F;

/// Boxes of eight obstacles: centre and half the size, along the plan's axes.
struct alignas(32) BoxesBlock {
  float x[kFloatLanes];
  float y[kFloatLanes];
  float half_x[kFloatLanes];
  float half_y[kFloatLanes];
  /// One bit per obstacle: the blocks of its corners are written. Done on first use.
  std::uint32_t is_ready;
};

/// A maneuver's area within lanes, in the frame of its start.
struct LaneArea {
  std::uint32_t first_block;  ///< of `Tables::area_blocks`
  std::uint32_t num_blocks;   ///< 0: the area is empty
  float centre_x;             ///< of the box
  float centre_y;
  float half_x;
  float half_y;
};

/// Transformation from one frame to another, in the first's axes, in single precision: displacement
/// [1 / Tables::units_per_m m], direction of the heading.
struct Move {
  float x;
  float y;
  float cos_heading;
  float sin_heading;
};

/// Indices of a position and heading: numbers of `place` and the like.
enum Coordinate : std::uint32_t { kX, kY, kCos, kSin };

struct alignas(64) EdgeData {
  double displacement[4];  ///< x, y [m], cosine and sine of the heading
  double turned[4];        ///< position and heading of it, turned to the left: -y, x, -sine, cosine
  Move move;               ///< the displacement in single precision
  double cost;             ///< of the maneuver itself (EdgeCosts::reduced_cost)
  std::uint32_t to;        ///< trim
  /// The swept area: convex pieces of up to eight corners. Most have one.
  std::uint32_t first_swept;  ///< of `Tables::area_blocks`
  std::uint32_t num_swept;
  bool stands;  ///< `stands_in`
};

/// Steps of a BoundBlock.
inline constexpr std::uint32_t kBoundSteps = 4;

/// Bounds of four edges for four consecutive steps: per axis the intervals of those edges and steps
/// [1 / Tables::units_per_m m]. Interval number 8 (s / 2) + 2 e + s % 2 is that of edge e for step
/// s. Ends saturate.
struct alignas(32) BoundBlock {
  std::int16_t low[kBoundAxes][kShortLanes];
  std::int16_t high[kBoundAxes][kShortLanes];
};

/// Tables of the subgraph. Edges are stored trim by trim; the edges of a trim are padded, so that
/// groups of four never mix two trims. Every trim has at least one group, if only of padding.
struct Tables {
  const EdgeData* edges;
  const std::uint32_t* first_group;  ///< per trim and one more: edges [4 first, 4 next first)
  const double* displacement_x;      ///< per edge
  const double* displacement_y;
  const BoundBlock* bounds;  ///< per group `bound_size`: see Level::bounds and BranchAndBound
  const PolygonBlock* area_blocks;
  const LaneArea* lane_areas;  ///< per edge
  const Surroundings* around;  ///< per trim
  std::size_t bound_size;
  float units_per_m;      ///< units of a bound in a metre
  float squared_unit_m2;  ///< square of the unit
  const double* numbers;  ///< 0, 1, 2, ... as bits
  std::uint64_t index_mask;
};

/// An obstacle of one step, as in the problem.
struct PolygonData {
  const double* corners;  ///< x, y, x, y ...
  std::uint32_t size;
  std::uint32_t step;    ///< from 0
  std::uint32_t number;  ///< among the step's, as in the problem
  bool only_in_motion;   ///< one of HorizonProblem::avoided_in_motion_m; behind the step's others
};

/// A convex piece of an obstacle with more than eight corners: its first corner and, from number
/// `second` on, some consecutive ones. A polygon meets the obstacle if it meets a piece. Most
/// obstacles have one.
struct PieceData {
  std::uint32_t polygon;
  std::uint32_t second;
  std::uint32_t size;
};
/// Most corners of a piece beside its first one, and the step from `second` to that of the next.
inline constexpr std::uint32_t kMostOthers = kFloatLanes - 1;
inline constexpr std::uint32_t kNextPiece = kMostOthers - 1;

/// Eight consecutive boundary segments, with their directions (larger component 1; 0 for a segment
/// without length). Missing segments repeat the last.
struct alignas(32) SegmentBlock {
  float from_x[kFloatLanes];
  float from_y[kFloatLanes];
  float to_x[kFloatLanes];
  float to_y[kFloatLanes];
  float along_x[kFloatLanes];
  float along_y[kFloatLanes];
};

/// Rectangles around eight blocks of segments: centre, half the length as a vector, half
/// the width.
struct alignas(32) SegmentRectanglesBlock {
  float x[kFloatLanes];
  float y[kFloatLanes];
  float half_x[kFloatLanes];
  float half_y[kFloatLanes];
  float half_width[kFloatLanes];
};

/// One problem, prepared. Reference, obstacles and boundary as in the problem are in its frame, all
/// floats relative to the start, along the same axes, except for coordinates seen from a vertex.
struct Plan {
  std::size_t horizon_steps;
  const double* reference_x;  ///< r_1 ... r_n
  const double* reference_y;
  const double* contouring_x;  ///< c_1 ... c_n, zeros if there are none
  const double* contouring_y;
  /// Reference points relative to the start [1 / Tables::units_per_m m], and eight more: at first
  /// along the axes of the problem's frame. Then, at offsets of `seen_stride`, seen from every
  /// vertex of a path except the last, those after its next one.
  float* seen_x;
  float* seen_y;
  std::size_t seen_stride;
  bool is_far;  ///< coordinates seen from a vertex may exceed 16 bits

  // The problem's content, and the reachable range.
  const PolygonData* polygons;  ///< by step
  std::size_t num_polygons;
  const double* boundary;  ///< per segment x, y of both ends
  std::size_t boundary_size;
  /// Per step, in the start's frame: along each axis the lowest coordinate that an area can reach
  /// in that step, then along each axis the highest.
  const double* const* reach;

  // The remaining part, written by Kernel::prepare.
  double origin_x;  ///< the start
  double origin_y;
  double scale;  ///< largest coordinate of a float, or more [m]
  /// Obstacles [first_obstacle[j - 1], last_obstacle[j - 1]) are those of step j; every step's
  /// begin at a multiple of eight. Equal consecutive polygons of a step are merged.
  std::uint32_t* first_obstacle;
  std::uint32_t* last_obstacle;
  std::uint32_t* first_in_motion;  ///< those of step j from here on are avoided in motion only
  PieceData* obstacles;
  BoxesBlock* obstacle_boxes;
  PolygonBlock* obstacle_blocks;
  std::uint32_t num_blocks;       ///< of boundary segments that can be met
  std::uint32_t* segment_source;  ///< per block, the number of its first segment in the problem
  SegmentBlock* segment_blocks;
  SegmentRectanglesBlock* segment_rectangles;
  /// Bound on the rounding of a distance in single precision [m].
  float tolerance;
};

/// Number of consecutive vertices seen each from the one before, the first of them from the start:
/// the known part need not wait for the vertex' place, and rounding does not add up for long.
inline constexpr std::size_t kSeenInARow = 8;

/// Factor for the error of a cost-to-go, and for that of far reference points; see
/// TableStore::compute_bounds for all three.
inline constexpr float kSurely = 1.0F - 0xAp-20F;
inline constexpr double kSurelyFar = 1.0 - 0x1p-40;

/// A vertex of the current path.
struct VertexData {
  double place[4];  ///< x, y [m], cosine and sine of the heading
  double cost_to_come;
  std::uint32_t trim;
  std::uint32_t from_edge;   ///< the edge that led here
  std::uint32_t first_edge;  ///< of those out of the trim
  std::uint32_t num_edges;   ///< with padding
  /// The vertex seen from the one before it or, in `from_start`, from the plan's start.
  const Move* move;
  Move from_start;
  double* keys;               ///< f of its children, each with the child's number in the last bits
  double next_key;            ///< the least of the untried ones
  std::uint32_t* near;        ///< obstacles that an edge from here may meet
  PolygonBlock* near_blocks;  ///< the same seen from here
  std::uint32_t num_near;
  std::uint32_t num_near_at_rest;  ///< the first of them: not only avoided in motion
};

/// Data shared by all vertices of one depth.
struct Level {
  /// Per edge: its own cost and the least one of the maneuvers after it (EdgeCosts), kForbidden if
  /// it is excluded at this depth.
  const double* penalty;
  const std::uint32_t* permitted;  ///< per trim, how many edges may be taken
  /// The steps after the edge, four by four, the first ones first: how many fours, and where among
  /// the bounds of a group theirs are.
  std::size_t num_blocks;
  const std::uint32_t* bounds;
};

/// A request for an exact collision test: whether the edge's area, placed at a vertex, meets this
/// item.
struct Question {
  std::uint32_t edge;
  bool is_segment;
  std::uint32_t item;  ///< obstacle or segment, by its number in the plan
  const VertexData* vertex;
};

/// One search: input and result.
struct Search {
  const Tables* tables;
  const Plan* plan;
  const Level* levels;  ///< n
  VertexData* path;     ///< n + 1 vertices; the first is the start
  float* to_go;         ///< scratch: per edge of a trim, two
  bool (*decides)(const void* context, const Question& question);
  const void* decides_context;
  bool (*stop)(const void* context);
  const void* stop_context;
  std::uint64_t max_expansions;
  // Input and output: the best path so far.
  double best_cost;  ///< kNoPath: none
  std::uint32_t* best_edges;
  double* best_x;
  double* best_y;
  // Output.
  std::uint64_t generated;
  std::uint64_t expanded;
  bool stopped_early;
  double lower_bound;  ///< of the open vertices, if it stopped early
};

/// The kernel, once per instruction set; all give the same bits.
struct Kernel {
  /// Drops the problem's obstacles and boundary segments that the plan cannot meet.
  void (*prepare)(Plan& plan, const VertexData& start);
  void (*search)(Search& search);
  /// Writes the keys of the start's children.
  void (*expand)(Search& search);
  /// Whether the edge is free in step `step`, driven from this vertex.
  /// @param vertex  placed, with its trim and room for near obstacles, which are written
  bool (*is_free)(const Search& search, std::uint32_t edge, std::size_t step, VertexData& vertex);
};

[[nodiscard]] Kernel portable_kernel();
/// @pre the processor has AVX2
[[nodiscard]] Kernel avx2_kernel();
/// @pre the processor has AVX2 and AVX-512 F, VL, DQ and BW
[[nodiscard]] Kernel avx512_kernel();

}  // namespace hlc::search::branch_and_bound
