// What the transports touch of the machine, read from /proc.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "hlc_bridge/dds/fast_dds.hpp"
#include "hlc_bridge/dds/wire.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc::dds::confinement_test {
namespace {

/// Files in /dev/shm that this process has mapped.
std::set<std::string> shared_memory_files() {
  std::set<std::string> files;
  std::ifstream maps{"/proc/self/maps"};
  for (std::string line; std::getline(maps, line);) {
    const auto at = line.find("/dev/shm/");
    if (at != std::string::npos) {
      files.insert(line.substr(at));
    }
  }
  return files;
}

/// Local addresses, as /proc writes them, of this process's UDP sockets (IPv4) and of IPv6 ones, if
/// any.
std::set<std::string> udp_addresses() {
  std::set<std::string> inodes;
  for (const auto& file : std::filesystem::directory_iterator{"/proc/self/fd"}) {
    std::error_code error;
    const std::string target = std::filesystem::read_symlink(file, error).string();
    if (target.starts_with("socket:[")) {
      inodes.insert(target.substr(8, target.size() - 9));
    }
  }
  std::set<std::string> addresses;
  for (const char* table :
       {"/proc/self/net/udp", "/proc/self/net/udp6", "/proc/self/net/tcp", "/proc/self/net/tcp6"}) {
    std::ifstream lines{table};
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::istringstream fields{line};
      std::string slot, local, remote, state, queues, timer, retransmits, user, timeout, inode;
      fields >> slot >> local >> remote >> state >> queues >> timer >> retransmits >> user >>
          timeout >> inode;
      if (inodes.contains(inode)) {
        addresses.insert(local.substr(0, local.find(':')));
      }
    }
  }
  return addresses;
}

constexpr const char* kLoopback = "0100007F";            // 127.0.0.1
constexpr const char* kDiscoveryMulticast = "0100FFEF";  // 239.255.0.1

TEST(LoopbackTransport, UsesNoSocketBeyondThisMachineAndNoSharedMemory) {
  const test::DomainReservation domains{3};
  Participant lab{on_loopback("a", domains.first(), DomainRole::kLab)};
  Participant local{on_loopback("a", domains.first() + 1, DomainRole::kLocal)};
  Participant controller{on_loopback("a", domains.first() + 2, DomainRole::kController)};
  Participant other{on_loopback("b", domains.first() + 2, DomainRole::kController)};
  Mailbox<coordination::Outcome> mailbox{other, topics::outcome()};
  Writer<coordination::Outcome> writer{controller, topics::outcome()};
  ASSERT_TRUE(writer.wait_for_matched(1, soon()));
  ASSERT_TRUE(
      writer.write(coordination::Outcome{.vehicle = {1}, .step = {0}, .wants_fallback = false}));
  ASSERT_EQ(mailbox.wait_for(1).size(), 1U);
  const std::set<std::string> addresses = udp_addresses();
  EXPECT_TRUE(addresses.contains(kLoopback)) << "this test looks at the wrong place";
  for (const std::string& address : addresses) {
    EXPECT_TRUE(address == kLoopback || address == kDiscoveryMulticast) << address;
  }
  EXPECT_EQ(shared_memory_files(), std::set<std::string>{});
}

ParticipantOptions as_in_the_lab(const std::string& name, int domain, DomainRole role) {
  ParticipantOptions options = on_loopback(name, domain, role);
  options.transport = Transport::kLab;
  return options;
}

// A vehicle died of its middleware's death, which had held the lock of a shared history.
TEST(LabTransport, LabDomainHasNoMemoryThatADeadProcessCouldHaveLocked) {
  const test::DomainReservation domain;
  Participant vehicle{as_in_the_lab("vehicle_1", domain.first(), DomainRole::kLab)};
  Participant middleware{as_in_the_lab("middleware_1", domain.first(), DomainRole::kLab)};
  Mailbox<VehicleState> states{middleware, topics::vehicle_state(1)};
  Writer<VehicleState> writer{vehicle, topics::vehicle_state(1)};
  ASSERT_TRUE(writer.wait_for_matched({"middleware_1"}, soon()));
  ASSERT_TRUE(states.reader().wait_for_matched(1, soon()));
  ASSERT_TRUE(writer.write(VehicleState{.vehicle_id = 1}));
  ASSERT_EQ(states.wait_for(1).size(), 1U);
  EXPECT_EQ(shared_memory_files(), std::set<std::string>{});
}

