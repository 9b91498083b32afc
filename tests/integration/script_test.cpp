// The launch scripts as a user meets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/record/drive_file.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/domain_reservation.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

const std::string kScripts = test::source_folder() + "/launch_scripts/";
/// Ample: under a sanitizer the programs read maps and automata many times slower.
const std::string kStartup_s = "120";
const std::string kBin = test::build_folder() + "/bin";

/// The child of a process that runs this program.
std::optional<pid_t> child_of(pid_t parent, const std::string& program) {
  const std::string id = std::to_string(parent);
  std::ifstream children("/proc/" + id + "/task/" + id + "/children");
  for (pid_t pid = 0; children >> pid;) {
    const std::string command = read_text("/proc/" + std::to_string(pid) + "/cmdline");
    const std::string first = command.substr(0, command.find('\0'));
    if (first.ends_with("/" + program)) return pid;
  }
  return std::nullopt;
}

class Scripts : public testing::Test {
 protected:
  /// Pid of one of vehicle 2's processes in the run, or 0.
  static pid_t pid_of(const std::filesystem::path& out, const std::string& process) {
    std::ifstream pids(out / "logs" / "vehicle_2.pids");
    std::string name;
    for (pid_t pid = 0; pids >> pid >> name;) {
      if (name == process) return pid;
    }
    return 0;
  }

  ChildProcess run_lab(std::vector<std::string> flags) {
    flags.insert(flags.begin(),
                 {kScripts + "run_lab.sh", "--bin", kBin, "--startup_timeout_s", kStartup_s});
    return ChildProcess(flags, folder_ / "output");
  }
  [[nodiscard]] std::string output() const { return read_text(folder_ / "output"); }

  const TemporaryFolder folder_;
};

TEST_F(Scripts, RunLabPrintsTheTableAndLeavesNobodyBehind) {
  ChildProcess run = run_lab({"--steps", "15", "--out", (folder_ / "run").string()});
  ASSERT_EQ(run.wait_for(240s), 0) << output();
  for (const char* word : {"red", "blue", "green", "reference", "lap", "collisions"}) {
    EXPECT_NE(output().find(word), std::string::npos) << word << " in\n" << output();
  }
  for (const char* file : {"summary.json", "steps.csv", "timing.csv", "reports.csv", "run.json"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "run" / file)) << file;
  }
  EXPECT_TRUE(eventually(60s, [&] { return ::kill(-run.pid(), 0) != 0; }))
      << "a process of the run is left";
}

TEST_F(Scripts, RunLabWithAViewPrintsItsAddressAndLeavesNobodyBehind) {
  const std::filesystem::path out = folder_ / "run";
  ChildProcess run = run_lab({"--view", "--steps", "15", "--out", out.string()});
  ASSERT_EQ(run.wait_for(240s), 0) << output();
  EXPECT_EQ(output().find("view: http://127.0.0.1:"), 0U) << output();
  EXPECT_NE(output().find("collisions"), std::string::npos) << output();
  EXPECT_TRUE(eventually(60s, [&] { return ::kill(-run.pid(), 0) != 0; }))
      << "a process of the run is left";
}

TEST_F(Scripts, RunLabDrivesEvenIfTheViewFails) {
  const std::filesystem::path bin = folder_ / "bin";
  std::filesystem::create_directory(bin);
  for (const auto& program : std::filesystem::directory_iterator(kBin)) {
    if (program.path().filename() == "view") continue;
    std::filesystem::create_symlink(program.path(), bin / program.path().filename());
  }
  std::ofstream(bin / "view") << "#!/bin/sh\necho 'view: fails' >&2\nexit 2\n";
  std::filesystem::permissions(bin / "view", std::filesystem::perms::owner_all);
  ChildProcess run = ChildProcess({kScripts + "run_lab.sh", "--bin", bin.string(), "--view",
                                   "--steps", "15", "--out", (folder_ / "run").string()},
                                  folder_ / "output");
  ASSERT_EQ(run.wait_for(240s), 0) << output();
  EXPECT_NE(output().find("run_lab.sh: no view of this run: view: fails"), std::string::npos)
      << output();
}

