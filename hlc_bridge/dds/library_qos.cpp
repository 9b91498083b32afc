#include "hlc_bridge/dds/library_qos.hpp"

#include "hlc_bridge/dds/library.hpp"

namespace hlc::dds {
namespace {

// Common to writers and readers.
template <class LibraryQos>
void set_common(const EndpointQos& qos, LibraryQos& result) {
  result.reliability().kind = qos.reliability == Reliability::kReliable
                                  ? fdds::RELIABLE_RELIABILITY_QOS
                                  : fdds::BEST_EFFORT_RELIABILITY_QOS;
  result.reliability().max_blocking_time = to_duration(qos.max_blocking);
  result.durability().kind = qos.durability == Durability::kTransientLocal
                                 ? fdds::TRANSIENT_LOCAL_DURABILITY_QOS
                                 : fdds::VOLATILE_DURABILITY_QOS;
  const bool keep_all = qos.history_depth == 0;
  result.history().kind = keep_all ? fdds::KEEP_ALL_HISTORY_QOS : fdds::KEEP_LAST_HISTORY_QOS;
  result.history().depth = keep_all ? 1 : qos.history_depth;
  result.resource_limits().max_instances = qos.max_instances;
  result.resource_limits().max_samples_per_instance = qos.max_samples_per_instance;
  result.resource_limits().max_samples = qos.max_samples;
  result.liveliness().kind = fdds::AUTOMATIC_LIVELINESS_QOS;
  result.data_sharing().off();
  result.endpoint().history_memory_policy = qos.preallocated
                                                ? frtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE
                                                : frtps::DYNAMIC_REUSABLE_MEMORY_MODE;
}

}  // namespace

fdds::DataWriterQos writer_qos(const EndpointQos& qos) {
  fdds::DataWriterQos result;
  set_common(qos, result);
  result.publish_mode().kind = fdds::SYNCHRONOUS_PUBLISH_MODE;
  auto& times = result.reliable_writer_qos().times;
  times.*kHeartbeatPeriod = to_duration(qos.heartbeat_period);
  times.*kInitialHeartbeatDelay = to_duration(qos.heartbeat_delay);
  times.*kNackResponseDelay = to_duration(qos.nack_response);
  times.*kNackSuppression = to_duration(qos.nack_suppression);
  return result;
}

fdds::DataReaderQos reader_qos(const EndpointQos& qos) {
  fdds::DataReaderQos result;
  set_common(qos, result);
  auto& times = result.reliable_reader_qos().times;
  times.*kInitialAcknackDelay = to_duration(qos.initial_acknack);
  times.*kHeartbeatResponseDelay = to_duration(qos.heartbeat_response);
  return result;
}

}  // namespace hlc::dds
