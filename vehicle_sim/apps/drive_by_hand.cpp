// Drives a guest by keyboard or gamepad: publishes the lab's speed and curvature commands for it,
// 50 times a second, in real time.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/apps/program_version.hpp"
#include "hlc_bridge/apps/run_program.hpp"
#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "planner/scenario/guest_values.hpp"
#include "vehicle_sim/apps/hand_inputs.hpp"
#include "vehicle_sim/guest/hand_control.hpp"

namespace {

constexpr auto kTick = std::chrono::nanoseconds{hlc::kVehiclePeriod};
/// Until the car stands, at its end.
constexpr auto kStopTime = std::chrono::seconds{2};

struct Flags {
  hlc::apps::NetworkFlags network;
  std::filesystem::path scenario;
  int vehicle_id{};
  std::string gamepad;
};

void declare(CLI::App& app, Flags& flags) {
  hlc::apps::declare_scenario(app, "--scenario", flags.scenario, ", with the guest and its limits")
      ->required();
  app.add_option("--vehicle_id", flags.vehicle_id, "the guest, with drive: by_hand")
      ->required()
      ->check(hlc::apps::vehicle_id_range());
  app.add_option(
         "--gamepad", flags.gamepad,
         "joystick device, e.g. /dev/input/js0, beside the keyboard; its first axis steers, "
         "its second one gives the speed; default: the keyboard alone")
      ->type_name("FILE");
  flags.network.declare_network(app);
  hlc::apps::declare_help_end(
      app,
      {.examples =
           {"drive_by_hand --scenario by_hand.yaml --vehicle_id 30 --dds_domain 1 --transport "
            "loopback",
            "drive_by_hand --scenario by_hand.yaml --vehicle_id 30 --dds_domain 21 --gamepad "
            "/dev/input/js0"},
       .exit_codes = "0 ended, 2 invalid input",
       .notes = "Keys: arrow up or w faster, down or s slower, left or a, right or d steer, x "
                "straight on, space stop, q end.\nCommands stay within the guest's limits. At its "
                "end, also by Ctrl-C, the car is stopped first."});
}

/// @throws std::invalid_argument naming the flag
hlc::scenario::ScenarioGuest guest_of(const Flags& flags) {
  const std::vector<hlc::scenario::ScenarioGuest> guests =
      hlc::scenario::guests_of_file(flags.scenario);
  const auto found = std::ranges::find_if(guests, [&](const hlc::scenario::ScenarioGuest& one) {
    return one.guest.vehicle.value == flags.vehicle_id &&
           one.drive == hlc::scenario::GuestDrive::kByHand;
  });
  if (found != guests.end()) return *found;
  throw std::invalid_argument(
      fmt::format("--vehicle_id = {}, must be a guest of {} with drive: by_hand", flags.vehicle_id,
                  flags.scenario.string()));
}

hlc::dds::ParticipantOptions participant_options(const Flags& flags) {
  hlc::dds::check_domain_id("--dds_domain", flags.network.dds_domain);
  hlc::dds::ParticipantOptions options;
  options.name = hlc::driver_name(static_cast<std::uint8_t>(flags.vehicle_id));
  options.domain_id = flags.network.dds_domain;
  options.role = hlc::dds::DomainRole::kLab;
  options.transport = hlc::dds::transport_from_name(flags.network.transport);
  options.discovery_server = flags.network.discovery_server();
  options.version = hlc::apps::program_version();
  options.security = flags.network.security;
  return options;
}

class HandDriver {
 public:
  explicit HandDriver(const Flags& flags)
      : guest_(guest_of(flags)),
        control_(guest_.guest.vehicle, guest_.guest.limits),
        inputs_(flags.gamepad),
        lab_(participant_options(flags)),
        speed_curvature_(lab_, hlc::dds::topics::vehicle_command<hlc::SpeedCurvatureCommand>(
                                   guest_.guest.vehicle.value)),
        direct_(lab_,
                hlc::dds::topics::vehicle_command<hlc::DirectCommand>(guest_.guest.vehicle.value)) {
  }

  int run() {
    auto next = std::chrono::steady_clock::now();
    const auto drive = [&] {
      next += kTick;
      const bool has_inputs = inputs_.pass_to(control_, next);
      send();
      return has_inputs;
    };
    while (!is_stopped_ && !control_.is_over() && drive()) show();
    control_.stop();
    for (const auto end = next + kStopTime; next < end;) {
      std::this_thread::sleep_until(next += kTick);
      send();
    }
    if (is_terminal_) std::fputs("\n", stderr);
    return hlc::kExitGood;
  }

  void stop() { is_stopped_ = true; }

 private:
  void send() {
    std::visit([this](const auto& command) { write(command); },
               control_.tick(hlc::time::real_time_now()));
  }
  void write(const hlc::SpeedCurvatureCommand& command) { speed_curvature_.write(command); }
  void write(const hlc::DirectCommand& command) { direct_.write(command); }

  void show() const {
    if (!is_terminal_) return;
    fmt::print(stderr, "\r{}: {:.1f} m/s, curvature {:+.1f} 1/m{}   ", guest_.name,
               control_.speed_mps(), control_.curvature_per_m(),
               speed_curvature_.matched() > 0 ? "" : ", not connected");
  }

  hlc::scenario::ScenarioGuest guest_;
  hlc::guest::HandControl control_;
  hlc::apps::HandInputs inputs_;
  hlc::dds::Participant lab_;
  hlc::dds::Writer<hlc::SpeedCurvatureCommand> speed_curvature_;
  hlc::dds::Writer<hlc::DirectCommand> direct_;
  bool is_terminal_{isatty(STDERR_FILENO) != 0};
  std::atomic<bool> is_stopped_{};
};

}  // namespace

int main(int argc, char** argv) {
  hlc::time::StopSignals signals;
  hlc::apps::CommandLine app{"Drives a guest of a running scenario by keyboard or gamepad.",
                             "drive_by_hand"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::run_program(
      "drive_by_hand", signals, [&] { return std::make_shared<HandDriver>(flags); },
      [](HandDriver& driver) { driver.stop(); });
}
