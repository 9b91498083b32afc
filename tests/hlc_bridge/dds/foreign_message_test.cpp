// Messages that none of our writers would send.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "hlc_bridge/dds/endpoint_qos.hpp"
#include "hlc_bridge/dds/participant_core.hpp"
#include "hlc_bridge/dds/wire.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/dds/writer_endpoint.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc::dds::foreign_message_test {
namespace {

/// Bytes that claim to be of another type.
class BytesType : public fdds::TopicDataType {
 public:
  explicit BytesType(const std::string& claimed_type) {
#if HLC_FAST_DDS == 3
    set_name(claimed_type);
    max_serialized_type_size = 1024;
#else
    setName(claimed_type.c_str());
    m_typeSize = 1024;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
#endif
  }

 private:
  using Bytes = std::vector<unsigned char>;
  using Payload = SerializedPayload;

  static bool copy(const void* data, Payload& payload) {
    const Bytes& bytes = *static_cast<const Bytes*>(data);
    payload.encapsulation = CDR_LE;
    std::copy(bytes.begin(), bytes.end(), payload.data);
    payload.length = size(data);
    return true;
  }
  static std::uint32_t size(const void* data) {
    return static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->size());
  }
#if HLC_FAST_DDS == 3
  bool serialize(const void* data, Payload& payload, fdds::DataRepresentationId_t) override {
    return copy(data, payload);
  }
  bool deserialize(Payload&, void*) override { return false; }
  std::uint32_t calculate_serialized_size(const void* data, fdds::DataRepresentationId_t) override {
    return size(data);
  }
  void* create_data() override { return new Bytes; }
  void delete_data(void* data) override { delete static_cast<Bytes*>(data); }
  bool compute_key(Payload&, frtps::InstanceHandle_t&, bool) override { return false; }
  bool compute_key(const void*, frtps::InstanceHandle_t&, bool) override { return false; }
#else
  bool serialize(void* data, Payload* payload) override { return copy(data, *payload); }
  bool deserialize(Payload*, void*) override { return false; }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return size(data); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, frtps::InstanceHandle_t*, bool) override { return false; }
#endif
};

class ForeignMessages : public testing::Test {
 protected:
  test::DomainReservation domain_;
  Participant honest_{on_loopback("honest", domain_.first(), DomainRole::kLab)};
  Participant foreign_{on_loopback("foreign", domain_.first(), DomainRole::kLab)};
  Participant receiver_{on_loopback("receiver", domain_.first(), DomainRole::kLab)};
};

TEST_F(ForeignMessages, BytesThatAreNoMessageAreSkippedAndTheReaderGoesOn) {
  const Topic<VehicleState> topic = topics::vehicle_state(1);
  Mailbox<VehicleState> mailbox{receiver_, topic};
  Writer<VehicleState> writer{honest_, topic};
  WriterEndpoint endpoint{foreign_.core(),
                          topic.name,
                          fdds::TypeSupport{new BytesType{"VehicleState"}},
                          topic_qos(topic.id, DomainRole::kLab, Transport::kLoopback).writer,
                          {}};
  ASSERT_TRUE(mailbox.reader().wait_for_matched({"honest", "foreign"}, soon()));
  ASSERT_TRUE(writer.wait_for_matched(1, soon()));
  ASSERT_TRUE(endpoint.peers().wait_for(1, soon()));
  std::vector<unsigned char> neither_true_nor_false(4 + 145, 0);
  neither_true_nor_false[1] = 1;  // little-endian CDR
  neither_true_nor_false.back() = 7;
  const std::vector<std::vector<unsigned char>> payloads{{},
                                                         {0, 1, 0, 0},
                                                         {0, 9, 0, 0, 1, 2, 3},
                                                         std::vector<unsigned char>(1000, 0xAB),
                                                         neither_true_nor_false};
  for (std::vector<unsigned char> payload : payloads) {
    endpoint.write(&payload);
    VehicleState state;
    state.vehicle_id = 1;
    ASSERT_TRUE(writer.write(state));
  }
  const auto received = mailbox.wait_for(payloads.size());
  ASSERT_EQ(received.size(), payloads.size());
  for (const VehicleState& state : received) {
    EXPECT_EQ(state.vehicle_id, 1);
  }
}

