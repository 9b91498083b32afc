// What the lab's vehicles can follow: the file, the automata, and what controllers plan on them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <regex>
#include <string>

#include "planner/automaton/lab_check.hpp"
#include "planner/controller/trajectory.hpp"
#include "planner/scenario/lab_file.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::scenario::lab_test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

const std::string kFolder = test::source_folder() + "/launch_scripts/";
const std::string kLabFile = kFolder + "labs/cpm_lab.yaml";

std::string content_of(const std::string& path) {
  std::ifstream file(path);
  return {(std::istreambuf_iterator<char>(file)), {}};
}

/// A file in the folder with the shipped text but for one change; its references go to the shipped
/// files.
std::string changed_file(const test::TemporaryFolder& folder, const std::string& source,
                         const std::string& from, const std::string& to) {
  std::string text = content_of(source);
  text = std::regex_replace(text, std::regex(R"(\.\./)"), kFolder);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  const std::string path = folder / std::filesystem::path(source).filename().string();
  std::ofstream(path) << text;
  return path;
}

template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

const Scenario& lab_scenario() {
  static const Scenario scenario =
      read_scenario({.file = kFolder + "scenarios/lab_three_cars.yaml"});
  return scenario;
}

TEST(LabFile, HoldsTheLimitsOfTheLabsVehicle) {
  const vehicle::LabLimits lab = read_lab(kLabFile, 0.2);
  EXPECT_EQ(lab.curvature_min_per_m, -3.960);
  EXPECT_EQ(lab.curvature_max_per_m, 4.316);
  EXPECT_EQ(lab.acceleration_max_mps2, 20.0);
  EXPECT_EQ(lab.x_max_m, 4.5);
  EXPECT_EQ(lab.y_max_m, 4.0);
}

// The steering s = -1 ... 1 of the identified vehicle, solved for the curvature.
TEST(LabFile, ItsCurvaturesAreThoseOfTheIdentifiedVehicleAtFullSteering) {
  const vehicle::LabLimits lab = read_lab(kLabFile, 0.2);
  const vehicle::IdentifiedVehicle vehicle;
  EXPECT_NEAR(vehicle::steady_steering(lab.curvature_max_per_m, vehicle),
              1.0 + vehicle.steering_offset, 1e-3);
  EXPECT_NEAR(vehicle::steady_steering(lab.curvature_min_per_m, vehicle),
              -1.0 + vehicle.steering_offset, 1e-3);
}

TEST(LabFile, ErrorsNameLineValueAndWhatIsAllowed) {
  const auto error_text = [](const std::string& from, const std::string& to) {
    const test::TemporaryFolder folder;
    const std::string file = changed_file(folder, kLabFile, from, to);
    return error_of([&] { static_cast<void>(read_lab(file, 0.2)); });
  };
  EXPECT_THAT(error_text("curvature_min_per_m: -3.960", "curvature_min_per_m: 3.960"),
              AllOf(HasSubstr(":5: curvature_min_per_m = 3.960"), HasSubstr("must be")));
  EXPECT_THAT(error_text("point_interval_s: 0.025", "point_interval_s: 0.03"),
              HasSubstr("point_interval_s = 0.03, must be a divisor of the automaton's step of "
                        "0.2 s"));
  EXPECT_THAT(error_text("x_max_m: 4.5", "x_max_m: -4.5"), HasSubstr("area.x_max_m = -4.5"));
  EXPECT_THAT(error_text("y_max_m: 4.0", "y_top_m: 4.0"), HasSubstr("y_max_m"));
  EXPECT_THAT(error_text("pose_lead_s: 0.020", "pose_lead_s: 0.101"),
              HasSubstr("pose_lead_s = 0.101, must be"));
  for (const char* bad : {"-0.001", ".nan", "soon"}) {
    EXPECT_THAT(error_text("pose_lead_s: 0.020", std::string("pose_lead_s: ") + bad),
                HasSubstr("pose_lead_s"));
  }
  EXPECT_THAT(error_text("tracking_error_max_m: 0.035", "tracking_error_max_m: -1"),
              HasSubstr("tracking_error_max_m = -1"));
  EXPECT_THAT(error_text("area:", "speed: 3\narea:"), HasSubstr("speed"));
}

TEST(Lab, ThePapersAutomatonIsRefusedWithTheTrimThatIsTooTight) {
  const test::TemporaryFolder folder;
  const std::string file = changed_file(folder, kFolder + "scenarios/lab_three_cars.yaml",
                                        "automata/lab.yaml", "automata/paper.yaml");
  const std::string error_text =
      error_of([&] { static_cast<void>(read_scenario({.file = file})); });
  EXPECT_THAT(
      error_text,
      AllOf(HasSubstr("automata/paper.yaml: subgraph B, trim 2: curvature = -4.31"),
            HasSubstr(" 1/m, must be in -3.96 ... 4.316 by "), EndsWith("labs/cpm_lab.yaml")));
  EXPECT_EQ(error_text.find('\n'), std::string::npos);
}

