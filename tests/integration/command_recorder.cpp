// Records the commands of the middlewares to the vehicles: every command is a plan that was
// agreed, and tests hold what was driven against it.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/apps/run_program.hpp"
#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/machine/pacing.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/time/signal.hpp"
#include "tests/integration/recorded_commands.hpp"

namespace {

struct Flags {
  hlc::apps::NetworkFlags network;
  std::vector<int> vehicle_ids;
  std::string out;
};

void declare(CLI::App& app, Flags& flags) {
  flags.network.declare(app);
  app.add_option("--vehicle_ids", flags.vehicle_ids, "whose commands")
      ->delimiter(',')
      ->required()
      ->check(hlc::apps::vehicle_id_range());
  app.add_option("--out", flags.out, "file for the commands")->required()->type_name("FILE");
  hlc::apps::declare_help_end(
      app,
      {.examples = {"command_recorder --vehicle_ids 1,2,3 --dds_domain 40 --out commands.csv",
                    "command_recorder --vehicle_ids 1 --transport loopback --simulated_time true "
                    "--out commands.csv"},
       .exit_codes = "0 success, 2 invalid input or an output that cannot be written, 4 failed",
       .notes = "Ends with the lab control or the last of the middlewares."});
}

class Recorder {
 public:
  explicit Recorder(const Flags& flags)
      : file_(std::fopen(flags.out.c_str(), "w"), std::fclose),
        lab_({.name = "command_recorder",
              .domain_id = flags.network.dds_domain,
              .role = hlc::dds::DomainRole::kLab,
              .transport = hlc::dds::transport_from_name(flags.network.transport),
              .lease = hlc::machine::run_time(flags.network.simulated_time).lease,
              .discovery_server = flags.network.discovery_server()},
             [this] { signal_.notify(); }) {
    if (!file_) throw std::invalid_argument("--out = " + flags.out + ", cannot be written");
    for (const int id : flags.vehicle_ids) {
      const auto vehicle = static_cast<std::uint8_t>(id);
      readers_.try_emplace(vehicle, lab_, hlc::dds::topics::vehicle_command(vehicle),
                           [this](const hlc::TrajectoryCommand& command) {
                             signal_.post([&] { commands_.push_back(command); });
                           });
    }
  }

  int run() {
    bool goes_on = true;
    while (goes_on) {
      const auto soon = std::chrono::steady_clock::now() + std::chrono::milliseconds{500};
      static_cast<void>(signal_.wait_until(soon, [this] { return stop_ || !commands_.empty(); }));
      goes_on = !is_over() && !signal_.locked([this] { return stop_; });
      for (const hlc::TrajectoryCommand& command :
           signal_.locked([this] { return std::exchange(commands_, {}); })) {
        hlc::test::append(command, *file_);
      }
    }
    return hlc::kExitGood;
  }
  void stop() {
    signal_.post([this] { stop_ = true; });
  }

 private:
  /// A discovery server announces only participants with a common topic: not the lab control.
  [[nodiscard]] bool is_over() const {
    return lab_.is_lost(hlc::kLabControlName) ||
           std::ranges::all_of(readers_, [this](const auto& reader) {
             return lab_.is_lost(hlc::middleware_name(reader.first));
           });
  }

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  hlc::time::Signal signal_;
  std::vector<hlc::TrajectoryCommand> commands_;
  bool stop_{};
  hlc::dds::Participant lab_;
  std::map<std::uint8_t, hlc::dds::Reader<hlc::TrajectoryCommand>> readers_;
};

}  // namespace

int main(int argc, char** argv) {
  hlc::time::StopSignals signals;
  hlc::apps::CommandLine app{"Writes every trajectory command of the lab domain to a file.",
                             "command_recorder"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::run_program(
      "command_recorder", signals, [&] { return std::make_shared<Recorder>(flags); },
      [](Recorder& recorder) { recorder.stop(); });
}
