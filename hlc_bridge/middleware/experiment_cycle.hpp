#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/machine/wait_notice.hpp"
#include "hlc_bridge/middleware/experiment_parameters.hpp"
#include "hlc_bridge/middleware/middleware_messages.hpp"

namespace hlc::middleware {

/// From the controllers' readiness to the stop symbol, and from there to the next experiment.
///
///     controllers get ready ──trigger──► triggered ──stop symbol──► stopped
///               ▲                                         │ keep_running
///               └──trigger── between experiments ◄────────┘
///
/// Between experiments commands are withheld, the controllers must report ready again, and the
/// parameters of the next experiment are requested from the lab control (NextExperiment): a ready
/// status allows the lab control to start the experiment, so lists must hold its vehicles by then.
class ExperimentCycle {
 public:
  /// @param vehicle_ids   of the controllers
  /// @param offset        of the lists in a period
  /// @param keep_running  the stop symbol ends the experiment, not the process
  ExperimentCycle(std::vector<std::uint8_t> vehicle_ids, Nanoseconds offset, bool keep_running);

  /// A controller is ready (node_names.hpp, controller_ready_id); other messages are ignored.
  void take(const ReadyStatus& status);
  void take(const SystemTrigger& trigger);
  /// Counts between experiments.
  void take(const Parameter& parameter);
  /// A goal for the controllers, withheld until all of them are ready; of more than kMostGoals, in
  /// all experiments, the last are dropped: their writer keeps each for late joiners.
  void take(GoalState goal);

  /// The first experiment. @return why it cannot be served; empty if it can
  /// @pre parameters.complete()
  [[nodiscard]] std::string begin(const RunParameters& parameters);
  /// Begin has succeeded.
  [[nodiscard]] bool has_begun() const { return parameters_.complete(); }
  /// Of the current experiment, or the last one. @pre has_begun()
  [[nodiscard]] const RunParameters& parameters() const { return parameters_; }

  /// To be called once a period; between experiments it requests the next one's parameters and
  /// adopts them. All times are wall time.
  void prepare_next(Nanoseconds now, MiddlewareActions& actions);
  /// Forwards the goals withheld if all controllers are ready.
  void forward_goals(MiddlewareActions& actions);
  /// Before the first trigger: announces that the controllers are ready, or logs from time to time
  /// which are not.
  void announce_readiness(Nanoseconds now, MiddlewareActions& actions);

  /// A trigger was received in this experiment.
  [[nodiscard]] bool is_triggered() const { return is_triggered_; }
  /// A list of this time belongs to the experiment: its first trigger's time has passed.
  [[nodiscard]] bool is_running_at(Nanoseconds t_now) const {
    return is_triggered_ && t_now >= starts_at_;
  }
  /// The stop symbol was received, and the process ends.
  [[nodiscard]] bool is_stopped() const { return is_stopped_; }
  /// Commands are not forwarded to vehicles.
  [[nodiscard]] bool withholds_commands() const { return is_between_ || is_stopped_; }

  /// A vehicle has one.
  static constexpr std::size_t kMostGoals = 256;

 private:
  [[nodiscard]] std::vector<std::string> unready_controllers() const;

  std::vector<std::uint8_t> vehicle_ids_;
  Nanoseconds offset_;
  bool keep_running_;
  RunParameters parameters_;
  NextExperiment next_;
  std::set<std::uint8_t> ready_;
  std::vector<GoalState> goals_;
  std::size_t num_goals_{};
  std::optional<machine::WaitNotice> notice_;
  bool is_triggered_{};
  Nanoseconds starts_at_{};  ///< of the first trigger
  bool is_between_{};        ///< the stop symbol was received, and no trigger since
  bool is_stopped_{};
};

}  // namespace hlc::middleware
