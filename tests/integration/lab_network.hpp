#pragma once

#include <string>
#include <vector>

#include "tests/integration/run_processes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {

/// Machines 1 to 4 with addresses 10.77.0.1 to 10.77.0.4 on one switch: network namespaces joined
/// by a bridge. Needs root. All of it is gone with this object.
class Network {
 public:
  static constexpr int kVehicles = 3;  ///< machine i is vehicle i's
  static constexpr int kMachines = 4;  ///< the last one is the lab control's

  explicit Network(bool multicast);
  ~Network();
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  /// False without root or iproute2.
  [[nodiscard]] bool is_made() const { return is_made_; }
  [[nodiscard]] static std::string address(int machine);

  /// A command line that runs on a machine, with the shared memory of that machine.
  [[nodiscard]] std::vector<std::string> on(int machine, const std::string& command) const;
  void cut_off(int machine) const;  ///< from its return on
  bool join(int machine) const;     ///< false if that cannot be

 private:
  [[nodiscard]] std::string switch_name() const { return prefix_ + "switch"; }
  [[nodiscard]] std::string machine(int i) const { return prefix_ + std::to_string(i); }
  [[nodiscard]] static std::string port(int machine) { return "p" + std::to_string(machine); }
  [[nodiscard]] bool add_machine(int i) const;

  std::string prefix_;
  bool multicast_;
  TemporaryFolder shared_memories_;
  bool is_made_{};
};

/// The lab's three cars over the network in real time, `vehicle.sh` on machines 1 to 3 and the lab
/// control on the fourth. Processes: machine_1, ..., lab_control; beside each vehicle a recorder of
/// the commands that reach it.
class LabOverNetwork : public RunProcesses {
 public:
  /// @param discovery    further flags of all processes
  /// @param names_peers  whether controllers get the others' addresses
  LabOverNetwork(const Network& network, int steps, const std::string& discovery = "",
                 bool names_peers = false);
};

}  // namespace hlc::test
