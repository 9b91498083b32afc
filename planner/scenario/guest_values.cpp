#include "planner/scenario/guest_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "planner/common/csv.hpp"
#include "planner/scenario/area_values.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::scenario {
namespace {

constexpr double kFastest_mps = 10.0;
constexpr double kStrongest_mps2 = 20.0;
constexpr double kTightest_per_m = 20.0;
constexpr double kLongest_m = 5.0;
constexpr double kLatest_s = 3600.0;
constexpr double kLeast = 1e-2;  // of each limit

Pose read_start(const Node& node) {
  node.check_keys({"x_m", "y_m", "heading_rad"});
  return {node.required<double>("x_m", between(-kFarthest_m, kFarthest_m)),
          node.required<double>("y_m", between(-kFarthest_m, kFarthest_m)),
          node.optional<double>("heading_rad", 0.0,
                                between(-2.0 * std::numbers::pi, 2.0 * std::numbers::pi))};
}

coordination::GuestLimits read_limits(const Node& node) {
  node.check_keys({"speed_mps", "acceleration_mps2", "deceleration_mps2", "curvature_per_m"});
  return {.speed_mps = node.required<double>("speed_mps", between(kLeast, kFastest_mps)),
          .acceleration_mps2 =
              node.required<double>("acceleration_mps2", between(kLeast, kStrongest_mps2)),
          .deceleration_mps2 =
              node.required<double>("deceleration_mps2", between(kLeast, kStrongest_mps2)),
          .curvature_per_m =
              node.required<double>("curvature_per_m", between(kLeast, kTightest_per_m))};
}

std::optional<Footprint> read_footprint(const Node& guest) {
  if (!guest.has("footprint")) return std::nullopt;
  const Node node = guest.map("footprint");
  node.check_keys({"length_m", "width_m"});
  return Footprint{.length_m = node.required<double>("length_m", between(kLeast, kLongest_m)),
                   .width_m = node.required<double>("width_m", between(kLeast, kLongest_m))};
}

GuestDrive read_drive(const Node& node) {
  const auto drive = node.required<std::string>("drive", one_of({"by_hand", "track", "wander"}));
  if (drive == "track") return GuestDrive::kTrack;
  return drive == "wander" ? GuestDrive::kWander : GuestDrive::kByHand;
}

GuestValues read_guest(const Node& node, const std::filesystem::path& file) {
  GuestValues guest{.id = {static_cast<std::uint8_t>(
                        node.required<std::size_t>("id", between(1.0, kMaxVehicleId)))},
                    .name = {},
                    .start = read_start(node.map("start")),
                    .limits = read_limits(node.map("limits")),
                    .footprint = read_footprint(node),
                    .drive = read_drive(node),
                    .track_file = {},
                    .node = node};
  guest.name = node.optional<std::string>("name", fmt::format("guest {}", guest.id.value));
  if (guest.drive == GuestDrive::kTrack) {
    guest.track_file =
        (file.parent_path() / node.required<std::string>("track")).lexically_normal();
  } else if (guest.drive == GuestDrive::kWander) {
    const Node area = node.map("area");
    area.check_keys({"rectangle", "circle", "polygon"});
    guest.home_m = bounding_box(read_area(area));
    guest.seed = node.optional<std::size_t>("seed", 1, between(0.0, kMaxSeed));
  }
  node.check_no_unknown_keys();
  return guest;
}

}  // namespace

std::vector<GuestValues> read_guests(const Node& scenario, const std::filesystem::path& file) {
  std::vector<GuestValues> guests;
  const std::vector<Node> entries = scenario.optional_list("guests");
  if (entries.size() > kMostGuests) {
    scenario.fail("guests",
                  fmt::format("a list of at most {}, got {}", kMostGuests, entries.size()));
  }
  for (const Node& node : entries) {
    GuestValues guest = read_guest(node, file);
    if (std::ranges::find(guests, guest.id, &GuestValues::id) != guests.end()) {
      node.fail("id", "unique");
    }
    guests.push_back(std::move(guest));
  }
  return guests;
}

std::vector<ScenarioGuest> guests_of(const std::vector<GuestValues>& values,
                                     const vehicle::VehicleParameters& vehicle) {
  std::vector<ScenarioGuest> guests;
  for (const GuestValues& one : values) {
    guests.push_back({.guest = {.vehicle = one.id,
                                .footprint = one.footprint.value_or(vehicle.footprint),
                                .safety_margin_m = vehicle.safety_margin_m,
                                .limits = one.limits},
                      .name = one.name,
                      .start = one.start,
                      .drive = one.drive,
                      .track_file = one.track_file,
                      .track = {},
                      .home_m = one.home_m,
                      .seed = one.seed});
    if (one.drive == GuestDrive::kTrack) guests.back().track = read_track(one.track_file);
  }
  return guests;
}

std::vector<ScenarioGuest> guests_of_file(const std::filesystem::path& file) {
  return guests_of(read_guests(Node::read_yaml(file), file), {});
}

std::vector<TimedPoint> read_track(const std::filesystem::path& file) {
  const CsvTable table(file);
  std::vector<std::size_t> columns;
  for (const char* name : {"t_s", "x_m", "y_m"}) {
    const auto column = table.find(name);
    if (!column) {
      throw std::invalid_argument(fmt::format(
          "{}: no column {}, must have the columns t_s, x_m and y_m", file.string(), name));
    }
    columns.push_back(*column);
  }
  const auto bounded = [&](std::size_t row, std::size_t column, double least, double most) {
    const double value = table.number(row, column);
    if (!(value >= least && value <= most)) {
      table.refuse(row, column, fmt::format("{} ... {}", least, most));
    }
    return value;
  };
  std::vector<TimedPoint> track;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const double t_s = bounded(row, columns[0], 0.0, kLatest_s);
    if (!track.empty() && t_s <= track.back().time_s) {
      table.refuse(row, columns[0], "larger than in the row above");
    }
    track.push_back({.time_s = t_s,
                     .position_m = {bounded(row, columns[1], -kFarthest_m, kFarthest_m),
                                    bounded(row, columns[2], -kFarthest_m, kFarthest_m)},
                     .velocity_mps = Point::Zero()});
  }
  if (track.size() < 2) {
    throw std::invalid_argument(
        fmt::format("{}: rows = {}, must be >= 2", file.string(), track.size()));
  }
  return track;
}

}  // namespace hlc::scenario