// Cars 1, 2 and 3 stand in each other's way forever.
// Where nobody makes room, three of six cars get stuck.
TEST_F(Scripts, RunLabTellsThatCarsAreStuckAtTheEnd) {
  const std::filesystem::path out = folder_ / "run";
  const std::string scenario = folder_ / "circle.yaml";
  std::ofstream(scenario)
      << "{name: circle, steps: 115, automaton: " << kScripts
      << "automata/paper.yaml, subgraph: B, max_expansions: 400000, "
         "coordination: strict,\n"
         " circle: {cars: 6, radius_m: 1.5, centre_x_m: 2.25, centre_y_m: 2.0}}\n";
  ChildProcess run = run_lab({"--scenario", scenario, "--out", out.string()});
  ASSERT_EQ(run.wait_for(240s), 6) << output();
  EXPECT_NE(output().find("stuck at the end: vehicles                   1 2 3\n"),
            std::string::npos)
      << output();
  const auto summary = nlohmann::json::parse(read_text(out / "summary.json"), nullptr, false);
  ASSERT_TRUE(summary.is_object());
  EXPECT_EQ(summary["stuck_vehicles"].dump(), "[1,2,3]");
  const std::string log = read_text(out / "logs" / "high_level_controller_1-6.log");
  const std::string stuck = "stuck: vehicle 2, waiting for 1, 3 for 20.0 s";
  const std::size_t first = log.find(stuck);
  EXPECT_NE(first, std::string::npos) << log;
  EXPECT_EQ(log.find("stuck: vehicle 2", first + 1), std::string::npos) << "once";
}

/// The run within one process is the same.
testing::AssertionResult is_replayed(const std::filesystem::path& run) {
  const auto [exit_code, output] = run_program("replay --run " + run.string());
  if (exit_code == 0) return testing::AssertionSuccess();
  return testing::AssertionFailure() << output;
}

TEST_F(Scripts, RunLabKeepsTheFlagsThatDriveTheRun) {
  const std::filesystem::path out = folder_ / "run";
  ChildProcess run = run_lab(
      {"--steps", "10", "--noise_seed", "010", "--gains_scale", "0.9", "--out", out.string()});
  ASSERT_EQ(run.wait_for(240s), 5) << "gains a tenth too small lead out of the margin\n"
                                   << output();
  const std::string flags = read_text(out / "configuration" / "flags.yaml");
  for (const char* line : {"profile: 'default'", "subgraph: null", "steps: 10", "noise_seed: 10",
                           "gains_scale: 0.9", "simulated_time: true"}) {
    EXPECT_NE(flags.find(std::string("\n") + line + "\n"), std::string::npos) << line << " in\n"
                                                                              << flags;
  }
  const auto summary = nlohmann::json::parse(read_text(out / "summary.json"), nullptr, false);
  ASSERT_TRUE(summary.is_object());
  EXPECT_EQ(summary["seed"], 10);
  EXPECT_TRUE(is_replayed(out));
}

TEST_F(Scripts, DrawnCarsDriveRandomRoutesAndTheDrawIsKept) {
  const std::filesystem::path out = folder_ / "run";
  ChildProcess run = run_lab({"--scenario", "lab_cars", "--cars", "2", "--seed", "03", "--routes",
                              "random", "--steps", "10", "--out", out.string()});
  ASSERT_EQ(run.wait_for(240s), 0) << output();
  const std::string flags = read_text(out / "configuration" / "flags.yaml");
  for (const char* line : {"cars: 2", "seed: 3", "routes: 'random'"}) {
    EXPECT_NE(flags.find(std::string("\n") + line + "\n"), std::string::npos) << line << " in\n"
                                                                              << flags;
  }
  const auto summary = nlohmann::json::parse(read_text(out / "summary.json"), nullptr, false);
  ASSERT_TRUE(summary.is_object());
  ASSERT_EQ(summary["vehicles"].size(), 2U);
  EXPECT_TRUE(summary["vehicles"][0]["name"].get<std::string>().starts_with("path "));
  EXPECT_TRUE(is_replayed(out));
}

