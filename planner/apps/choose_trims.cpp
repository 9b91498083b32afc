// Chooses trims from a recorded drive and prints them as the `trims` of an automaton's
// configuration.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "planner/apps/flags.hpp"
#include "planner/automaton/vehicle_yaml.hpp"
#include "planner/common/csv.hpp"
#include "planner/common/node.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/maneuver_design/trim_choice.hpp"

namespace {

constexpr double kWindow_s = 0.2;  // long enough that measurement noise is not taken for steering

/// Columns of a drive, by name.
class DriveTable {
 public:
  explicit DriveTable(const std::filesystem::path& path) : table_(path) {}

  [[nodiscard]] bool has(const std::string& column) const {
    return table_.find(column).has_value();
  }
  [[nodiscard]] std::string columns() const {
    return fmt::format("{}", fmt::join(table_.columns(), ","));
  }
  [[nodiscard]] std::size_t size() const { return table_.size(); }
  [[nodiscard]] double number(std::size_t row, const std::string& column) const {
    const std::size_t i = table_.find(column).value();
    const double value = table_.number(row, i);
    if (!std::isfinite(value)) table_.refuse(row, i, "a number");
    return value;
  }
  [[noreturn]] void refuse(std::size_t row, const std::string& column,
                           const std::string& allowed) const {
    table_.refuse(row, table_.find(column).value(), allowed);
  }

 private:
  hlc::CsvTable table_;
};

std::vector<hlc::maneuver_design::DriveSample> read_samples(const DriveTable& table) {
  std::vector<hlc::maneuver_design::DriveSample> samples;
  for (std::size_t row = 0; row < table.size(); ++row) {
    samples.push_back({table.number(row, "speed_mps"), table.number(row, "steering_rad")});
  }
  return samples;
}

std::vector<hlc::maneuver_design::DriveSample> read_drive(
    const std::filesystem::path& path, const hlc::vehicle::VehicleParameters& vehicle) {
  const DriveTable table(path);
  if (table.has("speed_mps") && table.has("steering_rad")) return read_samples(table);
  const std::string time = table.has("t_ns") ? "t_ns" : "t_s";
  const std::string heading = table.has("yaw_rad") ? "yaw_rad" : "heading_rad";
  for (const std::string& column : {time, std::string("x_m"), std::string("y_m"), heading}) {
    if (table.has(column)) continue;
    throw std::invalid_argument(
        fmt::format("{}:1: columns = {}, must be speed_mps and steering_rad, or t_ns or t_s, x_m, "
                    "y_m and yaw_rad or heading_rad",
                    path.string(), hlc::one_line(table.columns())));
  }
  std::vector<hlc::maneuver_design::DrivePoint> points;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const double time_s = table.number(row, time) * (time == "t_ns" ? 1e-9 : 1.0);
    if (!points.empty() && time_s <= points.back().time_s) {
      table.refuse(row, time, "larger than in the row before");
    }
    points.push_back(
        {time_s, {table.number(row, "x_m"), table.number(row, "y_m"), table.number(row, heading)}});
  }
  return hlc::maneuver_design::drive_samples(points, kWindow_s, vehicle);
}

/// Vehicle and limits of a configuration; its other keys may be absent.
struct Car {
  std::string name{"the uCar"};
  hlc::vehicle::VehicleParameters vehicle;
  hlc::vehicle::VehicleLimits limits;
};

Car read_car(const std::filesystem::path& configuration) {
  const hlc::Node file = hlc::Node::read_yaml(configuration);
  const hlc::Node vehicle = file.map("vehicle");
  Car car;
  car.name = configuration.filename().string();
  car.vehicle = hlc::automaton::read_vehicle(vehicle);
  car.limits = hlc::automaton::read_limits(file.map("limits"));
  static_cast<void>(hlc::automaton::read_identified(vehicle, car.vehicle, car.limits));
  vehicle.check_no_unknown_keys();
  return car;
}

void print(const std::vector<hlc::maneuver_design::ChosenTrim>& trims,
           const std::filesystem::path& drive, const Car& car) {
  const hlc::vehicle::VehicleLimits& limits = car.limits;
  std::printf("# limits of %s: %g ... %g m/s, +-%g rad", car.name.c_str(), limits.speed_min_mps,
              limits.speed_max_mps, limits.steering_max_rad);
  if (limits.friction_mps2) std::printf(", friction circle %g m/s^2", *limits.friction_mps2);
  if (limits.curvature_max_per_m) std::printf(", curvature %g 1/m", *limits.curvature_max_per_m);
  std::printf("; wheelbase %g m\n", car.vehicle.wheelbase_m);
  std::printf("# Trims that represent %s; the share of the drive that each represents.\ntrims:\n",
              drive.filename().c_str());
  for (std::size_t i = 0; i < trims.size(); ++i) {
    const hlc::automaton::Trim& trim = trims[i].trim;
    std::printf("  - {speed_mps: %.3f, steering_rad: %.3f}%s# %zu, %.1f %%\n", trim.speed_mps,
                trim.steering_rad, trim.steering_rad < 0.0 ? "   " : "    ", i + 1,
                100.0 * trims[i].share);
  }
}

