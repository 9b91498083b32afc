// high_level_controller as the lab control centre starts it: by its flags, from any folder, for
// several vehicles.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/domain_reservation.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

constexpr Nanoseconds kPeriod = 200'000'000;
const std::string kProgram = test::build_folder() + "/bin/high_level_controller";
const std::string kScenario =
    test::source_folder() + "/launch_scripts/scenarios/paper_three_cars.yaml";

std::vector<pid_t> children_of(pid_t parent) {
  const std::string id = std::to_string(parent);
  std::ifstream file("/proc/" + id + "/task/" + id + "/children");
  std::vector<pid_t> children;
  for (pid_t pid = 0; file >> pid;) children.push_back(pid);
  return children;
}

/// Also of a zombie: not.
bool runs(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string id, name, state;
  return (file >> id >> name >> state) && state != "Z";
}

/// The program for vehicles 1 and 2, on a middleware's domain of which the test is the middleware;
/// both stand where the scenario has them.
class TwoControllers : public testing::Test {
 protected:
  TwoControllers()
      : participant_(
            dds::on_loopback("middleware_1,2", domains_.first() + 1, dds::DomainRole::kLocal)),
        lists_(participant_, dds::topics::vehicle_state_list()),
        commands_(participant_, dds::topics::command()),
        ready_(participant_, dds::topics::ready_status()),
        program_({kProgram, "--node_id=high_level_controller", "--vehicle_ids=1,2",
                  "--scenario=" + kScenario, "--transport=loopback", "--simulated_time=false",
                  "--dds_domain=" + std::to_string(domains_.first()),
                  "--middleware_domain=" + std::to_string(domains_.first() + 1)},
                 folder_ / "output") {}

  /// Writes state lists until the condition holds.
  template <class Condition>
  [[nodiscard]] bool write_until(Condition condition) {
    return time::Signal{}.repeat_until(dds::soon(), 50ms, condition, [this] {
      VehicleStateList list{.t_now = next_on_grid(time::real_time_now(), kPeriod, kListOffset),
                            .period_ms = 200,
                            .states = {},
                            .observations = {},
                            .active_vehicle_ids = {1, 2}};
      for (const std::uint8_t id : {std::uint8_t{1}, std::uint8_t{2}}) {
        list.states.push_back(
            {.vehicle_id = id,
             .create_stamp = list.t_now - kStateDelay,
             .valid_after_stamp = list.t_now,
             .pose = scenario::measured_start(scenario_, scenario::vehicle_of(scenario_, {id}))});
      }
      lists_.write(list);
    });
  }
  [[nodiscard]] bool are_ready() {
    return write_until([this] { return num_ready(1) > 0 && num_ready(2) > 0; });
  }
  /// How often the vehicle's controller has published that it is ready, as it does until the start.
  [[nodiscard]] std::size_t num_ready(std::uint8_t vehicle) const {
    return static_cast<std::size_t>(std::ranges::count(
        ready_.wait_for(0), controller_ready_id(vehicle), &ReadyStatus::source_id));
  }

  const scenario::Scenario scenario_ = scenario::read_scenario({.file = kScenario});
  TemporaryFolder folder_;
  DomainReservation domains_{2};
  dds::Participant participant_;
  dds::Writer<VehicleStateList> lists_;
  dds::Mailbox<TrajectoryCommand> commands_;  ///< without a reader of commands none is ready
  dds::Mailbox<ReadyStatus> ready_;
  ChildProcess program_;
};

TEST_F(TwoControllers, AreReadyTogetherAndWhatHappensToOneHappensToNoOther) {
  ASSERT_TRUE(are_ready()) << read_text(folder_ / "output");
  const std::vector<pid_t> children = children_of(program_.pid());
  ASSERT_EQ(children.size(), 2U);
  kill(children[0], SIGKILL);
  ASSERT_TRUE(eventually(60s, [&] { return !runs(children[0]); }));
  const std::size_t before = num_ready(2);
  EXPECT_TRUE(write_until([&] { return num_ready(2) > before + 3; }));
  program_.send(SIGTERM);
  EXPECT_EQ(program_.wait_for(60s), kExitDied) << "one of them was killed";
  EXPECT_TRUE(eventually(60s, [&] { return !runs(children[1]); }));
}

TEST_F(TwoControllers, EndWithTheProgramThatWasStarted) {
  ASSERT_TRUE(are_ready()) << read_text(folder_ / "output");
  const std::vector<pid_t> children = children_of(program_.pid());
  ASSERT_EQ(children.size(), 2U);
  program_.send(SIGKILL);
  EXPECT_TRUE(program_.wait_for(60s).has_value());
  EXPECT_TRUE(eventually(60s, [&] { return !runs(children[0]) && !runs(children[1]); }));
}

