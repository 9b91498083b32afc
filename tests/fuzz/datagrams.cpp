// RTPS datagrams over UDP to participants of this process, one on each domain, which read every
// topic: a digit for the port, then the datagram. kSender in it stands for the GUID prefix of a
// participant that they know.
#include <dirent.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <random>
#include <stdexcept>
#include <thread>

#include "hlc_bridge/dds/writer.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/hlc_bridge/dds/mutated_datagram.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"
#include "tests/hlc_bridge/dds/send_datagram.hpp"
#include "tests/hlc_bridge/dds/sent_datagrams.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc::fuzz {
namespace {

namespace topics = dds::topics;

constexpr std::string_view kSender = "SENDERPREFIX";
constexpr std::size_t kPrefixAt = 8;  // in a datagram
constexpr int kRoles = 3;
constexpr std::size_t kPorts = std::size_t{2} * kRoles;

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// A reader and its writer.
template <class Message>
struct Pair {
  Pair(dds::Participant& sender, dds::Participant& receiver, const dds::Topic<Message>& topic)
      : writer(sender, topic), reader(receiver, topic, [](const Message& /*message*/) {}) {}

  dds::Writer<Message> writer;
  dds::Reader<Message> reader;
};

class Domain {
 public:
  /// @param index  among those of the process
  Domain(int first, int index, dds::DomainRole role)
      : number_(first + index),
        index_(index),
        receiver_(dds::on_loopback("receiver", number_, role)),
        sender_(dds::on_loopback("sender", number_, role)) {}

  template <class Message>
  void add(const dds::Topic<Message>& topic) {
    std::mt19937_64 random(1);
    auto pair = std::make_shared<Pair<Message>>(sender_, receiver_, topic);
    const auto message = dds::sample<Message>(random);
    if (!pair->writer.wait_for_matched(1, dds::soon()) || !pair->writer.write(message)) {
      throw std::logic_error("no reader of " + topic.name);
    }
    pairs_.push_back(pair);
  }
  /// The receiver's, for messages or for discovery. The library numbers the process's participants,
  /// two on each domain.
  [[nodiscard]] int port(bool is_of_messages) const {
    return 7400 + 250 * number_ + 10 + 4 * index_ + (is_of_messages ? 1 : 0);
  }

 private:
  int number_;
  int index_;
  dds::Participant receiver_;
  dds::Participant sender_;
  std::vector<std::shared_ptr<void>> pairs_;
};

/// Bytes that wait at this process's sockets of a port.
int num_waiting(int port) {
  int bytes = 0;
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(::opendir("/proc/self/fd"), ::closedir);
  while (const dirent* entry = ::readdir(folder.get())) {
    const int socket = std::atoi(entry->d_name);
    sockaddr_in address{};
    socklen_t size = sizeof address;
    int waiting = 0;
    if (::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0 &&
        address.sin_family == AF_INET && ntohs(address.sin_port) == port &&
        ::ioctl(socket, FIONREAD, &waiting) == 0) {
      bytes += waiting;
    }
  }
  return bytes;
}

/// Among what was sent to a port. The writers repeat theirs until they are acknowledged.
bool has_heartbeat(const dds::SentDatagrams& sent, int port) {
  constexpr unsigned char kHeartbeat = 0x07;
  return std::ranges::any_of(sent.so_far(), [port](const dds::Datagram& datagram) {
    return ntohs(datagram.to.sin_port) == port &&
           std::ranges::any_of(dds::submessages(datagram.bytes),
                               [&](std::size_t at) { return datagram.bytes[at] == kHeartbeat; });
  });
}

class Network {
 public:
  Network() {
    const dds::SentDatagrams sent;
    add_topics();
    for (const auto& domain : domains_) {
      if (!test::eventually(std::chrono::seconds{60},
                            [&] { return has_heartbeat(sent, domain->port(true)); })) {
        throw std::logic_error("no heartbeat was sent");
      }
    }
    for (std::size_t i = 0; i < domains_.size(); ++i) add_samples(sent, i);
  }
  ~Network() { ::close(socket_); }
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  /// Returns as soon as the receiver has taken the datagram from its socket, and so dealt with the
  /// one before it.
  void send(std::string_view bytes) const {
    if (bytes.empty()) return;
    const auto choice = static_cast<std::size_t>(bytes.front() - '0') % kPorts;
    const int port = domains_[choice / 2]->port(choice % 2 == 1);
    const std::string datagram =
        replaced(std::string(bytes.substr(1)), kSender, senders_[choice / 2]);
    dds::send_datagram(socket_, datagram.data(), datagram.size(), port);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds{10};
    while (num_waiting(port) > 0) {
      if (std::chrono::steady_clock::now() > deadline) {
        throw std::logic_error("a datagram is dealt with for 10 s");
      }
      std::this_thread::yield();
    }
  }
  [[nodiscard]] const std::vector<std::string>& samples() const { return samples_; }

 private:
  void add_topics() {
    for (const auto role :
         {dds::DomainRole::kLab, dds::DomainRole::kLocal, dds::DomainRole::kController}) {
      domains_.push_back(
          std::make_unique<Domain>(reservation_.first(), static_cast<int>(domains_.size()), role));
    }
    const auto add = [this](std::size_t i, const auto&... all) { (domains_[i]->add(all), ...); };
    add(0, topics::vehicle_state(3), topics::vehicle_observation(3), topics::vehicle_command(3),
        topics::vehicle_command<DirectCommand>(4), topics::vehicle_command<PathTrackingCommand>(5),
        topics::vehicle_command<SpeedCurvatureCommand>(6), topics::ready_status(),
        topics::system_trigger(), topics::parameter(), topics::parameter_request(),
        topics::stop_request(), topics::log(), topics::log_level(), topics::goal_state(),
        topics::visualization());
    add(1, topics::vehicle_state_list(), topics::command(), topics::ready_status(),
        topics::system_trigger(), topics::goal_state());
    add(2, topics::traffic(), topics::prediction(), topics::outcome(), topics::report(),
        topics::run_state(), topics::automaton_request(), topics::automaton_answer());
  }
  /// What the sender sent to the receiver; and its GUID prefix, which is in each of them.
  void add_samples(const dds::SentDatagrams& sent, std::size_t domain) {
    for (const dds::Datagram& datagram : sent.so_far()) {
      const int port = ntohs(datagram.to.sin_port);
      const bool is_of_messages = port == domains_[domain]->port(true);
      if (!is_of_messages && port != domains_[domain]->port(false)) continue;
      const std::string bytes(datagram.bytes.begin(), datagram.bytes.end());
      if (senders_.size() == domain) senders_.push_back(bytes.substr(kPrefixAt, kSender.size()));
      samples_.push_back(std::to_string(2 * domain + (is_of_messages ? 1 : 0)) +
                         replaced(bytes, senders_[domain], kSender));
    }
    if (senders_.size() == domain) throw std::logic_error("nothing was sent");
  }

  test::DomainReservation reservation_{kRoles};
  int socket_{::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)};
  std::vector<std::unique_ptr<Domain>> domains_;
  std::vector<std::string> senders_;  ///< GUID prefixes, by domain
  std::vector<std::string> samples_;
};

const Network& network() {
  static const Network kNetwork;
  return kNetwork;
}

}  // namespace

std::vector<Target> datagram_targets() {
  return {{"datagrams", [](std::string_view bytes) { network().send(bytes); },
           [] { return network().samples(); }}};
}

}  // namespace hlc::fuzz
