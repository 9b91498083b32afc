#include "tests/hlc_bridge/dds/sample_messages.hpp"

#include <CommonroadDDSGoalState.h>

#include <iomanip>
#include <sstream>
#include <type_traits>

#include "planner/coordination/digest.hpp"

namespace hlc::dds {
namespace {

// --- text ---------------------------------------------------------------------------------------

template <class Value>
void put(std::ostream& out, const Value& value);

template <class... Values>
void put_all(std::ostream& out, const Values&... values) {
  out << "{";
  (put(out, values), ...);
  out << "}";
}

template <class Values>
void put_list(std::ostream& out, const Values& values) {
  out << "[";
  for (const auto& value : values) {
    put(out, value);
  }
  out << "]";
}

void put_message(std::ostream& out, const std::string& value) { out << std::quoted(value); }
void put_message(std::ostream& out, const Point& value) { put_all(out, value.x(), value.y()); }
void put_message(std::ostream& out, const Pose& value) {
  put_all(out, value.x_m, value.y_m, value.heading_rad);
}
void put_message(std::ostream& out, VehicleId value) { put_all(out, value.value); }
void put_message(std::ostream& out, StepIndex value) { put_all(out, value.value); }
void put_message(std::ostream& out, TrimId value) { put_all(out, value.index); }
void put_message(std::ostream& out, const ConvexPolygon& value) { put_list(out, value.vertices_m); }
void put_message(std::ostream& out, const coordination::OccupiedAreas& value) {
  const auto& [first, areas_m, final_area_m] = value;
  put_all(out, first, areas_m, final_area_m);
}
void put_message(std::ostream& out, const PathPoint& value) { put_all(out, value.pose, value.s_m); }
void put_message(std::ostream& out, const TrajectoryPoint& value) {
  const auto& [t, x_m, y_m, vx_mps, vy_mps] = value;
  put_all(out, t, x_m, y_m, vx_mps, vy_mps);
}
void put_message(std::ostream& out, const VehicleState& value) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = value;
  put_all(out, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q);
}
void put_message(std::ostream& out, const VehicleObservation& value) {
  const auto& [a, b, c, d] = value;
  put_all(out, a, b, c, d);
}
void put_message(std::ostream& out, const VehicleStateList& value) {
  const auto& [a, b, c, d, e] = value;
  put_all(out, a, b, c, d, e);
}
void put_message(std::ostream& out, const TrajectoryCommand& value) {
  const auto& [a, b, c, d] = value;
  put_all(out, a, b, c, d);
}
void put_message(std::ostream& out, const PathTrackingCommand& value) {
  const auto& [a, b, c, d, e] = value;
  put_all(out, a, b, c, d, e);
}
void put_message(std::ostream& out, const SpeedCurvatureCommand& value) {
  const auto& [a, b, c, d, e] = value;
  put_all(out, a, b, c, d, e);
}
void put_message(std::ostream& out, const DirectCommand& value) {
  const auto& [a, b, c, d, e] = value;
  put_all(out, a, b, c, d, e);
}
void put_message(std::ostream& out, const ReadyStatus& value) {
  const auto& [a, b] = value;
  put_all(out, a, b);
}
void put_message(std::ostream& out, const SystemTrigger& value) { put_all(out, value.next_start); }
void put_message(std::ostream& out, std::monostate) { out << "nothing"; }
void put_message(std::ostream& out, const Parameter& value) {
  put_all(out, value.name, value.value.index());
  std::visit([&](const auto& held) { put(out, held); }, value.value);
}
void put_message(std::ostream& out, const ParameterRequest& value) { put_all(out, value.name); }
void put_message(std::ostream& out, const StopRequest& value) { put_all(out, value.vehicle_id); }
void put_message(std::ostream& out, const Log& value) {
  const auto& [a, b, c, d] = value;
  put_all(out, a, b, c, d);
}
void put_message(std::ostream& out, const LogLevel& value) { put_all(out, value.level); }
void put_message(std::ostream& out, const ::CommonroadDDSPoint& value) {
  put_all(out, value.x(), value.y());
}
void put_message(std::ostream& out, const ::CommonroadDDSInterval& value) {
  put_all(out, value.interval_start(), value.interval_end());
}
void put_message(std::ostream& out, const ::CommonroadDDSCircle& value) {
  put_all(out, value.center(), value.radius());
}
void put_message(std::ostream& out, const ::CommonroadDDSPolygon& value) {
  put_list(out, value.points());
}
void put_message(std::ostream& out, const ::CommonroadDDSRectangle& value) {
  put_all(out, value.length(), value.width(), value.center(), value.orientation());
}
void put_message(std::ostream& out, const ::CommonroadDDSPositionInterval& value) {
  put_all(out, value.circles(), value.polygons(), value.rectangles(), value.lanelet_refs());
}
void put_message(std::ostream& out, const GoalState& value) {
  const auto& goal = std::any_cast<const ::CommonroadDDSGoalState&>(value.payload);
  put_all(out, goal.time(), goal.time_set(), goal.has_exact_position(), goal.exact_position(),
          goal.position(), goal.orientation(), goal.velocity(), goal.planning_problem_id(),
          goal.goal_state_pos());
}
void put_message(std::ostream& out, const DrawingColor& value) {
  put_all(out, value.alpha, value.red, value.green, value.blue);
}
void put_message(std::ostream& out, const Visualization& value) {
  const auto& [a, b, c, d, e, f, g, h] = value;
  put_all(out, a, b, c, d, e, f, g, h);
}
void put_message(std::ostream& out, const coordination::LaneClaim& value) {
  const auto& [a, b, c, d] = value;
  put_all(out, a, b, c, d);
}
void put_message(std::ostream& out, const coordination::Traffic& value) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k] = value;
  put_all(out, a, b, c, d, e, f, g, h, i, j.has_value(), j.value_or(coordination::LaneClaim{}),
          k.has_value(), coordination::digest_of(value));
}
void put_message(std::ostream& out, const coordination::Prediction& value) {
  const auto& [a, b, c, d, e] = value;
  put_all(out, a, b, c, d, e.has_value(), e.value_or(coordination::OccupiedAreas{}));
}
void put_message(std::ostream& out, const coordination::Outcome& value) {
  const auto& [a, b, c, d] = value;
  const auto& [inputs, plan, published] = d.value_or(coordination::PlanDigests{});
  put_all(out, a, b, c, d.has_value(), inputs, plan, published);
}
void put_message(std::ostream& out, const coordination::Waiting& value) {
  put_all(out, value.vehicles, value.since);
}
void put_message(std::ostream& out, const coordination::PlannedManeuver& value) {
  put_all(out, value.to, value.label);
}
void put_message(std::ostream& out, const coordination::HeldRoad& value) {
  put_all(out, value.route, value.place_m, value.ahead_m);
}
void put_message(std::ostream& out, const SeparatingLine& value) {
  put_all(out, value.direction_rad, value.offset_m);
}
void put_message(std::ostream& out, const coordination::Separation& value) {
  const auto& [a, b, c] = value;
  put_all(out, a, b, c);
}
void put_message(std::ostream& out, const coordination::Certificate& value) {
  const auto& [a, b, c, d] = value;
  put_all(out, a.length_m, a.width_m, b, c, d);
}
void put_message(std::ostream& out, const coordination::Report& value) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x] = value;
  put_all(out, a, b, c, d, e, f, g, h, i, j, k, l.has_value(), l.value_or(0.0), m, n, o, p, q, r, s,
          t.has_value(), t.value_or(StepIndex{}), u, v, w.has_value(),
          w.value_or(coordination::HeldRoad{}), x != nullptr,
          x != nullptr ? *x : coordination::Certificate{});
}
void put_message(std::ostream& out, const ReportRecord& value) {
  const auto& [a, b, c, d, e] = value;
  put_all(out, a, b, c, d, e);
}
void put_message(std::ostream& out, const RunState& value) {
  put_all(out, value.phase, value.start);
}
void put_message(std::ostream& out, const TrimPair& value) { put_all(out, value.from, value.to); }
void put_message(std::ostream& out, const CriterionWeight& value) {
  put_all(out, value.criterion, value.weight);
}
void put_message(std::ostream& out, const SubgraphRequest& value) {
  const auto& [a, b, c, d, e, f, g] = value;
  put_all(out, a, b, c.has_value(), c.value_or(0.0), d, e, f, g);
}
void put_message(std::ostream& out, const AutomatonRequest& value) {
  const auto& [a, b, c, d] = value;
  put_all(out, a, b, c, d);
}
void put_message(std::ostream& out, const AutomatonAnswer& value) {
  const auto& [a, b, c, d, e] = value;
  put_all(out, a, b, c, d, e);
}
template <class Value>
void put_message(std::ostream& out, const std::vector<Value>& values) {
  put_list(out, values);
}

