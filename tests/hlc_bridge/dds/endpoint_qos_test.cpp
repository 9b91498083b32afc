#include "hlc_bridge/dds/endpoint_qos.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>
#include <vector>

namespace hlc::dds::endpoint_qos_test {
namespace {

using Place = std::pair<TopicId, DomainRole>;

const std::vector<Place> kOwn{{TopicId::kTraffic, DomainRole::kController},
                              {TopicId::kPrediction, DomainRole::kController},
                              {TopicId::kOutcome, DomainRole::kController},
                              {TopicId::kReport, DomainRole::kController},
                              {TopicId::kRunState, DomainRole::kController},
                              {TopicId::kAutomatonRequest, DomainRole::kController},
                              {TopicId::kAutomatonAnswer, DomainRole::kController}};

const std::vector<Place> kOfTheLab{{TopicId::kVehicleState, DomainRole::kLab},
                                   {TopicId::kVehicleObservation, DomainRole::kLab},
                                   {TopicId::kVehicleCommand, DomainRole::kLab},
                                   {TopicId::kReadyStatus, DomainRole::kLab},
                                   {TopicId::kSystemTrigger, DomainRole::kLab},
                                   {TopicId::kParameter, DomainRole::kLab},
                                   {TopicId::kParameterRequest, DomainRole::kLab},
                                   {TopicId::kStopRequest, DomainRole::kLab},
                                   {TopicId::kLog, DomainRole::kLab},
                                   {TopicId::kLogLevel, DomainRole::kLab},
                                   {TopicId::kVisualization, DomainRole::kLab},
                                   {TopicId::kGoalState, DomainRole::kLab},
                                   {TopicId::kGoalState, DomainRole::kLocal},
                                   {TopicId::kVehicleStateList, DomainRole::kLocal},
                                   {TopicId::kVehicleCommand, DomainRole::kLocal},
                                   {TopicId::kReadyStatus, DomainRole::kLocal},
                                   {TopicId::kSystemTrigger, DomainRole::kLocal}};

std::vector<Place> all() {
  std::vector<Place> places = kOfTheLab;
  places.insert(places.end(), kOwn.begin(), kOwn.end());
  return places;
}

TEST(TopicQos, WritersOfferWhatReadersAskFor) {
  for (const auto& [id, role] : all()) {
    for (const Transport transport : {Transport::kLoopback, Transport::kLab}) {
      const auto [writer, reader] = topic_qos(id, role, transport);
      EXPECT_GE(writer.reliability, reader.reliability) << static_cast<int>(id);
      EXPECT_GE(writer.durability, reader.durability) << static_cast<int>(id);
    }
  }
}

TEST(TopicQos, LimitsLeaveRoomForEveryInstance) {
  for (const auto& [id, role] : all()) {
    for (const Transport transport : {Transport::kLoopback, Transport::kLab}) {
      const auto [writer, reader] = topic_qos(id, role, transport);
      for (const EndpointQos& qos : {writer, reader}) {
        EXPECT_GE(qos.max_samples_per_instance, qos.history_depth);
        EXPECT_GE(qos.max_samples, qos.max_instances * qos.max_samples_per_instance);
        EXPECT_GE(qos.max_instances, 1);
      }
    }
  }
}

TEST(TopicQos, LoopbackIsReliableKeepsTheLastAndRepairsSoon) {
  using namespace std::chrono_literals;
  for (const auto& [id, role] : all()) {
    const auto [writer, reader] = topic_qos(id, role, Transport::kLoopback);
    for (const EndpointQos& qos : {writer, reader}) {
      EXPECT_EQ(qos.reliability, Reliability::kReliable);
      EXPECT_GT(qos.history_depth, 0) << "keep all blocks the writer when a reader hangs";
      EXPECT_LE(qos.heartbeat_period, 50ms);
      EXPECT_GT(qos.nack_suppression, 0ms) << "a timer would restart with every sample";
      EXPECT_LT(qos.nack_suppression, qos.heartbeat_period) << "the next report counts";
      EXPECT_EQ(qos.nack_response, 0ms);
      EXPECT_LE(qos.heartbeat_response, 10ms);
    }
  }
}

TEST(TopicQos, OwnTopicsAreReliableOnBothTransportsWithAHistoryPerVehicle) {
  for (const auto& [id, role] : kOwn) {
    for (const Transport transport : {Transport::kLoopback, Transport::kLab}) {
      const auto [writer, reader] = topic_qos(id, role, transport);
      EXPECT_EQ(reader.reliability, Reliability::kReliable);
      EXPECT_EQ(writer.max_instances, id == TopicId::kRunState ? 1 : kMaxInstances);
      EXPECT_EQ(reader.max_instances, writer.max_instances);
    }
  }
  for (const TopicId id : {TopicId::kTraffic, TopicId::kPrediction, TopicId::kOutcome}) {
    const auto qos = topic_qos(id, DomainRole::kController, Transport::kLab).writer;
    EXPECT_LE(qos.heartbeat_period, std::chrono::milliseconds{10}) << "a step waits 40 ms at most";
  }
  const auto report = topic_qos(TopicId::kReport, DomainRole::kController, Transport::kLab);
  EXPECT_EQ(report.writer.history_depth, 10'000);
  EXPECT_EQ(report.reader.durability, Durability::kTransientLocal);
}

// The points of the wire contract at which a wrong value means no match or a lost message.
TEST(TopicQos, LabTransportIsTheContract) {
  const auto lab = [](TopicId id, DomainRole role) { return topic_qos(id, role, Transport::kLab); };
  const auto list = lab(TopicId::kVehicleStateList, DomainRole::kLocal);
  EXPECT_EQ(list.reader.reliability, Reliability::kBestEffort);
  const auto ready = lab(TopicId::kReadyStatus, DomainRole::kLocal);
  EXPECT_EQ(ready.writer.reliability, Reliability::kReliable);
  EXPECT_EQ(ready.reader.history_depth, 0);
  for (const DomainRole role : {DomainRole::kLab, DomainRole::kLocal}) {
    const auto trigger = lab(TopicId::kSystemTrigger, role);
    EXPECT_EQ(trigger.reader.reliability, Reliability::kReliable);
    EXPECT_EQ(trigger.reader.durability, Durability::kVolatile);
  }
  const auto state = lab(TopicId::kVehicleState, DomainRole::kLab);
  EXPECT_EQ(state.writer.reliability, Reliability::kBestEffort);
  EXPECT_EQ(state.writer.history_depth, 1);
  EXPECT_EQ(state.reader.history_depth, 0);
  const auto command = lab(TopicId::kVehicleCommand, DomainRole::kLocal);
  // Not the lab's depth of 1, which counts over all vehicles: commands of one writer for several
  // may come back to back.
  EXPECT_EQ(command.reader.history_depth, 0);
  EXPECT_EQ(command.reader.reliability, Reliability::kBestEffort);
  EXPECT_EQ(lab(TopicId::kParameterRequest, DomainRole::kLab).reader.reliability,
            Reliability::kBestEffort);
  const auto level = lab(TopicId::kLogLevel, DomainRole::kLab);
  EXPECT_EQ(level.writer.durability, Durability::kTransientLocal);
  EXPECT_EQ(level.reader.durability, Durability::kTransientLocal);
  for (const DomainRole role : {DomainRole::kLab, DomainRole::kLocal}) {
    const auto goal = lab(TopicId::kGoalState, role);
    EXPECT_EQ(goal.writer.durability, Durability::kTransientLocal);
    EXPECT_EQ(goal.writer.history_depth, 0);
    EXPECT_EQ(goal.reader.reliability, Reliability::kReliable);
  }
}

TEST(TopicQos, ATopicOnTheWrongDomainIsRefused) {
  EXPECT_THROW(
      static_cast<void>(topic_qos(TopicId::kTraffic, DomainRole::kLab, Transport::kLoopback)),
      std::invalid_argument);
  EXPECT_THROW(static_cast<void>(topic_qos(TopicId::kVehicleState, DomainRole::kController,
                                           Transport::kLoopback)),
               std::invalid_argument);
}

}  // namespace
}  // namespace hlc::dds::endpoint_qos_test
