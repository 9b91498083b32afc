#include "vehicle_sim/closed_loop/process_factory.hpp"

#include <cmath>
#include <utility>

#include "hlc_bridge/lab_control/logical_run.hpp"
#include "hlc_bridge/lab_control/real_time_run.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "vehicle_sim/closed_loop/controller_host.hpp"
#include "vehicle_sim/closed_loop/lab_control_host.hpp"
#include "vehicle_sim/closed_loop/middleware_host.hpp"
#include "vehicle_sim/closed_loop/seeded_random.hpp"
#include "vehicle_sim/closed_loop/stamps_of.hpp"
#include "vehicle_sim/closed_loop/vehicle_host.hpp"

namespace hlc::closed_loop {
namespace {

constexpr Nanoseconds kStartupTimeout = 30 * kNanosecondsPerSecond;
constexpr std::uint64_t kEndless = 1'000'000;

template <class Host>
std::unique_ptr<SimulatedProcess> wrapped(const ProcessPlace& place, Host host,
                                          typename Host::Machine machine) {
  return std::make_unique<MachineProcess<Host>>(place, std::move(host), std::move(machine),
                                                kStartupTimeout);
}

lab_control::LabControlMachine lab_control(const scenario::Scenario& scenario,
                                           const LabSettings& settings,
                                           const std::vector<std::uint8_t>& ids) {
  const double step_s = scenario.subgraph->automaton().step_s;
  lab_control::LabRunSettings run{.vehicle_ids = ids,
                                  .period = static_cast<Nanoseconds>(std::llround(1e9 * step_s)),
                                  .steps = settings.steps,
                                  .startup_timeout = kStartupTimeout};
  if (settings.is_logical) {
    return {std::make_unique<lab_control::LogicalRun>(std::move(run)), settings.progress_interval};
  }
  run.on_death = lab_control::OnDeath::kContinue;
  run.steps = kEndless;
  return {std::make_unique<lab_control::RealTimeRun>(std::move(run)), settings.progress_interval};
}

simulated_vehicle::VehicleMachine vehicle(const scenario::Scenario& scenario, std::uint8_t id,
                                          const Pose& start, const LabSettings& settings) {
  return simulated_vehicle::VehicleMachine(
      {.vehicle = {.vehicle_id = id,
                   .start = start,
                   .noise_seed = mixed(settings.seed, id),
                   .vehicle = scenario.subgraph->automaton().identified,
                   .stamps = stamps_of(scenario)},
       .rules = settings.is_logical ? machine::logical_rules() : machine::real_rules(kVehicleStays),
       .startup_timeout = kStartupTimeout});
}

middleware::MiddlewareMachine middleware(std::uint8_t id, const LabSettings& settings) {
  return middleware::MiddlewareMachine({.vehicle_ids = {id},
                                        .startup_timeout = kStartupTimeout,
                                        .rules = settings.is_logical
                                                     ? middleware::logical_middleware_rules(false)
                                                     : middleware::real_middleware_rules(false)});
}

high_level_controller::HlcMachine controller(const scenario::Scenario& scenario, std::uint8_t id,
                                             const LabSettings& settings) {
  const bool is_in_the_lab = settings.transport == Transport::kLab;
  high_level_controller::HlcRules rules =
      settings.is_logical
          ? high_level_controller::rules_in_logical_time(is_in_the_lab)
          : high_level_controller::rules_in_real_time(
                is_in_the_lab, high_level_controller::StepDeadlines{}, kStartupTimeout);
  rules.warms_up = false;
  scenario::Scenario own = scenario;
  if (settings.differs(id, Difference::kSequential)) own.rounds = controller::Rounds::kSequential;
  if (settings.differs(id, Difference::kOtherBasis)) ++own.search.max_expansions;
  return {{.rules = rules,
           .startup_timeout = kStartupTimeout,
           .reconfiguration = scenario.reconfiguration},
          scenario::make_controller(own, VehicleId{id}, *settings.prepared)};
}

}  // namespace

std::string name_of(const ProcessKey& key) {
  switch (key.role) {
    case Role::kLabControl:
      return kLabControlName;
    case Role::kVehicle:
      return vehicle_name(key.vehicle);
    case Role::kMiddleware:
      return middleware_name(key.vehicle);
    case Role::kController:
      return controller_name(key.vehicle);
  }
  return {};
}

std::string to_string(const DifferentController& one) {
  std::string vehicle = "controller " + std::to_string(one.vehicle);
  switch (one.difference) {
    case Difference::kSequential:
      return vehicle + " does not share";
    case Difference::kOtherBasis:
      return vehicle + " plans by other rules";
    case Difference::kOtherBits:
      return vehicle + " computes other bits";
  }
  return vehicle;
}

ProcessFactory::ProcessFactory(const scenario::Scenario& scenario, const LabSettings& settings)
    : scenario_(&scenario), settings_(settings) {
  if (!settings_.prepared) settings_.prepared = scenario::prepare_subgraph_of(scenario);
  for (const scenario::ScenarioVehicle& one : scenario.vehicles) ids_.push_back(one.id.value);
}

std::vector<ProcessKey> ProcessFactory::processes() const {
  std::vector<ProcessKey> keys{{.role = Role::kLabControl}};
  for (const std::uint8_t id : ids_) {
    for (const Role role : {Role::kVehicle, Role::kMiddleware, Role::kController}) {
      keys.push_back({.role = role, .vehicle = id});
    }
  }
  return keys;
}

NodeDescription ProcessFactory::description(const ProcessKey& key) const {
  switch (key.role) {
    case Role::kLabControl:
      return LabControlHost::description(ids_, settings_.is_logical);
    case Role::kVehicle:
      return VehicleHost::description(key.vehicle);
    case Role::kMiddleware:
      return MiddlewareHost::description(key.vehicle, ids_);
    case Role::kController:
      return ControllerHost::description(key.vehicle);
  }
  return {};
}

std::unique_ptr<SimulatedProcess> ProcessFactory::make(const ProcessKey& key,
                                                       const ProcessPlace& place,
                                                       const std::optional<Pose>& start) const {
  switch (key.role) {
    case Role::kLabControl:
      return wrapped(place, LabControlHost(), lab_control(*scenario_, settings_, ids_));
    case Role::kVehicle:
      return wrapped(
          place, VehicleHost(key.vehicle),
          vehicle(*scenario_, key.vehicle, start.value_or(first_pose(key.vehicle)), settings_));
    case Role::kMiddleware:
      return wrapped(place, MiddlewareHost(key.vehicle, ids_), middleware(key.vehicle, settings_));
    case Role::kController:
      return wrapped(place, ControllerHost(settings_.differs(key.vehicle, Difference::kOtherBits)),
                     controller(*scenario_, key.vehicle, settings_));
  }
  return nullptr;
}

Pose ProcessFactory::first_pose(std::uint8_t vehicle) const {
  return scenario::measured_start(*scenario_, scenario::vehicle_of(*scenario_, VehicleId{vehicle}));
}

}  // namespace hlc::closed_loop
