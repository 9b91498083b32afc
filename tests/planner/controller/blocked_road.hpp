#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "tests/planner/controller/east_bound.hpp"

/// A car that shall drive east, and another one that keeps it from doing so.
namespace hlc::controller::east_bound {

inline constexpr std::uint64_t kNow = 101;

/// Across its road.
inline ConvexPolygon wall(double x_m) {
  return {{Point(x_m, -1.0), Point(x_m + 0.1, -1.0), Point(x_m + 0.1, 1.0), Point(x_m, 1.0)}};
}

/// Car 1 in a lane along y = 0, which a parked car 2 blocks until it is gone.
class BlockedRoad : public testing::Test {
 protected:
  void start(double wall_x_m = 9.0) {
    std::vector<road::Corridor::Piece> pieces;
    for (const double y_m : {-0.12, 0.12}) {
      pieces.push_back({{Point(-1.0, y_m), Point(wall_x_m, y_m)}, -1.0, 10.0});
    }
    pieces.push_back({{Point(wall_x_m, -0.12), Point(wall_x_m, 0.12)}, -1.0, 10.0});
    start(10.0, {std::move(pieces), 0.0});
  }
  void start(double goal_x_m, road::Corridor corridor) {
    one_ = std::make_unique<Controller>(
        ControllerOptions{.vehicle = {1}}, subgraph(),
        road::ReferencePath({Point(-0.5, 0.0), Point(goal_x_m, 0.0)}, false), std::move(corridor));
    static_cast<void>(one_->stand_by(at(kNow - 1, {seen(1, 0.0, 0.0)})));
  }

  /// @param receives  traffic of car 2, which is parked
  coordination::Report step(bool receives = true) {
    const Observation observation = at(k_, {following(*one_, k_), seen(2, parked_x_m_, 0.0)});
    static_cast<void>(one_->observe(observation));
    one_->couple(receives ? std::vector{parked(k_)} : std::vector<coordination::Traffic>{});
    static_cast<void>(one_->plan({}));
    return finish(one_->commit(std::vector{stays(k_)}, {}));
  }

  /// Until it has planned, with car 2 in view.
  void begin_step() {
    static_cast<void>(one_->observe(at(k_, {following(*one_, k_), seen(2, parked_x_m_, 0.0)})));
    one_->couple(std::vector{parked(k_)});
    static_cast<void>(one_->plan({}));
  }

  coordination::Report step_alone() {
    static_cast<void>(one_->observe(at(k_, {following(*one_, k_)})));
    one_->couple({});
    static_cast<void>(one_->plan({}));
    return finish(one_->commit({}, {}));
  }

  coordination::Report step_too_late() {
    static_cast<void>(one_->observe(at(k_, {following(*one_, k_), seen(2, parked_x_m_, 0.0)})));
    return finish(one_->fall_back(coordination::FallbackReason::kLate));
  }

  coordination::Report finish(coordination::Report report) {
    ++k_;
    one_->note_causes(report);
    return report;
  }

  coordination::Traffic parked(std::uint64_t k) const {
    const auto two = controller(2);
    static_cast<void>(two->stand_by(at(k - 1, {seen(2, parked_x_m_, 0.0)})));
    return two->observe(at(k, {seen(2, parked_x_m_, 0.0)}));
  }

  coordination::Prediction stays(std::uint64_t k) const {
    return {
        .vehicle = {2},
        .step = {k},
        .is_new = false,
        .areas = {.first = {k + 1}, .areas_m = {}, .final_area_m = parked(k).running.final_area_m}};
  }

  std::unique_ptr<Controller> one_;
  std::uint64_t k_{kNow};
  double parked_x_m_{0.32};  ///< of car 2
};

}  // namespace hlc::controller::east_bound
