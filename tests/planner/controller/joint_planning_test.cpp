// Every controller computes the new plans of the others from their traffic, bit for bit as these
// compute them.
#include "planner/controller/joint_planning.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "planner/controller/followed_plan.hpp"
#include "planner/controller/joint_step.hpp"
#include "planner/coordination/digest.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"

namespace hlc::controller {
namespace {

struct Run {
  std::string name;
  std::string file;
  std::optional<std::size_t> cars;
  std::size_t steps{};
};

void PrintTo(const Run& run, std::ostream* out) { *out << run.name; }

/// Controllers of a scenario, each with what it plans for the others.
class JointRun {
 public:
  explicit JointRun(const scenario::Scenario& scenario) {
    const PreparedSubgraph prepared = scenario::prepare_subgraph_of(scenario);
    for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
      controllers_.push_back(scenario::make_controller(scenario, vehicle.id, prepared));
      Controller& one = *controllers_.back();
      const vehicle::State standing{.pose = vehicle.start};
      static_cast<void>(one.stand_by(
          {.step = {0},
           .active = {vehicle.id},
           .states = {as_measured(vehicle.id, standing, one.subgraph().automaton())}}));
      joint_.emplace_back(one.options().others);
      active_.push_back(vehicle.id);
    }
  }

  [[nodiscard]] Observation observation(std::uint64_t step) const {
    Observation result{.step = {step}, .active = active_, .states = {}, .present = active_};
    for (const auto& one : controllers_) result.states.push_back(on_its_plan(*one, {step}));
    return result;
  }

  /// One step without loss. Counts the plans that a controller computed for another vehicle.
  void step(std::uint64_t k) {
    std::vector<coordination::Traffic> traffic;
    const Observation seen = observation(k);
    for (const auto& one : controllers_) traffic.push_back(one->observe(seen));
    for (const auto& one : controllers_) one->couple(traffic);
    std::map<VehicleId, coordination::ReceivedMessages<coordination::Prediction>> computed;
    std::vector<coordination::Prediction> own;
    for (std::size_t i = 0; i < controllers_.size(); ++i) {
      ASSERT_TRUE(joint_[i].prepare(*controllers_[i]).empty()) << "step " << k << ", car " << i;
      const VehicleId id = active_[i];
      computed[id] = joint_[i].plan(*controllers_[i]);
      own.push_back(*computed[id].find(id, {k}));
    }
    for (const auto& [by, predictions] : computed) {
      for (const auto& one : predictions.all()) {
        const auto real = std::ranges::find(own, one->vehicle, &coordination::Prediction::vehicle);
        ASSERT_EQ(digest_of(*one), digest_of(*real))
            << "step " << k << ", plan of " << int{one->vehicle.value} << " by " << int{by.value};
        num_for_others_ += one->vehicle != by;
        num_new_ += one->vehicle != by && one->is_new;
      }
    }
    for (const auto& one : controllers_) static_cast<void>(one->commit(own, {}));
  }

  [[nodiscard]] std::vector<Controller*> controllers() const {
    std::vector<Controller*> result;
    for (const auto& one : controllers_) result.push_back(one.get());
    return result;
  }
  [[nodiscard]] int num_for_others() const { return num_for_others_; }
  [[nodiscard]] int num_new() const { return num_new_; }

 private:
  std::vector<std::unique_ptr<Controller>> controllers_;
  std::vector<JointPlanning> joint_;
  std::vector<VehicleId> active_;
  int num_for_others_{};
  int num_new_{};
};

scenario::Scenario scenario_of(const Run& run) {
  scenario::Scenario scenario = scenario::read_scenario(
      {.file = std::filesystem::path(test::source_folder()) / "launch_scripts/scenarios" / run.file,
       .cars = run.cars});
  scenario.rounds = Rounds::kTwo;
  return scenario;
}

class JointPlans : public testing::TestWithParam<Run> {};

TEST_P(JointPlans, AreThoseOfEachVehicleItself) {
  JointRun run(scenario_of(GetParam()));
  for (std::uint64_t k = 1; k <= GetParam().steps; ++k) {
    run.step(k);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(run.num_for_others(), static_cast<int>(GetParam().steps));
  EXPECT_GT(run.num_new(), static_cast<int>(GetParam().steps));
}

// The other one is driven as ever: by predictions.
TEST_P(JointPlans, AreThoseOfTheSequentialWay) {
  const scenario::Scenario scenario = scenario_of(GetParam());
  JointRun joint(scenario);
  JointRun sequential(scenario);
  for (std::uint64_t k = 1; k <= GetParam().steps; ++k) {
    joint.step(k);
    if (testing::Test::HasFatalFailure()) return;
    static_cast<void>(joint_step(sequential.controllers(), sequential.observation(k)));
    for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) {
      const coordination::Plan& a = joint.controllers()[i]->plan_in_force();
      const coordination::Plan& b = sequential.controllers()[i]->plan_in_force();
      ASSERT_EQ(a.end(), b.end()) << "step " << k;
      for (StepIndex step{k}; step <= a.end(); ++step.value) {
        ASSERT_EQ(a.pose_at(step), b.pose_at(step)) << "step " << k;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, JointPlans,
                         testing::Values(Run{"LabCars", "lab_cars.yaml", 20, 20},
                                         Run{"PaperThreeCars", "paper_three_cars.yaml", {}, 100},
                                         Run{"Circle", "circle.yaml", 6, 60},
                                         Run{"LabThreeCars", "lab_three_cars.yaml", {}, 60},
                                         Run{"LabRing", "lab_ring.yaml", {}, 60}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace hlc::controller
