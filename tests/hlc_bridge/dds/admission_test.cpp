// Messages that a reader does not pass on, since there are too many of them, or they are too long.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "hlc_bridge/dds/writer.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc::dds::admission_test {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

class Admission : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(reports_.reader().wait_for_matched(1, soon()));
    ASSERT_TRUE(writer_.wait_for_matched(1, soon()));
  }

  void publish(std::uint64_t step, std::size_t bytes) {
    std::mt19937_64 random(1);
    auto record = sample<ReportRecord>(random);
    record.report.step = {step};
    record.report.waiting = {};
    record.report.arrived_since = {};
    record.report.plan.assign(100, {.to = {0}, .label = std::string(bytes / 100, 'l')});
    ASSERT_TRUE(writer_.write(record));
  }

  ParticipantOptions receiver() {
    ParticipantOptions options = on_loopback("receiver", domain_.first(), DomainRole::kController);
    options.admits = [](const ParticipantKey&, std::size_t bytes) { return bytes < 20'000; };
    options.on_loss = [this](const std::string& line) { lines_.push_back(line); };
    return options;
  }

  test::DomainReservation domain_;
  std::vector<std::string> lines_;  ///< of the thread that receives; read when it has passed on
  Participant peer_{on_loopback("peer", domain_.first(), DomainRole::kController)};
  Participant receiver_{receiver()};
  Mailbox<ReportRecord> reports_{receiver_, topics::report()};
  Writer<ReportRecord> writer_{peer_, topics::report()};
};

TEST_F(Admission, WhatAProcessHasNoRoomForIsDroppedCountedAndLoggedOnce) {
  publish(1, 40'000);
  publish(2, 40'000);
  publish(3, 100);
  const std::vector<ReportRecord> received = reports_.wait_for(1);
  ASSERT_THAT(received, SizeIs(1));
  EXPECT_EQ(received[0].report.step, StepIndex{3});
  EXPECT_EQ(reports_.reader().lost(), 2U);
  ASSERT_THAT(lines_, SizeIs(1));
  EXPECT_THAT(lines_[0], HasSubstr("topic hlc/report: messages of participant \"peer\""));
}

// A reliable reader otherwise waits for each message before it passes on the next.
TEST_F(Admission, AMessageThatIsTooLongIsPassedOver) {
  publish(1, 1'000'000);
  publish(2, 100);
  const std::vector<ReportRecord> received = reports_.wait_for(1);
  ASSERT_THAT(received, SizeIs(1));
  EXPECT_EQ(received[0].report.step, StepIndex{2});
}

}  // namespace
}  // namespace hlc::dds::admission_test
