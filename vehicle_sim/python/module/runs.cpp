#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/result/run_record.hpp"
#include "hlc_bridge/result/trace_hash.hpp"
#include "planner/controller/coordination_rules.hpp"
#include "planner/rollout/rollout.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"
#include "vehicle_sim/python/module/arrays.hpp"
#include "vehicle_sim/python/module/bindings.hpp"
#include "vehicle_sim/python/module/priority_rule.hpp"
#include "vehicle_sim/python/module/run_files.hpp"
#include "vehicle_sim/python/module/scenario.hpp"

namespace hlc::python {
namespace {

using result::StepRecord;
using Rows = std::vector<StepRecord>;

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// What a run may differ in from its scenario.
struct RunChoices {
  std::optional<std::size_t> steps;
  py::object priorities;  ///< a function, or None: the scenario's
};

/// A pending Ctrl-C ends the run as an exception of Python, which only its main thread receives. To
/// be asked once per step, without the interpreter's lock. The lock is taken in the main thread
/// only, because another thread's Python code can hold it for some milliseconds.
class Interruption {
 public:
  Interruption() {
    const py::module_ threading = py::module_::import("threading");
    is_main_ = threading.attr("current_thread")().is(threading.attr("main_thread")());
  }
  void check() {
    if (!is_main_) return;
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

 private:
  bool is_main_;
};

scenario::Scenario scenario_of(const LoadedScenario& loaded, const RunChoices& choices) {
  scenario::Scenario scenario = loaded.scenario;
  if (choices.steps) scenario.steps = *choices.steps;
  if (!choices.priorities.is_none()) {
    scenario.profile.strategies.priorities.strategy = &kPythonPriorities;
    // A function gives an order and searches for none, for which two rounds would be needed.
    scenario.rounds = controller::Rounds::kSequential;
  }
  return scenario;
}

template <class Get>
py::list words(const Rows& rows, Get get) {
  py::list list;
  for (const StepRecord& row : rows) list.append(get(row.record.report));
  return list;
}

void add_poses(const Rows& rows, py::dict& columns) {
  const auto planned = [&](const char* name, double Pose::*part) {
    columns[name] = column<double>(
        rows, [&](const StepRecord& row) { return row.record.report.planned_pose.*part; });
  };
  planned("planned_x_m", &Pose::x_m);
  planned("planned_y_m", &Pose::y_m);
  planned("planned_heading_rad", &Pose::heading_rad);
  const auto driven = [&](const char* name, double Pose::*part) {
    columns[name] = column<double>(
        rows, [&](const StepRecord& row) { return row.driven ? *row.driven.*part : kNotKnown; });
  };
  driven("driven_x_m", &Pose::x_m);
  driven("driven_y_m", &Pose::y_m);
  driven("driven_yaw_rad", &Pose::heading_rad);
  columns["driven_speed_mps"] = column<double>(
      rows, [](const StepRecord& row) { return row.driven_speed_mps.value_or(kNotKnown); });
}

void add_plans(const Rows& rows, py::dict& columns) {
  using coordination::Report;
  const auto add = [&]<class Number>(const char* name, Number /*type*/, auto get) {
    columns[name] =
        column<Number>(rows, [&](const StepRecord& row) { return get(row.record.report); });
  };
  columns["status"] = words(rows, [](const Report& r) { return to_string(r.status); });
  columns["reason"] = words(rows, [](const Report& r) { return to_string(r.reason); });
  columns["quality"] = words(rows, [](const Report& r) { return to_string(r.quality); });
  columns["maneuver"] = words(rows, [](const Report& r) { return r.maneuver; });
  columns["subgraph"] = words(rows, [](const Report& r) { return r.subgraph; });
  add("trim", std::int64_t{}, [](const Report& r) { return r.planned_trim.index; });
  add("cost_m2", double{}, [](const Report& r) { return r.cost_m2; });
  add("gap_m2", double{}, [](const Report& r) { return r.gap_m2; });
  add("generated", std::int64_t{}, [](const Report& r) { return r.generated; });
  add("expanded", std::int64_t{}, [](const Report& r) { return r.expanded; });
  add("level", std::int64_t{}, [](const Report& r) { return r.level; });
  add("num_coupled", std::int64_t{}, [](const Report& r) { return r.coupled.size(); });
  add("deviation_m", double{}, [](const Report& r) { return r.deviation_m; });
}

py::dict step_columns(const Rows& rows) {
  py::dict columns;
  columns["step"] = column<std::int64_t>(rows, [](const StepRecord& row) { return row.step; });
  columns["vehicle"] = column<std::int64_t>(
      rows, [](const StepRecord& row) { return row.record.report.vehicle.value; });
  columns["t_s"] = column<double>(rows, [](const StepRecord& row) { return row.t_s; });
  add_poses(rows, columns);
  add_plans(rows, columns);
  return columns;
}

/// All vehicles' samples, one after the other. @param first  t(k0)
py::dict trajectory_columns(const result::Drives& drives, Nanoseconds first) {
  std::vector<std::pair<std::uint8_t, const result::DrivenSample*>> all;
  for (const auto& [id, drive] : drives) {
    for (const result::DrivenSample& one : drive) all.emplace_back(id, &one);
  }
  py::dict columns;
  columns["vehicle"] = column<std::int64_t>(all, [](const auto& row) { return row.first; });
  const auto add = [&](const char* name, auto get) {
    columns[name] = column<double>(all, [&](const auto& row) { return get(*row.second); });
  };
  using Sample = result::DrivenSample;
  add("t_s", [first](const Sample& one) { return 1e-9 * static_cast<double>(one.t - first); });
  add("x_m", [](const Sample& one) { return one.pose.x_m; });
  add("y_m", [](const Sample& one) { return one.pose.y_m; });
  add("yaw_rad", [](const Sample& one) { return one.pose.heading_rad; });
  add("speed_mps", [](const Sample& one) { return one.speed_mps; });
  add("throttle", [](const Sample& one) { return one.throttle; });
  add("steering", [](const Sample& one) { return one.steering; });
  return columns;
}

py::dict run_of(const Rows& rows) {
  py::dict run;
  run["steps"] = step_columns(rows);
  run["trace_sha256"] = result::trace_sha256(rows);
  return run;
}

py::dict rollout(const LoadedScenario& loaded, std::optional<std::size_t> steps,
                 const py::object& priorities) {
  const PriorityRuleInForce rule(priorities);
  const scenario::Scenario scenario =
      scenario_of(loaded, {.steps = steps, .priorities = priorities});
  Interruption interruption;
  std::vector<ReportRecord> reports;
  result::RunFacts facts{.steps = scenario.steps};
  {
    const py::gil_scoped_release release;
    facts.period =
        static_cast<Nanoseconds>(std::llround(1e9 * scenario.subgraph->automaton().step_s));
    rollout::Rollout vehicles = rollout::make_rollout(scenario, loaded.prepared);
    for (const scenario::ScenarioVehicle& one : scenario.vehicles)
      facts.vehicle_ids.push_back(one.id.value);
    facts.first_step = vehicles.next_step().value;
    for (std::size_t i = 0; i < scenario.steps; ++i) {
      interruption.check();
      for (coordination::Report& one : vehicles.step()) reports.push_back({.report = one});
    }
  }
  return run_of(result::step_records(reports, {}, facts));
}

std::vector<closed_loop::Fork> forks_of(const std::vector<record::KeptFork>& texts,
                                        const scenario::Scenario& scenario) {
  std::vector<closed_loop::Fork> forks;
  for (const record::KeptFork& one : texts) {
    closed_loop::Fork fork{.from = one.from, .changes = {}};
    for (const std::string& text : one.set)
      fork.changes.push_back(closed_loop::change_from_text(text, scenario));
    forks.push_back(std::move(fork));
  }
  closed_loop::check_forks(forks, scenario, scenario.steps);
  return forks;
}

/// In a run in logical time the vehicles' tick must divide the step.
void check_step(const scenario::Scenario& scenario) {
  const double step_s = scenario.subgraph->automaton().step_s;
  const double ticks = step_s / (1e-9 * static_cast<double>(kVehiclePeriod));
  if (std::abs(ticks - std::round(ticks)) < 1e-9) return;
  throw std::invalid_argument(
      fmt::format("{}: step_s = {}, must be a multiple of 0.02 to be driven",
                  scenario.automaton_file.string(), step_s));
}

py::dict drive(const LoadedScenario& loaded, std::optional<std::size_t> steps,
               const py::object& priorities, std::optional<std::uint64_t> noise_seed,
               const std::vector<record::KeptFork>& forks,
               const std::optional<std::filesystem::path>& out) {
  const PriorityRuleInForce rule(priorities);
  const scenario::Scenario scenario =
      scenario_of(loaded, {.steps = steps, .priorities = priorities});
  check_step(scenario);
  const RunConfiguration configuration{.scenario = scenario,
                                       .changed_text = loaded.changed_text,
                                       .noise_seed = noise_seed,
                                       .forks = forks};
  closed_loop::ExperimentOptions options{.steps = scenario.steps,
                                         .noise_seed = noise_seed,
                                         .forks = forks_of(forks, scenario),
                                         .prepared = loaded.prepared};
  options.after_step = [interruption = Interruption(), last = std::optional<StepIndex>()](
                           const auto&, const auto&, const coordination::Report& report) mutable {
    if (last == report.step) return;  // once per step, whichever vehicles are still there
    last = report.step;
    interruption.check();
  };
  std::optional<RunFolderWriter> folder;
  if (out) folder.emplace(*out, configuration);
  closed_loop::Experiment experiment;
  Rows rows;
  {
    const py::gil_scoped_release release;
    experiment = closed_loop::drive_experiment(scenario, options);
    rows = result::step_records(experiment.reports, experiment.drives, experiment.facts);
    if (folder) folder->complete(configuration, experiment, rows);
  }
  py::dict run = run_of(rows);
  run["trajectories"] = trajectory_columns(
      experiment.drives,
      static_cast<Nanoseconds>(experiment.facts.first_step.value_or(0)) * experiment.facts.period);
  run["exit_code"] = experiment.facts.exit_code;
  run["reason"] = experiment.facts.reason;
  return run;
}

}  // namespace

void bind_runs(py::module_& module) {
  py::class_<record::KeptFork>(module, "ForkText")
      .def(py::init<std::uint64_t, std::vector<std::string>>());
  module.def("rollout", &rollout);
  module.def("drive", &drive);
  module.attr("fork_changes") = closed_loop::kChangeForms;
}

}  // namespace hlc::python
