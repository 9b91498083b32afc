#include "hlc_bridge/record/facts_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/temporary_folder.hpp"

namespace hlc::record {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

result::RunFacts some_facts() {
  result::RunFacts facts;
  facts.simulated_time = true;
  facts.vehicle_ids = {1, 2, 7};
  facts.period = 200'000'000;
  facts.steps = 150;
  facts.first_step = 8'500'000'005;
  facts.wall_s = 1.25;
  facts.clock_s = 31.2;
  facts.exit_code = 4;
  facts.reason = "died: middleware_2";
  facts.died = {{"middleware_2", "it left"}, {"high_level_controller_2", "it left"}};
  return facts;
}

TEST(FactsFile, ReadsBackEveryFact) {
  const test::TemporaryFolder folder;
  const result::RunFacts facts = some_facts();
  test::put(folder / "run.json", facts_json(facts));
  const result::RunFacts read = read_facts(folder / "run.json");
  EXPECT_EQ(read.simulated_time, facts.simulated_time);
  EXPECT_EQ(read.vehicle_ids, facts.vehicle_ids);
  EXPECT_EQ(read.period, facts.period);
  EXPECT_EQ(read.steps, facts.steps);
  EXPECT_EQ(read.first_step, facts.first_step);
  EXPECT_EQ(read.wall_s, facts.wall_s);
  EXPECT_EQ(read.clock_s, facts.clock_s);
  EXPECT_EQ(read.exit_code, facts.exit_code);
  EXPECT_EQ(read.reason, facts.reason);
  EXPECT_EQ(read.died, facts.died);
}

TEST(FactsFile, RunThatNeverStartedHasNoFirstStep) {
  const test::TemporaryFolder folder;
  result::RunFacts facts = some_facts();
  facts.first_step.reset();
  test::put(folder / "run.json", facts_json(facts));
  EXPECT_FALSE(read_facts(folder / "run.json").first_step);
}

TEST(FactsFile, BrokenFileIsNamed) {
  const test::TemporaryFolder folder;
  for (const std::string& bad : {std::string{"{"}, std::string{"{}"}, std::string{"[1]"},
                                 std::string{"{\"simulated_time\": 3}"}}) {
    test::put(folder / "run.json", bad);
    EXPECT_THAT([&] { (void)read_facts(folder / "run.json"); },
                ThrowsMessage<std::runtime_error>(HasSubstr("run.json: ")))
        << bad;
  }
}

}  // namespace
}  // namespace hlc::record