/// Samples that do not count as they are.
struct Notes {
  std::size_t outside{};
  std::size_t reversing{};
  double fastest_mps{};
  double slowest_mps{std::numeric_limits<double>::infinity()};
  double sharpest_rad{};
  double fastest_reverse_mps{};
};

Notes notes_on(const std::vector<hlc::maneuver_design::DriveSample>& samples,
               const hlc::vehicle::VehicleLimits& limits) {
  Notes notes;
  for (const hlc::maneuver_design::DriveSample& sample : samples) {
    if (hlc::maneuver_design::is_reversing(sample)) {
      ++notes.reversing;
      notes.fastest_reverse_mps = std::max(notes.fastest_reverse_mps, -sample.speed_mps);
    }
    if (sample.speed_mps < hlc::maneuver_design::kSlowestDrive_mps) continue;
    const double sharpness_rad = std::abs(sample.steering_rad);
    notes.fastest_mps = std::max(notes.fastest_mps, sample.speed_mps);
    notes.slowest_mps = std::min(notes.slowest_mps, sample.speed_mps);
    notes.sharpest_rad = std::max(notes.sharpest_rad, sharpness_rad);
    if (sample.speed_mps > limits.speed_max_mps || sample.speed_mps < limits.speed_min_mps ||
        sharpness_rad > limits.steering_max_rad) {
      ++notes.outside;
    }
  }
  return notes;
}

std::string excess(const Notes& notes, const hlc::vehicle::VehicleLimits& limits) {
  std::vector<std::string> texts;
  const auto add = [&texts](const char* what, double value, const char* unit, const char* bound,
                            double allowed) {
    texts.push_back(fmt::format("{} {:g}{}, must be {}{:g}", what, value, unit, bound, allowed));
  };
  if (notes.fastest_mps > limits.speed_max_mps) {
    add("speed up to", notes.fastest_mps, " m/s", "<= ", limits.speed_max_mps);
  }
  if (notes.slowest_mps < limits.speed_min_mps) {
    add("speed down to", notes.slowest_mps, " m/s", ">= ", limits.speed_min_mps);
  }
  if (notes.sharpest_rad > limits.steering_max_rad) {
    add("steering up to", notes.sharpest_rad, " rad", "<= ", limits.steering_max_rad);
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

/// A line per kind of samples that do not count as they are.
void print_notes(const Notes& notes, const std::string& drive, std::size_t samples,
                 const hlc::vehicle::VehicleLimits& limits) {
  if (notes.outside > 0) {
    std::cerr << "choose_trims: " << drive << ": " << notes.outside << " of " << samples
              << " samples are outside the limits (" << excess(notes, limits)
              << ") and count as at the limit\n";
  }
  if (notes.reversing > 0) {
    std::cerr << "choose_trims: " << drive << ": " << notes.reversing << " of " << samples
              << " samples are reversing (up to " << notes.fastest_reverse_mps
              << " m/s) and are left out\n";
  }
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Chooses trims from a recorded drive (k-means in the plane of speed and steering) and prints "
      "them as the `trims` of an automaton's configuration.",
      "choose_trims"};
  std::filesystem::path drive;
  std::filesystem::path configuration;
  std::size_t count = 12;
  app.add_option("DRIVE", drive,
                 "CSV with columns speed_mps and steering_rad, or with poses: t_ns or t_s, x_m, "
                 "y_m, yaw_rad or heading_rad (such as vehicle_1.csv of a run)")
      ->required()
      ->type_name("FILE");
  app.add_option("--count", count, "number of trims, standstill included")
      ->capture_default_str()
      ->check(hlc::apps::whole(2, 200));
  app.add_option(
         "--configuration", configuration,
         "automaton configuration (YAML), of which the keys `vehicle` and `limits` are read; "
         "default: the uCar")
      ->type_name("FILE");
  hlc::apps::declare_help_end(
      app, {.examples = {"choose_trims runs/my_run/vehicle_1.csv --count 8",
                         "choose_trims drive.csv --configuration "
                         "launch_scripts/automata/passenger_car.yaml > trims.yaml"}});
  if (const auto code =
          hlc::apps::parse_flags(app, argc, argv, {{"--config", "--configuration"}})) {
    return *code;
  }
  return hlc::apps::exit_code_of("choose_trims", [&] {
    const Car car = configuration.empty() ? Car{} : read_car(configuration);
    const std::vector<hlc::maneuver_design::DriveSample> samples = [&] {
      try {
        return read_drive(drive, car.vehicle);
      } catch (const std::runtime_error& error) {
        throw std::invalid_argument(error.what());  // the drive is user input
      }
    }();
    try {
      const std::vector<hlc::maneuver_design::ChosenTrim> trims =
          hlc::maneuver_design::choose_trims(samples, count, car.vehicle, car.limits);
      print_notes(notes_on(samples, car.limits), drive.filename().string(), samples.size(),
                  car.limits);
      print(trims, drive, car);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(drive.string() + ": " + error.what());
    }
  });
}
