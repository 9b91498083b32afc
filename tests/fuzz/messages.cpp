// Bytes of messages: which type, then CDR with its encapsulation header, as Reader gets them.
#include <CommonroadObstacleListPubSubTypes.h>
#include <HLCHelloPubSubTypes.h>
#include <RoundTripTimePubSubTypes.h>

#include <random>

#include "hlc_bridge/dds/wire.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"

namespace hlc::fuzz {
namespace {

template <class PubSubType, class Wire>
bool is_read(std::string_view cdr, Wire& wire) {
  dds::TolerantType<PubSubType> type{false};
  dds::SerializedPayload payload(static_cast<std::uint32_t>(cdr.size()));
  std::ranges::copy(cdr, reinterpret_cast<char*>(payload.data));
  payload.length = static_cast<std::uint32_t>(cdr.size());
  return dds::deserialize(type, payload, &wire);
}

template <class Message>
void convert(std::string_view cdr) {
  typename dds::Wire<Message>::Type wire;
  if (!is_read<typename dds::Wire<Message>::PubSubType>(cdr, wire)) return;
  const auto incoming = dds::from_wire(wire);
  if (!incoming.message && incoming.invalid == 0) throw std::logic_error("neither valid nor not");
}

template <class PubSubType>
void deserialize(std::string_view cdr) {
  typename PubSubType::type wire;
  static_cast<void>(is_read<PubSubType>(cdr, wire));
}

template <class Message>
std::string serialized(std::mt19937_64& random) {
  const auto type = dds::type_support<Message>(dds::Transport::kLab);
  typename dds::Wire<Message>::Type wire;
  dds::to_wire(dds::sample<Message>(random), wire);
  dds::SerializedPayload payload{dds::serialized_size(*type, &wire)};
  static_cast<void>(dds::serialize(*type, &wire, payload));
  return {reinterpret_cast<const char*>(payload.data), payload.length};
}

template <class... Messages>
struct Types {
  explicit Types(testing::Types<Messages...>) {}

  const std::vector<void (*)(std::string_view)> readers{
      convert<Messages>..., deserialize<CommonroadObstacleListPubSubType>,
      deserialize<HLCHelloPubSubType>, deserialize<RoundTripTimePubSubType>};

  void read(std::string_view bytes) const {
    if (bytes.empty()) return;
    readers[static_cast<unsigned char>(bytes.front()) % readers.size()](bytes.substr(1));
  }
  [[nodiscard]] std::vector<std::string> samples() const {
    std::mt19937_64 random(1);
    std::vector<std::string> all{serialized<Messages>(random)...};
    all.resize(readers.size(), std::string("\0\1\0\0", 4) + std::string(40, '\0'));
    for (std::size_t i = 0; i < all.size(); ++i) all[i].insert(0, 1, static_cast<char>(i));
    return all;
  }
};

}  // namespace

std::vector<Target> message_targets() {
  static const Types kTypes{dds::AllMessages{}};
  return {{"messages", [](std::string_view bytes) { kTypes.read(bytes); },
           [] { return kTypes.samples(); }}};
}

}  // namespace hlc::fuzz
