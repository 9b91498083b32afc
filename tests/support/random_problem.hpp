#pragma once

#include <cstddef>
#include <random>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::test {

/// Uniform in [low, high).
[[nodiscard]] double uniform(std::mt19937_64& random, double low, double high);
/// One of 0 ... count - 1.
[[nodiscard]] std::size_t pick(std::mt19937_64& random, std::size_t count);

[[nodiscard]] Pose random_pose(std::mt19937_64& random);
[[nodiscard]] TrimId random_trim(const automaton::Subgraph& subgraph, std::mt19937_64& random);

/// n reference points on an arc that starts near `start`, in most cases along its heading, at up to
/// 1.6 m/s; now and then a point far away or the start itself.
[[nodiscard]] std::vector<Point> random_reference_m(const Pose& start, std::size_t horizon_steps,
                                                    std::mt19937_64& random);

/// Start in a random trim, reference as above with its speeds; no obstacles, no boundary.
[[nodiscard]] search::HorizonProblem random_free_problem(const automaton::Subgraph& subgraph,
                                                         std::size_t horizon_steps,
                                                         std::mt19937_64& random);

/// The same with up to four moving convex obstacles near the reference, and in one of two problems
/// a lane along the reference, not always wide enough, or some loose boundary segments; in one of
/// three up to two growing areas that are avoided in motion.
[[nodiscard]] search::HorizonProblem random_problem(const automaton::Subgraph& subgraph,
                                                    std::size_t horizon_steps,
                                                    std::mt19937_64& random);

}  // namespace hlc::test
