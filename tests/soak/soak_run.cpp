#include "tests/soak/soak_run.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <stdexcept>
#include <thread>

#include "hlc_bridge/doctor/shared_memory.hpp"
#include "hlc_bridge/record/drive_file.hpp"
#include "hlc_bridge/record/facts_file.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "hlc_bridge/result/encounters.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "tests/integration/driven_plan.hpp"
#include "tests/integration/lab_network.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/integration/run_processes.hpp"
#include "tests/support/own_shared_memory.hpp"
#include "tests/support/standstill_watch.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kVehicles = 3;
constexpr int kStepsOfAFaultyRun = 400;
constexpr auto kStartTime = 120s;
constexpr auto kEndTime = 60s;
/// A controller that comes back when the run has just ended waits 10 s longer than this.
constexpr int kStartupTimeout_s = 40;
/// A run that still goes on this long after its last fault has got over it and is interrupted.
constexpr auto kTimeToRecover = 6s;

bool all_drive(const std::filesystem::path& run_folder) {
  std::set<std::uint8_t> driving;
  for (const ReportRecord& record : reports_so_far(run_folder)) {
    if (record.report.status == coordination::StepStatus::kPlanned)
      driving.insert(record.report.vehicle.value);
  }
  return driving.size() == kVehicles;
}

/// One thing to do at a time.
struct Action {
  double at_s{};
  const PlannedFault* fault{};
  bool ends{};  ///< the fault that began before
};

std::vector<Action> actions_of(const FaultPlan& plan) {
  std::vector<Action> actions;
  for (const PlannedFault& fault : plan.faults) {
    actions.push_back({fault.at_s, &fault, false});
    if (fault.lasts_s > 0.0) actions.push_back({fault.at_s + fault.lasts_s, &fault, true});
  }
  std::ranges::stable_sort(actions, {}, &Action::at_s);
  return actions;
}

const char* scenario_on(const std::string& transport) {
  return transport == "lab" ? "lab_three_cars" : "paper_three_cars";
}

void check_driving(const scenario::Scenario& scenario, const result::Drives& drives,
                   SoakResult& result) {
  const result::Encounters close =
      result::encounters(result::describe(scenario, std::nullopt).vehicles, drives, 0, kForever);
  result.collisions = close.collisions;
  result.min_distance_m = close.min_distance_m;
  if (drives.size() != kVehicles) result.problems.emplace_back("a vehicle left no record");
  if (result.collisions > 0) {
    result.problems.push_back(std::to_string(result.collisions) + " driven collisions");
  }
}

template <class Lab>
void check_end(Lab& lab, SoakResult& result) {
  for (const std::string& name : lab.still_running_after(kEndTime)) {
    result.problems.push_back(name + " hangs");
  }
}

/// Without children, and before anything else of ours can have begun.
void look_for_leftovers(SoakResult& result) {
  if (!use_own_shared_memory()) return;
  for (const doctor::SharedMemoryFile& file : doctor::shared_memory_files()) {
    if (!result.may_leave_files) result.problems.push_back("left in /dev/shm: " + file.name);
    std::filesystem::remove("/dev/shm/" + file.name);  // not the next run's
  }
}

/// What goes wrong in the program that watches is a problem of the run, too.
template <class Run>
SoakResult watched(Run run) {
  SoakResult result;
  StandstillWatch standstill;
  try {
    run(result);
  } catch (const std::exception& error) {
    result.problems.emplace_back(error.what());
  }
  result.standstill_s = std::chrono::duration<double>(standstill.end()).count();
  look_for_leftovers(result);
  return result;
}

template <class Lab, class Strike>
void drive_and_strike(Lab& lab, const FaultPlan& plan, Strike strike) {
  const Clock::time_point begin = Clock::now();
  for (const Action& action : actions_of(plan)) {
    std::this_thread::sleep_until(begin + std::chrono::duration_cast<Clock::duration>(
                                              std::chrono::duration<double>(action.at_s)));
    strike(action);
  }
  if (!lab["lab_control"].wait_for(kTimeToRecover)) lab["lab_control"].send(SIGINT);
}

/// Strikes the processes of one run, and undoes what passes.
class Striker {
 public:
  Striker(LabProcesses& lab, SoakResult& result) : lab_(lab), result_(result) {}

  void act(const Action& action) {
    const PlannedFault& fault = *action.fault;
    const std::string name = struck_process(fault);
    const bool has_ended = lab_[name].wait_for(0ms).has_value();
    if (!action.ends) {
      if (!has_ended) strike(fault, name);
    } else if (fault.kind == FaultKind::kReturnController) {
      if (has_ended && !lab_["lab_control"].wait_for(0ms)) lab_.start(name);
    } else if (!has_ended && --stops_[name] == 0) {
      lab_[name].send(SIGCONT);
    }
  }

  [[nodiscard]] bool has_killed(const std::string& name) const { return killed_.contains(name); }

 private:
  void strike(const PlannedFault& fault, const std::string& name) {
    const bool is_stop =
        fault.kind == FaultKind::kStopController || fault.kind == FaultKind::kStopMiddleware;
    if (is_stop) ++stops_[name];
    if (!is_stop) killed_.insert(name);
    lab_[name].send(is_stop ? SIGSTOP : SIGKILL);
    ++result_.faults_done;
  }

