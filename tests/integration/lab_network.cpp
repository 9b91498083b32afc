#include "tests/integration/lab_network.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/folders.hpp"

namespace hlc::test {
namespace {

const std::string kPrograms = test::build_folder() + "/bin/";
const std::string kScripts = test::source_folder() + "/launch_scripts/";
const std::string kScenario = kScripts + "scenarios/lab_three_cars.yaml";

bool succeeds(const std::string& command) {
  return std::system((command + " > /dev/null 2>&1").c_str()) == 0;
}

bool in(const std::string& space, const std::string& command) {
  return succeeds("ip -n " + space + " " + command);
}

std::string peers_of(int machine) {
  std::string addresses;
  for (int other = 1; other <= Network::kMachines; ++other) {
    if (other == machine) continue;
    addresses += (addresses.empty() ? "" : ",") + Network::address(other);
  }
  return " --controller_peers=" + addresses;
}

}  // namespace

Network::Network(bool multicast)
    : prefix_("hlc_" + std::to_string(getpid()) + "_"), multicast_(multicast) {
  is_made_ = succeeds("ip netns add " + switch_name()) &&
             in(switch_name(), "link add br0 type bridge mcast_snooping 0") &&
             in(switch_name(), "link set br0 up");
  for (int i = 1; i <= kMachines && is_made_; ++i) is_made_ = add_machine(i);
}

Network::~Network() {
  for (int i = 1; i <= kMachines; ++i) succeeds("ip netns del " + machine(i));
  succeeds("ip netns del " + switch_name());
}

std::string Network::address(int machine) { return "10.77.0." + std::to_string(machine); }

std::vector<std::string> Network::on(int i, const std::string& command) const {
  const std::filesystem::path shared_memory = shared_memories_ / machine(i);
  std::filesystem::create_directories(shared_memory);
  return {"/bin/sh", "-c",
          "exec ip netns exec " + machine(i) + " sh -c 'mount --bind " + shared_memory.string() +
              " /dev/shm && exec " + command + "'"};
}

// Taken off the bridge, the port has its carrier still. A carrier that comes back is noticed by the
// kernel up to a second late (it looks once a second), and until then the machine sends nothing.
void Network::cut_off(int machine) const {
  in(switch_name(), "link set " + port(machine) + " nomaster");
}

bool Network::join(int machine) const {
  return in(switch_name(), "link set " + port(machine) + " master br0") &&
         in(switch_name(), "link set " + port(machine) + " type bridge_slave mcast_flood " +
                               (multicast_ ? "on" : "off"));
}

bool Network::add_machine(int i) const {
  return succeeds("ip netns add " + machine(i)) && in(machine(i), "link set lo up") &&
         succeeds("ip link add eth0 netns " + machine(i) + " type veth peer name " + port(i) +
                  " netns " + switch_name()) &&
         in(switch_name(), "link set " + port(i) + " up") && join(i) &&
         in(machine(i), "addr add " + address(i) + "/24 dev eth0") &&
         in(machine(i), "link set eth0 up") && in(machine(i), "route add 224.0.0.0/4 dev eth0");
}

LabOverNetwork::LabOverNetwork(const Network& network, int steps, const std::string& discovery,
                               bool names_peers)
    : RunProcesses(scenario::read_scenario({.file = kScenario})) {
  const auto run = [&](int machine, const std::string& program, const std::string& flags,
                       const std::filesystem::path& out) {
    std::string command = program + flags + discovery;
    command += " --simulated_time=false --transport=lab --dds_domain=1 --startup_timeout_s=60";
    command += " --out=" + out.string();
    return network.on(machine, command);
  };
  for (int i = 1; i <= Network::kVehicles; ++i) {
    const std::string id = std::to_string(i);
    std::string flags = " --vehicle_ids " + id;
    flags += " --bin " + kPrograms;
    flags += " --scenario " + kScenario;
    if (names_peers) flags += peers_of(i);
    start("machine_" + id, run(i, kScripts + "vehicle.sh", flags, folder()));
    const std::string recorder = "recorder_" + id;
    start(recorder,
          run(i, kPrograms + "command_recorder", " --vehicle_ids=" + id, commands_file(recorder)));
  }
  constexpr int kLast = Network::kMachines;
  std::string flags = " --vehicle_ids=1,2,3 --steps=" + std::to_string(steps);
  if (names_peers) flags += peers_of(kLast);
  start("lab_control", run(kLast, kPrograms + "lab_control", flags, folder()));
}

}  // namespace hlc::test