/// Vertices of a report by the begin of the names of its problem files.
std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> searched_vertices(
    const std::filesystem::path& reports) {
  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> vertices;
  for (const ReportRecord& record : record::read_reports(reports)) {
    const coordination::Report& report = record.report;
    if (report.expanded == 0) continue;
    char name[64];
    std::snprintf(name, sizeof(name), "vehicle_%u_step_%010llu", unsigned{report.vehicle.value},
                  static_cast<unsigned long long>(report.step.value));
    vertices[name] = {report.generated, report.expanded};
  }
  return vertices;
}

TEST_F(Scripts, PlanningProblemsOfARunAreSolvedAgainWithTheSameVertices) {
  const std::filesystem::path out = folder_ / "run";
  const std::filesystem::path problems = out / "problems";
  ChildProcess run =
      run_lab({"--scenario", "reconfiguration.yaml", "--steps", "10", "--engine", "best_first",
               "--dump_problems", problems.string(), "--out", out.string()});
  ASSERT_EQ(run.wait_for(240s), 0) << output();
  auto expected = searched_vertices(out / "reports.csv");
  EXPECT_GE(expected.size(), 30U);
  std::size_t num_automata = 0;
  for (const auto& entry : std::filesystem::directory_iterator(problems)) {
    num_automata += entry.path().extension() == ".yaml" ? 1U : 0U;
    if (entry.path().extension() != ".json") continue;
    const std::string name = entry.path().stem().string();
    SCOPED_TRACE(name);
    ChildProcess again({kBin + "/plan_problem", "--json", entry.path().string()},
                       folder_ / "again");
    // On a new subgraph there may be no plan at first: then the former one is searched, too.
    ASSERT_LE(again.wait_for(60s).value_or(-1), 1);
    const auto json = nlohmann::json::parse(read_text(folder_ / "again"), nullptr, false);
    ASSERT_TRUE(json.is_object()) << read_text(folder_ / "again");
    // What looks for a way into the lanes counts in no report (controller.hpp).
    if (name.find("_lane_entry") != std::string::npos) continue;
    auto& vertices = expected.at(name.substr(0, name.find("_search")));
    vertices.first -= json["generated"].get<std::uint64_t>();
    vertices.second -= json["expanded"].get<std::uint64_t>();
  }
  EXPECT_GT(num_automata, 0U) << "no controller switched";
  for (const auto& [name, rest] : expected) {
    EXPECT_EQ(rest.first, 0U) << name;
    EXPECT_EQ(rest.second, 0U) << name;
  }
}

TEST_F(Scripts, AFolderForProblemsThatIsNotGoodIsRefusedBeforeAnythingStarts) {
  const std::filesystem::path out = folder_ / "run";
  std::filesystem::create_directory(folder_ / "full");
  std::ofstream(folder_ / "full" / "vehicle_1.json") << "{}";
  for (const std::string& problems :
       {std::string("/dev/null"), std::string("/proc/problems"), std::string("/proc"),
        std::string(), (folder_ / "full").string(),
        (folder_ / "full" / "vehicle_1.json").string()}) {
    ChildProcess run =
        run_lab({"--steps", "10", "--dump_problems=" + problems, "--out", out.string()});
    EXPECT_EQ(run.wait_for(60s), 2) << output();
    EXPECT_NE(output().find("run_lab.sh: --dump_problems = " + problems), std::string::npos)
        << output();
    EXPECT_NE(output().find("must be a new or an empty folder"), std::string::npos) << output();
    EXPECT_EQ(std::ranges::count(output(), '\n'), 1) << output();
    EXPECT_FALSE(std::filesystem::exists(out));
  }
}

/// run_lab.sh itself tries a file there before it starts a process.
bool has_problem_file(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder)) return false;
  const std::filesystem::directory_iterator files(folder);
  return std::ranges::any_of(files,
                             [](const auto& entry) { return entry.path().extension() == ".json"; });
}