  LabProcesses& lab_;
  SoakResult& result_;
  std::set<std::string> killed_;
  std::map<std::string, int> stops_;  // that have not ended
};

void run_on_one_machine(const FaultPlan& plan, const std::string& transport, bool keep,
                        SoakResult& result) {
  const bool returns = std::ranges::any_of(plan.faults, [](const PlannedFault& fault) {
    return fault.kind == FaultKind::kReturnController;
  });
  std::vector<std::string> flags;
  if (returns) flags.emplace_back("--on_death=continue");
  LabProcesses lab({.scenario = scenario_on(transport),
                    .steps = kStepsOfAFaultyRun,
                    .simulated_time = false,
                    .lab_control_flags = flags,
                    .startup_timeout_s = kStartupTimeout_s,
                    .transport = transport});
  result.may_leave_files = transport == "lab";
  lab.start_all();
  Striker striker(lab, result);
  if (eventually(kStartTime, [&] { return all_drive(lab.folder()); })) {
    drive_and_strike(lab, plan, [&](const Action& action) { striker.act(action); });
  } else {
    result.problems.emplace_back("the cars do not start");
  }
  check_end(lab, result);
  if (!striker.has_killed("lab_control")) result.lab_control = lab["lab_control"].wait_for(0ms);
  check_driving(lab.scenario(), lab.drives(), result);
  if (keep && !result.problems.empty()) lab.keep_folder();
}

void run_over_network(const FaultPlan& plan, bool keep, SoakResult& result) {
  const Network network(true);
  if (!network.is_made()) throw std::runtime_error("the network cannot be created");
  LabOverNetwork lab(network, kStepsOfAFaultyRun);
  if (eventually(kStartTime, [&] { return all_drive(lab.folder()); })) {
    std::map<int, int> cuts;  // of a machine, that have not ended
    drive_and_strike(lab, plan, [&](const Action& action) {
      const int machine = action.fault->vehicle;
      if (action.ends) {
        if (--cuts[machine] == 0) network.join(machine);
        return;
      }
      if (lab["lab_control"].wait_for(0ms)) return;
      ++cuts[machine];
      network.cut_off(machine);
      ++result.faults_done;
    });
  } else {
    result.problems.emplace_back("the cars do not start");
  }
  check_end(lab, result);
  result.lab_control = lab["lab_control"].wait_for(0ms);
  check_driving(lab.scenario(), lab.drives(), result);
  if (keep && !result.problems.empty()) lab.keep_folder();
}

}  // namespace

SoakResult run_with_faults(const FaultPlan& plan, const std::string& transport, bool keep) {
  return watched([&](SoakResult& result) {
    plan.over_network ? run_over_network(plan, keep, result)
                      : run_on_one_machine(plan, transport, keep, result);
  });
}

SoakResult run_cycle(std::size_t number, bool keep) {
  return watched([&](SoakResult& result) {
    const bool is_interrupted = number % 4 >= 2;
    LabProcesses lab(
        {.steps = is_interrupted ? kStepsOfAFaultyRun : 3, .simulated_time = number % 2 == 0});
    lab.start_all();
    if (is_interrupted) {
      if (!eventually(kStartTime, [&] { return all_drive(lab.folder()); })) {
        result.problems.emplace_back("the cars do not start");
      }
      lab["lab_control"].send(SIGINT);
    }
    for (const std::string& name : lab.still_running_after(kStartTime + kEndTime)) {
      result.problems.push_back(name + " hangs");
    }
    for (const std::string& name : lab.names()) {
      const int wanted = is_interrupted && name == "lab_control" ? 130 : 0;
      const int code = lab[name].wait_for(0ms).value_or(-1);
      if (name == "lab_control") result.lab_control = code;
      if (code != wanted) {
        result.problems.push_back(name + " ended with " + std::to_string(code));
      }
    }
    if (keep && !result.problems.empty()) lab.keep_folder();
  });
}

SoakResult run_undisturbed(int steps, const std::string& transport, bool keep) {
  return watched([&](SoakResult& result) {
    LabProcesses lab({.scenario = scenario_on(transport),
                      .steps = steps,
                      .simulated_time = false,
                      .transport = transport});
    lab.start_all();
    const auto run_time = std::chrono::seconds(steps / 5);
    result.lab_control = lab["lab_control"].wait_for(kStartTime + run_time);
    check_end(lab, result);
    if (result.lab_control != 0) {
      result.problems.push_back("lab_control ended with " +
                                std::to_string(result.lab_control.value_or(-1)));
    }
    const result::Drives drives = lab.drives();
    check_driving(lab.scenario(), drives, result);
    const result::RunFacts facts = record::read_facts(lab.folder() / "run.json");
    const std::vector<ReportRecord> reports = record::read_reports(lab.folder() / "reports.csv");
    const result::RunSummary summary =
        result::summarize(result::describe(lab.scenario(), std::nullopt), facts,
                          result::step_records(reports, drives, facts), drives);
    for (const result::VehicleSummary& vehicle : summary.vehicles) {
      result.deadline_misses += vehicle.deadline_misses;
      result.fallback_steps += vehicle.fallback_steps;
      if (vehicle.planning_s) {
        result.planning_max_s = std::max(result.planning_max_s, vehicle.planning_s->max);
      }
    }
    if (keep && !result.problems.empty()) lab.keep_folder();
  });
}

}  // namespace hlc::test
