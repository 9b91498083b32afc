#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/view/page_messages.hpp"
#include "hlc_bridge/view/step_messages.hpp"

namespace hlc::view {

/// A run under way, as messages for the page (page_messages.hpp) in portions, and one more kind:
///
/// * `end`: the run has ended, with `reason` for the operator; the last message.
///
/// States are moved to the closest multiple of 20 ms from t(0) on. A state that follows the one
/// before it, after a step at most, is sent with that one: so the page can connect them.
///
/// Plain data: the caller takes messages from DDS, and portions by its clock.
class LiveMessages {
 public:
  /// @param run  its description, map, kinds of time and revision, and of its facts vehicle_ids and
  /// period: of these vehicles reports and states are taken
  explicit LiveMessages(FinishedRun run);

  void take(const ReportRecord& record);
  void take(const VehicleState& state);
  void take(std::vector<result::LoggedLine> lines);

  /// Messages about what was taken since the last portion, as one JSON array; empty: there is
  /// nothing. The first portion has the message `run`.
  ///
  /// t(0) is the first step in which a car drove. Late joiners get the reports of one controller
  /// after the other: so it is determined when all cars have reported, or kPatience portions after
  /// the first of them.
  [[nodiscard]] std::string portion();
  /// With `end`.
  [[nodiscard]] std::string last_portion(const std::string& reason);

  static constexpr int kPatience = 10;

  /// With the first step, once it is known.
  [[nodiscard]] const result::RunFacts& facts() const { return run_.facts; }

 private:
  struct Vehicle {
    std::vector<result::StepRecord> rows;       ///< not yet sent
    std::vector<result::DrivenSample> samples;  ///< the last one sent, if any, and those after it
    std::optional<std::uint64_t> last_step;     ///< of the reports taken
    bool has_sent_states{};
  };

  [[nodiscard]] bool has_begun();
  [[nodiscard]] Json new_messages();
  void add_drives(std::uint8_t id, Vehicle& vehicle, Json& messages) const;

  FinishedRun run_;  ///< `log`: lines not yet sent
  StepMessages steps_;
  std::map<std::uint8_t, Vehicle> vehicles_;
  bool has_sent_run_{};
  int portions_waited_{};
};

}  // namespace hlc::view