// The folder goes while the run is under way.
TEST_F(Scripts, ProblemsThatCouldNotBeWrittenAreAFailureButHideNone) {
  const std::vector<std::pair<std::string, int>> expected{{"1", 1}, {"0.9", 5}};
  for (const auto& [gains_scale, code] : expected) {
    SCOPED_TRACE("gains " + gains_scale);
    const std::filesystem::path problems = folder_ / ("problems_" + gains_scale);
    ChildProcess run = run_lab({"--steps", "15", "--simulated_time", "false", "--gains_scale",
                                gains_scale, "--dump_problems", problems.string(), "--out",
                                (folder_ / ("run_" + gains_scale)).string()});
    ASSERT_TRUE(eventually(60s, [&] { return has_problem_file(problems); })) << output();
    std::filesystem::rename(problems, problems.string() + "_elsewhere");
    EXPECT_EQ(run.wait_for(240s), code) << output();
  }
}

TEST_F(Scripts, AVehicleRefusesAFolderForProblemsThatCannotBeMade) {
  for (const std::string problems : {"", "/dev/null", "/proc/problems"}) {
    ChildProcess vehicle(
        {kScripts + "vehicle.sh", "--bin", kBin, "--vehicle_ids", "1", "--scenario",
         "paper_red_alone", "--dds_domain", "50", "--transport", "lab",
         "--dump_problems=" + problems, "--out", (folder_ / "run").string()},
        folder_ / "output");
    EXPECT_EQ(vehicle.wait_for(60s), 2) << output();
    EXPECT_NE(output().find("vehicle.sh: --dump_problems = " + problems), std::string::npos)
        << output();
    EXPECT_FALSE(std::filesystem::exists(folder_ / "run"));
  }
}

TEST_F(Scripts, FlagsThatContradictEachOtherAreRefused) {
  ChildProcess run = run_lab(
      {"--profile", "2022", "--engine", "branch_and_bound", "--out", (folder_ / "run").string()});
  EXPECT_EQ(run.wait_for(60s), 2) << output();
  EXPECT_NE(output().find("--engine = branch_and_bound"), std::string::npos) << output();
  ChildProcess controller(
      {kBin + "/high_level_controller", "--vehicle_ids", "1", "--profile", "2022", "--engine",
       "branch_and_bound", "--scenario", kScripts + "scenarios/paper_red_alone.yaml"},
      folder_ / "output");
  EXPECT_EQ(controller.wait_for(60s), 2) << output();
  EXPECT_NE(output().find("--engine = branch_and_bound"), std::string::npos) << output();
}

TEST_F(Scripts, AVehicleByHandJoinsNoRunThatHasReservedTheDomain) {
  const DomainReservation domains{2};
  const std::string domain = std::to_string(domains.first());
  ChildProcess vehicle(
      {kScripts + "vehicle.sh", "--bin", kBin, "--vehicle_ids", "1", "--scenario",
       "paper_red_alone", "--dds_domain", domain, "--out", folder_.path().string()},
      folder_ / "output");
  EXPECT_EQ(vehicle.wait_for(60s), 2) << output();
  EXPECT_NE(output().find("--dds_domain = " + domain), std::string::npos) << output();
}

struct Hung {
  std::string process;
  std::string simulated_time;
  std::string named;
};
void PrintTo(const Hung& one, std::ostream* out) { *out << one.process; }

class HungProcess : public Scripts, public testing::WithParamInterface<Hung> {};

TEST_P(HungProcess, EndsTheRunWithCode4AndIsNamed) {
  const std::filesystem::path out = folder_ / "run";
  ChildProcess run = run_lab(
      {"--steps", "5000", "--simulated_time", GetParam().simulated_time, "--out", out.string()});
  ASSERT_TRUE(eventually(60s, [&] { return read_text(out / "reports.csv").size() > 4000; }))
      << output();
  const pid_t hung = pid_of(out, GetParam().process);
  ASSERT_GT(hung, 0);
  ASSERT_EQ(::kill(hung, SIGSTOP), 0);
  EXPECT_EQ(run.wait_for(240s), 4) << output();
  EXPECT_NE(output().find(GetParam().named + " died"), std::string::npos) << output();
  EXPECT_TRUE(eventually(60s, [&] { return ::kill(-run.pid(), 0) != 0; }))
      << "a process of the run is left";
}

