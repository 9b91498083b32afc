#include "hlc_bridge/hlc/operator_notes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planner/controller/east_bound.hpp"

namespace hlc::high_level_controller::operator_notes_test {
namespace {

using testing::ElementsAre;

TEST(OperatorNotes, LogThatAVehicleIsStuckOnceInAWait) {
  const auto controller = controller::east_bound::controller(1);
  OperatorNotes notes;
  HlcActions actions;
  for (std::uint64_t k = 100; k < 320; ++k) {
    coordination::Report report{
        .vehicle = {1}, .step = {k}, .status = coordination::StepStatus::kPlanned};
    if (k != 210) report.waiting = {.vehicles = {{4}}, .since = {k < 210 ? 100U : 211U}};
    notes.note_step(*controller, report, actions);
  }
  std::vector<machine::LogLine> lines;
  for (const HlcAction& action : actions.take())
    lines.push_back(std::get<machine::LogLine>(action));
  const machine::LogLine line = machine::warning(
      "stuck: vehicle 1, waiting for 4 for 20.0 s, although its road would be free without the "
      "others; it has not moved since its controller began: if that was at the start of the run, "
      "place the vehicles elsewhere");
  EXPECT_THAT(lines, ElementsAre(line, line));
}

}  // namespace
}  // namespace hlc::high_level_controller::operator_notes_test
