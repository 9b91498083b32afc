#include "tests/integration/lab_processes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <stdexcept>

namespace hlc::test {
namespace {

const std::string kBin = std::string(HLC_BINARY_DIR) + "/bin/";
constexpr int kLargestVehicles = 4;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

std::filesystem::path new_folder() {
  static int count = 0;
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) /
      ("hlc_run_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
  std::filesystem::create_directories(folder / "logs");
  return folder;
}

std::filesystem::path scenario_file(const std::string& scenario) {
  if (scenario.ends_with(".yaml")) return scenario;
  return std::string(HLC_SOURCE_DIR) + "/launch_scripts/scenarios/" + scenario + ".yaml";
}

std::vector<std::string> scenario_flags(const ScenarioChoices& choices) {
  std::vector<std::string> flags{"--scenario=" + choices.file.string(),
                                 "--profile=" + choices.profile};
  if (choices.map_file) flags.push_back("--map=" + choices.map_file->string());
  return flags;
}

}  // namespace

LabProcesses::LabProcesses(const LabOptions& options)
    : domains_(1 + kLargestVehicles),
      folder_(new_folder()),
      choices_{.file = scenario_file(options.scenario), .profile = options.profile} {
  if (!options.map_file.empty()) choices_.map_file = options.map_file;
  scenario_ = read_scenario(choices_);
  const int lab = domains_.first();
  const auto common = [&](const std::string& program) {
    return std::vector<std::string>{
        kBin + program, "--dds_domain=" + std::to_string(lab), "--transport=" + options.transport,
        std::string("--simulated_time=") + (options.simulated_time ? "true" : "false"),
        "--startup_timeout_s=" +
            std::to_string(options.startup_timeout_s + (program == "lab_control" ? 0 : 10))};
  };
  const auto add = [&](const std::string& name, std::vector<std::string> command,
                       const std::vector<std::string>& flags) {
    if (std::ranges::find(options.absent, name) != options.absent.end()) return;
    command.insert(command.end(), flags.begin(), flags.end());
    commands_[name] = std::move(command);
  };
  std::string ids;
  for (const ScenarioVehicle& vehicle : scenario_.vehicles) {
    const std::string id = std::to_string(vehicle.id.value);
    const std::string local = "--middleware_domain=" + std::to_string(lab + vehicle.id.value);
    ids += (ids.empty() ? "" : ",") + id;
    const Pose pose = measured_start(scenario_, vehicle);
    auto car = common("vehicle_sim");
    car.insert(car.end(), {"--vehicle_id=" + id,
                           "--pose=" + number(pose.x_m) + "," + number(pose.y_m) + "," +
                               number(pose.heading_rad),
                           "--record=" + (folder_ / ("vehicle_" + id + ".csv")).string()});
    if (options.noise_seed) {
      car.push_back("--noise_seed=" + std::to_string(*options.noise_seed + vehicle.id.value));
    }
    add("vehicle_" + id, car, options.vehicle_flags);
    auto middleware = common("middleware");
    middleware.insert(middleware.end(), {"--vehicle_ids=" + id, local});
    add("middleware_" + id, middleware, {});
    auto controller = common("high_level_controller");
    controller.insert(controller.end(), {"--vehicle_ids=" + id, local});
    add("high_level_controller_" + id, controller, scenario_flags(choices_));
  }
  auto lab_control = common("lab_control");
  lab_control.insert(lab_control.end(),
                     {"--vehicle_ids=" + ids, "--steps=" + std::to_string(options.steps),
                      "--out=" + folder_.string()});
  add("lab_control", lab_control, options.lab_control_flags);
  if (options.records_commands) {
    add("command_recorder", common("command_recorder"),
        {"--vehicle_ids=" + ids, "--out=" + commands_file().string()});
  }
}

LabProcesses::~LabProcesses() {
  running_.clear();
  if (!keeps_folder_ && !testing::Test::HasFailure()) {
    std::filesystem::remove_all(folder_);
  } else {
    std::cerr << "the run's files are in " << folder_ << '\n';
  }
}

std::vector<std::string> LabProcesses::names() const {
  std::vector<std::string> names;
  for (const auto& [name, command] : commands_) names.push_back(name);
  return names;
}

void LabProcesses::start(const std::string& name) {
  running_.emplace(name, ChildProcess(commands_.at(name), folder_ / "logs" / (name + ".log")));
}

void LabProcesses::start_all() {
  for (const std::string& name : names()) start(name);
}

void LabProcesses::start_again(const std::string& name) {
  running_.erase(name);
  start(name);
}

std::vector<std::string> LabProcesses::still_running_after(std::chrono::seconds time) {
  return still_running(running_, time);
}

int LabProcesses::summarize() {
  std::vector<std::string> command{kBin + "summarize", "--run=" + folder_.string()};
  std::ranges::move(scenario_flags(choices_), std::back_inserter(command));
  ChildProcess program(command, folder_ / "logs" / "summarize.log");
  return program.wait_for(std::chrono::seconds(60)).value_or(-1);
}

std::string LabProcesses::log(const std::string& name) const {
  return read_text(folder_ / "logs" / (name + ".log"));
}

}  // namespace hlc::test