template <class Value>
void put(std::ostream& out, const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    out << static_cast<int>(value);
  } else if constexpr (std::is_floating_point_v<Value>) {
    out << std::hexfloat << value;
  } else if constexpr (std::is_integral_v<Value>) {
    out << +value;
  } else {
    put_message(out, value);
  }
  out << ' ';
}

template <class Message>
std::string text_of(const Message& message) {
  std::ostringstream out;
  put(out, message);
  return out.str();
}

// --- random values ------------------------------------------------------------------------------

using Random = std::mt19937_64;

double number(Random& random) { return std::uniform_real_distribution{-1e3, 1e3}(random); }

std::uint64_t whole(Random& random, std::uint64_t last) {
  return std::uniform_int_distribution<std::uint64_t>{0, last}(random);
}

bool coin(Random& random) { return whole(random, 1) == 1; }

VehicleId vehicle(Random& random) { return {static_cast<std::uint8_t>(1 + whole(random, 29))}; }

Pose pose(Random& random) { return {number(random), number(random), number(random)}; }

template <class Make>
auto list(Random& random, std::uint64_t max_size, Make make) {
  std::vector<decltype(make(random))> result(whole(random, max_size));
  for (auto& entry : result) {
    entry = make(random);
  }
  return result;
}

Point point(Random& random) { return {number(random), number(random)}; }

