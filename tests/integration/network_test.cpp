// One machine per vehicle: three network namespaces, each with one vehicle's processes and a shared
// memory of its own, and a fourth with the lab control, joined by a bridge.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hlc_bridge/record/report_file.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

constexpr int kMachines = 4;  // the last one is the lab control's
constexpr int kVehicles = 3;
const std::string kBin = HLC_BINARY_DIR "/bin/";
const std::string kScripts = HLC_SOURCE_DIR "/launch_scripts/";

bool succeeds(const std::string& command) {
  return std::system((command + " > /dev/null 2>&1").c_str()) == 0;
}

/// Machines 1 to 4 with addresses 10.77.0.1 to 10.77.0.4 on one switch. All of it is gone with this
/// object.
class Network {
 public:
  explicit Network(bool multicast) {
    is_made_ = succeeds("ip netns add " + switch_name()) &&
               in(switch_name(), "link add br0 type bridge mcast_snooping 0") &&
               in(switch_name(), "link set br0 up");
    for (int i = 1; i <= kMachines && is_made_; ++i) is_made_ = add_machine(i, multicast);
  }
  ~Network() {
    for (int i = 1; i <= kMachines; ++i) succeeds("ip netns del " + machine(i));
    succeeds("ip netns del " + switch_name());
  }
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  [[nodiscard]] bool is_made() const { return is_made_; }
  [[nodiscard]] static std::string address(int i) { return "10.77.0." + std::to_string(i); }

  /// A command line that runs on a machine, with a shared memory of that machine.
  [[nodiscard]] std::vector<std::string> on(int i, const std::string& command) const {
    return {"/bin/sh", "-c",
            "exec ip netns exec " + machine(i) + " sh -c 'mount -t tmpfs tmpfs /dev/shm && exec " +
                command + "'"};
  }
  void cut_off(int i) const { in(switch_name(), "link set p" + std::to_string(i) + " down"); }
  void join(int i) const { in(switch_name(), "link set p" + std::to_string(i) + " up"); }

 private:
  [[nodiscard]] std::string switch_name() const { return prefix_ + "switch"; }
  [[nodiscard]] std::string machine(int i) const { return prefix_ + std::to_string(i); }

  static bool in(const std::string& space, const std::string& command) {
    return succeeds("ip -n " + space + " " + command);
  }
  [[nodiscard]] bool add_machine(int i, bool multicast) const {
    const std::string number = std::to_string(i);
    const std::string port = "p" + number;
    return succeeds("ip netns add " + machine(i)) && in(machine(i), "link set lo up") &&
           succeeds("ip link add eth0 netns " + machine(i) + " type veth peer name " + port +
                    " netns " + switch_name()) &&
           in(switch_name(), "link set " + port + " master br0 up") &&
           in(switch_name(), "link set " + port + " type bridge_slave mcast_flood " +
                                 (multicast ? "on" : "off")) &&
           in(machine(i), "addr add " + address(i) + "/24 dev eth0") &&
           in(machine(i), "link set eth0 up") && in(machine(i), "route add 224.0.0.0/4 dev eth0");
  }

  std::string prefix_{"hlc_" + std::to_string(getpid()) + "_"};
  bool is_made_{};
};

/// A run in real time over the network.
class LabOverNetwork {
 public:
  LabOverNetwork(const Network& network, int steps, const std::string& discovery,
                 bool names_peers) {
    for (int i = 1; i <= kVehicles; ++i) {
      start("vehicle_" + std::to_string(i),
            network.on(i, kScripts + "vehicle.sh --id " + std::to_string(i) +
                              " --scenario paper_three_cars --bin " + kBin + common() + discovery +
                              (names_peers ? peers_of(i) : "")));
    }
    start("lab_control", network.on(kMachines, kBin + "lab_control --vehicle_ids=1,2,3 --steps=" +
                                                   std::to_string(steps) + common() + discovery +
                                                   (names_peers ? peers_of(kMachines) : "")));
  }

  [[nodiscard]] std::vector<ReportRecord> reports() const {
    std::error_code none;
    if (!std::filesystem::exists(folder_ / "reports.csv", none)) return {};
    return read_reports(folder_ / "reports.csv");
  }
  [[nodiscard]] std::string output(const std::string& name) const {
    return name + ": " + read_text(folder_ / name);
  }
  void expect_good_end() {
    for (auto& [name, process] : processes_) {
      EXPECT_EQ(process->wait_for(180s), 0) << output(name);
    }
  }
  /// Of the footprints that were driven, by the vehicles' own record [m].
  [[nodiscard]] double smallest_distance_m() {
    ChildProcess summarize({kBin + "summarize", "--run", folder_.path().string(), "--scenario",
                            kScripts + "scenarios/paper_three_cars.yaml"},
                           folder_ / "summary_output");
    EXPECT_EQ(summarize.wait_for(120s), 0) << output("summary_output");
    const auto summary = nlohmann::json::parse(read_text(folder_ / "summary.json"), nullptr, false);
    return summary.is_object() ? summary.value("min_footprint_distance_m", -1.0) : -1.0;
  }

