#include "tests/integration/lab_processes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "tests/support/folders.hpp"
#include "tests/support/own_shared_memory.hpp"

namespace hlc::test {
namespace {

const std::string kBin = test::build_folder() + "/bin/";

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

scenario::ScenarioChoices choices_of(const LabOptions& options) {
  scenario::ScenarioChoices choices{.file = options.scenario, .profile = options.profile};
  if (!options.scenario.ends_with(".yaml")) {
    choices.file =
        test::source_folder() + "/launch_scripts/scenarios/" + options.scenario + ".yaml";
  }
  choices.cars = options.cars;
  if (!options.policy.empty()) choices.policy = options.policy;
  if (!options.map_file.empty()) choices.map_file = options.map_file;
  return choices;
}

std::vector<std::string> scenario_flags(const scenario::ScenarioChoices& choices) {
  std::vector<std::string> flags{"--scenario=" + choices.file.string(),
                                 "--profile=" + choices.profile};
  if (choices.cars) flags.push_back("--cars=" + std::to_string(*choices.cars));
  if (choices.policy) flags.push_back("--policy=" + *choices.policy);
  if (choices.map_file) flags.push_back("--map=" + choices.map_file->string());
  return flags;
}

/// The lab's, and one for every middleware: the lab's + the id of its vehicle.
int num_domains(const scenario::Scenario& scenario) {
  int largest = 0;
  for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    largest = std::max<int>(largest, vehicle.id.value);
  }
  return 1 + largest;
}

}  // namespace

LabProcesses::LabProcesses(const LabOptions& options)
    : LabProcesses(options, scenario::read_scenario(choices_of(options))) {}

LabProcesses::LabProcesses(const LabOptions& options, scenario::Scenario given)
    : DomainReservation(num_domains(given)),
      RunProcesses(std::move(given)),
      scenario_flags_(scenario_flags(choices_of(options))) {
  if (options.transport == "lab") static_cast<void>(use_own_shared_memory());
  const int lab = lab_domain();
  const auto common = [&](const std::string& program) {
    return std::vector<std::string>{
        kBin + program, "--dds_domain=" + std::to_string(lab), "--transport=" + options.transport,
        std::string("--simulated_time=") + (options.simulated_time ? "true" : "false"),
        "--startup_timeout_s=" +
            std::to_string(options.startup_timeout_s + (program == "lab_control" ? 0 : 10))};
  };
  const std::string messages = "--messages_folder=" + (folder() / "messages").string();
  const auto add = [&](const std::string& name, std::vector<std::string> command,
                       const std::vector<std::string>& flags) {
    if (std::ranges::find(options.absent, name) != options.absent.end()) return;
    command.insert(command.end(), flags.begin(), flags.end());
    if (options.records_messages) command.push_back(messages);
    if (!options.security.empty()) command.push_back("--security=" + options.security);
    commands_[name] = std::move(command);
  };
  std::string ids;
  for (const scenario::ScenarioVehicle& vehicle : scenario().vehicles) {
    const std::string id = std::to_string(vehicle.id.value);
    const std::string local = "--middleware_domain=" + std::to_string(lab + vehicle.id.value);
    ids += (ids.empty() ? "" : ",") + id;
    const Pose pose = scenario::measured_start(scenario(), vehicle);
    auto car = common("vehicle_sim");
    car.insert(car.end(), {"--vehicle_id=" + id,
                           "--pose=" + number(pose.x_m) + "," + number(pose.y_m) + "," +
                               number(pose.heading_rad),
                           "--record=" + (folder() / ("vehicle_" + id + ".csv")).string()});
    if (options.noise_seed) {
      car.push_back("--noise_seed=" + std::to_string(*options.noise_seed + vehicle.id.value));
    }
    if (scenario::has_early_stamps(scenario())) car.emplace_back("--stamps=lab");
    add("vehicle_" + id, car, options.vehicle_flags);
    auto middleware = common("middleware");
    middleware.insert(middleware.end(), {"--vehicle_ids=" + id, local});
    add("middleware_" + id, middleware, {});
    auto controller = common("high_level_controller");
    controller.insert(controller.end(), {"--vehicle_ids=" + id, local});
    add("high_level_controller_" + id, controller, scenario_flags_);
  }
  auto lab_control = common("lab_control");
  lab_control.insert(lab_control.end(),
                     {"--vehicle_ids=" + ids, "--steps=" + std::to_string(options.steps),
                      "--out=" + folder().string()});
  add("lab_control", lab_control, options.lab_control_flags);
  if (options.records_commands) {
    const std::string recorder = "command_recorder";
    add(recorder, common(recorder),
        {"--vehicle_ids=" + ids, "--out=" + commands_file(recorder).string()});
  }
}

std::vector<std::string> LabProcesses::names() const {
  std::vector<std::string> names;
  for (const auto& [name, command] : commands_) names.push_back(name);
  return names;
}

void LabProcesses::start_all() {
  for (const std::string& name : names()) start(name);
}

int LabProcesses::summarize() {
  std::vector<std::string> command{kBin + "summarize", "--run=" + folder().string()};
  command.insert(command.end(), scenario_flags_.begin(), scenario_flags_.end());
  ChildProcess program(command, log_file("summarize"));
  return program.wait_for(std::chrono::seconds(60)).value_or(-1);
}

std::string trace_of(LabProcesses& lab) {
  lab.start_all();
  EXPECT_THAT(lab.still_running_after(std::chrono::seconds(120)), testing::IsEmpty());
  EXPECT_EQ(lab.summarize(), 0) << lab.log("summarize");
  const std::string summary = read_text(lab.folder() / "summary.json");
  return nlohmann::json::parse(summary, nullptr, false).value("trace_sha256", "");
}

}  // namespace hlc::test