ConvexPolygon polygon(Random& random) {
  std::vector<Point> points;
  for (std::uint64_t i = whole(random, 12); i > 0; --i) points.push_back(point(random));
  return convex_hull(std::move(points));
}

coordination::OccupiedAreas areas(Random& random) {
  return {{random()}, list(random, 9, polygon), polygon(random)};
}

coordination::Certificate certificate(Random& random) {
  const auto line = [](Random& r) { return SeparatingLine{number(r), number(r)}; };
  const auto separation = [&line](Random& r) {
    return coordination::Separation{vehicle(r), static_cast<coordination::KnownMotion>(whole(r, 3)),
                                    list(r, 9, line)};
  };
  return {
      {number(random), number(random)}, areas(random), coin(random), list(random, 5, separation)};
}

std::string words(Random& random) {
  std::string result(whole(random, 200), '?');
  for (char& letter : result) {
    letter = static_cast<char>('a' + whole(random, 25));
  }
  return result;
}

}  // namespace

template <>
VehicleState sample(Random& random) {
  return {static_cast<std::uint8_t>(whole(random, 255)),
          random(),
          random(),
          pose(random),
          random(),
          number(random),
          number(random),
          number(random),
          number(random),
          number(random),
          number(random),
          number(random),
          number(random),
          number(random),
          number(random),
          number(random),
          coin(random)};
}

template <>
VehicleObservation sample(Random& random) {
  return {static_cast<std::uint8_t>(whole(random, 255)), random(), random(), pose(random)};
}

template <>
VehicleStateList sample(Random& random) {
  return {random(), 1 + whole(random, 999), list(random, 20, sample<VehicleState>),
          list(random, 20, sample<VehicleObservation>),
          list(random, 20, [](Random& r) { return static_cast<std::int32_t>(1 + whole(r, 29)); })};
}

template <>
TrajectoryCommand sample(Random& random) {
  return {static_cast<std::uint8_t>(whole(random, 255)), random(), random(),
          list(random, 60, [](Random& r) {
            return TrajectoryPoint{r(), number(r), number(r), number(r), number(r)};
          })};
}

template <>
PathTrackingCommand sample(Random& random) {
  return {static_cast<std::uint8_t>(whole(random, 255)), random(), random(),
          list(random, 60,
               [](Random& r) {
                 return PathPoint{pose(r), number(r)};
               }),
          number(random)};
}

template <>
SpeedCurvatureCommand sample(Random& random) {
  return {static_cast<std::uint8_t>(whole(random, 255)), random(), random(), number(random),
          number(random)};
}

template <>
DirectCommand sample(Random& random) {
  return {static_cast<std::uint8_t>(whole(random, 255)), random(), random(), number(random),
          number(random)};
}

template <>
ReadyStatus sample(Random& random) {
  return {words(random), random()};
}

template <>
SystemTrigger sample(Random& random) {
  return {random()};
}

template <>
Parameter sample(Random& random) {
  const auto value = [&]() -> ParameterValue {
    switch (whole(random, 7)) {
      case 0:
        return std::monostate{};
      case 1:
        return coin(random);
      case 2:
        return static_cast<std::int32_t>(whole(random, 1000)) - 500;
      case 3:
        return std::uint64_t{random()};
      case 4:
        return number(random);
      case 5:
        return words(random);
      case 6:
        return list(random, 30,
                    [](Random& r) { return static_cast<std::int32_t>(whole(r, 1000)) - 500; });
      default:
        return list(random, 30, number);
    }
  };
  return {words(random), value()};
}

