// Messages of the lab control centre and its operator: ticks, parameters, logs, goals, drawings.
#include <algorithm>
#include <any>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "hlc_bridge/dds/convert_lab.hpp"

// The structured bindings name every field of a plain message, so that a new field does not compile
// until it is converted.
namespace hlc::dds {

void to_wire(const ReadyStatus& message, ::ReadyStatus& wire) {
  const auto& [source_id, next_start] = message;
  wire.source_id(source_id);
  wire.next_start_stamp().nanoseconds(next_start);
}

Incoming<ReadyStatus> from_wire(const ::ReadyStatus& wire) {
  return valid_if(wire.source_id().size() <= kMaxText,
                  ReadyStatus{wire.source_id(), wire.next_start_stamp().nanoseconds()});
}

void to_wire(const SystemTrigger& message, ::SystemTrigger& wire) {
  const auto& [next_start] = message;
  wire.next_start().nanoseconds(next_start);
}

Incoming<SystemTrigger> from_wire(const ::SystemTrigger& wire) {
  return {SystemTrigger{wire.next_start().nanoseconds()}, 0};
}

void to_wire(const Parameter& message, ::Parameter& wire) {
  const auto& [name, value] = message;
  wire = {};
  wire.name(name);
  wire.type(static_cast<::ParameterType>(value.index()));
  std::visit(
      [&](const auto& held) {
        using Held = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<Held, bool>) {
          wire.value_bool(held);
        } else if constexpr (std::is_same_v<Held, std::int32_t>) {
          wire.values_int32({held});
        } else if constexpr (std::is_same_v<Held, std::uint64_t>) {
          wire.value_uint64_t(held);
        } else if constexpr (std::is_same_v<Held, double>) {
          wire.values_double({held});
        } else if constexpr (std::is_same_v<Held, std::string>) {
          wire.value_string(held);
        } else if constexpr (std::is_same_v<Held, std::vector<std::int32_t>>) {
          wire.values_int32(held);
        } else if constexpr (std::is_same_v<Held, std::vector<double>>) {
          wire.values_double(held);
        }
      },
      value);
}

Incoming<Parameter> from_wire(const ::Parameter& wire) {
  const auto& integers = wire.values_int32();
  const auto& doubles = wire.values_double();
  const bool plausible =
      wire.name().size() <= kMaxText && wire.value_string().size() <= kMaxText &&
      integers.size() <= kMaxEntries && doubles.size() <= kMaxEntries &&
      std::ranges::all_of(doubles, [](double value) { return std::isfinite(value); });
  if (!plausible) {
    return {std::nullopt, 1};
  }
  const auto with = [&](ParameterValue value) {
    return Incoming<Parameter>{Parameter{wire.name(), std::move(value)}, 0};
  };
  switch (wire.type()) {
    case ::ParameterType::Invalid:
      return with(std::monostate{});
    case ::ParameterType::Bool:
      return with(wire.value_bool());
    case ::ParameterType::Int32:
      return integers.size() == 1 ? with(integers.front()) : Incoming<Parameter>{std::nullopt, 1};
    case ::ParameterType::UInt64:
      return with(wire.value_uint64_t());
    case ::ParameterType::Double:
      return doubles.size() == 1 ? with(doubles.front()) : Incoming<Parameter>{std::nullopt, 1};
    case ::ParameterType::String:
      return with(wire.value_string());
    case ::ParameterType::Vector_Int32:
      return with(integers);
    case ::ParameterType::Vector_Double:
      return with(doubles);
  }
  return {std::nullopt, 1};
}

void to_wire(const ParameterRequest& message, ::ParameterRequest& wire) {
  const auto& [name] = message;
  wire.name(name);
}

Incoming<ParameterRequest> from_wire(const ::ParameterRequest& wire) {
  return valid_if(wire.name().size() <= kMaxText, ParameterRequest{wire.name()});
}

void to_wire(const StopRequest& message, ::StopRequest& wire) {
  const auto& [vehicle_id] = message;
  wire.vehicle_id(vehicle_id);
}

Incoming<StopRequest> from_wire(const ::StopRequest& wire) {
  return {StopRequest{wire.vehicle_id()}, 0};
}

void to_wire(const Log& message, ::Log& wire) {
  const auto& [id, content, stamp, level] = message;
  wire.id(id);
  wire.content(content);
  wire.stamp().nanoseconds(stamp);
  wire.log_level(level);
}

Incoming<Log> from_wire(const ::Log& wire) {
  return valid_if(wire.id().size() <= kMaxText && wire.content().size() <= kMaxText,
                  Log{wire.id(), wire.content(), wire.stamp().nanoseconds(), wire.log_level()});
}

void to_wire(const LogLevel& message, ::LogLevel& wire) {
  const auto& [level] = message;
  wire.log_level(level);
}

Incoming<LogLevel> from_wire(const ::LogLevel& wire) { return {LogLevel{wire.log_level()}, 0}; }

void to_wire(const GoalState& message, ::CommonroadDDSGoalState& wire) {
  wire = std::any_cast<const ::CommonroadDDSGoalState&>(message.payload);
}

Incoming<GoalState> from_wire(const ::CommonroadDDSGoalState& wire) {
  const auto& position = wire.position();
  const std::size_t most = std::max({position.circles().size(), position.polygons().size(),
                                     position.rectangles().size(), position.lanelet_refs().size()});
  return valid_if(most <= kMaxEntries, GoalState{wire});
}

void to_wire(const Visualization& message, ::Visualization& wire) {
  const auto& [id, kind, time_to_live, points_m, size_m, text, anchor, color] = message;
  const auto& [alpha, red, green, blue] = color;
  wire.id(id);
  wire.type(static_cast<::VisualizationType>(kind));
  wire.time_to_live(time_to_live);
  std::vector<::Point2D> points(points_m.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].x(points_m[i].x());
    points[i].y(points_m[i].y());
  }
  wire.points(std::move(points));
  wire.size(size_m);
  wire.string_message(text);
  wire.string_message_anchor(static_cast<::StringMessageAnchor>(anchor));
  wire.color().a(alpha);
  wire.color().r(red);
  wire.color().g(green);
  wire.color().b(blue);
}

Incoming<Visualization> from_wire(const ::Visualization& wire) {
  if (wire.points().size() > kMaxEntries || wire.string_message().size() > kMaxText ||
      wire.type() > ::VisualizationType::FilledCircle ||
      wire.string_message_anchor() > ::StringMessageAnchor::TopRight ||
      !std::isfinite(wire.size())) {
    return {std::nullopt, 1};
  }
  Visualization message{.id = wire.id(),
                        .kind = static_cast<DrawingKind>(wire.type()),
                        .time_to_live = wire.time_to_live(),
                        .points_m = {},
                        .size_m = wire.size(),
                        .text = wire.string_message(),
                        .anchor = static_cast<TextAnchor>(wire.string_message_anchor()),
                        .color = {.alpha = wire.color().a(),
                                  .red = wire.color().r(),
                                  .green = wire.color().g(),
                                  .blue = wire.color().b()}};
  for (const ::Point2D& point : wire.points()) {
    if (!all_finite(point.x(), point.y())) return {std::nullopt, 1};
    message.points_m.emplace_back(point.x(), point.y());
  }
  return {std::move(message), 0};
}

}  // namespace hlc::dds
