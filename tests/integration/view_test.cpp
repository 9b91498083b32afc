// The program view beside real runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <ranges>
#include <regex>
#include <set>

#include "hlc_bridge/record/facts_file.hpp"
#include "hlc_bridge/result/run_record.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/http_client.hpp"
#include "tests/support/program.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

const std::string kScenario =
    test::source_folder() + "/launch_scripts/scenarios/paper_three_cars.yaml";

/// The program, once it has printed its address.
class View {
 public:
  View(const LabProcesses& lab, const std::string& simulated_time)
      : log_(lab.folder() / "logs" / "view.txt"),
        process_({test::build_folder() + "/bin/view", "--scenario=" + kScenario,
                  "--dds_domain=" + std::to_string(lab.lab_domain()), "--transport=loopback",
                  "--simulated_time=" + simulated_time, "--port=0",
                  "--logs=" + (lab.folder() / "logs").string()},
                 log_) {
    EXPECT_TRUE(eventually(60s, [this] { return port() != 0; })) << read_text(log_);
  }

  [[nodiscard]] std::uint16_t port() const {
    std::smatch match;
    const std::string text = read_text(log_);
    const std::regex address("view: http://127\\.0\\.0\\.1:([0-9]+)/\n");
    if (!std::regex_search(text, match, address)) return 0;
    return static_cast<std::uint16_t>(std::stoi(match[1]));
  }
  ChildProcess& process() { return process_; }

 private:
  std::filesystem::path log_;
  ChildProcess process_;
};

/// All messages that the server sends until the end.
std::vector<nlohmann::json> messages_of(HttpClient& client) {
  std::vector<nlohmann::json> messages;
  static_cast<void>(client.read_until("\r\n\r\n"));
  for (std::string event = client.read_until("\n\n"); !event.empty();
       event = client.read_until("\n\n")) {
    const std::size_t data = event.find("data: ");
    if (data == std::string::npos) continue;
    for (const auto& message : nlohmann::json::parse(event.substr(data + 6))) {
      messages.push_back(message);
      if (message.at("kind") == "end") return messages;
    }
  }
  return messages;
}

/// The steps of every car.
std::map<int, std::vector<int>> steps_in(const std::vector<nlohmann::json>& messages) {
  std::map<int, std::vector<int>> steps;
  for (const nlohmann::json& message : messages) {
    if (message.at("kind") != "steps") continue;
    int k = 0;
    for (const nlohmann::json& change : message.at("k")) {
      k += change.get<int>();
      steps[message.at("vehicle").get<int>()].push_back(k);
    }
  }
  return steps;
}

std::set<int> cars_with_states(const std::vector<nlohmann::json>& messages) {
  std::set<int> cars;
  for (const nlohmann::json& message : messages) {
    if (message.at("kind") == "drive") cars.insert(message.at("vehicle").get<int>());
  }
  return cars;
}

/// Names of the processes whose log has lines.
std::set<std::string> logging_processes(const std::vector<nlohmann::json>& messages) {
  std::set<std::string> names;
  for (const nlohmann::json& message : messages) {
    if (message.at("kind") != "log") continue;
    for (const nlohmann::json& line : message.at("lines")) names.insert(line.at("process"));
  }
  return names;
}

/// Those of the record of a finished run.
std::map<int, std::vector<int>> steps_in(const std::filesystem::path& folder) {
  std::map<int, std::vector<int>> steps;
  const result::RunFacts facts = record::read_facts(folder / "run.json");
  for (const result::StepRecord& step : result::step_records(reports_so_far(folder), {}, facts)) {
    steps[step.record.report.vehicle.value].push_back(static_cast<int>(step.step));
  }
  return steps;
}

/// Every car has each recorded step once, in order, from the begin on. Controllers plan until the
/// stop reaches them: there may be more than the record's.
void expect_all(const std::map<int, std::vector<int>>& recorded,
                const std::map<int, std::vector<int>>& shown) {
  EXPECT_EQ(shown.size(), recorded.size());
  for (const auto& [car, steps] : recorded) {
    ASSERT_TRUE(shown.contains(car)) << car;
    EXPECT_THAT(shown.at(car), testing::Truly([&steps](const std::vector<int>& of_page) {
                  return of_page.size() >= steps.size() &&
                         std::ranges::equal(of_page | std::views::take(steps.size()), steps) &&
                         std::ranges::adjacent_find(of_page, std::greater_equal<>()) ==
                             of_page.end();
                }))
        << "car " << car << ", recorded: " << testing::PrintToString(steps);
  }
}

