#include "hlc_bridge/lab_control/arrival_notice.hpp"

#include <gtest/gtest.h>

namespace hlc::lab_control::arrival_notice_test {
namespace {

coordination::Report report(std::uint64_t k, std::optional<StepIndex> arrived_since) {
  return {.vehicle = {2}, .step = {k}, .arrived_since = arrived_since};
}

TEST(Arrival, IsNoticedOnceAndAgainAfterTheVehicleLeft) {
  ArrivalNotice notice;
  EXPECT_FALSE(notice.note(report(100, std::nullopt), {100}, 0.2));
  EXPECT_EQ(notice.note(report(162, StepIndex{162}), {100}, 0.2).value(),
            "vehicle 2 arrived at its goal after 12.4 s");
  EXPECT_FALSE(notice.note(report(163, StepIndex{162}), {100}, 0.2));
  EXPECT_FALSE(notice.note(report(164, std::nullopt), {100}, 0.2));
  EXPECT_EQ(notice.note(report(170, StepIndex{170}), {100}, 0.2).value(),
            "vehicle 2 arrived at its goal after 14.0 s");
}

}  // namespace
}  // namespace hlc::lab_control::arrival_notice_test