INSTANTIATE_TEST_SUITE_P(Scripts, HungProcess,
                         testing::Values(Hung{"high_level_controller_2", "true",
                                              "high_level_controller_2"},
                                         Hung{"vehicle_2", "true", "vehicle_raspberry_2"},
                                         Hung{"middleware_2", "false", "middleware_2"}),
                         [](const auto& one) { return one.param.process; });

TEST_F(Scripts, ProcessesThatDieAtOnceEndTheRunWithCode4) {
  const std::filesystem::path out = folder_ / "run";
  ChildProcess run = run_lab({"--steps", "5000", "--out", out.string()});
  ASSERT_TRUE(eventually(60s, [&] { return read_text(out / "reports.csv").size() > 4000; }))
      << output();
  for (const char* process : {"vehicle_2", "middleware_2", "high_level_controller_2"}) {
    const pid_t pid = pid_of(out, process);
    ASSERT_GT(pid, 0);
    ASSERT_EQ(::kill(pid, SIGKILL), 0);
  }
  EXPECT_EQ(run.wait_for(240s), 4) << output();
  EXPECT_NE(output().find("middleware_2 died"), std::string::npos) << output();
  EXPECT_TRUE(eventually(60s, [&] { return ::kill(-run.pid(), 0) != 0; }))
      << "a process of the run is left";
}

struct Killed {
  std::string process;
  std::string only;   ///< what vehicle.sh calls it
  std::string named;  ///< by lab control
};
void PrintTo(const Killed& one, std::ostream* out) { *out << one.process; }

class KilledProcess : public Scripts, public testing::WithParamInterface<Killed> {};