TEST(ControllerProgram, FindsItsScenarioBesideItselfWhereverItIsInstalled) {
  const TemporaryFolder folder;
  const std::string lab = (folder / "lab").string();
  ASSERT_EQ(std::system(("cmake --install " + test::build_folder() + " --component lab --prefix " +
                         lab + " > /dev/null 2>&1")
                            .c_str()),
            0);
  const DomainReservation domains{2};
  const auto start = [&](const std::string& flags) {
    ChildProcess program(
        {"/bin/sh", "-c",
         "cd / && exec " + lab + "/high_level_controller --vehicle_ids=1 --transport=loopback" +
             " --dds_domain=" + std::to_string(domains.first()) + " --middleware_domain=" +
             std::to_string(domains.first() + 1) + " --startup_timeout_s=1 " + flags},
        folder / "output");
    const std::optional<int> code = program.wait_for(60s);
    return std::pair{code, read_text(folder / "output")};
  };
  const auto [missing, output] =
      start("--scenario=lab_circle --dds_initial_peer=rtps@udpv4://10.0.0.1");
  EXPECT_EQ(missing, kExitMissing) << output;
  EXPECT_NE(output.find("--dds_initial_peer"), std::string::npos) << output;
  EXPECT_EQ(start("").first, kExitMissing) << "without a name it drives the lab's three cars";
  const auto [bad, unknown] = start("--scenario=nowhere");
  EXPECT_EQ(bad, kExitBadInput);
  EXPECT_NE(unknown.find("nowhere, must be a file, or one of"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("/lab/scenarios"), std::string::npos) << unknown;
}

TEST(ControllerProgram, RefusesAnAutomatonThatTheLabsVehiclesCannotFollow) {
  const TemporaryFolder folder;
  const std::string file = (folder / "too_tight.yaml").string();
  const std::string shipped = test::source_folder() + "/launch_scripts";
  std::ofstream(file) << "name: too_tight\nsteps: 10\nautomaton: " << shipped
                      << "/automata/paper.yaml\nlab: " << shipped
                      << "/labs/cpm_lab.yaml\nsubgraph: B\ncircle: {cars: 2, radius_m: 1.5, "
                         "centre_x_m: 2.25, centre_y_m: 2.0}\n";
  const Outcome outcome = run_program("high_level_controller --vehicle_ids=1 --scenario=" + file);
  EXPECT_EQ(outcome.exit_code, kExitBadInput);
  EXPECT_NE(outcome.output.find("paper.yaml: subgraph B, trim 2: curvature = -4.3"),
            std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("must be in -3.96 ... 4.316"), std::string::npos) << outcome.output;
  EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
}

TEST(ControllerProgram, RefusesMoreVehiclesThanTheLabHas) {
  const Outcome outcome = run_program(
      "high_level_controller --vehicle_ids=1 --cars 31 --scenario=" + test::source_folder() +
      "/launch_scripts/scenarios/lab_cars.yaml");
  EXPECT_EQ(outcome.exit_code, kExitBadInput);
  EXPECT_NE(outcome.output.find("lab_cars.yaml: vehicle 31, must be in 1 ... 30 in the lab"),
            std::string::npos)
      << outcome.output;
  EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
}

TEST(ControllerProgram, RefusesAVehicleThatIsNamedTwice) {
  const Outcome outcome = run_program("high_level_controller --vehicle_ids=1,2,1");
  EXPECT_EQ(outcome.exit_code, kExitBadInput);
  EXPECT_NE(outcome.output.find("--vehicle_ids = 1 twice"), std::string::npos) << outcome.output;
}

TEST(ControllerProgram, SaysWhatAFlagMayBe) {
  const std::vector<std::pair<std::string, std::string>> lines{
      {"--simulated_time=perhaps", "--simulated_time: perhaps, must be true or false"},
      {"--core=first", "--core: first, must be in 0 ... 1023"},
      {"--dds_domain=400", "--dds_domain: 400, must be in 0 ... 232"},
      {"--transport=loopback --colour=red",
       "not expected: --colour=red, must be a flag that --help lists"}};
  for (const auto& [flag, line] : lines) {
    const Outcome outcome = run_program("high_level_controller --vehicle_ids=1 " + flag);
    EXPECT_EQ(outcome.exit_code, kExitBadInput) << flag;
    EXPECT_NE(outcome.output.find(line), std::string::npos) << outcome.output;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
  }
}

}  // namespace
}  // namespace hlc::test