template <>
ParameterRequest sample(Random& random) {
  return {words(random)};
}

template <>
StopRequest sample(Random& random) {
  return {static_cast<std::uint8_t>(whole(random, 255))};
}

template <>
Log sample(Random& random) {
  return {words(random), words(random), random(), static_cast<std::uint16_t>(whole(random, 3))};
}

template <>
LogLevel sample(Random& random) {
  return {static_cast<std::uint16_t>(whole(random, 3))};
}

template <>
GoalState sample(Random& random) {
  const auto dds_point = [](Random& r) {
    ::CommonroadDDSPoint result;
    result.x(number(r));
    result.y(number(r));
    return result;
  };
  const auto interval = [&random] {
    ::CommonroadDDSInterval result;
    result.interval_start(number(random));
    result.interval_end(number(random));
    return result;
  };
  ::CommonroadDDSPositionInterval position;
  position.circles(list(random, 3, [&](Random& r) {
    ::CommonroadDDSCircle circle;
    circle.center(dds_point(r));
    circle.radius(number(r));
    return circle;
  }));
  position.polygons(list(random, 3, [&](Random& r) {
    ::CommonroadDDSPolygon polygon;
    polygon.points(list(r, 5, dds_point));
    return polygon;
  }));
  position.rectangles(list(random, 3, [&](Random& r) {
    ::CommonroadDDSRectangle rectangle;
    rectangle.length(number(r));
    rectangle.width(number(r));
    rectangle.center(dds_point(r));
    rectangle.orientation(number(r));
    return rectangle;
  }));
  position.lanelet_refs(
      list(random, 4, [](Random& r) { return static_cast<std::int32_t>(whole(r, 9999)); }));
  ::CommonroadDDSGoalState goal;
  goal.time(interval());
  goal.time_set(whole(random, 1) == 1);
  goal.has_exact_position(whole(random, 1) == 1);
  goal.exact_position(dds_point(random));
  goal.position(position);
  goal.orientation(interval());
  goal.velocity(interval());
  goal.planning_problem_id(static_cast<std::int32_t>(whole(random, 99)));
  goal.goal_state_pos(static_cast<std::int32_t>(whole(random, 99)));
  return {goal};
}

template <>
Visualization sample(Random& random) {
  const auto byte = [&random] { return static_cast<std::uint8_t>(whole(random, 255)); };
  Visualization message{.id = random(),
                        .kind = static_cast<DrawingKind>(whole(random, 3)),
                        .time_to_live = random(),
                        .points_m = list(random, 9, point),
                        .size_m = number(random),
                        .text = words(random),
                        .anchor = static_cast<TextAnchor>(whole(random, 8)),
                        .color = {}};
  message.color = {.alpha = byte(), .red = byte(), .green = byte(), .blue = byte()};
  return message;
}

coordination::PlanningInput planning_input(Random& random) {
  const auto index = [](Random& from) { return static_cast<std::uint32_t>(from()); };
  coordination::PlanningInput input{
      .basis = random(),
      .may_plan = coin(random),
      .base = {{random()}, list(random, 9, pose), list(random, 9, index), index(random)},
      .is_moved = coin(random),
      .seen_step = {random()},
      .seen_time_s = number(random),
      .seen_pose = pose(random),
      .deviation_m = number(random),
      .route = index(random),
      .path_s_m = number(random),
      .area = {}};
  auto& [entry, is_possible, is_certain, is_departing, stands_since] = input.area;
  if (coin(random)) entry = {number(random), number(random), number(random), number(random)};
  is_possible = coin(random);
  is_certain = coin(random);
  is_departing = coin(random);
  if (coin(random)) stands_since = StepIndex{random()};
  return input;
}

template <>
coordination::Traffic sample(Random& random) {
  coordination::Traffic traffic{vehicle(random),         {random()},    pose(random),
                                {whole(random, 100)},    areas(random), polygon(random),
                                list(random, 5, vehicle)};
  traffic.standing_steps = static_cast<std::uint32_t>(random());
  traffic.reference_areas_m = list(random, 9, polygon);
  if (coin(random)) {
    traffic.claim = {static_cast<std::uint32_t>(random()), number(random), number(random),
                     static_cast<std::uint32_t>(random())};
  }
  if (coin(random)) traffic.planning = planning_input(random);
  return traffic;
}

