#include "hlc_bridge/dds/library_qos.hpp"

#include <gtest/gtest.h>

#include "hlc_bridge/dds/library.hpp"

namespace hlc::dds::library_qos_test {
namespace {

using std::chrono::milliseconds;

EndpointQos every_value_different() {
  EndpointQos qos;
  qos.reliability = Reliability::kReliable;
  qos.durability = Durability::kTransientLocal;
  qos.history_depth = 3;
  qos.max_instances = 5;
  qos.max_samples_per_instance = 4;
  qos.max_samples = 20;
  qos.max_blocking = milliseconds{1001};
  qos.heartbeat_period = milliseconds{1002};
  qos.heartbeat_delay = milliseconds{1003};
  qos.nack_response = milliseconds{1004};
  qos.nack_suppression = milliseconds{1005};
  qos.initial_acknack = milliseconds{1006};
  qos.heartbeat_response = milliseconds{1007};
  return qos;
}

template <class LibraryQos>
void expect_common(const LibraryQos& qos) {
  EXPECT_EQ(qos.reliability().kind, fdds::RELIABLE_RELIABILITY_QOS);
  EXPECT_EQ(qos.reliability().max_blocking_time, to_duration(milliseconds{1001}));
  EXPECT_EQ(qos.durability().kind, fdds::TRANSIENT_LOCAL_DURABILITY_QOS);
  EXPECT_EQ(qos.history().kind, fdds::KEEP_LAST_HISTORY_QOS);
  EXPECT_EQ(qos.history().depth, 3);
  EXPECT_EQ(qos.resource_limits().max_instances, 5);
  EXPECT_EQ(qos.resource_limits().max_samples_per_instance, 4);
  EXPECT_EQ(qos.resource_limits().max_samples, 20);
  EXPECT_EQ(qos.data_sharing().kind(), fdds::OFF);
  EXPECT_EQ(qos.endpoint().history_memory_policy, frtps::DYNAMIC_REUSABLE_MEMORY_MODE);
}

TEST(LibraryQos, WritersGetEveryValueOfTheTable) {
  const auto qos = writer_qos(every_value_different());
  expect_common(qos);
  EXPECT_EQ(qos.publish_mode().kind, fdds::SYNCHRONOUS_PUBLISH_MODE);
  const auto& times = qos.reliable_writer_qos().times;
  EXPECT_EQ(times.*kHeartbeatPeriod, to_duration(milliseconds{1002}));
  EXPECT_EQ(times.*kInitialHeartbeatDelay, to_duration(milliseconds{1003}));
  EXPECT_EQ(times.*kNackResponseDelay, to_duration(milliseconds{1004}));
  EXPECT_EQ(times.*kNackSuppression, to_duration(milliseconds{1005}));
}

TEST(LibraryQos, ReadersGetEveryValueOfTheTable) {
  const auto qos = reader_qos(every_value_different());
  expect_common(qos);
  const auto& times = qos.reliable_reader_qos().times;
  EXPECT_EQ(times.*kInitialAcknackDelay, to_duration(milliseconds{1006}));
  EXPECT_EQ(times.*kHeartbeatResponseDelay, to_duration(milliseconds{1007}));
}

TEST(LibraryQos, TheOtherValuesOfTheTableToo) {
  EndpointQos table = every_value_different();
  table.reliability = Reliability::kBestEffort;
  table.durability = Durability::kVolatile;
  table.history_depth = 0;
  table.preallocated = true;
  const auto qos = reader_qos(table);
  EXPECT_EQ(qos.reliability().kind, fdds::BEST_EFFORT_RELIABILITY_QOS);
  EXPECT_EQ(qos.durability().kind, fdds::VOLATILE_DURABILITY_QOS);
  EXPECT_EQ(qos.history().kind, fdds::KEEP_ALL_HISTORY_QOS);
  EXPECT_EQ(qos.data_sharing().kind(), fdds::OFF);
  EXPECT_EQ(qos.endpoint().history_memory_policy, frtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE);
}

TEST(Duration, SplitsSecondsAndNanoseconds) {
  const auto duration = to_duration(milliseconds{1234});
  EXPECT_EQ(duration.seconds, 1);
  EXPECT_EQ(duration.nanosec, 234'000'000U);
}

}  // namespace
}  // namespace hlc::dds::library_qos_test
