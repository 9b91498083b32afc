#include "tests/hlc_bridge/view/sample_run.hpp"

#include <memory>

#include "tests/support/test_automaton.hpp"

namespace hlc::view {
namespace {

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr Nanoseconds kTick = 20'000'000;
constexpr std::uint64_t kFirstStep = 7;
constexpr TrimId kStanding{0};
constexpr TrimId kDriving{6};

ReportRecord report_of(std::uint8_t id, std::uint64_t step, const Pose& pose) {
  ReportRecord record{.planning_ns = 150'000, .late_ns = 0};
  coordination::Report& report = record.report;
  report.vehicle = VehicleId{id};
  report.step = StepIndex{kFirstStep + step};
  report.status = coordination::StepStatus::kPlanned;
  report.planned_pose = pose;
  report.planned_trim = id == 2 ? kStanding : kDriving;
  report.maneuver = automaton::kSelfLoopLabel;
  report.plan.assign(3, {report.planned_trim, automaton::kSelfLoopLabel});
  report.subgraph = "B";
  report.quality = coordination::PlanQuality::kOptimal;
  if (id != 2) return record;
  report.coupled = {VehicleId{1}};
  if (step >= kWaitsFrom) {
    report.waiting = {.vehicles = {VehicleId{1}}, .since = StepIndex{kFirstStep + kWaitsFrom}};
  }
  if (step == kFallsBackIn) {
    report.status = coordination::StepStatus::kFallback;
    report.reason = coordination::FallbackReason::kConflict;
    report.blocked_by = {VehicleId{3}};
  }
  return record;
}

void add_step(std::uint8_t id, std::uint64_t step, const Pose& pose,
              const automaton::Maneuver& maneuver, FinishedRun& run) {
  run.rows.push_back({.step = step, .record = report_of(id, step, pose), .driven = {}});
  for (Nanoseconds t = 0; t < kPeriod; t += kTick) {
    const vehicle::State state = automaton::state_at(
        maneuver, 1e-9 * static_cast<double>(t), run.description.automaton->automaton().vehicle);
    run.drives[id].push_back({.t = (kFirstStep + step) * kPeriod + t,
                              .pose = compose(compose(pose, state.pose), {0.001, 0.0, 0.0}),
                              .speed_mps = state.speed_mps});
  }
}

}  // namespace

FinishedRun sample_run(std::uint8_t cars, std::uint64_t steps, const std::string& name) {
  FinishedRun run;
  run.description = {.scenario = "sample",
                     .profile = "default",
                     .engine = "branch_and_bound",
                     .map = "road",
                     .subgraph = "B",
                     .horizon_steps = 8,
                     .step_s = 0.2};
  run.description.automaton =
      std::make_shared<const automaton::Subgraph>(test::make_test_subgraph());
  run.facts.period = kPeriod;
  run.facts.steps = steps;
  run.facts.first_step = kFirstStep;
  run.time = "logical time";
  run.revision = "sample";
  run.map = road::LaneletMap{};
  const automaton::UniversalAutomaton& automaton = run.description.automaton->automaton();
  std::vector<Pose> poses;
  for (std::uint8_t id = 1; id <= cars; ++id) {
    const double y_m = 0.4 * id;
    run.map->lanelets[id] = {.id = id,
                             .left_m = {{0.0, y_m + 0.1}, {4.5, y_m + 0.1}},
                             .right_m = {{0.0, y_m - 0.1}, {4.5, y_m - 0.1}}};
    run.facts.vehicle_ids.push_back(id);
    run.description.vehicles.push_back(
        {.id = VehicleId{id},
         .name = id == 1 ? name : "car " + std::to_string(id),
         .route = road::ReferencePath{{{0.0, y_m}, {4.5, y_m}}, false},
         .footprint = {0.22, 0.107}});
    poses.push_back({2.0, y_m, 0.0});
  }
  for (std::uint64_t step = 0; step < steps; ++step) {
    for (std::uint8_t id = 1; id <= cars; ++id) {
      const TrimId trim = id == 2 ? kStanding : kDriving;
      const automaton::Maneuver* maneuver = automaton.find(trim, trim, automaton::kSelfLoopLabel);
      add_step(id, step, poses[id - 1U], *maneuver, run);
      poses[id - 1U] = compose(poses[id - 1U], maneuver->displacement);
    }
  }
  return run;
}

FinishedRun before(const FinishedRun& run) {
  FinishedRun begin = run;
  begin.rows.clear();
  begin.drives.clear();
  begin.facts.first_step = {};
  return begin;
}

}  // namespace hlc::view
