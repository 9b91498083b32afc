#include "tests/support/random_problem.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace hlc::test {
namespace {

constexpr double kStepS = 0.2;

Point direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

Point random_point(const Point& centre_m, double radius_m, std::mt19937_64& random) {
  const double angle_rad = uniform(random, -std::numbers::pi, std::numbers::pi);
  return centre_m + uniform(random, 0.0, radius_m) * direction(angle_rad);
}

ConvexPolygon random_polygon(const Point& centre_m, double radius_m, std::mt19937_64& random) {
  const std::size_t corners = 3 + pick(random, 6);
  std::vector<Point> points_m;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle_rad =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
    points_m.push_back(centre_m + uniform(random, 0.5, 1.0) * radius_m * direction(angle_rad));
  }
  return convex_hull(std::move(points_m));
}

void add_obstacle(search::HorizonProblem& problem, std::mt19937_64& random) {
  const std::size_t n = problem.horizon_steps();
  const Point near_m = problem.reference_m[pick(random, n)];
  const Point first_m = random_point(near_m, 0.4, random);
  const Point motion_m = random_point(Point::Zero(), pick(random, 2) == 0 ? 0.0 : 0.2, random);
  const ConvexPolygon shape = random_polygon(Point::Zero(), uniform(random, 0.05, 0.25), random);
  for (std::size_t j = 0; j < n; ++j) {
    const Point centre_m = first_m + static_cast<double>(j) * motion_m;
    problem.obstacles_m[j].push_back(transformed(shape, Pose{centre_m.x(), centre_m.y(), 0.0}));
  }
}

/// Two polylines beside the way from behind the start through the reference.
void add_lane(search::HorizonProblem& problem, std::mt19937_64& random) {
  const Point ahead = direction(problem.start.heading_rad);
  std::vector<Point> way_m{problem.start.position_m() - 0.3 * ahead, problem.start.position_m()};
  way_m.insert(way_m.end(), problem.reference_m.begin(), problem.reference_m.end());
  for (const double side : {-1.0, 1.0}) {
    const double offset_m = side * uniform(random, 0.06, 0.3);
    for (std::size_t i = 1; i < way_m.size(); ++i) {
      const Point along_m = way_m[i] - way_m[i - 1];
      if (along_m.norm() < 1e-6) {
        continue;
      }
      const Point shift_m = offset_m / along_m.norm() * Point{-along_m.y(), along_m.x()};
      problem.boundary_m.push_back({way_m[i - 1] + shift_m, way_m[i] + shift_m});
    }
  }
}

void add_loose_segments(search::HorizonProblem& problem, std::mt19937_64& random) {
  for (std::size_t count = 1 + pick(random, 3); count > 0; --count) {
    const Point near_m = problem.reference_m[pick(random, problem.horizon_steps())];
    problem.boundary_m.push_back(
        {random_point(near_m, 0.5, random), random_point(near_m, 0.5, random)});
  }
}

/// Up to two areas that grow with the steps, now and then around the start.
void add_avoided_in_motion(search::HorizonProblem& problem, std::mt19937_64& random) {
  const std::size_t n = problem.horizon_steps();
  problem.avoided_in_motion_m.resize(n);
  for (std::size_t count = 1 + pick(random, 2); count > 0; --count) {
    const Point near_m =
        pick(random, 3) == 0 ? problem.start.position_m() : problem.reference_m[pick(random, n)];
    const Pose centre{near_m.x() + uniform(random, -0.4, 0.4),
                      near_m.y() + uniform(random, -0.4, 0.4), 0.0};
    const double growth_m = uniform(random, 0.0, 0.1);
    for (std::size_t j = 0; j < n; ++j) {
      const double radius_m = 0.05 + growth_m * static_cast<double>(j);
      problem.avoided_in_motion_m[j].push_back(
          transformed(random_polygon(Point::Zero(), radius_m, random), centre));
    }
  }
}

/// Any directions: the search must not rely on normals of the path.
void add_contouring(search::HorizonProblem& problem, std::mt19937_64& random) {
  const double weight = std::pow(10.0, uniform(random, -1.0, 3.0));
  for (std::size_t j = 0; j < problem.horizon_steps(); ++j) {
    problem.contouring.push_back(std::sqrt(weight) *
                                 direction(uniform(random, -std::numbers::pi, std::numbers::pi)));
  }
}

}  // namespace

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

std::size_t pick(std::mt19937_64& random, std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

Pose random_pose(std::mt19937_64& random) {
  const double x_m = uniform(random, 0.0, 4.5);
  const double y_m = uniform(random, 0.0, 4.0);
  return {x_m, y_m, uniform(random, -10.0, 10.0)};
}

TrimId random_trim(const automaton::Subgraph& subgraph, std::mt19937_64& random) {
  return subgraph.spec().trims[pick(random, subgraph.spec().trims.size())];
}

std::vector<Point> random_reference_m(const Pose& start, std::size_t horizon_steps,
                                      std::mt19937_64& random) {
  const double spacing_m = uniform(random, 0.0, 0.32);
  const double turn_rad = uniform(random, -0.5, 0.5);
  double heading_rad = start.heading_rad + uniform(random, -0.5, 0.5);
  if (pick(random, 5) == 0) {
    heading_rad += uniform(random, -std::numbers::pi, std::numbers::pi);  // the wrong way
  }
  Point point_m = random_point(start.position_m(), 0.15, random);
  std::vector<Point> reference_m;
  for (std::size_t j = 0; j < horizon_steps; ++j) {
    point_m += spacing_m * direction(heading_rad);
    heading_rad += turn_rad;
    reference_m.push_back(point_m);
  }
  if (pick(random, 8) == 0) {
    reference_m[pick(random, horizon_steps)] = random_point(start.position_m(), 3.0, random);
  }
  if (pick(random, 8) == 0) {
    reference_m[pick(random, horizon_steps)] = start.position_m();
  }
  return reference_m;
}

search::HorizonProblem random_free_problem(const automaton::Subgraph& subgraph,
                                           std::size_t horizon_steps, std::mt19937_64& random) {
  search::HorizonProblem problem;
  problem.start = random_pose(random);
  problem.start_trim = random_trim(subgraph, random);
  problem.reference_m = random_reference_m(problem.start, horizon_steps, random);
  const double spacing_m = (problem.reference_m.front() - problem.reference_m.back()).norm() /
                           static_cast<double>(horizon_steps);
  problem.reference_speed_mps.assign(horizon_steps, spacing_m / kStepS);
  return problem;
}

search::HorizonProblem random_problem(const automaton::Subgraph& subgraph,
                                      std::size_t horizon_steps, std::mt19937_64& random) {
  search::HorizonProblem problem = random_free_problem(subgraph, horizon_steps, random);
  problem.obstacles_m.resize(horizon_steps);
  for (std::size_t count = pick(random, 5); count > 0; --count) {
    add_obstacle(problem, random);
  }
  if (problem.obstacles_m.front().empty()) {
    problem.obstacles_m.clear();
  }
  const std::size_t boundary = pick(random, 4);
  if (boundary == 0) {
    add_lane(problem, random);
  } else if (boundary == 1) {
    add_loose_segments(problem, random);
  }
  if (pick(random, 3) == 0) add_contouring(problem, random);
  if (pick(random, 3) == 0) add_avoided_in_motion(problem, random);
  return problem;
}

}  // namespace hlc::test
