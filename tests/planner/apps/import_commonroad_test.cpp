// The program that makes a scenario of a CommonRoad file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "planner/common/text_file.hpp"
#include "tests/support/commonroad_samples.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test::import_commonroad_test {
namespace {

using testing::HasSubstr;

class ImportCommonRoad : public testing::Test {
 protected:
  /// One car on one lane.
  void put_problem(double speed_mps) const {
    write_file(problem(), CommonRoadSketch()
                              .lane(1, straight({0.0, 0.0}, {80.0, 0.0}))
                              .problem(7, {10.0, 0.0, 0.0},
                                       {rectangle_at({60.0, 0.0, 0.0}, {10.0, 3.0})}, speed_mps)
                              .xml());
  }
  [[nodiscard]] Outcome import(const std::string& more = "") const {
    return run_program("import_commonroad --commonroad " + problem() +
                       " --like passenger_cars_in_town --out " + out() + more);
  }
  [[nodiscard]] std::string problem() const { return folder_ / "problem.xml"; }
  [[nodiscard]] std::string out() const { return folder_ / "problem.yaml"; }

  const TemporaryFolder folder_;
};

TEST_F(ImportCommonRoad, WritesAScenarioThatOtherProgramsDrive) {
  put_problem(0.0);
  const Outcome imported = import();
  ASSERT_EQ(imported.exit_code, 0) << imported.output;
  EXPECT_THAT(imported.output, HasSubstr("vehicle 1: problem 7, 50.0 m to its goal\n"));
  EXPECT_THAT(imported.output, HasSubstr("120 steps of 0.5 s"));
  EXPECT_EQ(run_program("show_scenario --scenario " + out()).exit_code, 0);
  const Outcome driven = run_program("rollout --scenario " + out());
  EXPECT_EQ(driven.exit_code, 0) << driven.output;
  EXPECT_THAT(driven.output, HasSubstr("vehicle 1 arrived at its goal after"));
}

TEST_F(ImportCommonRoad, RefusesWhatCannotBeHonouredInOneLineAndWritesNothing) {
  put_problem(8.0);
  const Outcome refused = import();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.output,
            "import_commonroad: " + problem() +
                ": planning problem 7: velocity of the initial state is 8 m/s, must be 0: vehicles "
                "begin standing; with --from_standstill true this one does, too\n");
  EXPECT_FALSE(std::filesystem::exists(out()));
  EXPECT_EQ(import(" --from_standstill true").exit_code, 0);
}

TEST_F(ImportCommonRoad, DoesNotWriteOverItsInput) {
  put_problem(0.0);
  const Outcome refused = run_program("import_commonroad --commonroad " + problem() +
                                      " --like passenger_cars_in_town --out " + problem());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("--out = "));
}

}  // namespace
}  // namespace hlc::test::import_commonroad_test
