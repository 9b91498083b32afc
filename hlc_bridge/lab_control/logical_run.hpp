#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/lab_control/lab_run.hpp"
#include "hlc_bridge/lab_control/tick_master.hpp"

namespace hlc::lab_control {

/// A run in logical time: time stands still until the lab control releases the next tick.
///
/// Timers are those of the vehicles and of the middlewares. The next tick T is released when
///   * every living timer has answered all ticks before (TickMaster), and
///   * every living controller has reported the step of the last list before T.
/// Then everything that happens before T has happened, in any order of messages: the results of a
/// run depend only on its inputs. A controller without a middleware gets no lists, so no reports
/// are pending.
///
/// A timer that repeats its request for the tick that is released already may have missed the
/// trigger: it is sent again. (Timers ignore triggers for other ticks.)
class LogicalRun : public LabRun {
 public:
  explicit LogicalRun(LabRunSettings settings);

  void ready(const ReadyStatus& status) override;
  [[nodiscard]] bool releases_time() const override { return true; }

 protected:
  [[nodiscard]] std::vector<std::string> not_ready() const override;
  void go_on(LabRunActions& actions) override;
  [[nodiscard]] Nanoseconds clock() const override;
  [[nodiscard]] std::vector<std::string> pending_replies() const override;
  [[nodiscard]] std::size_t num_messages(const std::vector<std::string>& processes) const override;
  void drop(const std::string& process) override;

 private:
  /// Controllers that have not yet reported the step of the last list before `tick`.
  [[nodiscard]] std::vector<std::string> unreported_before(Nanoseconds tick) const;
  [[nodiscard]] std::optional<Nanoseconds> next_tick() const;

  TickMaster ticks_;
  std::map<std::string, std::string> shared_by_;  ///< source_id of the timers of several vehicles
  std::set<std::string> controllers_;             ///< living, with living middleware
  bool send_again_{};
};

}  // namespace hlc::lab_control
