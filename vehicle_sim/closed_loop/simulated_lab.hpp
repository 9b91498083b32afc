#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vehicle_sim/closed_loop/event_queue.hpp"
#include "vehicle_sim/closed_loop/process_factory.hpp"
#include "vehicle_sim/closed_loop/simulated_clock.hpp"
#include "vehicle_sim/closed_loop/simulated_network.hpp"
#include "vehicle_sim/closed_loop/simulated_process.hpp"

namespace hlc::closed_loop {

/// The current state of a process of the lab. Its clocks outlive it.
struct ProcessSlot {
  ProcessKey key;
  std::string name;
  SimulatedClock run_clock{0, 0, 0};
  SimulatedClock wall_clock{0, 0, 0};
  std::unique_ptr<SimulatedProcess> process;  ///< none: not started, killed, or ended
  NodeId node{};
  bool is_frozen{};
  bool is_killed{};                                          ///< and not started again yet
  std::optional<int> exit_code;                              ///< it has ended by itself
  std::deque<std::pair<std::size_t, SharedMessage>> unread;  ///< while frozen
  Nanoseconds planned_iteration{kNever};
  std::uint32_t generation{};      ///< of that plan
  std::uint64_t num_iterations{};  ///< since the counter was reset
  std::uint64_t num_plans{};
};

/// All processes of a run, their clocks and their network, in one thread and in the order of true
/// time. The course depends only on scenario, settings, and calls: not on threads, clocks or
/// addresses.
///
/// Processes start within half a second. A process that has ended by itself is not restarted.
/// Clocks differ by up to 0.2 ms and drift by up to 20 ppm; a process acts 20 ... 150 us after its
/// wake-up.
class SimulatedLab {
 public:
  /// @param observer  is notified of events, during `step`; must outlive this object
  SimulatedLab(const scenario::Scenario& scenario, const LabSettings& settings,
               RunObserver& observer);
  SimulatedLab(const SimulatedLab&) = delete;  // processes refer to it
  SimulatedLab& operator=(const SimulatedLab&) = delete;

  /// True time since the begin.
  [[nodiscard]] Nanoseconds now() const;
  /// What an exact clock shows.
  [[nodiscard]] bool is_logical() const { return settings_.is_logical; }
  [[nodiscard]] Nanoseconds true_time() const { return now_; }
  /// `step` returns this number at that time.
  void set_alarm(Nanoseconds at, std::uint32_t number);
  /// Executes the next event; the number of an alarm if it is one. @pre an alarm is set
  std::optional<std::uint32_t> step();

  [[nodiscard]] std::vector<ProcessSlot>& slots() { return slots_; }
  /// @pre there is a process of that name
  [[nodiscard]] ProcessSlot& slot(const std::string& name) { return slots_[by_name_.at(name)]; }
  [[nodiscard]] SimulatedNetwork& network() { return network_; }
  [[nodiscard]] const std::string& name(NodeId node) const { return network_.name(node); }
  /// All processes have ended by themselves.
  [[nodiscard]] bool has_ended() const;

  /// Kills the process at any point; without effect on one that has ended by itself.
  void kill(ProcessSlot& slot);
  /// One that was killed.
  void restart(ProcessSlot& slot);
  /// SIGSTOP and SIGCONT.
  void freeze(ProcessSlot& slot);
  void resume(ProcessSlot& slot);
  /// SIGINT.
  void interrupt(ProcessSlot& slot);
  /// @param step       [ns], of the real-time clock
  /// @param drift_ppb  that both its clocks gain in addition
  void set_clocks(ProcessSlot& slot, std::int64_t step, std::int64_t drift_ppb);

  /// Called when a process has begun or ended (then with its exit code).
  std::function<void(const ProcessSlot&)> on_change{[](const ProcessSlot&) {}};
  /// Pose of a restarted vehicle.
  std::function<std::optional<Pose>(std::uint8_t)> pose_of{
      [](std::uint8_t) { return std::nullopt; }};

 private:
  void add_slot(const ProcessKey& key);
  void start(ProcessSlot& slot);
  void plan_iteration(ProcessSlot& slot);
  void iterate(ProcessSlot& slot);
  void arrive(Event event);
  void discover(const Event& event);
  [[nodiscard]] ProcessSlot* slot_of(NodeId node);

  LabSettings settings_;
  ProcessFactory factory_;
  RunObserver* observer_;
  EventQueue queue_;
  Nanoseconds now_;
  SimulatedNetwork network_;
  std::vector<ProcessSlot> slots_;
  std::map<std::string, std::size_t> by_name_;
  std::vector<std::size_t> by_node_;
};

}  // namespace hlc::closed_loop
