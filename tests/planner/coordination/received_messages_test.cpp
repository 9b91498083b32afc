#include "planner/coordination/received_messages.hpp"

#include <gtest/gtest.h>

#include "planner/geometry/footprint.hpp"

namespace hlc::coordination::received_messages_test {
namespace {

Prediction from(std::uint8_t vehicle, std::uint64_t step) {
  return {.vehicle = {vehicle},
          .step = {step},
          .areas = {.first = {step + 1}, .final_area_m = footprint_area({1.0, 1.0}, {})}};
}

TEST(ReceivedMessages, AreFoundBySenderAndStep) {
  const ReceivedMessages<Prediction> messages({from(3, 7), from(2, 6), from(2, 7)});
  EXPECT_TRUE(messages.contains({2}));
  EXPECT_FALSE(messages.contains({1}));
  ASSERT_NE(messages.find({2}, {7}), nullptr);
  EXPECT_EQ(messages.find({2}, {7})->step, StepIndex{7});
  EXPECT_EQ(messages.find({3}, {6}), nullptr) << "of another step";
  EXPECT_EQ(messages.find({1}, {7}), nullptr);
}

TEST(ReceivedMessages, TheLastOfASenderCountsAndIsNotCopied) {
  ReceivedMessages<Prediction> messages;
  const auto last = std::make_shared<const Prediction>(from(2, 7));
  for (const std::uint8_t vehicle : std::vector<std::uint8_t>{4, 2, 3}) {
    messages.put(std::make_shared<const Prediction>(from(vehicle, 7)));
  }
  messages.put(last);
  EXPECT_EQ(messages.find({2}, {7}), last);
  for (const VehicleId vehicle : {VehicleId{2}, VehicleId{3}, VehicleId{4}}) {
    EXPECT_NE(messages.find(vehicle, {7}), nullptr);
  }
}

TEST(ReceivedMessages, AMalformedOneIsNotReceived) {
  Prediction nowhere = from(2, 7);
  nowhere.areas.final_area_m = {};
  EXPECT_EQ(ReceivedMessages<Prediction>({nowhere}).find({2}, {7}), nullptr);
}

}  // namespace
}  // namespace hlc::coordination::received_messages_test
