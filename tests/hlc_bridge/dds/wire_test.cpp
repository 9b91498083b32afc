#include "hlc_bridge/dds/wire.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/hlc_bridge/dds/sample_messages.hpp"

namespace hlc::dds::wire_test {
namespace {

using Bytes = std::vector<unsigned char>;

template <class Message>
Bytes serialized(const Message& message) {
  const auto type = type_support<Message>(Transport::kLab);
  typename Wire<Message>::Type wire;
  to_wire(message, wire);
  SerializedPayload payload{serialized_size(*type, &wire)};
  EXPECT_TRUE(serialize(*type, &wire, payload));
  return Bytes(payload.data, payload.data + payload.length);
}

template <class Message>
bool deserializes(const Bytes& bytes) {
  const auto type = type_support<Message>(Transport::kLab);
  SerializedPayload payload{static_cast<std::uint32_t>(bytes.size())};
  std::copy(bytes.begin(), bytes.end(), payload.data);
  payload.length = static_cast<std::uint32_t>(bytes.size());
  typename Wire<Message>::Type wire;
  return deserialize(*type, payload, &wire);
}

TEST(WireType, ABooleanThatIsNeitherTrueNorFalseIsNoMessage) {
  Bytes bytes = serialized(VehicleState{});
  ASSERT_TRUE(deserializes<VehicleState>(bytes));
  bytes.back() = 7;
  EXPECT_FALSE(deserializes<VehicleState>(bytes));
}

template <class Message>
class WireTypes : public testing::Test {};
TYPED_TEST_SUITE(WireTypes, AllMessages);

// Cut off, overwritten in places, or both: a message or not, but never an exception, and never a
// value that our checks let through although it is not finite (from_wire is called on whatever can
// be read).
TYPED_TEST(WireTypes, DamagedBytesAreReadOrRefused) {
  const unsigned seed = 5;
  SCOPED_TRACE(seed);
  std::mt19937_64 random{seed};
  const auto type = type_support<TypeParam>(Transport::kLab);
  for (int i = 0; i < 2000; ++i) {
    Bytes bytes = serialized(sample<TypeParam>(random));
    const auto cut = random() % 2 == 0 ? bytes.size() : random() % (bytes.size() + 1);
    bytes.resize(cut);
    for (std::uint64_t hits = random() % 4; hits > 0 && !bytes.empty(); --hits) {
      bytes[random() % bytes.size()] =
          static_cast<unsigned char>(random() % 3 == 0 ? 255 : random());
    }
    SerializedPayload payload{static_cast<std::uint32_t>(bytes.size() + 1)};
    std::copy(bytes.begin(), bytes.end(), payload.data);
    payload.length = static_cast<std::uint32_t>(bytes.size());
    typename Wire<TypeParam>::Type wire;
    bool readable = false;
    ASSERT_NO_THROW(readable = deserialize(*type, payload, &wire));
    if (readable) {
      Incoming<TypeParam> incoming = from_wire(wire);
      ASSERT_TRUE(incoming.message.has_value() || incoming.invalid > 0);
      if (incoming.message) {
        if constexpr (std::is_same_v<TypeParam, ReportRecord>) {  // words, which may be any
          incoming.message->report.maneuver.clear();
          incoming.message->report.subgraph.clear();
          incoming.message->report.plan.clear();
        }
        const std::string content = text(*incoming.message);
        if constexpr (std::is_same_v<TypeParam, AutomatonRequest>) {
          ASSERT_TRUE(std::isfinite(incoming.message->subgraph.max_speed_mps.value_or(0.0)));
        }
        // But for those that hold words, which may be any, and goals, which are not read here.
        if constexpr (!std::is_same_v<TypeParam, ReadyStatus> && !std::is_same_v<TypeParam, Log> &&
                      !std::is_same_v<TypeParam, Parameter> &&
                      !std::is_same_v<TypeParam, Visualization> &&
                      !std::is_same_v<TypeParam, ParameterRequest> &&
                      !std::is_same_v<TypeParam, GoalState> &&
                      !std::is_same_v<TypeParam, AutomatonRequest> &&
                      !std::is_same_v<TypeParam, AutomatonAnswer>) {
          ASSERT_EQ(content.find("nan"), std::string::npos);
          ASSERT_EQ(content.find("inf"), std::string::npos);
        }
      }
    }
  }
}

}  // namespace
}  // namespace hlc::dds::wire_test
