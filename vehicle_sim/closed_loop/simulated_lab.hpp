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

/// A process of the lab as it is now. Its clocks outlive it.
struct Seat {
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
  Nanoseconds planned_turn{kNoTurn};
  std::uint32_t generation{};  ///< of that plan
  std::uint64_t num_turns{};   ///< since whoever counts them has set it back
  std::uint64_t num_plans{};
};

/// All processes of a run, their clocks and their network, in one thread and in the order of true
/// time. What happens is a matter of scenario, settings, and calls alone: no thread, no clock, no
/// address decides anything.
///
/// Processes start within half a second. One that has ended by itself stays away. Clocks differ by
/// up to 0.2 ms and run by up to 20 ppm too fast or too slow; from what wakes a process until it
/// acts 20 ... 150 us pass.
class SimulatedLab {
 public:
  /// @param observer  hears of what happens, during `step`; must outlive this object
  SimulatedLab(const Scenario& scenario, const LabSettings& settings, RunObserver& observer);
  SimulatedLab(const SimulatedLab&) = delete;  // processes refer to it
  SimulatedLab& operator=(const SimulatedLab&) = delete;

  /// True time since the begin.
  [[nodiscard]] Nanoseconds now() const;
  /// What an exact clock shows.
  [[nodiscard]] Nanoseconds true_time() const { return now_; }
  /// `step` returns this number at that time.
  void set_alarm(Nanoseconds at, std::uint32_t number);
  /// The next thing that happens; the number of an alarm if it is one. @pre an alarm is set
  std::optional<std::uint32_t> step();

  [[nodiscard]] std::vector<Seat>& seats() { return seats_; }
  /// @pre there is a process of that name
  [[nodiscard]] Seat& seat(const std::string& name) { return seats_[by_name_.at(name)]; }
  [[nodiscard]] SimulatedNetwork& network() { return network_; }
  [[nodiscard]] const std::string& name(NodeId node) const { return network_.name(node); }
  /// Everybody has ended by itself.
  [[nodiscard]] bool is_deserted() const;

  /// It is gone in the midst of whatever it did; without effect on one that has ended by itself.
  void kill(Seat& seat);
  /// One that was killed.
  void restart(Seat& seat);
  /// SIGSTOP and SIGCONT.
  void freeze(Seat& seat);
  void thaw(Seat& seat);
  /// SIGINT.
  void interrupt(Seat& seat);
  /// @param step       [ns], of the real-time clock
  /// @param drift_ppb  that both its clocks gain in addition
  void set_clocks(Seat& seat, std::int64_t step, std::int64_t drift_ppb);

  /// Called when a process has begun or ended (then with its exit code).
  std::function<void(const Seat&)> on_change{[](const Seat&) {}};
  /// Where a vehicle stands that is started again.
  std::function<std::optional<Pose>(std::uint8_t)> pose_of{
      [](std::uint8_t) { return std::nullopt; }};

 private:
  void add_seat(const ProcessKey& key);
  void start(Seat& seat);
  void plan_turn(Seat& seat);
  void turn(Seat& seat);
  void arrive(Event event);
  void look(const Event& event);
  [[nodiscard]] Seat* seat_of(NodeId node);

  LabSettings settings_;
  ProcessFactory factory_;
  RunObserver* observer_;
  EventQueue queue_;
  Nanoseconds now_;
  SimulatedNetwork network_;
  std::vector<Seat> seats_;
  std::map<std::string, std::size_t> by_name_;
  std::vector<std::size_t> by_node_;
};

}  // namespace hlc::closed_loop
