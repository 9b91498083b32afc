#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/machine/log_line.hpp"
#include "hlc_bridge/machine/wait_notice.hpp"
#include "hlc_bridge/messages/run_parameters.hpp"

namespace hlc::machine {

/// The phase of a process before its first tick: it gets the run's parameters from the lab control,
/// and (if the rules require it) waits until all participants are present. Both together take at
/// most `timeout`, from the first call of learn on; then the process ends with kExitMissing. All
/// times are wall time.
///
///     if (!start_up_.learn(now.wall, actions)) return;
///     if (!start_up_.connect(now.wall, who_is_missing(), actions)) return;
class StartUp {
 public:
  explicit StartUp(Nanoseconds timeout) : timeout_(timeout) {}

  /// An answer of the lab control.
  void take(const Parameter& parameter) { parameters_.take(parameter); }
  [[nodiscard]] const RunParameters& parameters() const { return parameters_; }

  /// Requests missing parameters every kRequestInterval. True once all are known.
  /// @param actions  gets ParameterRequest and LogLine
  template <class Action>
  [[nodiscard]] bool learn(Nanoseconds now, std::vector<Action>& actions) {
    for (const std::string& name : requests_at(now)) actions.emplace_back(ParameterRequest{name});
    return move_line(actions) && parameters_.complete();
  }

  /// True once all participants are present.
  /// @param missing  absent participants: "a, b"; empty: none
  template <class Action>
  [[nodiscard]] bool connect(Nanoseconds now, const std::string& missing,
                             std::vector<Action>& actions) {
    wait_for(now, missing);
    return move_line(actions) && missing.empty();
  }

  /// kExitMissing after the timeout.
  [[nodiscard]] std::optional<int> exit_code() const { return exit_code_; }
  /// When to call these two again without an event; empty once the start-up is done.
  [[nodiscard]] std::optional<Nanoseconds> wake_up() const { return wake_up_; }

  static constexpr Nanoseconds kRequestInterval = 100 * kNanosecondsPerMillisecond;

 private:
  [[nodiscard]] std::vector<std::string> requests_at(Nanoseconds now);
  void wait_for(Nanoseconds now, const std::string& missing);
  [[nodiscard]] bool is_too_late(Nanoseconds now) const { return now >= *since_ + timeout_; }
  void fail(std::string text);

  /// False if the start-up has failed.
  template <class Action>
  bool move_line(std::vector<Action>& actions) {
    if (line_) actions.emplace_back(std::move(*line_));
    line_.reset();
    return !exit_code_;
  }

  Nanoseconds timeout_;
  RunParameters parameters_;
  std::optional<Nanoseconds> since_;
  Nanoseconds next_request_{};
  WaitNotice notice_{0};
  std::optional<Nanoseconds> wake_up_;
  std::optional<LogLine> line_;
  std::optional<int> exit_code_;
};

}  // namespace hlc::machine