 private:
  [[nodiscard]] std::string common() const {
    return " --simulated_time=false --transport=lab --dds_domain=1 --startup_timeout_s=60 --out=" +
           folder_.path().string();
  }
  static std::string peers_of(int i) {
    std::string addresses;
    for (int other = 1; other <= kMachines; ++other) {
      if (other == i) continue;
      addresses += (addresses.empty() ? "" : ",") + Network::address(other);
    }
    return " --controller_peers=" + addresses;
  }
  void start(const std::string& name, const std::vector<std::string>& command) {
    processes_[name] = std::make_unique<ChildProcess>(command, folder_ / name);
  }

  TemporaryFolder folder_;
  std::map<std::string, std::unique_ptr<ChildProcess>> processes_;
};

bool is_among(VehicleId vehicle, const std::vector<VehicleId>& vehicles) {
  return std::ranges::find(vehicles, vehicle) != vehicles.end();
}

std::size_t planned_steps_of(const std::vector<ReportRecord>& records, VehicleId vehicle) {
  return static_cast<std::size_t>(std::ranges::count_if(records, [&](const ReportRecord& record) {
    return record.report.vehicle == vehicle && record.report.status == StepStatus::kPlanned;
  }));
}

class OverNetwork : public testing::Test {};

TEST_F(OverNetwork, AMachineThatIsCutOffForASecondIsTakenBack) {
  const Network network(true);
  if (!network.is_made()) GTEST_SKIP() << "network namespaces need root and iproute2";
  LabOverNetwork lab(network, 100, "", false);
  ASSERT_TRUE(eventually(120s, [&] { return planned_steps_of(lab.reports(), {2}) >= 15; }))
      << lab.output("lab_control") << lab.output("vehicle_2");
  network.cut_off(2);
  ::usleep(1'000'000);  // the fault lasts as long
  network.join(2);
  lab.expect_good_end();

  // Everybody noticed, and everybody hears everybody again. (In the last step some have left.)
  constexpr std::uint64_t kStepsOfTheFault = 5;
  std::map<std::uint8_t, StepIndex> missed_first;
  std::map<std::uint8_t, StepIndex> complete_last;
  for (const ReportRecord& record : lab.reports()) {
    const Report& report = record.report;
    if (report.status == StepStatus::kStandby) continue;
    const bool misses = report.vehicle.value == 2
                            ? is_among({1}, report.missing) && is_among({3}, report.missing)
                            : is_among({2}, report.missing);
    if (misses) missed_first.try_emplace(report.vehicle.value, report.step);
    if (report.missing.empty() && report.status == StepStatus::kPlanned) {
      complete_last[report.vehicle.value] = report.step;
    }
  }
  for (std::uint8_t id = 1; id <= kVehicles; ++id) {
    SCOPED_TRACE("vehicle " + std::to_string(id));
    ASSERT_TRUE(missed_first.contains(id));
    ASSERT_TRUE(complete_last.contains(id));
    EXPECT_GT(complete_last[id].value, missed_first[id].value + kStepsOfTheFault);
  }
  EXPECT_GT(lab.smallest_distance_m(), 0.0);
}

TEST_F(OverNetwork, MachinesFindEachOtherWithoutMulticast) {
  const Network network(false);
  if (!network.is_made()) GTEST_SKIP() << "network namespaces need root and iproute2";
  const TemporaryFolder folder;
  const std::string address = " --discovery_server_ip=" + Network::address(kMachines);
  ChildProcess server(network.on(kMachines, kBin + "discovery_server --dds_domain=1" + address),
                      folder / "server");
  LabOverNetwork lab(network, 20, " --discovery_mode=client" + address, true);
  lab.expect_good_end();
  for (std::uint8_t id = 1; id <= kVehicles; ++id) {
    EXPECT_GE(planned_steps_of(lab.reports(), {id}), 1U) << "vehicle " << int{id};
  }
  EXPECT_GT(lab.smallest_distance_m(), 0.0);
  server.send(SIGTERM);
  EXPECT_EQ(server.wait_for(60s), 0) << read_text(folder / "server");
}

}  // namespace
}  // namespace hlc::test
