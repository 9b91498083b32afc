// ParticipantOptions::on_published.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "hlc_bridge/dds/serialized.hpp"
#include "hlc_bridge/dds/wire.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc::dds::published_message_test {
namespace {

struct Published {
  DomainRole role{};
  std::string topic;
  std::string type;
  std::string cdr;
  std::optional<Nanoseconds> time;
  std::optional<StepIndex> step;
};

class PublishedMessages : public testing::Test {
 protected:
  Participant participant(DomainRole role) {
    ParticipantOptions options = on_loopback("sender", domain_.first(), role);
    options.on_published = [this](const PublishedMessage& message) {
      published_.push_back({message.role, message.topic, message.type, std::string(message.cdr),
                            message.stamp.time, message.stamp.step});
    };
    return Participant(options);
  }

  test::DomainReservation domain_;
  std::vector<Published> published_;
};

TEST_F(PublishedMessages, EveryMessageIsObservedWithItsBytesAndItsStamp) {
  Participant sender = participant(DomainRole::kLab);
  Writer<VehicleState> writer(sender, topics::vehicle_state(3));
  const VehicleState state{.vehicle_id = 3, .create_stamp = 40, .speed_mps = 0.7};
  ASSERT_TRUE(writer.write(state));
  ASSERT_EQ(published_.size(), 1U);
  EXPECT_EQ(published_[0].role, DomainRole::kLab);
  EXPECT_EQ(published_[0].topic, "vehicle/3/vehicleState");
  EXPECT_EQ(published_[0].type, "VehicleState");
  EXPECT_EQ(published_[0].time, 40U);
  EXPECT_FALSE(published_[0].step);

  SerializedPayload payload(static_cast<std::uint32_t>(published_[0].cdr.size()));
  std::ranges::copy(published_[0].cdr, payload.data);
  payload.length = static_cast<std::uint32_t>(published_[0].cdr.size());
  ::VehicleState wire;
  ASSERT_TRUE(deserialize(*type_support<VehicleState>(Transport::kLoopback), payload, &wire));
  EXPECT_EQ(wire.vehicle_id(), 3);
  EXPECT_EQ(wire.speed(), 0.7);
}

TEST_F(PublishedMessages, AMessageOfAStepHasItsStep) {
  Participant sender = participant(DomainRole::kController);
  Writer<ReportRecord> reports(sender, topics::report());
  ReportRecord record;
  record.report.vehicle = VehicleId{2};
  record.report.step = StepIndex{7};
  ASSERT_TRUE(reports.write(record));
  ASSERT_EQ(published_.size(), 1U);
  EXPECT_EQ(published_[0].type, "hlc::ReportMessage");
  EXPECT_EQ(published_[0].step, StepIndex{7});
}

TEST_F(PublishedMessages, ATriggerBeginsItsTimeAndTheStopSymbolIsNoTime) {
  Participant sender = participant(DomainRole::kLab);
  Writer<SystemTrigger> triggers(sender, topics::system_trigger());
  ASSERT_TRUE(triggers.write({.next_start = 20}));
  ASSERT_TRUE(triggers.write({.next_start = kStopSymbol}));
  ASSERT_EQ(published_.size(), 2U);
  EXPECT_EQ(published_[0].time, 20U);
  EXPECT_FALSE(published_[1].time);
}

template <class Message>
void expect_read_back(const Topic<Message>& topic, Participant& sender,
                      const std::vector<Published>& published) {
  std::mt19937_64 random(11);
  Writer<Message> writer(sender, topic);
  const auto message = sample<Message>(random);
  ASSERT_TRUE(writer.write(message));
  const std::string& cdr = published.back().cdr;
  const std::optional<Message> back = message_from<Message>(cdr);
  ASSERT_TRUE(back);
  EXPECT_EQ(text(*back), text(message));
  EXPECT_FALSE(message_from<Message>(std::string_view(cdr).substr(0, cdr.size() / 2)));
  EXPECT_FALSE(message_from<Message>(""));
}

TEST_F(PublishedMessages, OfAStepAreReadBackFromTheirBytes) {
  Participant sender = participant(DomainRole::kController);
  expect_read_back(topics::traffic(), sender, published_);
  expect_read_back(topics::prediction(), sender, published_);
  expect_read_back(topics::outcome(), sender, published_);
  Participant middleware = participant(DomainRole::kLocal);
  expect_read_back(topics::vehicle_state_list(), middleware, published_);
}

TEST_F(PublishedMessages, AMessageThatIsNotAcceptedIsNotObserved) {
  Participant sender = participant(DomainRole::kController);
  Writer<ReportRecord> reports(sender, topics::report());
  EXPECT_FALSE(reports.write({}));  // vehicle 0
  EXPECT_TRUE(published_.empty());
}

}  // namespace
}  // namespace hlc::dds::published_message_test
