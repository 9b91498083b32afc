#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/integration/recorded_commands.hpp"
#include "vehicle_sim/closed_loop/run_monitor.hpp"

namespace hlc::closed_loop {

/// Of the shipped ones, read once.
[[nodiscard]] const scenario::Scenario& scenario_of(const std::string& name);

/// All processes of a run in memory, with a record of what they log, report and drive. The test
/// decides what happens to them and when.
class ObservedRun final : private RunObserver {
 public:
  ObservedRun(const scenario::Scenario& scenario, const LabSettings& settings);

  /// Goes on until the condition holds. False if that takes longer.
  [[nodiscard]] bool comes_to(const std::function<bool()>& condition, Nanoseconds patience);
  void pass(Nanoseconds time) {
    static_cast<void>(comes_to([] { return false; }, time));
  }

  void kill(const std::string& process);
  void restart(const std::string& process) { lab_.restart(lab_.slot(process)); }
  void freeze(const std::string& process) { lab_.freeze(lab_.slot(process)); }
  void resume(const std::string& process) { lab_.resume(lab_.slot(process)); }
  /// It hangs while its participants stay: from now on nobody receives anything of it.
  void silence(const std::string& process) {
    lab_.network().add(Disturbance{.from = process, .withheld = 1.0});
  }
  void interrupt(const std::string& process) { lab_.interrupt(lab_.slot(process)); }

  /// What an exact clock shows: vehicles and controllers count by it in real time.
  [[nodiscard]] Nanoseconds now() const { return lab_.true_time(); }
  /// Whole commands of a step, with their copies, have been sent and received, and no others. A
  /// death between the two leaves a car without the rest of its plan.
  [[nodiscard]] bool is_between_commands() const {
    constexpr Nanoseconds kStep = kNanosecondsPerSecond / 5;
    return now() % kStep > kStep / 2;
  }
  /// The newest tick of the vehicles.
  [[nodiscard]] Nanoseconds tick() const { return tick_; }

  [[nodiscard]] const scenario::Scenario& scenario() const { return *scenario_; }
  /// By the vehicles' own clocks.
  [[nodiscard]] const result::Drives& drives() const { return drives_; }
  /// That vehicles have received.
  [[nodiscard]] const test::Commands& commands() const { return commands_; }
  [[nodiscard]] const std::vector<ReportRecord>& reports() const { return reports_; }
  /// Exit codes of the processes that have ended by themselves, last.
  [[nodiscard]] const std::map<std::string, int>& exit_codes() const { return exit_codes_; }
  /// All processes have ended by themselves, except perhaps for that one.
  [[nodiscard]] bool have_all_ended(const std::string& except = "") {
    return std::ranges::all_of(lab_.slots(), [&](const ProcessSlot& slot) {
      return slot.name == except || exit_codes_.contains(slot.name);
    });
  }
  struct Line {
    Nanoseconds tick{};  ///< newest one then
    machine::LogLine line;
  };
  [[nodiscard]] const std::vector<Line>& log(const std::string& process) { return log_[process]; }
  /// "" if there is none.
  [[nodiscard]] std::string last_line(const std::string& process) {
    return log(process).empty() ? "" : log(process).back().line.text;
  }
  [[nodiscard]] bool has_logged(const std::string& process, const std::string& text) const;
  /// Newest tick when the stop symbol reached the first vehicle.
  [[nodiscard]] std::optional<Nanoseconds> stopped_at() const { return stopped_at_; }

  /// Of the invariants that hold in every run (RunMonitor), each in a line; "" if there are none.
  [[nodiscard]] std::string violations();

  /// Called with every sample that is driven.
  std::function<void(std::uint8_t vehicle, Nanoseconds tick)> on_tick{[](auto...) {}};
  /// @param receiver  of every message that a process publishes, with the process's name
  void record(std::function<void(const std::string& process, const Message& message)> receiver) {
    lab_.network().on_published = [this, receiver = std::move(receiver)](
                                      NodeId node, const SharedMessage& message) {
      receiver(lab_.name(node), *message);
    };
  }

 private:
  void on_log(NodeId node, const machine::LogLine& line) override;
  void on_driven(std::uint8_t vehicle, Nanoseconds time,
                 const result::DrivenSample& sample) override;
  void on_traffic(const coordination::Traffic& traffic, bool is_seen) override {
    monitor_.on_traffic(traffic, is_seen);
  }
  void on_prediction(const coordination::Prediction& prediction) override {
    monitor_.on_prediction(prediction);
  }
  void on_report(const ReportRecord& record, const coordination::Plan* in_force) override;
  void on_command(const TrajectoryCommand& command) override { monitor_.on_command(command); }
  void on_received(const TrajectoryCommand& command) override;
  void on_stop_symbol(std::uint8_t vehicle) override;

  const scenario::Scenario* scenario_;
  Trace no_trace_;
  RunMonitor monitor_;
  SimulatedLab lab_;
  result::Drives drives_;
  test::Commands commands_;
  std::vector<ReportRecord> reports_;
  std::map<std::string, int> exit_codes_;
  std::map<std::string, std::vector<Line>> log_;
  Nanoseconds tick_{};
  std::optional<Nanoseconds> stopped_at_;
};

}  // namespace hlc::closed_loop