TEST(Lab, AnAutomatonIsRefusedForAManeuverWhoseTrimsCanBeDriven) {
  const test::TemporaryFolder folder;
  const std::string automaton =
      changed_file(folder, kFolder + "automata/lab.yaml", "curvature_max_per_m: 3.75",
                   "curvature_max_per_m: 9.0");
  const std::string file = changed_file(folder, kFolder + "scenarios/lab_circle.yaml",
                                        kFolder + "automata/lab.yaml", automaton);
  EXPECT_THAT(error_of([&] { static_cast<void>(read_scenario({.file = file})); }),
              AllOf(HasSubstr("subgraph B, maneuver 1 -> "), HasSubstr("(J2): curvature = ")));
}

TEST(Lab, EachBoundCountsForAutomata) {
  const automaton::Subgraph& subgraph = *lab_scenario().subgraph;
  const vehicle::LabLimits lab = *lab_scenario().lab;
  EXPECT_EQ(automaton::validate_for_lab(subgraph, lab), "");
  vehicle::LabLimits left = lab;
  left.curvature_max_per_m = 3.0;
  EXPECT_THAT(automaton::validate_for_lab(subgraph, left), HasSubstr("trim 11: curvature = 3.0"));
  vehicle::LabLimits right = lab;
  right.curvature_min_per_m = -3.0;
  EXPECT_THAT(automaton::validate_for_lab(subgraph, right), HasSubstr("trim 2: curvature = -3.5"));
  vehicle::LabLimits slow = lab;
  slow.acceleration_max_mps2 = 3.9;
  EXPECT_THAT(automaton::validate_for_lab(subgraph, slow), HasSubstr("acceleration = "));
  vehicle::LabLimits exact = lab;
  exact.velocity_mismatch_max_mps = 1e-5;
  EXPECT_THAT(automaton::validate_for_lab(subgraph, exact), HasSubstr("differ by "));
}

/// A plan from somewhere, of random edges, standing at the end.
coordination::Plan random_plan(const automaton::Subgraph& subgraph, std::mt19937_64& random,
                               std::size_t steps) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const TrimId standstill = subgraph.standstill();
  const automaton::Maneuver& stand =
      *subgraph.automaton().find(standstill, standstill, automaton::kSelfLoopLabel);
  std::vector<const automaton::Maneuver*> maneuvers;
  TrimId at = standstill;
  for (std::size_t left = steps; left > 0; --left) {
    const auto edges = subgraph.successors(at, left);
    const automaton::Edge& edge = edges[random() % edges.size()];
    maneuvers.push_back(edge.maneuver);
    at = edge.to;
  }
  const Pose start{2.25 + 0.5 * unit(random), 2.0 + 0.5 * unit(random), 3.0 * unit(random)};
  return coordination::Plan({100}, start, stand).continued({101}, maneuvers);
}

// So the check of a command finds only faults of the program.
TEST(Lab, NoPlanOnAnAutomatonThatIsAcceptedHasAFault) {
  const automaton::Subgraph& subgraph = *lab_scenario().subgraph;
  vehicle::LabLimits lab = *lab_scenario().lab;
  lab.x_min_m = lab.y_min_m = -10.0;
  lab.x_max_m = lab.y_max_m = 10.0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const coordination::Plan plan = random_plan(subgraph, random, 8);
    for (std::uint64_t step = 100; step < 110; ++step) {
      const auto fault = vehicle::trajectory_fault(
          controller::sample_trajectory(plan, {step}, lab.point_interval_s, 2.25, 0.2,
                                        subgraph.automaton().vehicle),
          lab);
      ASSERT_FALSE(fault) << vehicle::to_text(*fault, lab) << " at " << fault->time_s << " s";
    }
  }
}

controller::Observation seen_at(StepIndex step, const Pose& pose) {
  return {.step = step,
          .active = {{1}},
          .states = {{.vehicle = {1}, .pose = pose, .speed_mps = 0.0, .age_s = 0.0}},
          .present = {{1}}};
}

coordination::Report first_step(const Scenario& scenario) {
  const auto controller = make_controller(scenario, {1});
  const Pose pose = measured_start(scenario, scenario.vehicles.front());
  static_cast<void>(controller->stand_by(seen_at({10}, pose)));
  static_cast<void>(controller->observe(seen_at({11}, pose)));
  controller->couple({});
  const coordination::Prediction prediction = controller->plan({});
  const coordination::Report report = controller->commit({}, {});
  EXPECT_EQ(prediction.is_new, report.status == coordination::StepStatus::kPlanned)
      << "a plan that is not driven is not announced";
  return report;
}

TEST(Lab, APlanThatLeavesTheAreaDoesNotComeIntoForceAndTheReportSaysSo) {
  EXPECT_EQ(first_step(lab_scenario()).status, coordination::StepStatus::kPlanned);
  Scenario narrow = lab_scenario();
  const Point start = narrow.vehicles.front().start.position_m();
  narrow.lab->x_min_m = start.x() - 0.01;
  narrow.lab->x_max_m = start.x() + 0.01;
  const coordination::Report report = first_step(narrow);
  EXPECT_EQ(report.status, coordination::StepStatus::kFallback);
  EXPECT_EQ(report.reason, coordination::FallbackReason::kUndrivable);
}

}  // namespace
}  // namespace hlc::scenario::lab_test
