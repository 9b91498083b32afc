#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "planner/controller/controller.hpp"
#include "planner/policy/policy.hpp"
#include "planner/policy/policy_settings.hpp"
#include "planner/policy/prepared_choice.hpp"

namespace hlc {

/// Says before every step which subgraph a vehicle's controller plans on, and switches it. In this
/// order:
///
/// 1. *Safety*: in and before a speed zone its limit holds, whoever asks for what; of several zones
///    the lowest one.
/// 2. The *operator*: what he asked for, until he asks for the scenario's own again (the empty
///    request), which gives the vehicle back to
/// 3. its *policies*, of which the first with an opinion counts. What one has asked for stays at
///    least ReconfigurationSettings::min_stay_s, unless one before it has an opinion. Without an
///    opinion: the scenario's own subgraph.
///
/// **How early a limit holds.** A zone is looked for on the path as far ahead as the vehicle gets,
/// at the highest speed of all that may be asked for, in n + 3 steps, n being the most steps that
/// it takes to slow down. Found before step k, it was farther than that before step k - 1; what is
/// planned in step k holds from t(k + 1) on. So n steps are left when it does, and one more for
/// places that a vehicle beside its path comes to earlier. Two kinds of steps are left out: in a
/// fallback the vehicle drives the plan that was agreed, at its speed, and where nothing can be
/// planned under the limit the former subgraph is planned on (Controller::switch_to).
///
/// Everything that may be asked for is prepared at the start, under every limit, so that a switch
/// costs hardly more than a planner. No clock, no thread.
class SubgraphSelector {
 public:
  /// @param controller  on the scenario's own subgraph
  /// @pre check_reconfiguration throws nothing
  SubgraphSelector(const Controller& controller, const ReconfigurationSettings& settings);

  /// The scenario's own subgraph and the limits: what a request of the operator has to be prepared
  /// on and for.
  [[nodiscard]] const PreparedSubgraph& base() const { return base_; }
  [[nodiscard]] const std::vector<double>& limits_mps() const { return limits_mps_; }
  /// How far ahead a zone is looked for; never less than it was.
  [[nodiscard]] double zone_ahead_m() const { return zone_ahead_m_; }

  /// From the next step on. @param request  made on `base` for `limits_mps`; none: the policies
  void ask(std::shared_ptr<const PreparedChoice> request);

  /// To be called before every step of the controller, also before the experiment has begun.
  /// @param start  its first step, from which time counts; none: it has not begun, and policies are
  /// not asked yet
  /// @return true if the controller was switched
  bool begin_step(Controller& controller, StepIndex step, std::optional<StepIndex> start,
                  std::optional<double> battery_v);

  /// True if policies look ahead after the next step.
  [[nodiscard]] bool looks_ahead() const;
  /// To be called after a step, when nobody waits for the vehicle any more.
  /// @param may_look_ahead  false: there is no time for policies to look ahead
  void end_step(const Controller& controller, const Report& report, bool may_look_ahead = true);

 private:
  static constexpr std::size_t kNoPolicyCounts = static_cast<std::size_t>(-1);

  [[nodiscard]] const PreparedChoice& prepared(const SubgraphRequest& request) const;
  [[nodiscard]] std::optional<double> limit_for(const Controller& controller, StepIndex step) const;
  void see_zones_for(const PreparedChoice& choice);
  void let_policies_choose(StepIndex step, StepIndex start, std::optional<double> battery_v);

  PreparedSubgraph base_;
  std::vector<SpeedZone> zones_;
  std::vector<double> limits_mps_;
  double zone_ahead_m_{};
  double step_s_{};
  double min_stay_s_{};
  std::vector<std::unique_ptr<Policy>> policies_;
  std::vector<std::pair<SubgraphRequest, PreparedChoice>> choices_;

  std::shared_ptr<const PreparedChoice> operator_;
  std::optional<Report> last_;
  SubgraphRequest proposed_;                  ///< by the policies
  std::size_t proposed_by_{kNoPolicyCounts};  ///< the policy that did, by its place
  std::optional<StepIndex> proposed_since_;   ///< none: they have not changed it yet
  std::size_t counts_{kNoPolicyCounts};       ///< the first with an opinion in the last step
};

}  // namespace hlc
