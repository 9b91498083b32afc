#include "hlc_bridge/dds/writer.hpp"

#include <utility>

#include "hlc_bridge/dds/endpoint_qos.hpp"
#include "hlc_bridge/dds/message_stamp.hpp"
#include "hlc_bridge/dds/wire.hpp"
#include "hlc_bridge/dds/writer_endpoint.hpp"

namespace hlc::dds {

template <class Message>
Writer<Message>::Writer(Participant& participant, const Topic<Message>& topic,
                        std::function<void()> on_matched_change)
    : endpoint_{std::make_unique<WriterEndpoint>(
          participant.core(), topic.name, type_support<Message>(participant.options().transport),
          topic_qos(topic.id, participant.options().role, participant.options().transport).writer,
          std::move(on_matched_change))} {}

template <class Message>
Writer<Message>::~Writer() = default;

template <class Message>
bool Writer<Message>::write(const Message& message) {
  if constexpr (requires { can_be_written(message); }) {
    if (!can_be_written(message)) {
      return false;
    }
  }
  typename Wire<Message>::Type sample;
  to_wire(message, sample);
  if (!endpoint_->write(&sample)) return false;
  if (endpoint_->is_observed()) endpoint_->observe(&sample, stamp_of(message));
  return true;
}

template <class Message>
std::size_t Writer<Message>::matched() const {
  return endpoint_->peers().count();
}

template <class Message>
std::set<std::string> Writer<Message>::matched_names() const {
  return endpoint_->peers().names();
}

template <class Message>
bool Writer<Message>::wait_for_matched(std::size_t count,
                                       std::chrono::steady_clock::time_point deadline) const {
  return endpoint_->peers().wait_for(count, deadline);
}

template <class Message>
bool Writer<Message>::wait_for_matched(const std::set<std::string>& names,
                                       std::chrono::steady_clock::time_point deadline) const {
  return endpoint_->peers().wait_for(names, deadline);
}

template class Writer<VehicleState>;
template class Writer<VehicleObservation>;
template class Writer<VehicleStateList>;
template class Writer<TrajectoryCommand>;
template class Writer<PathTrackingCommand>;
template class Writer<SpeedCurvatureCommand>;
template class Writer<DirectCommand>;
template class Writer<ReadyStatus>;
template class Writer<SystemTrigger>;
template class Writer<Parameter>;
template class Writer<ParameterRequest>;
template class Writer<StopRequest>;
template class Writer<Log>;
template class Writer<LogLevel>;
template class Writer<Visualization>;
template class Writer<GoalState>;
template class Writer<coordination::Traffic>;
template class Writer<coordination::Prediction>;
template class Writer<coordination::Outcome>;
template class Writer<ReportRecord>;
template class Writer<RunState>;
template class Writer<AutomatonRequest>;
template class Writer<AutomatonAnswer>;

}  // namespace hlc::dds
