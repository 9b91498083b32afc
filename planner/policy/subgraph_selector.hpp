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

namespace hlc::policy {

/// Decides before every step which subgraph a vehicle's controller plans on, and switches it. In
/// this order:
///
/// 1. *Safety*: in and before a speed zone its limit holds, whatever the request; of several zones
///    the lowest one. With ZonesLimit::kReference it limits the reference instead of the subgraph,
///    and plans may exceed it: a baseline to compare with.
/// 2. The *operator*: the last request, until the operator requests the scenario's own subgraph
///    again (the empty request), which gives the vehicle back to
/// 3. its *policies*, of which the first with an opinion counts. A proposal stays at least
///    ReconfigurationSettings::min_stay_s, unless a policy before it has an opinion. Without an
///    opinion: the scenario's own subgraph.
///
/// **How early a limit holds.** Zones are searched on the path as far ahead as the vehicle can get,
/// at the highest speed of all possible requests, in n + 3 steps, n being the most steps needed to
/// slow down. Found before step k, a zone was farther than that before step k - 1; the plan of step
/// k holds from t(k + 1) on. So n steps are left then, and one more for places that a vehicle
/// beside its path reaches earlier. Two kinds of steps are exceptions: in a fallback the vehicle
/// drives the agreed plan, at its speed, and where nothing can be planned under the limit the
/// former subgraph is planned on (Controller::switch_to).
///
/// Every possible request is prepared at the start, under every limit, so that a switch costs
/// hardly more than a planner. No clock, no thread.
class SubgraphSelector {
 public:
  /// @param controller  on the scenario's own subgraph
  /// @pre check_reconfiguration throws nothing
  SubgraphSelector(const controller::Controller& controller,
                   const ReconfigurationSettings& settings);

  /// The scenario's own subgraph and the limits: base of the preparation of an operator's request.
  [[nodiscard]] const controller::PreparedSubgraph& base() const { return base_; }
  [[nodiscard]] const std::vector<double>& limits_mps() const { return limits_mps_; }
  /// How far ahead zones are searched; never decreases.
  [[nodiscard]] double zone_ahead_m() const { return zone_ahead_m_; }

  /// Holds from the next step on. @param request  made on `base` for `limits_mps`; none: the
  /// policies decide
  void ask(std::shared_ptr<const PreparedChoice> request);

  /// To be called before every step of the controller, also before the experiment has begun.
  /// @param start  the experiment's first step, from which time counts; none: not begun, policies
  /// are not called yet
  /// @return true if the controller was switched
  bool begin_step(controller::Controller& controller, StepIndex step,
                  std::optional<StepIndex> start, std::optional<double> battery_v);

  /// Who decided on the subgraph of the last `begin_step`.
  struct Decision {
    const PreparedChoice* choice{};     ///< the request in force, under every limit
    bool is_operators{};                ///< it is the operator's
    std::optional<std::size_t> policy;  ///< otherwise: index of the policy that proposed it, if any
    std::optional<std::size_t> zone;    ///< index of the zone whose limit holds, if any
    std::optional<double> subgraph_limit_mps;  ///< that limit, if zones limit the subgraph
    const PreparedChoice* own{};               ///< the scenario's own subgraph instead of a request
  };
  /// @pre `begin_step` was called, and nothing since that changes what is in force
  [[nodiscard]] Decision decision() const;
  /// @param zone  index of a zone
  [[nodiscard]] double limit_mps(std::size_t zone) const {
    return settings_.zones[zone].max_speed_mps;
  }

  /// Of the controller where no zone limits it: ControllerOptions::reference_speed_mps.
  [[nodiscard]] double reference_speed_mps() const { return reference_speed_mps_; }

  /// True if policies look ahead after the next step.
  [[nodiscard]] bool looks_ahead() const;
  /// To be called after a step, when its messages and command are published.
  /// @param may_look_ahead  false: there is no time for policies to look ahead
  void end_step(const controller::Controller& controller, const coordination::Report& report,
                bool may_look_ahead = true);

 private:
  static constexpr std::size_t kNoPolicyCounts = static_cast<std::size_t>(-1);

  [[nodiscard]] const PreparedChoice& prepared(const SubgraphRequest& request) const;
  [[nodiscard]] const PreparedChoice& in_force() const;
  [[nodiscard]] std::optional<std::size_t> zone_for(const controller::Controller& controller,
                                                    StepIndex step) const;
  [[nodiscard]] std::optional<double> subgraph_limit_mps(std::optional<std::size_t> zone) const;
  /// True if it switches the controller.
  bool apply(const PreparedChoice& choice, std::optional<std::size_t> zone,
             controller::Controller& controller) const;
  void see_zones_for(const PreparedChoice& choice);
  void let_policies_choose(StepIndex step, StepIndex start, std::optional<double> battery_v);

  controller::PreparedSubgraph base_;
  ReconfigurationSettings settings_;
  double reference_speed_mps_{};
  std::vector<double> limits_mps_;
  double zone_ahead_m_{};
  double step_s_{};
  std::vector<std::unique_ptr<Policy>> policies_;
  std::vector<std::pair<SubgraphRequest, PreparedChoice>> choices_;

  std::shared_ptr<const PreparedChoice> operator_;
  std::optional<std::size_t> zone_;  ///< whose limit holds
  std::optional<coordination::Report> last_;
  SubgraphRequest proposed_;                  ///< by the policies
  std::size_t proposed_by_{kNoPolicyCounts};  ///< index of the proposing policy
  std::optional<StepIndex> proposed_since_;   ///< none: the policies have not changed it yet
  std::size_t counts_{kNoPolicyCounts};       ///< the first with an opinion in the last step
};

}  // namespace hlc::policy