TEST_P(KilledProcess, IsStartedAgainByOneCommandAndTheRunGoesOn) {
  const std::filesystem::path out = folder_ / "run";
  const auto& [process, only, named] = GetParam();
  ChildProcess run = run_lab({"--simulated_time=false", "--on_death", "continue", "--steps", "100",
                              "--out", out.string()});
  ASSERT_TRUE(eventually(60s, [&] { return read_text(out / "reports.csv").size() > 8000; }))
      << output();
  const std::vector<std::string> command{kScripts + "vehicle.sh",
                                         "--bin",
                                         kBin,
                                         "--vehicle_ids",
                                         "2",
                                         "--only",
                                         only,
                                         "--out",
                                         out.string()};
  const pid_t pid = pid_of(out, process);
  ASSERT_GT(pid, 0);
  ChildProcess second(command, folder_ / "second");
  EXPECT_EQ(second.wait_for(60s), 2);
  EXPECT_EQ(read_text(folder_ / "second"), "vehicle.sh: --only = " + only + ": " + process +
                                               " still running; stop it first: kill -9 " +
                                               std::to_string(pid) + "\n");

  ASSERT_EQ(::kill(pid, SIGKILL), 0);
  ASSERT_TRUE(eventually(60s, [&] { return output().find(named + " died") != std::string::npos; }))
      << output();
  ChildProcess again(command, folder_ / "again");
  // 5: a vehicle was off its plan, as a simulated car is that stood still while it was dead, and as
  // any may be on a busy machine.
  const std::optional<int> code = run.wait_for(240s);
  EXPECT_TRUE(code == 0 || code == 5) << output();
  EXPECT_EQ(again.wait_for(60s), 0) << read_text(folder_ / "again");
  EXPECT_NE(output().find(named + " is back"), std::string::npos) << output();
  EXPECT_EQ(output().find("ended with exit code"), std::string::npos) << output();
  const auto facts = nlohmann::json::parse(read_text(out / "run.json"));
  EXPECT_EQ(facts["exit_code"], 0) << "of lab control";

  // The whole drive, in which the car is never elsewhere at once.
  const result::Drive drive = record::read_drive(record::drive_file(out, 2));
  ASSERT_FALSE(drive.empty());
  EXPECT_GT(drive.back().t - drive.front().t, 15 * kNanosecondsPerSecond);
  constexpr double kTickWay_m = 0.05;
  for (std::size_t i = 1; i < drive.size(); ++i) {
    ASSERT_LT((drive[i].pose.position_m() - drive[i - 1].pose.position_m()).norm(), kTickWay_m)
        << "row " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Scripts, KilledProcess,
                         testing::Values(Killed{"high_level_controller_2", "hlc",
                                                "high_level_controller_2"},
                                         Killed{"middleware_2", "middleware", "middleware_2"},
                                         Killed{"vehicle_2", "vehicle", "vehicle_raspberry_2"}),
                         [](const auto& one) { return one.param.process; });

TEST_F(Scripts, AFinishedRunIsNotWrittenOver) {
  std::filesystem::create_directory(folder_ / "run");
  std::ofstream(folder_ / "run" / "run.json") << R"({"exit_code": 0, "reason": ""})";
  ChildProcess vehicle({kScripts + "vehicle.sh", "--bin", kBin, "--vehicle_ids", "1", "--scenario",
                        "paper_red_alone", "--out", (folder_ / "run").string()},
                       folder_ / "output");
  EXPECT_EQ(vehicle.wait_for(60s), 2) << output();
  EXPECT_NE(output().find("a finished run"), std::string::npos) << output();
}

TEST_F(Scripts, LogicalTimeDoesNotGoOnAfterADeath) {
  ChildProcess run = run_lab({"--on_death", "continue", "--out", (folder_ / "run").string()});
  EXPECT_EQ(run.wait_for(60s), 2);
  EXPECT_NE(output().find("--on_death = continue, must be stop"), std::string::npos) << output();
}

TEST_F(Scripts, ALabControlThatHangsIsEnded) {
  const std::filesystem::path out = folder_ / "run";
  // It is given its startup timeout, and some seconds.
  ChildProcess run =
      run_lab({"--steps", "5000", "--startup_timeout_s", "20", "--out", out.string()});
  ASSERT_TRUE(eventually(60s, [&] { return read_text(out / "reports.csv").size() > 4000; }))
      << output();
  const std::optional<pid_t> lab_control = child_of(run.pid(), "lab_control");
  ASSERT_TRUE(lab_control);
  ASSERT_EQ(::kill(*lab_control, SIGSTOP), 0);
  EXPECT_EQ(run.wait_for(180s), 4) << output();
  EXPECT_NE(output().find("lab_control not responding"), std::string::npos) << output();
  EXPECT_TRUE(eventually(60s, [&] { return ::kill(-run.pid(), 0) != 0; }))
      << "a process of the run is left";
}

TEST_F(Scripts, AnInterruptedRunLeavesNobodyBehind) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const std::filesystem::path out = folder_ / ("run" + std::to_string(signal));
    ChildProcess run = run_lab({"--steps", "5000", "--out", out.string()});
    ASSERT_TRUE(eventually(60s, [&] { return read_text(out / "reports.csv").size() > 4000; }))
        << output();
    run.send(signal);
    EXPECT_EQ(run.wait_for(60s), 130) << output();
    EXPECT_TRUE(eventually(60s, [&] { return ::kill(-run.pid(), 0) != 0; }))
        << "a process of the run is left";
    EXPECT_TRUE(std::filesystem::exists(out / "summary.json")) << "no table of what was driven";
  }
}

TEST_F(Scripts, AKilledRunLeavesNobodyBehind) {
  const std::filesystem::path out = folder_ / "run";
  ChildProcess run = run_lab({"--steps", "5000", "--out", out.string()});
  ASSERT_TRUE(eventually(60s, [&] { return read_text(out / "reports.csv").size() > 4000; }))
      << output();
  run.send(SIGKILL);
  EXPECT_EQ(run.wait_for(60s), 128 + SIGKILL) << output();
  EXPECT_TRUE(eventually(60s, [&] { return ::kill(-run.pid(), 0) != 0; }))
      << "a process of the run is left";
}

