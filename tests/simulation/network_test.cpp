#include "vehicle_sim/closed_loop/simulated_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace hlc::closed_loop {
namespace {

constexpr Nanoseconds kMilli = kNanosecondsPerMillisecond;

/// Two processes: one writes vehicle states, triggers and run states, the other one reads them.
class Network : public testing::Test {
 protected:
  enum Topics : std::size_t { kStates, kTriggers, kRunStates };

  void use(Transport transport) {
    network_ = SimulatedNetwork(queue_, {.seed = 3, .transport = transport});
  }
  NodeId join_writer(const std::string& name = "writer") {
    return network_.join(
        {.name = name,
         .writes = {{TopicId::kVehicleState, 1}, {TopicId::kSystemTrigger}, {TopicId::kRunState}},
         .reads = {}});
  }
  NodeId join_reader() {
    return network_.join(
        {.name = "reader",
         .writes = {},
         .reads = {{TopicId::kVehicleState, 1}, {TopicId::kSystemTrigger}, {TopicId::kRunState}}});
  }
  /// Lets time pass; what arrives is kept by topic of the reader.
  void pass(Nanoseconds time) {
    queue_.add(queue_.now() + time, {.what = EventKind::kAlarm});
    while (true) {
      Event event = queue_.take();
      if (event.what == EventKind::kAlarm) return;
      if (event.what == EventKind::kDiscovery) {
        static_cast<void>(network_.discover(event));
      } else if (const auto arrival = network_.arrive(std::move(event))) {
        arrived_.push_back(arrival->topic);
        if (const auto* trigger = std::get_if<SystemTrigger>(arrival->message.get())) {
          triggers_.push_back(trigger->next_start);
        }
      }
    }
  }
  [[nodiscard]] std::ptrdiff_t num_arrived(std::size_t topic) const {
    return std::ranges::count(arrived_, topic);
  }
  [[nodiscard]] bool sees(NodeId node, const std::string& name) const {
    return network_.participants(node, Domain::kLab).alive.contains(name);
  }

