// Chooses trims from a recorded drive and prints them as the `trims` of an automaton's
// configuration.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "planner/apps/flags.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "planner/maneuver_design/trim_choice.hpp"

namespace {

constexpr double kWindow_s = 0.2;  // long enough that measurement noise does not pass for steering

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

/// A table of numbers with a line of column names.
class NumberTable {
 public:
  explicit NumberTable(const std::filesystem::path& path) : path_(path), file_(path) {
    std::string line;
    if (!std::getline(file_, line)) {
      throw std::invalid_argument(path.string() + ": cannot be read, allowed a CSV file");
    }
    for (const std::string& name : cells_of(line)) columns_.emplace(name, columns_.size());
    names_ = line;
  }

  [[nodiscard]] bool has(const std::string& column) const { return columns_.contains(column); }
  [[nodiscard]] const std::string& names() const { return names_; }

  [[nodiscard]] bool next_row() {
    std::string line;
    if (!std::getline(file_, line)) return false;
    cells_ = cells_of(line);
    ++row_;
    return true;
  }
  [[nodiscard]] double number(const std::string& column) const {
    const std::size_t i = columns_.at(column);
    const std::string text = i < cells_.size() ? cells_[i] : "";
    double value{};
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || rest != text.data() + text.size() || !std::isfinite(value)) {
      throw std::invalid_argument(path_.string() + ":" + std::to_string(row_) + ": " + column +
                                  " = " + text + ", allowed a number");
    }
    return value;
  }

 private:
  std::filesystem::path path_;
  std::ifstream file_;
  std::string names_;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::string> cells_;
  std::size_t row_{1};
};

std::vector<hlc::DriveSample> read_drive(const std::filesystem::path& path,
                                         const hlc::VehicleParameters& vehicle) {
  NumberTable table(path);
  std::vector<hlc::DriveSample> samples;
  if (table.has("speed_mps") && table.has("steering_rad")) {
    while (table.next_row()) {
      samples.push_back({table.number("speed_mps"), table.number("steering_rad")});
    }
    return samples;
  }
  const std::string time = table.has("t_ns") ? "t_ns" : "t_s";
  const std::string heading = table.has("yaw_rad") ? "yaw_rad" : "heading_rad";
  for (const std::string& column : {time, std::string("x_m"), std::string("y_m"), heading}) {
    if (table.has(column)) continue;
    throw std::invalid_argument(path.string() + ":1: columns = " + table.names() +
                                ", allowed speed_mps and steering_rad, or t_ns or t_s, x_m, y_m "
                                "and yaw_rad or heading_rad");
  }
  std::vector<hlc::DrivePoint> points;
  while (table.next_row()) {
    const double time_s = table.number(time) * (time == "t_ns" ? 1e-9 : 1.0);
    if (!points.empty() && time_s <= points.back().time_s) {
      throw std::invalid_argument(path.string() + ": " + time + " = " +
                                  std::to_string(table.number(time)) + ", allowed only increasing");
    }
    points.push_back({time_s, {table.number("x_m"), table.number("y_m"), table.number(heading)}});
  }
  return hlc::drive_samples(points, kWindow_s, vehicle);
}

void print(const std::vector<hlc::ChosenTrim>& trims, const std::filesystem::path& drive) {
  std::printf("# Trims that stand for %s; the share of the drive that each stands for.\ntrims:\n",
              drive.filename().c_str());
  for (std::size_t i = 0; i < trims.size(); ++i) {
    const hlc::Trim& trim = trims[i].trim;
    std::printf("  - {speed_mps: %.3f, steering_rad: %.3f}%s# %zu, %.1f %%\n", trim.speed_mps,
                trim.steering_rad, trim.steering_rad < 0.0 ? "   " : "    ", i + 1,
                100.0 * trims[i].share);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Chooses trims from a recorded drive (k-means in the plane of speed and steering) and prints "
      "them as the `trims` of an automaton's configuration.",
      "choose_trims"};
  std::filesystem::path drive;
  std::filesystem::path configuration;
  std::size_t count = 12;
  app.add_option("drive", drive,
                 "CSV with columns speed_mps and steering_rad, or with poses: t_ns or t_s, x_m, "
                 "y_m, yaw_rad or heading_rad (such as vehicle_1.csv of a run)")
      ->required();
  app.add_option("--count", count, "number of trims, standstill included")
      ->capture_default_str()
      ->check(CLI::Range(2, 200));
  app.add_option("--config", configuration,
                 "automaton configuration with the vehicle and its limits; default: the uCar");
  app.footer("Exit codes: 0 good, 2 bad input.");
  if (const auto code = hlc::parse_flags(app, argc, argv)) return *code;
  return hlc::exit_code_of("choose_trims", [&] {
    hlc::AutomatonConfiguration automaton;
    if (!configuration.empty()) automaton = hlc::read_automaton_configuration(configuration);
    const std::vector<hlc::DriveSample> samples = read_drive(drive, automaton.vehicle);
    try {
      print(hlc::choose_trims(samples, count, automaton.vehicle, automaton.limits), drive);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(drive.string() + ": " + error.what());
    }
  });
}
