#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "planner/controller/controller.hpp"
#include "planner/policy/look_ahead.hpp"
#include "planner/policy/policy.hpp"
#include "planner/policy/policy_settings.hpp"
#include "planner/policy/prepared_choice.hpp"

namespace hlc {

/// Says before every step which subgraph a vehicle's controller plans on, and switches it. In this
/// order:
///
/// 1. *Safety*: in and before a speed zone its limit holds, whoever asks for what. It is looked for
///    as far ahead as the fastest trim of the automaton gets in kStepsBeforeZone steps, so that a
///    car has slowed down when it comes there; of several zones the lowest limit counts.
/// 2. The *operator*: what he asked for, until he asks for the scenario's own again (the empty
///    request), which gives the vehicle back to
/// 3. its *policies*, of which the first with an opinion counts. What they have asked for stays at
///    least ReconfigurationSettings::min_stay_s. Without an opinion: the scenario's own subgraph.
///
/// Everything that may be asked for is prepared at the start, under every limit, so that a switch
/// costs hardly more than a planner. No clock, no thread.
class SubgraphChoice {
 public:
  static constexpr std::size_t kStepsBeforeZone = 3;

  /// @param controller  on the scenario's own subgraph
  /// @pre check_reconfiguration throws nothing
  SubgraphChoice(const Controller& controller, const ReconfigurationSettings& settings);

  /// The scenario's own subgraph and the limits: what a request of the operator has to be prepared
  /// on and for.
  [[nodiscard]] const PreparedSubgraph& base() const { return base_; }
  [[nodiscard]] const std::vector<double>& limits_mps() const { return limits_mps_; }

  /// From the next step on. @param request  made on `base` for `limits_mps`; none: the policies
  void ask(std::shared_ptr<const PreparedChoice> request) { operator_ = std::move(request); }

  /// To be called before every step of the controller, also before the experiment has begun.
  /// @param is_running  it has: time counts, and policies remember
  /// @return true if the controller was switched
  bool begin_step(Controller& controller, StepIndex step, bool is_running,
                  std::optional<double> battery_v);

  /// To be called after a step, when nobody waits for the vehicle any more: policies look ahead.
  void end_step(const Controller& controller, const Report& report, const HeardInStep& heard);

  /// True if `end_step` needs what was heard.
  [[nodiscard]] bool looks_ahead() const { return !look_aheads_.empty() && !operator_; }

 private:
  [[nodiscard]] const PreparedChoice& prepared(const SubgraphRequest& request) const;
  [[nodiscard]] std::optional<double> limit_for(const Controller& controller) const;
  void let_policies_choose(StepIndex step, std::optional<double> battery_v);

  PreparedSubgraph base_;
  std::vector<SpeedZone> zones_;
  std::vector<double> limits_mps_;
  double ahead_m_{};  ///< how far ahead a zone's limit holds
  double step_s_{};
  double min_stay_s_{};
  std::vector<std::unique_ptr<Policy>> policies_;
  std::vector<LookAhead*> look_aheads_;  ///< of `policies_`
  std::vector<std::pair<SubgraphRequest, PreparedChoice>> choices_;

  std::shared_ptr<const PreparedChoice> operator_;
  std::optional<StepIndex> first_step_;
  std::optional<Report> last_;
  SubgraphRequest wished_;                 ///< by the policies
  std::optional<StepIndex> wished_since_;  ///< none: they have not changed it yet
};

}  // namespace hlc
