#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "planner/coordination/ids.hpp"
#include "planner/road/placement.hpp"

namespace hlc::controller {

/// The route that a vehicle follows, and its place there. A value; the routes are shared.
class RouteTracker {
 public:
  /// @param routes  the permitted ones, at least one
  explicit RouteTracker(std::shared_ptr<const std::vector<road::DrivableRoute>> routes);

  [[nodiscard]] const std::vector<road::DrivableRoute>& routes() const { return *routes_; }
  /// The selected route; before the first `select_route` the first of all.
  [[nodiscard]] const road::DrivableRoute& route() const { return (*routes_)[route_]; }
  /// Of the last `select_route`.
  [[nodiscard]] const std::optional<road::Placement>& placement() const { return placement_; }
  [[nodiscard]] bool fits_route() const { return placement_ && road::fits(*placement_, route()); }
  /// Arc length on the route; none before the first `select_route`.
  [[nodiscard]] const std::optional<double>& s_m() const { return s_m_; }

  /// Since when the vehicle is at the end of its route without a break (see is_at_goal); none: it
  /// is not, or it has not yet stood there.
  [[nodiscard]] const std::optional<StepIndex>& arrived_since() const { return arrived_since_; }

  /// Index of the selected route.
  [[nodiscard]] std::size_t index() const { return route_; }
  /// Continues from this place. @pre the route exists
  void resume(std::size_t route, double s_m);

  /// Selects the route that the pose fits best (placement.hpp), from its place there on.
  /// @param pose  the planner's (heading, not yaw)
  void select_route(const Pose& pose, const Footprint& footprint);
  /// The place of the pose on the selected route: near the former place, unless it was moved away
  /// from there (road::placement_on).
  road::Placement place(const Pose& pose, const Footprint& footprint);
  /// Advances to the position. @param reach_m  as for `project`
  void advance(const Point& position_m, double reach_m) { s_m_ = project(position_m, reach_m); }

  /// Where the vehicle is in a step, and whether its plan stays there. It arrives where its plan
  /// stays, or where it has been for `patience_steps`: the plan of each step may move at its end,
  /// and the next one put that off again. It has arrived until it leaves the goal.
  void note_place(const Pose& pose, bool stays, StepIndex step, std::size_t patience_steps,
                  const Footprint& footprint);

  /// Arc length of a position within the vehicle's reach.
  /// @param reach_m  how far it may get
  [[nodiscard]] double project(const Point& position_m, double reach_m) const;

 private:
  std::shared_ptr<const std::vector<road::DrivableRoute>> routes_;
  std::size_t route_{};
  std::optional<road::Placement> placement_;
  std::optional<double> s_m_;
  std::optional<Pose> noted_;  ///< the last place
  StepIndex noted_since_;
  std::optional<StepIndex> arrived_since_;
};

}  // namespace hlc::controller
