// choose_trims as it is called.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "planner/maneuver_design/automaton_configuration.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::apps {
namespace {

using test::Outcome;
using test::run_program;

class ChooseTrimsProgram : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  test::TemporaryFolder folder_;
};

TEST_F(ChooseTrimsProgram, PrintsTrimsThatAConfigurationTakes) {
  std::string drive = "t_s,x_m,y_m,yaw_rad\n";
  Pose pose;
  for (int i = 0; i < 300; ++i) {
    char row[120];
    std::snprintf(row, sizeof row, "%.2f,%.9f,%.9f,%.9f\n", 0.02 * i, pose.x_m, pose.y_m,
                  pose.heading_rad);
    drive += row;
    const double steering_rad = i < 100 ? 0.3 : i < 200 ? -0.2 : 0.0;
    pose = vehicle::trim_motion(pose, i < 100 ? 0.5 : 0.8, steering_rad, 0.02,
                                vehicle::VehicleParameters{});
  }
  write("drive.csv", drive);
  const Outcome chosen = run_program("choose_trims " + path("drive.csv") + " --count 4");
  ASSERT_EQ(chosen.exit_code, 0) << chosen.output;
  write("car.yaml",
        "vehicle: {wheelbase_m: 0.15, rear_axle_to_cg_m: 0.075, length_m: 0.22, "
        "width_m: 0.107}\n"
        "limits: {acceleration_mps2: 12, steering_rate_radps: 6.2, speed_min_mps: 0, "
        "speed_max_mps: 3.7, steering_max_rad: 0.62}\n" +
            chosen.output +
            "step_s: 0.2\ncriteria: [J2]\n"
            "subgraphs: [{name: B, label: J2, trims: all, rule: reachable}]\n");
  const maneuver_design::AutomatonConfiguration configuration =
      maneuver_design::read_automaton_configuration(folder_ / "car.yaml");
  ASSERT_EQ(configuration.trims.size(), 4U);
  EXPECT_EQ(configuration.trims[0], automaton::Trim{});
  EXPECT_NEAR(configuration.trims[1].steering_rad, -0.2, 0.02);
  EXPECT_NEAR(configuration.trims[2].steering_rad, 0.0, 0.02);
  EXPECT_NEAR(configuration.trims[3].steering_rad, 0.3, 0.02);
  EXPECT_NEAR(configuration.trims[3].speed_mps, 0.5, 0.02);
}

TEST_F(ChooseTrimsProgram, TakesVehicleAndLimitsOfAFileAndSaysWhichLimitsItTook) {
  write("drive.csv", "speed_mps,steering_rad\n5,0.1\n2,-0.2\n");
  write("car.yaml",
        "vehicle: {wheelbase_m: 2.5, rear_axle_to_cg_m: 1.2, length_m: 4, width_m: 1.6, "
        "identified: kinematic}\n"
        "limits: {acceleration_mps2: 8, steering_rate_radps: 0.4, speed_min_mps: 0, "
        "speed_max_mps: 50, steering_max_rad: 1}\n"
        "notes: of no concern here\n");
  const Outcome own = run_program("choose_trims " + path("drive.csv") +
                                  " --count 3 --configuration " + path("car.yaml"));
  EXPECT_EQ(own.exit_code, 0) << own.output;
  EXPECT_TRUE(
      own.output.starts_with("# limits of car.yaml: 0 ... 50 m/s, +-1 rad; wheelbase 2.5 m\n"))
      << own.output;
  EXPECT_NE(own.output.find("{speed_mps: 5.000, steering_rad: 0.100}"), std::string::npos)
      << own.output;
  const Outcome shipped = run_program("choose_trims " + path("drive.csv") + " --count 3");
  EXPECT_EQ(shipped.exit_code, 0) << shipped.output;
  EXPECT_NE(shipped.output.find("# limits of the uCar: 0 ... 3.7 m/s, +-0.62 rad"),
            std::string::npos)
      << shipped.output;
}

TEST_F(ChooseTrimsProgram, TellsOfSamplesOutsideTheLimitsAndOfReversing) {
  write("drive.csv",
        "speed_mps,steering_rad\n0.5,0.1\n90,0.1\n0.8,-0.9\n0.7,-0.2\n-1,0.1\n-0.5,0\n-0.01,0\n");
  const Outcome outcome = run_program("choose_trims " + path("drive.csv") + " --count 3");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(outcome.output.find(
                "choose_trims: drive.csv: 2 of 7 samples are outside the limits (speed up to 90 "
                "m/s, must be <= 3.7; steering up to 0.9 rad, must be <= 0.62) and count as at the "
                "limit\n"),
            std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("choose_trims: drive.csv: 2 of 7 samples are reversing (up to 1 "
                                "m/s) and are left out\n"),
            std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("# 1, 20.0 %"), std::string::npos) << outcome.output;
}

TEST_F(ChooseTrimsProgram, BadInputIsOneLineAndCode2) {
  write("letters.csv", "speed_mps,steering_rad\n0.5,left\n");
  write("columns.csv", "a,b\n1,2\n");
  write("stands.csv", "speed_mps,steering_rad\n0,0\n");
  const auto refused = [this](const std::string& arguments, const std::string& named) {
    const Outcome outcome = run_program("choose_trims " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find(named), std::string::npos) << outcome.output;
    EXPECT_EQ(outcome.output.find('\n'), outcome.output.size() - 1) << outcome.output;
  };
  refused(path("letters.csv"), "letters.csv:2: steering_rad = \"left\", must be a number");
  refused(path("columns.csv"), "columns.csv:1: columns = a,b, must be");
  refused(path("stands.csv"), "stood for the whole drive");
  refused(path("nowhere.csv"), "nowhere.csv: cannot be read");
  refused(path("stands.csv") + " --count 1", "--count");
  refused("/dev/zero", "/dev/zero: cannot be read");
  write("reverse.csv", "speed_mps,steering_rad\n-1,0\n");
  refused(path("reverse.csv"), "never drove forwards");
  write("no_limits.yaml",
        "vehicle: {wheelbase_m: 2.5, rear_axle_to_cg_m: 1.2, length_m: 4, width_m: 1.6}\n");
  refused(path("stands.csv") + " --configuration " + path("no_limits.yaml"), "limits is missing");
}

}  // namespace
}  // namespace hlc::apps
