#include "tests/soak/soak_run.hpp"

#include <sched.h>
#include <sys/mount.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <stdexcept>
#include <thread>

#include "hlc_bridge/core/run_description.hpp"
#include "hlc_bridge/core/run_summary.hpp"
#include "hlc_bridge/doctor/shared_memory.hpp"
#include "hlc_bridge/record/drive_file.hpp"
#include "hlc_bridge/record/facts_file.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "tests/integration/driven_plan.hpp"
#include "tests/integration/lab_network.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/integration/run_reports.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kVehicles = 3;
constexpr int kStepsOfAFaultyRun = 400;
constexpr auto kStartTime = 120s;
constexpr auto kEndTime = 60s;
/// A run that still goes on this long after its last fault has got over it and is interrupted.
constexpr auto kTimeToRecover = 6s;

bool has_own_shared_memory = false;

bool all_drive(const std::filesystem::path& run_folder) {
  std::set<std::uint8_t> driving;
  for (const ReportRecord& record : reports_so_far(run_folder)) {
    if (record.report.status == StepStatus::kPlanned) driving.insert(record.report.vehicle.value);
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

int begin_signal(const PlannedFault& fault) { return fault.lasts_s > 0.0 ? SIGSTOP : SIGKILL; }

void look_at_driving(const Scenario& scenario, const Drives& drives,
                     const std::set<std::uint8_t>& dead, SoakResult& result) {
  const Encounters close =
      driven_encounters(describe(scenario, std::nullopt).vehicles, drives, dead);
  result.collisions = close.collisions;
  result.min_distance_m = close.min_distance_m;
  if (drives.size() != kVehicles) result.problems.emplace_back("a vehicle left no record");
  if (result.collisions > 0) {
    result.problems.push_back(std::to_string(result.collisions) + " driven collisions");
  }
}

template <class Lab>
void look_at_the_end(Lab& lab, SoakResult& result) {
  for (const std::string& name : lab.still_running_after(kEndTime)) {
    result.problems.push_back(name + " hangs");
  }
}

/// Without children, and before anything else of ours can have begun.
void look_for_leftovers(SoakResult& result) {
  if (!has_own_shared_memory) return;
  for (const SharedMemoryFile& file : shared_memory_files()) {
    result.problems.push_back("left in /dev/shm: " + file.name);
    std::filesystem::remove("/dev/shm/" + file.name);  // not the next run's
  }
}

/// What goes wrong in the program that watches is a problem of the run, too.
template <class Run>
SoakResult watched(Run run) {
  SoakResult result;
  try {
    run(result);
  } catch (const std::exception& error) {
    result.problems.emplace_back(error.what());
  }
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

void run_on_loopback(const FaultPlan& plan, bool keep, SoakResult& result) {
  LabProcesses lab({.steps = kStepsOfAFaultyRun, .simulated_time = false});
  lab.start_all();
  std::set<std::uint8_t> dead;
  std::set<std::string> killed;
  std::map<std::string, int> stops;  // that have not ended
  if (eventually(kStartTime, [&] { return all_drive(lab.folder()); })) {
    drive_and_strike(lab, plan, [&](const Action& action) {
      const std::string name = struck_process(*action.fault);
      if (lab[name].wait_for(0ms)) return;
      if (action.ends) {
        if (--stops[name] == 0) lab[name].send(SIGCONT);
        return;
      }
      if (begin_signal(*action.fault) == SIGSTOP) {
        ++stops[name];
      } else {
        killed.insert(name);
      }
      lab[name].send(begin_signal(*action.fault));
      ++result.faults_done;
      if (action.fault->kind == FaultKind::kKillVehicle) {
        dead.insert(static_cast<std::uint8_t>(action.fault->vehicle));
      }
    });
  } else {
    result.problems.emplace_back("the cars do not start");
  }
  look_at_the_end(lab, result);
  if (!killed.contains("lab_control")) result.lab_control = lab["lab_control"].wait_for(0ms);
  look_at_driving(lab.scenario(), read_drives(lab.folder(), {1, 2, 3}), dead, result);
  if (keep && !result.problems.empty()) lab.keep_folder();
}

void run_over_network(const FaultPlan& plan, bool keep, SoakResult& result) {
  const Network network(true);
  if (!network.is_made()) throw std::runtime_error("the network cannot be made");
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
  look_at_the_end(lab, result);
  result.lab_control = lab["lab_control"].wait_for(0ms);
  look_at_driving(read_scenario({.file = LabOverNetwork::scenario_file()}), lab.drives(), {},
                  result);
  if (keep && !result.problems.empty()) lab.keep_folder();
}

}  // namespace

SoakResult run_with_faults(const FaultPlan& plan, bool keep) {
  return watched([&](SoakResult& result) {
    plan.over_network ? run_over_network(plan, keep, result) : run_on_loopback(plan, keep, result);
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

SoakResult run_undisturbed(int steps, bool keep) {
  return watched([&](SoakResult& result) {
    LabProcesses lab({.steps = steps, .simulated_time = false});
    lab.start_all();
    const auto run_time = std::chrono::seconds(steps / 5);
    result.lab_control = lab["lab_control"].wait_for(kStartTime + run_time);
    look_at_the_end(lab, result);
    if (result.lab_control != 0) {
      result.problems.push_back("lab_control ended with " +
                                std::to_string(result.lab_control.value_or(-1)));
    }
    const Drives drives = read_drives(lab.folder(), {1, 2, 3});
    look_at_driving(lab.scenario(), drives, {}, result);
    const RunFacts facts = read_facts(lab.folder() / "run.json");
    const std::vector<ReportRecord> reports = read_reports(lab.folder() / "reports.csv");
    const RunSummary summary = summarize(describe(lab.scenario(), std::nullopt), facts,
                                         step_records(reports, drives, facts), drives);
    for (const VehicleSummary& vehicle : summary.vehicles) {
      result.deadline_misses += vehicle.deadline_misses;
      result.fallback_steps += vehicle.fallback_steps;
      if (vehicle.planning_s) {
        result.planning_max_s = std::max(result.planning_max_s, vehicle.planning_s->max);
      }
    }
    if (keep && !result.problems.empty()) lab.keep_folder();
  });
}

bool use_own_shared_memory() {
  has_own_shared_memory = ::unshare(CLONE_NEWNS) == 0 &&
                          ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                          ::mount("tmpfs", "/dev/shm", "tmpfs", 0, nullptr) == 0;
  return has_own_shared_memory;
}

}  // namespace hlc::test