  EventQueue queue_{kNanosecondsPerSecond};
  SimulatedNetwork network_{queue_, {.seed = 3}};
  std::vector<std::size_t> arrived_;
  std::vector<Nanoseconds> triggers_;
};

TEST_F(Network, OnlyWhoSeesEachOtherHearsEachOther) {
  const NodeId writer = join_writer();
  const NodeId reader = join_reader();
  network_.publish(writer, kStates, VehicleState{});
  EXPECT_TRUE(network_.readers(writer, kStates).empty());
  pass(kNanosecondsPerSecond);
  EXPECT_EQ(num_arrived(kStates), 0);
  EXPECT_TRUE(network_.readers(writer, kStates).contains("reader"));
  EXPECT_TRUE(network_.writers(reader, kStates).contains("writer"));
  network_.publish(writer, kStates, VehicleState{});
  pass(2 * kMilli);
  EXPECT_EQ(num_arrived(kStates), 1);
}

TEST_F(Network, ALateReaderGetsWhatIsKeptForIt) {
  const NodeId writer = join_writer();
  network_.publish(writer, kRunStates, RunState{});
  network_.publish(writer, kTriggers, SystemTrigger{.next_start = 1});
  join_reader();
  pass(kNanosecondsPerSecond);
  EXPECT_EQ(num_arrived(kRunStates), 1);
  EXPECT_EQ(num_arrived(kTriggers), 0);
}

TEST_F(Network, WhoIsKilledIsMissedWhenItsLeaseHasRunOutAndWhoLeavesAtOnce) {
  const NodeId killed = join_writer("killed");
  const NodeId leaving = join_writer("leaving");
  const NodeId reader = join_reader();
  pass(kNanosecondsPerSecond);
  network_.crash(killed);
  network_.leave(leaving);
  pass(10 * kMilli);
  EXPECT_TRUE(sees(reader, "killed"));
  EXPECT_FALSE(sees(reader, "leaving"));
  EXPECT_TRUE(network_.participants(reader, Domain::kLab).lost.contains("leaving"));
  pass(2 * kNanosecondsPerSecond);
  EXPECT_FALSE(sees(reader, "killed"));
}

TEST_F(Network, ANameIsThereAsLongAsOneOfThoseThatBearItIs) {
  const NodeId first = join_writer("name");
  const NodeId reader = join_reader();
  pass(kNanosecondsPerSecond);
  network_.crash(first);
  join_writer("name");
  pass(kNanosecondsPerSecond / 2);
  EXPECT_TRUE(sees(reader, "name"));
  pass(3 * kNanosecondsPerSecond);
  EXPECT_TRUE(sees(reader, "name"));
}

TEST_F(Network, AShortCutDelaysWhatIsReliableAndLosesTheRest) {
  use(Transport::kLab);
  const NodeId writer = join_writer();
  const NodeId reader = join_reader();
  pass(kNanosecondsPerSecond);
  const Cut cut{.from = "writer", .to = "reader"};
  network_.add(cut);
  network_.publish(writer, kStates, VehicleState{});
  network_.publish(writer, kTriggers, SystemTrigger{.next_start = 1});
  network_.publish(writer, kTriggers, SystemTrigger{.next_start = 2});
  pass(kNanosecondsPerSecond);
  EXPECT_EQ(num_arrived(kTriggers), 0);
  EXPECT_TRUE(sees(reader, "writer"));
  network_.remove(cut);
  pass(5 * kMilli);
  EXPECT_EQ(triggers_, std::vector<Nanoseconds>{2});  // the lab's writer keeps one
  EXPECT_EQ(num_arrived(kStates), 0);
}

TEST_F(Network, ACutThatLastsLongerThanTheLeaseLosesThemAndThenTheyFindEachOtherAgain) {
  const NodeId writer = join_writer();
  const NodeId reader = join_reader();
  pass(kNanosecondsPerSecond);
  const Cut cut{.from = "writer", .to = ""};
  network_.add(cut);
  pass(2 * kNanosecondsPerSecond + 10 * kMilli);
  EXPECT_FALSE(sees(reader, "writer"));
  EXPECT_TRUE(sees(writer, "reader"));  // one way only
  network_.publish(writer, kTriggers, SystemTrigger{.next_start = 1});
  network_.remove(cut);
  pass(kNanosecondsPerSecond);
  EXPECT_TRUE(sees(reader, "writer"));
  EXPECT_EQ(triggers_, std::vector<Nanoseconds>{1});  // its writer saw the reader all the time
}

TEST_F(Network, ReliableTopicsKeepTheirOrderUnlessItIsDisturbed) {
  const NodeId writer = join_writer();
  join_reader();
  pass(kNanosecondsPerSecond);
  const Disturbance delay{.lost = 0.5, .delay = 100 * kMilli};
  network_.add(delay);
  for (Nanoseconds i = 0; i < 100; ++i) network_.publish(writer, kTriggers, SystemTrigger{i});
  pass(2 * kNanosecondsPerSecond);
  EXPECT_EQ(triggers_.size(), 100U);
  EXPECT_TRUE(std::ranges::is_sorted(triggers_));
  network_.remove(delay);
  network_.add(Disturbance{.overtaken = 0.5, .overtake_delay = 100 * kMilli});
  triggers_.clear();
  for (Nanoseconds i = 0; i < 100; ++i) network_.publish(writer, kTriggers, SystemTrigger{i});
  pass(2 * kNanosecondsPerSecond);
  EXPECT_EQ(triggers_.size(), 100U);
  EXPECT_FALSE(std::ranges::is_sorted(triggers_));
}

TEST_F(Network, WhatIsLostOrRepeatedIsAShareOfAll) {
  use(Transport::kLab);
  const NodeId writer = join_writer();
  join_reader();
  pass(kNanosecondsPerSecond);
  const auto share = [&](const Disturbance& disturbance, Topics topic) {
    arrived_.clear();
    network_.add(disturbance);
    for (int i = 0; i < 1000; ++i) {
      if (topic == kStates) network_.publish(writer, topic, VehicleState{});
      if (topic == kTriggers) network_.publish(writer, topic, SystemTrigger{});
    }
    network_.remove(disturbance);
    pass(kNanosecondsPerSecond);
    return static_cast<double>(num_arrived(topic)) / 1000.0;
  };
  EXPECT_NEAR(share({.lost = 0.3}, kStates), 0.7, 0.05);
  EXPECT_EQ(share({.lost = 0.3}, kTriggers), 1.0);
  EXPECT_NEAR(share({.withheld = 0.3}, kTriggers), 0.7, 0.05);
  EXPECT_NEAR(share({.repeated = 0.3}, kStates), 1.3, 0.05);
  EXPECT_EQ(share({.from = "reader", .withheld = 1.0}, kStates), 1.0);
}

TEST_F(Network, AFloodRepeatsTheNewestMessageAtItsRateUntilTheNextOne) {
  const NodeId writer = join_writer();
  join_reader();
  pass(kNanosecondsPerSecond);
  const Disturbance flood{.from = "writer", .flood_hz = 2000.0};
  network_.add(flood);
  for (int i = 0; i < 50; ++i) {
    network_.publish(writer, kStates, VehicleState{.vehicle_id = 1});
    pass(20 * kMilli);
  }
  EXPECT_NEAR(static_cast<double>(num_arrived(kStates)), 2000.0 + 50.0 + 400.0, 100.0)
      << "the first message is repeated for 200 ms";
  network_.remove(flood);
  pass(kNanosecondsPerSecond);
  arrived_.clear();
  network_.publish(writer, kStates, VehicleState{.vehicle_id = 1});
  pass(kNanosecondsPerSecond);
  EXPECT_EQ(num_arrived(kStates), 1);
}

TEST_F(Network, WhoStandsStillShowsNoSignOfLifeAndMissesSomeWhenItGoesOn) {
  const NodeId writer = join_writer();
  const NodeId reader = join_reader();
  pass(kNanosecondsPerSecond);
  network_.freeze(writer);
  pass(3 * kNanosecondsPerSecond);
  EXPECT_FALSE(sees(reader, "writer"));
  network_.resume(writer);
  pass(kNanosecondsPerSecond);
  EXPECT_TRUE(sees(reader, "writer"));
  EXPECT_TRUE(sees(writer, "reader"));
}

}  // namespace
}  // namespace hlc::closed_loop