/// `trace_sha256` of the finished run.
std::string trace_at_end_of(LabProcesses& lab) {
  EXPECT_THAT(lab.still_running_after(120s), testing::IsEmpty());
  EXPECT_EQ(lab.summarize(), 0) << lab.log("summarize");
  const auto summary =
      nlohmann::json::parse(read_text(lab.folder() / "summary.json"), nullptr, false);
  return summary.is_object() ? summary.value("trace_sha256", "") : "";
}

TEST(View, LeavesTheRunAsItIsAndEndsWithIt) {
  LabProcesses alone({.steps = 40});
  alone.start_all();
  const std::string trace = trace_at_end_of(alone);
  LabProcesses watched({.steps = 40});
  View view(watched, "true");
  HttpClient client(view.port());
  client.get("/events");
  watched.start_all();
  const std::vector<nlohmann::json> messages = messages_of(client);
  EXPECT_EQ(trace_at_end_of(watched), trace);
  EXPECT_NE(trace, "");
  ASSERT_FALSE(messages.empty());
  EXPECT_EQ(messages.front().value("kind", ""), "run");
  EXPECT_EQ(messages.back().value("reason", ""), "The run has ended.");
  EXPECT_EQ(view.process().wait_for(30s), 0);
}

// In real time: in logical time a run may be over before its participants have found each other.
// Steps that the controllers skipped, on a machine that stood still, are not in the record either.
TEST(View, ShowsAllStepsOfAllCarsEvenIfItIsStartedInTheMiddleOfTheRun) {
  LabProcesses lab({.steps = 25, .simulated_time = false});
  lab.start_all();
  ASSERT_TRUE(eventually(60s, [&] { return reports_so_far(lab.folder()).size() > 9; }));
  View view(lab, "false");
  HttpClient client(view.port());
  client.get("/events");
  const std::vector<nlohmann::json> messages = messages_of(client);
  EXPECT_EQ(cars_with_states(messages), std::set({1, 2, 3}));
  EXPECT_THAT(
      logging_processes(messages),
      testing::IsSupersetOf({"high_level_controller_1", "high_level_controller_2", "lab_control"}));
  EXPECT_THAT(lab.still_running_after(120s), testing::IsEmpty());
  const auto recorded = steps_in(lab.folder());
  EXPECT_EQ(recorded.size(), 3U);
  expect_all(recorded, steps_in(messages));
}

TEST(View, ThatIsKilledOrStoppedDoesNotHoldUpTheRun) {
  for (const int signal : {SIGKILL, SIGSTOP}) {
    LabProcesses lab({.steps = 20, .simulated_time = false});
    View view(lab, "false");
    lab.start_all();
    ASSERT_TRUE(eventually(60s, [&] { return reports_so_far(lab.folder()).size() > 9; }));
    view.process().send(signal);
    EXPECT_THAT(lab.still_running_after(120s), testing::IsEmpty());
    EXPECT_EQ(lab["lab_control"].wait_for(0ms), 0) << lab.log("lab_control");
  }
}

TEST(View, BadFlagsAreRefusedInOneLineWithCode2) {
  const DomainReservation domain;
  const std::string view =
      "view --transport=loopback --dds_domain=" + std::to_string(domain.first()) +
      " --scenario=" + kScenario + " ";
  LabProcesses lab({});
  View first(lab, "true");
  const std::string port = std::to_string(first.port());
  for (const auto& [flags, line] : std::map<std::string, std::string>{
           {"--port=" + port, "--port = " + port + " is taken, must be free"},
           {"--port=70000", "--port: 70000, must be in 0 ... 65535"},
           {"--listen=here", "--listen = here, must be an IP address of this machine"},
           {"--vehicle_ids=1,1", "--vehicle_ids = 1 twice, must be unique"},
           {"--controller_domain=" + std::to_string(domain.first()), "must be different from"},
           {"--nonsense", "--nonsense, must be a flag that --help lists"}}) {
    const Outcome outcome = run_program(view + flags);
    EXPECT_EQ(outcome.exit_code, 2) << flags;
    EXPECT_THAT(outcome.output, testing::HasSubstr(line)) << flags;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
  }
}

}  // namespace
}  // namespace hlc::test
