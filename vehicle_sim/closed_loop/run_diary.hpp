#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vehicle_sim/closed_loop/simulated_lab.hpp"

namespace hlc::closed_loop {

/// What the processes of a run log, report, drive and end with. Times `at` are true times since the
/// begin of the run.
struct RunDiary {
  struct Line {
    Nanoseconds at{};
    std::string process;
    machine::LogLine line;
  };
  struct Tick {
    Nanoseconds at{};
    Nanoseconds time{};  ///< true time in real time, of the run in logical time
    double speed_mps{};
  };
  struct Step {
    Nanoseconds at{};
    coordination::Report report;
  };
  struct Life {
    Nanoseconds begin{};               ///< of the first start
    std::optional<Nanoseconds> end{};  ///< by itself, the last one
    std::optional<int> exit_code{};
  };

  std::vector<Line> lines;
  std::vector<Line> progress;  ///< of the lab control
  std::vector<Step> steps;
  std::map<std::uint8_t, std::vector<Tick>> drives;
  std::map<std::string, Life> lives;          ///< by process
  std::optional<Nanoseconds> begin_of_drive;  ///< first step with a new plan
  std::optional<Nanoseconds> stop;            ///< a vehicle receives the stop symbol
};

/// Writes the diary, and passes every event on to the run's observer.
class DiaryWriter final : public RunObserver {
 public:
  /// @param diary  may be nullptr: nothing is written
  DiaryWriter(RunObserver& next, RunDiary* diary) : next_(&next), diary_(diary) {}
  /// The lab that it observes; before the first event.
  void attach(const SimulatedLab& lab) { lab_ = &lab; }

  void on_log(NodeId node, const machine::LogLine& line) override;
  void on_driven(std::uint8_t vehicle, Nanoseconds time,
                 const result::DrivenSample& sample) override;
  void on_traffic(const coordination::Traffic& traffic, bool is_seen) override {
    next_->on_traffic(traffic, is_seen);
  }
  void on_prediction(const coordination::Prediction& prediction) override {
    next_->on_prediction(prediction);
  }
  void on_report(const ReportRecord& record, const coordination::Plan* in_force) override;
  void on_command(const TrajectoryCommand& command) override { next_->on_command(command); }
  void on_received(const TrajectoryCommand& command) override { next_->on_received(command); }
  void on_stop_symbol(std::uint8_t vehicle) override;
  void on_progress(const std::string& text) override;
  /// A process has begun or ended.
  void changed(const ProcessSlot& slot);

 private:
  RunObserver* next_;
  RunDiary* diary_;
  const SimulatedLab* lab_{};
};

}  // namespace hlc::closed_loop
