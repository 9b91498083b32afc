#include "hlc_bridge/hlc/hlc_rules.hpp"

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::high_level_controller {
namespace {

// Leases are 2 s in real time and 10 s in logical time (RunTime).
constexpr Nanoseconds kDuplicatePatience = 4 * kNanosecondsPerSecond;
constexpr Nanoseconds kDuplicatePatienceInLogicalTime = 12 * kNanosecondsPerSecond;
/// Shorter than a middleware of ours waits for the answer to a list.
constexpr Nanoseconds kControllerPatienceInLogicalTime = kMessageTimeout / 2;
/// The others wait 10 s for a controller (kMessageTimeout). A preparation that takes longer is in
/// force later.
constexpr Nanoseconds kPreparationPatience = 8 * kNanosecondsPerSecond;

}  // namespace

HlcRules rules_in_logical_time(bool is_in_the_lab) {
  return {.start = StartRule::kTogether,
          .deadlines = std::nullopt,
          .answers_every_list = true,
          .logs_missing_lists = false,
          .stops_on_lab_domain = false,
          .copy = is_in_the_lab ? CommandCopy::kNever : CommandCopy::kAtOnce,
          .duplicate_patience = kDuplicatePatienceInLogicalTime,
          .middleware_patience = 0,
          .waits_for_start = is_in_the_lab,
          .controller_patience = kControllerPatienceInLogicalTime,
          .preparation_patience = kPreparationPatience};
}

HlcRules rules_in_real_time(bool is_in_the_lab, const StepDeadlines& deadlines,
                            Nanoseconds startup_timeout) {
  return {.start = StartRule::kAtTrigger,
          .deadlines = deadlines,
          .answers_every_list = false,
          .logs_missing_lists = true,
          .stops_on_lab_domain = true,
          .copy = is_in_the_lab ? CommandCopy::kAfterPause : CommandCopy::kAtOnce,
          .duplicate_patience = kDuplicatePatience,
          .middleware_patience = startup_timeout,
          .asks_lab_control = is_in_the_lab,
          .waits_for_start = is_in_the_lab,
          .controller_patience = startup_timeout,
          .preparation_patience = 0};
}

}  // namespace hlc::high_level_controller