/// A participant with a writer and a reader of vehicle states, all with the library's defaults:
/// UDP and shared memory, and shared histories.
class DefaultPeer {
 public:
  DefaultPeer(int domain, const std::string& topic) {
    auto* factory = fdds::DomainParticipantFactory::get_instance();
    participant_ = factory->create_participant(static_cast<std::uint32_t>(domain),
                                               fdds::PARTICIPANT_QOS_DEFAULT);
    const fdds::TypeSupport type{new VehicleStatePubSubType};
    type.register_type(participant_);
    auto* const described =
        participant_->create_topic(topic, type.get_type_name(), fdds::TOPIC_QOS_DEFAULT);
    writer_ = participant_->create_publisher(fdds::PUBLISHER_QOS_DEFAULT)
                  ->create_datawriter(described, fdds::DATAWRITER_QOS_DEFAULT);
    reader_ = participant_->create_subscriber(fdds::SUBSCRIBER_QOS_DEFAULT)
                  ->create_datareader(described, fdds::DATAREADER_QOS_DEFAULT);
  }
  ~DefaultPeer() {
    participant_->delete_contained_entities();
    fdds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  DefaultPeer(const DefaultPeer&) = delete;
  DefaultPeer& operator=(const DefaultPeer&) = delete;

  [[nodiscard]] int matched_readers() const {
    fdds::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count;
  }
  void write(::VehicleState state) { writer_->write(&state); }
  [[nodiscard]] bool reads(std::uint8_t vehicle) {
    ::VehicleState state;
    fdds::SampleInfo info;
    while (is_ok(reader_->take_next_sample(&state, &info))) {
      if (info.valid_data && state.vehicle_id() == vehicle) return true;
    }
    return false;
  }

 private:
  fdds::DomainParticipant* participant_{};
  fdds::DataWriter* writer_{};
  fdds::DataReader* reader_{};
};

TEST(LabTransport, APeerWithTheLibrarysDefaultsHearsUsAndIsHeard) {
  const test::DomainReservation domain;
  Participant ours{as_in_the_lab("ours", domain.first(), DomainRole::kLab)};
  const Topic<VehicleState> topic = topics::vehicle_state(1);
  DefaultPeer theirs(domain.first(), topic.name);
  Mailbox<VehicleState> mailbox{ours, topic};
  Writer<VehicleState> writer{ours, topic};
  // Their reader is matched with their writer, too: two readers each.
  ASSERT_TRUE(test::eventually(std::chrono::seconds{60}, [&] {
    return theirs.matched_readers() == 2 && writer.matched() == 1 &&
           mailbox.reader().matched() == 1;
  }));
  ::VehicleState state;
  state.vehicle_id(7);
  EXPECT_TRUE(test::eventually(std::chrono::seconds{60}, [&] {
    theirs.write(state);  // volatile and best effort: until it is received
    return std::ranges::any_of(
        mailbox.now(), [](const VehicleState& received) { return received.vehicle_id == 7; });
  }));
  EXPECT_TRUE(test::eventually(std::chrono::seconds{60}, [&] {
    return writer.write(VehicleState{.vehicle_id = 8}) && theirs.reads(8);
  }));
}

TEST(LabTransport, LocalDomainIsSharedMemoryOnly) {
  const test::DomainReservation domain;
  const auto options = [&](const std::string& name) {
    return as_in_the_lab(name, domain.first(), DomainRole::kLocal);
  };
  Participant middleware{options("middleware_1")};
  Participant controller{options("high_level_controller_1")};
  Mailbox<VehicleStateList> lists{controller, topics::vehicle_state_list()};
  Mailbox<ReadyStatus> ready{middleware, topics::ready_status()};
  Mailbox<TrajectoryCommand> commands{middleware, topics::command()};
  Writer<VehicleStateList> list_writer{middleware, topics::vehicle_state_list()};
  Writer<ReadyStatus> ready_writer{controller, topics::ready_status()};
  Writer<TrajectoryCommand> command_writer{controller, topics::command()};
  ASSERT_TRUE(list_writer.wait_for_matched({"high_level_controller_1"}, soon()));
  ASSERT_TRUE(lists.reader().wait_for_matched(1, soon()));
  ASSERT_TRUE(ready_writer.wait_for_matched({"middleware_1"}, soon()));
  ASSERT_TRUE(command_writer.wait_for_matched({"middleware_1"}, soon()));
  ASSERT_TRUE(commands.reader().wait_for_matched(1, soon()));
  ASSERT_TRUE(ready_writer.write({"hlc_1", 0}));
  ASSERT_EQ(ready.wait_for(1).size(), 1U);
  VehicleStateList list;
  list.period_ms = 200;
  ASSERT_TRUE(list_writer.write(list));
  ASSERT_EQ(lists.wait_for(1).size(), 1U);
  ASSERT_TRUE(command_writer.write(TrajectoryCommand{}));
  ASSERT_EQ(commands.wait_for(1).size(), 1U);
  EXPECT_EQ(udp_addresses(), std::set<std::string>{});
  EXPECT_FALSE(shared_memory_files().empty());
}

}  // namespace
}  // namespace hlc::dds::confinement_test
