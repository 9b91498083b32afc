#include "hlc_bridge/dds/reader.hpp"

#include <utility>

#include "hlc_bridge/dds/drop_log.hpp"
#include "hlc_bridge/dds/endpoint_qos.hpp"
#include "hlc_bridge/dds/reader_endpoint.hpp"
#include "hlc_bridge/dds/sender_check.hpp"
#include "hlc_bridge/dds/wire.hpp"

namespace hlc::dds {
namespace {

// Converts, and passes on what is valid, of its sender, and admitted.
template <class Message>
auto converting(std::function<void(const Message&)> on_message, SenderOf<Message> sender,
                const std::shared_ptr<const ParticipantCore>& core, const std::string& topic) {
  using PubSubType = typename Wire<Message>::PubSubType;
  const auto& admits = core->options().admits;
  return [on_message = std::move(on_message), sender = std::move(sender), admits,
          check = SenderCheck{core, topic}, excess = DropLog{core, topic}](
             const void* sample, const frtps::GUID_t& writer) mutable -> ReaderEndpoint::Fault {
    const auto& wire = *static_cast<const typename Wire<Message>::Type*>(sample);
    const auto incoming = from_wire(wire);
    if (!incoming.message) return {.invalid = incoming.invalid};
    if (sender && !check.accepts(writer, sender(*incoming.message))) return {.is_of_another = true};
    if (admits && !admits(key_of(writer.guidPrefix), message_bytes<PubSubType>(&wire))) {
      excess.log(writer, "as many as a process stores of one publisher are not read yet");
      return {.is_in_excess = true};
    }
    on_message(*incoming.message);
    return {.invalid = incoming.invalid};
  };
}

}  // namespace

template <class Message>
Reader<Message>::Reader(Participant& participant, const Topic<Message>& topic,
                        std::function<void(const Message&)> on_message,
                        std::function<void()> on_matched_change, SenderOf<Message> sender)
    : endpoint_{std::make_unique<ReaderEndpoint>(
          participant.core(), topic.name, type_support<Message>(participant.options().transport),
          topic_qos(topic.id, participant.options().role, participant.options().transport).reader,
          converting<Message>(std::move(on_message), std::move(sender), participant.core(),
                              topic.name),
          std::move(on_matched_change))} {}

template <class Message>
Reader<Message>::~Reader() = default;

template <class Message>
std::size_t Reader<Message>::matched() const {
  return endpoint_->peers().count();
}

template <class Message>
std::set<std::string> Reader<Message>::matched_names() const {
  return endpoint_->peers().names();
}

template <class Message>
bool Reader<Message>::wait_for_matched(std::size_t count,
                                       std::chrono::steady_clock::time_point deadline) const {
  return endpoint_->peers().wait_for(count, deadline);
}

template <class Message>
bool Reader<Message>::wait_for_matched(const std::set<std::string>& names,
                                       std::chrono::steady_clock::time_point deadline) const {
  return endpoint_->peers().wait_for(names, deadline);
}

template <class Message>
std::uint64_t Reader<Message>::dropped() const {
  return endpoint_->dropped();
}

template <class Message>
std::uint64_t Reader<Message>::of_others() const {
  return endpoint_->of_others();
}

template <class Message>
std::uint64_t Reader<Message>::lost() const {
  return endpoint_->lost();
}

template class Reader<VehicleState>;
template class Reader<VehicleObservation>;
template class Reader<VehicleStateList>;
template class Reader<TrajectoryCommand>;
template class Reader<PathTrackingCommand>;
template class Reader<SpeedCurvatureCommand>;
template class Reader<DirectCommand>;
template class Reader<ReadyStatus>;
template class Reader<SystemTrigger>;
template class Reader<Parameter>;
template class Reader<ParameterRequest>;
template class Reader<StopRequest>;
template class Reader<Log>;
template class Reader<LogLevel>;
template class Reader<Visualization>;
template class Reader<GoalState>;
template class Reader<coordination::Traffic>;
template class Reader<coordination::Prediction>;
template class Reader<coordination::Outcome>;
template class Reader<ReportRecord>;
template class Reader<RunState>;
template class Reader<AutomatonRequest>;
template class Reader<AutomatonAnswer>;

}  // namespace hlc::dds