TEST_F(Scripts, TheExitCodeIsThatOfTheFirstWhoFails) {
  const std::filesystem::path bin = folder_ / "bin";
  std::filesystem::create_directories(bin);
  for (const char* program :
       {"lab_control", "vehicle_sim", "high_level_controller", "show_scenario", "summarize"}) {
    std::filesystem::create_symlink(kBin + "/" + program, bin / program);
  }
  std::ofstream(bin / "middleware") << "#!/bin/sh\nexit 7\n";
  std::filesystem::permissions(bin / "middleware", std::filesystem::perms::owner_all);
  ChildProcess run({kScripts + "run_lab.sh", "--bin", bin.string(), "--startup_timeout_s", "3",
                    "--out", (folder_ / "run").string()},
                   folder_ / "output");
  EXPECT_EQ(run.wait_for(60s), 7) << "lab control's 3 came later\n" << output();
}

struct BadInput {
  std::string name;
  std::vector<std::string> flags;
  std::string named;
};
void PrintTo(const BadInput& one, std::ostream* out) { *out << one.name; }

class BadInputs : public Scripts, public testing::WithParamInterface<BadInput> {};

TEST_P(BadInputs, AreRefusedWithOneLineAndCode2) {
  ChildProcess run = run_lab(GetParam().flags);
  ASSERT_EQ(run.wait_for(60s), 2) << output();
  EXPECT_NE(output().find(GetParam().named), std::string::npos) << output();
  EXPECT_EQ(std::ranges::count(output(), '\n'), 1) << output();
}

INSTANTIATE_TEST_SUITE_P(
    RunLab, BadInputs,
    testing::Values(BadInput{"UnknownFlag", {"--speed", "3"}, "--speed"},
                    BadInput{"MissingValue", {"--steps"}, "--steps"},
                    BadInput{"NoSuchScenario", {"--scenario", "nowhere"}, "nowhere"},
                    BadInput{"NoSuchMap", {"--map", "nowhere.xml"}, "nowhere.xml"},
                    BadInput{"NoSuchProfile", {"--profile", "2023"}, "2023"},
                    BadInput{"NoSuchSubgraph", {"--subgraph", "Z"}, "Z"},
                    BadInput{"StepsNotANumber", {"--steps", "many"}, "steps"},
                    BadInput{"TimeNotABoolean", {"--simulated_time", "maybe"}, "maybe"},
                    BadInput{"CarsWhereTheyHaveNames", {"--cars", "3"}, "--cars"},
                    BadInput{"TooManyCars", {"--scenario", "circle", "--cars", "99"}, "99"},
                    BadInput{"MoreCarsThanTheLabHas",
                             {"--scenario", "lab_cars", "--cars", "31"},
                             "--cars = 31, must be in 1 ... 30"},
                    BadInput{"SeedWhereNothingIsDrawn", {"--seed", "3"}, "--seed"},
                    BadInput{"SeedNotANumber", {"--seed", "x"}, "seed = x"},
                    BadInput{"RoutesUnknown", {"--routes", "some"}, "some"},
                    BadInput{"DomainTooLarge", {"--dds_domain", "233"}, "233"},
                    BadInput{"NoiseSeedNotANumber", {"--noise_seed", "abc"}, "noise_seed = abc"},
                    BadInput{"GainsNotANumber", {"--gains_scale", "abc"}, "gains_scale = abc"},
                    BadInput{"NoSuchPreset", {"--preset", "foo"}, "preset = foo"},
                    BadInput{"DomainNotANumber", {"--dds_domain", "x"}, "dds_domain"}),
    [](const auto& one) { return one.param.name; });

TEST_F(Scripts, AFolderWithOtherThingsInItIsNotTouched) {
  std::filesystem::create_directories(folder_ / "mine");
  std::ofstream(folder_ / "mine" / "thesis.txt") << "all of it";
  ChildProcess run = run_lab({"--out", (folder_ / "mine").string()});
  EXPECT_EQ(run.wait_for(60s), 2) << output();
  EXPECT_EQ(read_text(folder_ / "mine" / "thesis.txt"), "all of it");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "mine"), {}), 1);
}

}  // namespace
}  // namespace hlc::test
