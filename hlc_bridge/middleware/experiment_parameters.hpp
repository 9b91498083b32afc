#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/messages/run_parameters.hpp"

namespace hlc::middleware {

/// Why a middleware of these vehicles cannot serve such an experiment; empty if it can.
/// @pre parameters.complete()
[[nodiscard]] std::string validate(const RunParameters& parameters,
                                   std::span<const std::uint8_t> vehicle_ids, Nanoseconds offset);

/// Between two experiments: the vehicles of the next one. The operator may change them until the
/// start, so the lab control is asked again every kRequestInterval. All times are wall time.
class NextExperiment {
 public:
  static constexpr Nanoseconds kRequestInterval = kNanosecondsPerSecond;

  /// The experiment is over: nothing is known of the next one.
  void begin() { is_known_ = false; }
  /// An answer of the lab control.
  void take(const Parameter& parameter) { answers_.take(parameter); }
  /// True if the parameters are to be requested again now.
  [[nodiscard]] bool request_is_due(Nanoseconds now);

  struct Outcome {
    std::optional<RunParameters> parameters;  ///< of the next experiment
    std::string problem;  ///< why these cannot be served; empty if it is the problem reported last
  };
  /// Evaluates the answers so far.
  /// @param period  of this process: that of the next experiment must be the same
  Outcome evaluate(std::span<const std::uint8_t> vehicle_ids, Nanoseconds offset,
                   Nanoseconds period);

  /// Parameters that can be served have been received since begin(), and no unservable ones after
  /// them.
  [[nodiscard]] bool is_known() const { return is_known_; }

 private:
  RunParameters answers_;  ///< to the last request
  bool is_known_{};
  Nanoseconds next_request_{};
  std::string last_problem_;
};

}  // namespace hlc::middleware