template <>
coordination::Prediction sample(Random& random) {
  return {vehicle(random),
          {random()},
          coin(random),
          areas(random),
          coin(random) ? std::optional{areas(random)} : std::nullopt};
}

template <>
coordination::Outcome sample(Random& random) {
  coordination::Outcome outcome{vehicle(random), {random()}, coin(random)};
  if (coin(random))
    outcome.digests = {
        .inputs = random(), .plan = random(), .is_prediction_published = coin(random)};
  return outcome;
}

template <>
ReportRecord sample(Random& random) {
  const std::uint64_t step = random();
  const auto maneuver = [](Random& r) {
    return coordination::PlannedManeuver{.to = {whole(r, 100)}, .label = words(r)};
  };
  coordination::Report report{
      vehicle(random),
      {step},
      static_cast<coordination::StepStatus>(whole(random, 3)),
      static_cast<coordination::FallbackReason>(whole(random, 9)),
      pose(random),
      {whole(random, 100)},
      words(random),
      words(random),
      number(random),
      static_cast<coordination::PlanQuality>(whole(random, 2)),
      number(random),
      coin(random) ? std::optional(number(random)) : std::nullopt,
      random(),
      random(),
      static_cast<std::uint32_t>(whole(random, 20)),
      list(random, 5, vehicle),
      list(random, 5, vehicle),
      number(random),
      {list(random, 5, vehicle), {step - std::min<std::uint64_t>(step, whole(random, 200))}},
      coin(random) ? std::optional(StepIndex{whole(random, step)}) : std::nullopt,
      list(random, 5, vehicle),
      list(random, 9, maneuver)};
  if (coin(random)) {
    report.held = {static_cast<std::uint32_t>(random()), number(random), number(random)};
  }
  if (coin(random)) {
    report.certificate = std::make_shared<const coordination::Certificate>(certificate(random));
  }
  return {report, random(), coin(random), random()};
}

template <>
RunState sample(Random& random) {
  return {static_cast<RunPhase>(whole(random, 1)), random()};
}

template <>
AutomatonRequest sample(Random& random) {
  const auto trim = [](Random& r) { return TrimId{whole(r, 100)}; };
  const auto edge = [&](Random& r) { return TrimPair{trim(r), trim(r)}; };
  const auto weight = [](Random& r) { return CriterionWeight{words(r), number(r)}; };
  AutomatonRequest request{.vehicle = vehicle(random),
                           .id = random(),
                           .valid_from = random(),
                           .subgraph = {.labels = list(random, 4, words),
                                        .weights = list(random, 4, weight),
                                        .max_speed_mps = {},
                                        .enable_trims = list(random, 4, trim),
                                        .disable_trims = list(random, 4, trim),
                                        .enable_edges = list(random, 4, edge),
                                        .disable_edges = list(random, 4, edge)}};
  if (coin(random)) request.subgraph.max_speed_mps = number(random);
  return request;
}

template <>
AutomatonAnswer sample(Random& random) {
  return {vehicle(random),
          random(),
          static_cast<RequestOutcome>(whole(random, 3)),
          {random()},
          words(random)};
}

std::string text(const VehicleState& message) { return text_of(message); }
std::string text(const VehicleObservation& message) { return text_of(message); }
std::string text(const VehicleStateList& message) { return text_of(message); }
std::string text(const TrajectoryCommand& message) { return text_of(message); }
std::string text(const PathTrackingCommand& message) { return text_of(message); }
std::string text(const SpeedCurvatureCommand& message) { return text_of(message); }
std::string text(const DirectCommand& message) { return text_of(message); }
std::string text(const ReadyStatus& message) { return text_of(message); }
std::string text(const SystemTrigger& message) { return text_of(message); }
std::string text(const Parameter& message) { return text_of(message); }
std::string text(const ParameterRequest& message) { return text_of(message); }
std::string text(const StopRequest& message) { return text_of(message); }
std::string text(const Log& message) { return text_of(message); }
std::string text(const LogLevel& message) { return text_of(message); }
std::string text(const Visualization& message) { return text_of(message); }
std::string text(const GoalState& message) { return text_of(message); }
std::string text(const coordination::Traffic& message) { return text_of(message); }
std::string text(const coordination::Prediction& message) { return text_of(message); }
std::string text(const coordination::Outcome& message) { return text_of(message); }
std::string text(const ReportRecord& message) { return text_of(message); }
std::string text(const RunState& message) { return text_of(message); }
std::string text(const AutomatonRequest& message) { return text_of(message); }
std::string text(const AutomatonAnswer& message) { return text_of(message); }

}  // namespace hlc::dds
