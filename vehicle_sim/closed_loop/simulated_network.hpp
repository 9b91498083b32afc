#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/machine/machine.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "vehicle_sim/closed_loop/event_queue.hpp"
#include "vehicle_sim/closed_loop/seeded_random.hpp"
#include "vehicle_sim/closed_loop/topics.hpp"

namespace hlc::closed_loop {

/// Endpoints of a process. Its name is on every domain of its topics.
struct NodeDescription {
  std::string name;
  std::vector<Topic> writes;
  std::vector<Topic> reads;
};

/// Temporary disturbance of messages. Shares are probabilities per message.
struct Disturbance {
  std::string from;     ///< name of the writer's process; empty: any
  std::string to;       ///< of the reader's
  double lost{};        ///< in transit: a reliable topic sends again, later; others do not
  double withheld{};    ///< lost for good, even on reliable topics
  double repeated{};    ///< comes twice, the second time up to `repeat_delay` later
  double overtaken{};   ///< comes up to `overtake_delay` later, and others do not wait for it
  Nanoseconds delay{};  ///< additional delay of every message, at most
  Nanoseconds repeat_delay{};
  Nanoseconds overtake_delay{};
  double flood_hz{};  ///< so many copies a second of the newest message arrive on every topic
  friend bool operator==(const Disturbance&, const Disturbance&) = default;
};

/// No messages and no signs of life pass between the two.
struct Cut {
  std::string from;
  std::string to;
  std::optional<Domain> domain;  ///< none: all
  friend bool operator==(const Cut&, const Cut&) = default;
};

struct NetworkOptions {
  std::uint64_t seed{};
  Transport transport{};
  Nanoseconds lease{2 * kNanosecondsPerSecond};  ///< as participant_qos.hpp has it
  Nanoseconds least_delay{100'000};
  Nanoseconds most_delay{1'000'000};
};

/// The network of all processes of a run, with the properties of DDS that the machines rely on:
///
/// * A process *sees* another one of its domains from its first received announcement until the
///   other one leaves, or until nothing has come from it for the lease. Announcements come eight
///   times in a lease. A process that was seen and no longer is, is lost. Names need not be unique.
/// * A writer reaches a reader while each sees the other. Earlier messages are lost to the reader,
///   except on topics with durability for late joiners.
/// * A process that is suspended for longer than the lease may miss the others briefly on resuming.
/// * Lost messages of a reliable topic are sent again, in the order of writing; while nothing
///   passes the last `depth` messages of a writer are kept for that. Other topics lose them.
///
/// Every delay is a number of seed, channel, and count of its messages: a disturbance in one place
/// does not change delays in another.
class SimulatedNetwork {
 public:
  SimulatedNetwork(EventQueue& queue, NetworkOptions options) : queue_(&queue), options_(options) {}

  // Processes. A node is never used again.
  NodeId join(const NodeDescription& description);
  /// Orderly end: the others see it at once.
  void leave(NodeId node);
  /// Killed: the others lose it when its lease has run out.
  void crash(NodeId node);
  /// Suspended: arriving messages wait, and it shows no sign of life.
  void freeze(NodeId node);
  void resume(NodeId node);

  // Faults.
  void add(const Cut& cut);
  void remove(const Cut& cut);
  void add(const Disturbance& disturbance) { disturbances_.push_back(disturbance); }
  void remove(const Disturbance& disturbance);

  /// @param topic  index among the description's `writes`
  void publish(NodeId node, std::size_t topic, Message message);
  /// Called with every message that a process publishes. May be absent.
  std::function<void(NodeId node, const SharedMessage& message)> on_published{};

  /// An event that is due: an arrival or a discovery.
  struct Arrival {
    NodeId node{};
    std::size_t topic{};  ///< index among the reader's `reads`
    SharedMessage message;
  };
  /// Nothing if the reader no longer matches the writer.
  [[nodiscard]] std::optional<Arrival> arrive(Event event);
  /// True if `event.node` now sees a participant that it did not see, or has lost one.
  [[nodiscard]] bool discover(const Event& event);

  /// Participants that a node sees on a domain.
  [[nodiscard]] machine::Participants participants(NodeId node, Domain domain) const;
  /// Names of the matched readers of the node's topic (as far as it knows).
  [[nodiscard]] std::set<std::string> readers(NodeId node, std::size_t topic) const;
  /// Names of the matched writers of the node's topic.
  [[nodiscard]] std::set<std::string> writers(NodeId node, std::size_t topic) const;

  [[nodiscard]] const std::string& name(NodeId node) const { return nodes_[node].name; }

 private:
  struct Discovery {
    bool is_known{};     ///< there is such a participant
    bool is_open{true};  ///< signs of life pass
    bool is_seen{};
    std::uint32_t generation{};
  };
  struct Node {
    std::string name;
    std::vector<Topic> writes;
    std::vector<Topic> reads;
    std::set<Domain> domains;
    bool is_gone{};
    bool is_frozen{};
    Nanoseconds frozen_at{};
    /// By topic written: channels to all readers.
    std::vector<std::vector<std::uint32_t>> outlets;
    /// By topic written: messages for late joiners.
    std::vector<std::deque<SharedMessage>> kept;
    /// By domain and node: of others, as this one sees them.
    std::array<std::vector<Discovery>, kNumDomains> discoveries;
    std::array<machine::Participants, kNumDomains> participants;
  };
  struct Channel {
    NodeId from{};
    NodeId to{};
    std::uint32_t outlet{};  ///< index of the topic among the writer's
    std::uint32_t inlet{};   ///< and among the reader's
    TopicRules rules;
    std::uint64_t seed{};
    std::uint64_t count{};
    Nanoseconds last_arrival{};
    Nanoseconds last_sent{};
    std::deque<SharedMessage> waiting;
  };

  void miss_some(NodeId node);
  void connect(NodeId from, NodeId to);
  [[nodiscard]] Discovery& new_discovery(NodeId observer, NodeId other, Domain domain);
  [[nodiscard]] bool sees(NodeId observer, NodeId other, Domain domain) const;
  [[nodiscard]] bool is_cut(NodeId from, NodeId to, Domain domain) const;
  [[nodiscard]] bool passes(const Channel& channel) const;
  [[nodiscard]] bool is_disturbed_by(const Disturbance& disturbance, const Channel& channel) const;
  void send(std::uint32_t index, const SharedMessage& message);
  void transmit(std::uint32_t index, const SharedMessage& message);
  void flood(std::uint32_t index, const SharedMessage& message, double rate_hz);
  void flush(NodeId from, NodeId to);
  void update_discovery(NodeId observer, NodeId other, Domain domain);
  void update_discoveries_of(NodeId other);
  void note_names(NodeId observer, NodeId other, Domain domain);

  EventQueue* queue_;
  NetworkOptions options_;
  std::vector<Node> nodes_;
  std::vector<Channel> channels_;
  /// By writer and reader.
  std::map<std::pair<NodeId, NodeId>, std::vector<std::uint32_t>> between_;
  std::vector<Cut> cuts_;
  std::vector<Disturbance> disturbances_;
  std::uint64_t num_discoveries_{};
};

}  // namespace hlc::closed_loop