// A list that claims to be longer than its message must not make the reader ask for that much
// memory.
TEST_F(ForeignMessages, ListsThatClaimToBeEndlessAreSkipped) {
  const Topic<ReadyStatus> good = topics::ready_status();
  Mailbox<ReadyStatus> mailbox{receiver_, good};
  Writer<ReadyStatus> writer{honest_, good};
  const Topic<Parameter> topic = topics::parameter();
  Mailbox<Parameter> parameters{receiver_, topic};
  WriterEndpoint endpoint{foreign_.core(),
                          topic.name,
                          fdds::TypeSupport{new BytesType{"Parameter"}},
                          topic_qos(topic.id, DomainRole::kLab, Transport::kLoopback).writer,
                          {}};
  ASSERT_TRUE(parameters.reader().wait_for_matched({"foreign"}, soon()));
  ASSERT_TRUE(endpoint.peers().wait_for(1, soon()));
  ASSERT_TRUE(writer.wait_for_matched(1, soon()));
  std::vector<unsigned char> endless_name{0, 1, 0, 0, 255, 255, 255, 255, 'a'};
  endpoint.write(&endless_name);
  std::vector<unsigned char> endless_list(4 + 64, 0);
  endless_list[1] = 1;
  endless_list[4] = 1;  // the empty name
  for (int i = 0; i < 4; ++i) {
    endless_list[4U + 24U + static_cast<unsigned>(i)] = 255;  // length of values_int32
  }
  endpoint.write(&endless_list);
  std::vector<unsigned char> at_last(4 + 64, 0);
  at_last[1] = 1;
  at_last[4] = 1;
  endpoint.write(&at_last);
  EXPECT_EQ(parameters.wait_for(1).size(), 1U);
  ASSERT_TRUE(writer.write({"still here", 1}));
  EXPECT_EQ(mailbox.wait_for(1).size(), 1U);
}

TEST_F(ForeignMessages, InvalidValuesAreDroppedAndCounted) {
  const Topic<VehicleState> topic = topics::vehicle_state(1);
  Mailbox<VehicleState> mailbox{receiver_, topic};
  Writer<VehicleState> writer{honest_, topic};
  ASSERT_TRUE(writer.wait_for_matched(1, soon()));
  VehicleState state;
  state.speed_mps = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(writer.write(state));
  state.speed_mps = 1.0;
  ASSERT_TRUE(writer.write(state));
  const auto received = mailbox.wait_for(1);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received.front().speed_mps, 1.0);
  EXPECT_EQ(mailbox.reader().dropped(), 1U);
}

/// A type of ours as our writers have it.
fdds::TypeSupport outcome_type() {
  return type_support<coordination::Outcome>(Transport::kLoopback);
}

// Every key that a reader has received takes one of its instances until the end.
TEST(ForeignKeys, InvalidVehicleIdsTakeNoInstanceFromAVehicle) {
  const test::DomainReservation domain;
  Participant honest{on_loopback("honest", domain.first(), DomainRole::kController)};
  Participant foreign{on_loopback("foreign", domain.first(), DomainRole::kController)};
  Participant receiver{on_loopback("receiver", domain.first(), DomainRole::kController)};
  const Topic<coordination::Outcome> topic = topics::outcome();
  Mailbox<coordination::Outcome> mailbox{receiver, topic};
  Writer<coordination::Outcome> writer{honest, topic};
  EndpointQos qos = topic_qos(topic.id, DomainRole::kController, Transport::kLoopback).writer;
  qos.max_instances = 256;
  qos.max_samples = qos.max_instances * qos.max_samples_per_instance;
  WriterEndpoint endpoint{foreign.core(), topic.name, outcome_type(), qos, {}};
  ASSERT_TRUE(mailbox.reader().wait_for_matched({"honest", "foreign"}, soon()));
  ASSERT_TRUE(writer.wait_for_matched(1, soon()));
  ASSERT_TRUE(endpoint.peers().wait_for(1, soon()));
  const auto write = [&](int id) {
    OutcomeMessage message;
    message.vehicle_id(static_cast<std::uint8_t>(id));
    endpoint.write(&message);
  };
  constexpr int kInvalid = 40;
  for (int id = 0; id < kInvalid; ++id) write(255 - id);
  write(1);
  EXPECT_EQ(mailbox.wait_for(1).size(), 1U);
  ASSERT_TRUE(writer.write({.vehicle = VehicleId{kMaxLabVehicleId}}));
  EXPECT_EQ(mailbox.wait_for(2).size(), 2U);
  EXPECT_EQ(mailbox.reader().dropped(), static_cast<std::uint64_t>(kInvalid));
}

}  // namespace
}  // namespace hlc::dds::foreign_message_test
