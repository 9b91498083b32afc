// step_benchmark as it is called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/common/text_file.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test::step_benchmark_program_test {
namespace {

using testing::HasSubstr;

const std::string kScenario =
    " --scenario " + source_folder() + "/launch_scripts/scenarios/lab_cars.yaml";

TEST(StepBenchmark, EveryNumberOfCarsHasARowAndThePictureIsDrawn) {
  const TemporaryFolder folder;
  const std::string plot = folder / "growth.svg";
  const Outcome outcome = run_program(
      "step_benchmark --cars 1,34 --steps 2 --draws 1 --repeats 2 --plot " + plot + kScenario);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("\n| 1 | "));
  EXPECT_THAT(outcome.output, HasSubstr("\n| 34 | "));
  EXPECT_THAT(read_file(plot), HasSubstr("<svg"));
}

TEST(StepBenchmark, MoreCarsThanFitAreRefusedWithHowManyDo) {
  const Outcome outcome = run_program("step_benchmark --cars 200 --steps 1" + kScenario);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("--cars = 200, must be in 1 ... 60: no more cars fit"));
}

}  // namespace
}  // namespace hlc::test::step_benchmark_program_test
