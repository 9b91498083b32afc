// No plan ends where its vehicle could not drive off again beside those that stand there.
#include "planner/controller/way_off.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>

#include "planner/search/search_engine.hpp"
#include "tests/planner/controller/car_and_intruder.hpp"
#include "tests/planner/scenario/changed_scenario.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::controller::way_off_test {
namespace {

/// With the twelve trims of the paper, which need more room to drive off than others.
const scenario::Scenario& few_trims() {
  static const scenario::Scenario kScenario = test::changed_scenario(
      "lab_cars", "", {{"ucar_traffic_49", "paper"}, {"subgraph: J2", "subgraph: B"}},
      {.cars = 20, .seed = 1});
  return kScenario;
}

const PreparedSubgraph& prepared() {
  static const PreparedSubgraph kPrepared = scenario::prepare_subgraph_of(few_trims());
  return kPrepared;
}

/// Who ends at most so far from the intruder has it beside it.
constexpr double kBeside_m = 0.3;

/// From a standing place, while the intruder stays.
class WaysOff {
 public:
  WaysOff(const CarAndIntruder& car, const Pose& place, const ConvexPolygon& intruder_m)
      : path_(car.controller().route().path),
        engine_(search::make_search_engine(*prepared().subgraph, *prepared().reachable, {})),
        problem_(car.controller().problems().back().problem) {
    problem_.start = place;
    problem_.start_trim = prepared().subgraph->standstill();
    problem_.contouring.clear();
    problem_.incumbent.clear();
    problem_.obstacles_m.assign(problem_.horizon_steps(), {intruder_m});
  }

  [[nodiscard]] bool is_one_along_the_path() {
    const double from_m = path_.project(problem_.start.position_m()).s_m;
    for (std::size_t j = 0; j < problem_.horizon_steps(); ++j) {
      problem_.reference_m[j] = path_.at(from_m + 0.08 * static_cast<double>(j + 1));
    }
    return leads_off();
  }
  [[nodiscard]] bool is_one_to_any_side() {
    for (int i = -6; i <= 6; ++i) {
      const double heading_rad = problem_.start.heading_rad + 0.2 * i;
      const Point way_m = 0.6 * Point(std::cos(heading_rad), std::sin(heading_rad));
      problem_.reference_m.assign(problem_.horizon_steps(), problem_.start.position_m() + way_m);
      if (leads_off()) return true;
    }
    return is_one_along_the_path();
  }

 private:
  [[nodiscard]] bool leads_off() {
    const search::SearchResult found = engine_->search(problem_);
    return !found.poses.empty() &&
           (found.poses.back().position_m() - problem_.start.position_m()).norm() > 0.05;
  }

  const road::ReferencePath& path_;
  std::unique_ptr<search::SearchEngine> engine_;
  search::HorizonProblem problem_;
};

// A search for a way off may stop early; then the end is permitted. Without these searches one end
// in four has none.
TEST(WayOff, IsThereFromWhereverAPlanEndsBesideAStandingVehicle) {
  std::size_t num_beside = 0;
  std::size_t num_without = 0;
  const std::uint64_t num_cars = test::num_costly_seeds(400);
  for (std::uint64_t seed = 0; seed < num_cars; ++seed) {
    Draw draw(seed);
    const VehicleId vehicle = draw.vehicle();
    const double place_m = draw.place_m();
    CarAndIntruder car(few_trims(), prepared(), vehicle, place_m);
    const double side = draw.uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
    const double beside_m = side * draw.uniform(0.10, 0.16);
    const ConvexPolygon area_m = intruder_m(car, place_m + draw.uniform(0.3, 0.8), beside_m);
    for (int i = 0; i < 8; ++i) {
      const Pose former = car.end();
      car.step(area_m);
      const bool is_new = (car.end().position_m() - former.position_m()).norm() > 1e-3;
      if (!is_new || !contains(area_m, car.end().position_m(), kBeside_m)) continue;
      ++num_beside;
      const bool has_one = WaysOff(car, car.end(), area_m).is_one_to_any_side() ||
                           !WaysOff(car, former, area_m).is_one_along_the_path();
      num_without += has_one ? 0U : 1U;
    }
  }
  EXPECT_LE(100 * num_without, num_beside) << num_without << " of " << num_beside;
  EXPECT_GT(4 * num_beside, num_cars) << num_beside << " ends beside the intruder";
}

}  // namespace
}  // namespace hlc::controller::way_off_test
