#include "planner/rollout/priority_trial.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include "planner/coordination/priorities/strategies.hpp"
#include "planner/rollout/rollout.hpp"

namespace hlc::rollout {
namespace {

using coordination::Report;

constexpr std::size_t kDeadlockHorizons = 3;

/// The step of a copy of the rollout in the optimal order.
std::vector<Report> in_optimal_order(const Rollout& rollout) {
  Rollout copy = rollout.clone();
  for (const auto& one : copy.controllers()) {
    const coordination::PriorityRule optimal{.strategy = &coordination::kOptimalPriorities};
    one->coordinate_by(optimal, one->options().strategies.coordination);
  }
  return copy.step();
}

std::size_t num_planned(const std::vector<Report>& reports) {
  return static_cast<std::size_t>(std::ranges::count(reports, coordination::StepStatus::kPlanned,
                                                     [](const Report& one) { return one.status; }));
}

double cost_m2_of(const std::vector<Report>& reports) {
  double cost_m2 = 0.0;
  for (const Report& report : reports) cost_m2 += report.cost_m2;
  return cost_m2;
}

/// Of the last step.
bool is_any_component_larger_than(std::size_t most, const Rollout& rollout) {
  return std::ranges::any_of(rollout.controllers(), [most](const auto& controller) {
    return controller->component().size() > most;
  });
}

class Trial {
 public:
  Trial(const scenario::Scenario& scenario, std::size_t horizon_steps)
      : rollout_(make_rollout(scenario)), horizon_steps_(horizon_steps) {}

  void step(bool is_compared, const std::function<double()>& now_s) {
    const std::vector<Report> optimal =
        is_compared ? in_optimal_order(rollout_) : std::vector<Report>{};
    const double begin_s = now_s();
    std::vector<Report> reports = rollout_.step();
    result_.step_s.push_back(now_s() - begin_s);
    result_.planned += num_planned(reports);
    result_.vehicle_steps += reports.size();
    std::size_t levels = 0;
    for (const Report& report : reports) {
      levels = std::max<std::size_t>(levels, report.level + 1);
      note_motion(report);
    }
    result_.levels.push_back(levels);
    if (is_compared) compare(reports, optimal);
    std::vector<const Report*> pointers;
    for (std::size_t i = 0; i < reports.size(); ++i) {
      rollout_.controllers()[i]->note_bound(reports[i]);
      pointers.push_back(&reports[i]);
    }
    std::ranges::copy(coordination::joint_gaps(pointers), std::back_inserter(result_.gaps));
  }

  [[nodiscard]] PriorityTrial result() && { return std::move(result_); }

 private:
  struct Motion {
    Pose last;
    std::size_t standing_steps{};
  };

  void note_motion(const Report& report) {
    const auto [known, is_first] =
        motions_.try_emplace(report.vehicle, Motion{report.planned_pose});
    Motion& motion = known->second;
    if (is_first) return;
    const bool stands = report.planned_pose == motion.last;
    motion.standing_steps = stands ? motion.standing_steps + 1 : 0;
    result_.driven_m += (report.planned_pose.position_m() - motion.last.position_m()).norm();
    motion.last = report.planned_pose;
    const bool is_deadlock = motion.standing_steps >= kDeadlockHorizons * horizon_steps_;
    if (is_deadlock && !result_.deadlock_step) result_.deadlock_step = result_.step_s.size() - 1;
  }

  void compare(const std::vector<Report>& reports, const std::vector<Report>& optimal) {
    if (is_any_component_larger_than(coordination::kOptimalPriorities.most_vehicles, rollout_)) {
      return;
    }
    const std::size_t planned = num_planned(reports);
    const std::size_t best = num_planned(optimal);
    if (planned < best) ++result_.worse_steps;
    if (planned != best) return;
    ++result_.compared_steps;
    result_.cost_m2 += cost_m2_of(reports);
    result_.optimal_order_m2 += cost_m2_of(optimal);
  }

  Rollout rollout_;
  std::size_t horizon_steps_;
  PriorityTrial result_;
  std::map<VehicleId, Motion> motions_;
};

}  // namespace

PriorityTrial try_priorities(const scenario::Scenario& scenario, bool is_compared,
                             const std::function<double()>& now_s) {
  Trial trial(scenario, scenario.horizon_steps);
  for (std::size_t i = 0; i < scenario.steps; ++i) trial.step(is_compared, now_s);
  return std::move(trial).result();
}

}  // namespace hlc::rollout
