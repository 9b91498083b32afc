#include "hlc_bridge/hlc/step_mailbox.hpp"

#include <gtest/gtest.h>

namespace hlc {
namespace {

Outcome outcome(std::uint8_t vehicle, std::uint64_t step) {
  return {.vehicle = {vehicle}, .step = {step}};
}

TEST(StepMailbox, MessagesOfTheStepAreThereAndOthersAreNot) {
  StepMailbox<Outcome> mailbox;
  mailbox.begin({5});
  mailbox.put(outcome(2, 5));
  mailbox.put(outcome(3, 6));
  EXPECT_TRUE(mailbox.holds({2}));
  EXPECT_FALSE(mailbox.holds({3}));
  EXPECT_EQ(mailbox.all().size(), 1U);
}

TEST(StepMailbox, MessagesThatCameEarlyWaitForTheirStep) {
  StepMailbox<Outcome> mailbox;
  mailbox.begin({5});
  mailbox.put(outcome(3, 6));
  mailbox.begin({6});
  EXPECT_TRUE(mailbox.holds({3}));
}

TEST(StepMailbox, OldMessagesAndThoseFarAheadAreDropped) {
  StepMailbox<Outcome> mailbox;
  mailbox.begin({5});
  mailbox.put(outcome(2, 4));
  mailbox.put(outcome(2, 500));
  mailbox.begin({500});
  EXPECT_FALSE(mailbox.holds({2}));
}

TEST(StepMailbox, SendersAreSortedWhateverTheOrderOfArrival) {
  StepMailbox<Outcome> mailbox;
  for (const unsigned vehicle : {9U, 1U, 4U})
    mailbox.put(outcome(static_cast<std::uint8_t>(vehicle), 0));
  const std::vector<Outcome> all = mailbox.all();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].vehicle, VehicleId{1});
  EXPECT_EQ(all[2].vehicle, VehicleId{9});
}

}  // namespace
}  // namespace hlc
