#include "vehicle_sim/closed_loop/simulated_network.hpp"

#include <algorithm>
#include <memory>

namespace hlc::closed_loop {
namespace {

constexpr Nanoseconds kAnnouncementsPerLease = 8;
/// From the announcement of a new participant until its endpoints are known.
constexpr Nanoseconds kLeastDiscovery = 5 * kNanosecondsPerMillisecond;
constexpr Nanoseconds kMostDiscovery = 60 * kNanosecondsPerMillisecond;
/// Until a lost message is sent again.
constexpr Nanoseconds kLeastRepair = 10 * kNanosecondsPerMillisecond;
constexpr Nanoseconds kMostRepair = 60 * kNanosecondsPerMillisecond;
/// For which a flood repeats the newest message.
constexpr Nanoseconds kLongestFlood = 200 * kNanosecondsPerMillisecond;

std::size_t index_of(Domain domain) { return static_cast<std::size_t>(domain); }

bool is_meant(const std::string& name, const std::string& by) { return by.empty() || by == name; }

}  // namespace

// --- processes ----------------------------------------------------------------------------------

NodeId SimulatedNetwork::join(const NodeDescription& description) {
  const auto id = static_cast<NodeId>(nodes_.size());
  Node node;
  node.name = description.name;
  node.writes = description.writes;
  node.reads = description.reads;
  node.outlets.resize(node.writes.size());
  node.kept.resize(node.writes.size());
  for (const auto* topics : {&node.writes, &node.reads}) {
    for (const Topic& topic : *topics)
      node.domains.insert(rules_of(topic.id, options_.transport).domain);
  }
  nodes_.push_back(std::move(node));
  for (NodeId other = 0; other < id; ++other) {
    if (nodes_[other].is_gone) continue;
    connect(id, other);
    connect(other, id);
    for (const Domain domain : nodes_[id].domains) {
      if (!nodes_[other].domains.contains(domain)) continue;
      new_discovery(id, other, domain).is_open = false;
      new_discovery(other, id, domain).is_open = false;
      update_discovery(id, other, domain);
      update_discovery(other, id, domain);
    }
  }
  return id;
}

void SimulatedNetwork::connect(NodeId from, NodeId to) {
  for (std::uint32_t outlet = 0; outlet < nodes_[from].writes.size(); ++outlet) {
    const Topic& topic = nodes_[from].writes[outlet];
    const auto& reads = nodes_[to].reads;
    const auto found = std::ranges::find(reads, topic);
    if (found == reads.end()) continue;
    const auto index = static_cast<std::uint32_t>(channels_.size());
    Channel channel;
    channel.from = from;
    channel.to = to;
    channel.outlet = outlet;
    channel.inlet = static_cast<std::uint32_t>(found - reads.begin());
    channel.rules = rules_of(topic.id, options_.transport);
    channel.seed = mixed(options_.seed, index);
    channels_.push_back(std::move(channel));
    nodes_[from].outlets[outlet].push_back(index);
    between_[{from, to}].push_back(index);
  }
}

void SimulatedNetwork::leave(NodeId node) {
  nodes_[node].is_gone = true;
  for (NodeId other = 0; other < nodes_.size(); ++other) {
    for (const Domain domain : nodes_[node].domains) {
      auto& discoveries = nodes_[other].discoveries[index_of(domain)];
      if (node >= discoveries.size() || !discoveries[node].is_known || nodes_[other].is_gone)
        continue;
      Discovery& discovery = discoveries[node];
      const bool is_reachable = discovery.is_open && !is_cut(node, other, domain);
      update_discovery(other, node, domain);
      if (!is_reachable || !discovery.is_seen) continue;
      ++discovery.generation;
      queue_->add(queue_->now() + options_.most_delay,
                  {.what = EventKind::kDiscovery,
                   .node = other,
                   .other = node,
                   .detail = static_cast<std::uint32_t>(domain),
                   .generation = discovery.generation});
    }
  }
}

void SimulatedNetwork::crash(NodeId node) {
  nodes_[node].is_gone = true;
  update_discoveries_of(node);
}

void SimulatedNetwork::freeze(NodeId node) {
  nodes_[node].is_frozen = true;
  nodes_[node].frozen_at = queue_->now();
  update_discoveries_of(node);
}

void SimulatedNetwork::resume(NodeId node) {
  nodes_[node].is_frozen = false;
  update_discoveries_of(node);
  if (queue_->now() - nodes_[node].frozen_at >= options_.lease) miss_some(node);
}

/// Its leases of the others have run out, but their messages wait to be read: their order is
/// random.
void SimulatedNetwork::miss_some(NodeId node) {
  SeededRandom random(mixed(options_.seed, ++num_discoveries_ + (1ULL << 32U)));
  for (std::uint32_t domain = 0; domain < kNumDomains; ++domain) {
    auto& discoveries = nodes_[node].discoveries[domain];
    for (NodeId other = 0; other < discoveries.size(); ++other) {
      Discovery& discovery = discoveries[other];
      if (!discovery.is_seen || !discovery.is_open || random.chance(0.5)) continue;
      discovery.is_open = false;
      ++discovery.generation;
      queue_->add(queue_->now(), {.what = EventKind::kDiscovery,
                                  .node = node,
                                  .other = other,
                                  .detail = domain,
                                  .generation = discovery.generation});
    }
  }
}

// --- faults -------------------------------------------------------------------------------------

void SimulatedNetwork::add(const Cut& cut) {
  cuts_.push_back(cut);
  for (NodeId node = 0; node < nodes_.size(); ++node) {
    if (is_meant(nodes_[node].name, cut.from)) update_discoveries_of(node);
  }
}

void SimulatedNetwork::remove(const Cut& cut) {
  const auto found = std::ranges::find(cuts_, cut);
  if (found == cuts_.end()) return;
  cuts_.erase(found);
  for (NodeId node = 0; node < nodes_.size(); ++node) {
    if (is_meant(nodes_[node].name, cut.from)) update_discoveries_of(node);
  }
}

void SimulatedNetwork::remove(const Disturbance& disturbance) {
  const auto found = std::ranges::find(disturbances_, disturbance);
  if (found != disturbances_.end()) disturbances_.erase(found);
}

bool SimulatedNetwork::is_cut(NodeId from, NodeId to, Domain domain) const {
  return std::ranges::any_of(cuts_, [&](const Cut& cut) {
    return (!cut.domain || *cut.domain == domain) && is_meant(nodes_[from].name, cut.from) &&
           is_meant(nodes_[to].name, cut.to);
  });
}

// --- discovery ----------------------------------------------------------------------------------

SimulatedNetwork::Discovery& SimulatedNetwork::new_discovery(NodeId observer, NodeId other,
                                                             Domain domain) {
  auto& discoveries = nodes_[observer].discoveries[index_of(domain)];
  if (discoveries.size() <= other) discoveries.resize(other + 1);
  discoveries[other].is_known = true;
  return discoveries[other];
}

bool SimulatedNetwork::sees(NodeId observer, NodeId other, Domain domain) const {
  const auto& discoveries = nodes_[observer].discoveries[index_of(domain)];
  return other < discoveries.size() && discoveries[other].is_seen;
}

void SimulatedNetwork::update_discoveries_of(NodeId other) {
  for (NodeId observer = 0; observer < nodes_.size(); ++observer) {
    if (observer == other || nodes_[observer].is_gone) continue;
    for (const Domain domain : nodes_[other].domains) {
      if (nodes_[observer].domains.contains(domain)) update_discovery(observer, other, domain);
    }
  }
}

/// Plans when the observer will find or miss the other one, if nothing changes until then.
void SimulatedNetwork::update_discovery(NodeId observer, NodeId other, Domain domain) {
  auto& discoveries = nodes_[observer].discoveries[index_of(domain)];
  if (other >= discoveries.size() || !discoveries[other].is_known) return;
  Discovery& discovery = discoveries[other];
  const Node& node = nodes_[other];
  const bool is_open = !node.is_gone && !node.is_frozen && !is_cut(other, observer, domain);
  if (is_open == discovery.is_open) return;
  discovery.is_open = is_open;
  ++discovery.generation;
  if (is_open) flush(other, observer);
  if (is_open == discovery.is_seen) return;
  SeededRandom random(mixed(options_.seed, ++num_discoveries_ + (1ULL << 32U)));
  const Nanoseconds period = options_.lease / kAnnouncementsPerLease;
  const bool is_new = discovery.generation == 1;
  const Nanoseconds pause = !is_open ? options_.lease - random.below(period)
                                     : random.between(kLeastDiscovery, kMostDiscovery) +
                                           (is_new ? 0 : random.below(period));
  queue_->add(queue_->now() + pause, {.what = EventKind::kDiscovery,
                                      .node = observer,
                                      .other = other,
                                      .detail = static_cast<std::uint32_t>(domain),
                                      .generation = discovery.generation});
}

bool SimulatedNetwork::discover(const Event& event) {
  Node& observer = nodes_[event.node];
  const auto domain = static_cast<Domain>(event.detail);
  auto& discoveries = observer.discoveries[event.detail];
  Discovery& discovery = discoveries.at(event.other);
  if (observer.is_gone || discovery.generation != event.generation) return false;
  if (discovery.is_seen == discovery.is_open) return false;
  discovery.is_seen = discovery.is_open;
  note_names(event.node, event.other, domain);
  const auto between = between_.find({event.node, event.other});
  if (between != between_.end()) {
    for (const std::uint32_t index : between->second) {
      Channel& channel = channels_[index];
      if (channel.rules.domain != domain) continue;
      channel.waiting.clear();
      if (discovery.is_seen && channel.rules.is_kept_late) {
        channel.waiting = observer.kept[channel.outlet];
      }
    }
  }
  flush(event.node, event.other);
  flush(event.other, event.node);
  update_discovery(event.node, event.other, domain);  // lost although present
  return true;
}

/// A name is present as long as one process with this name is.
void SimulatedNetwork::note_names(NodeId observer, NodeId other, Domain domain) {
  Node& node = nodes_[observer];
  const std::string& name = nodes_[other].name;
  const auto& discoveries = node.discoveries[index_of(domain)];
  bool is_there = false;
  for (NodeId one = 0; one < discoveries.size() && !is_there; ++one) {
    is_there = discoveries[one].is_seen && nodes_[one].name == name;
  }
  machine::Participants& participants = node.participants[index_of(domain)];
  if (is_there) {
    participants.alive.insert(name);
    participants.lost.erase(name);
  } else if (participants.alive.erase(name) > 0) {
    participants.lost.insert(name);
  }
}

machine::Participants SimulatedNetwork::participants(NodeId node, Domain domain) const {
  return nodes_[node].participants[index_of(domain)];
}

std::set<std::string> SimulatedNetwork::readers(NodeId node, std::size_t topic) const {
  std::set<std::string> names;
  for (const std::uint32_t index : nodes_[node].outlets[topic]) {
    const Channel& channel = channels_[index];
    if (sees(node, channel.to, channel.rules.domain)) names.insert(nodes_[channel.to].name);
  }
  return names;
}

std::set<std::string> SimulatedNetwork::writers(NodeId node, std::size_t topic) const {
  const Topic& wanted = nodes_[node].reads[topic];
  const Domain domain = rules_of(wanted.id, options_.transport).domain;
  std::set<std::string> names;
  const auto& discoveries = nodes_[node].discoveries[index_of(domain)];
  for (NodeId other = 0; other < discoveries.size(); ++other) {
    if (discoveries[other].is_seen && std::ranges::count(nodes_[other].writes, wanted) > 0) {
      names.insert(nodes_[other].name);
    }
  }
  return names;
}

// --- messages -----------------------------------------------------------------------------------

void SimulatedNetwork::publish(NodeId node, std::size_t topic, Message message) {
  const auto shared = std::make_shared<const Message>(std::move(message));
  if (on_published) on_published(node, shared);
  const TopicRules rules = rules_of(nodes_[node].writes[topic].id, options_.transport);
  if (rules.is_kept_late) {
    auto& kept = nodes_[node].kept[topic];
    kept.push_back(shared);
    if (kept.size() > rules.depth) kept.pop_front();
  }
  for (const std::uint32_t index : nodes_[node].outlets[topic]) send(index, shared);
}

/// Both see each other, and nothing lies between.
bool SimulatedNetwork::passes(const Channel& channel) const {
  return sees(channel.to, channel.from, channel.rules.domain) &&
         !is_cut(channel.from, channel.to, channel.rules.domain);
}

void SimulatedNetwork::send(std::uint32_t index, const SharedMessage& message) {
  Channel& channel = channels_[index];
  if (!sees(channel.from, channel.to, channel.rules.domain)) return;
  if (passes(channel)) return transmit(index, message);
  if (!channel.rules.is_reliable()) return;
  channel.waiting.push_back(message);
  if (channel.waiting.size() > channel.rules.depth) channel.waiting.pop_front();
}

void SimulatedNetwork::flush(NodeId from, NodeId to) {
  const auto between = between_.find({from, to});
  if (between == between_.end() || nodes_[from].is_gone) return;
  for (const std::uint32_t index : between->second) {
    Channel& channel = channels_[index];
    if (channel.waiting.empty() || !passes(channel)) continue;
    for (const SharedMessage& message : std::exchange(channel.waiting, {})) {
      transmit(index, message);
    }
  }
}

bool SimulatedNetwork::is_disturbed_by(const Disturbance& disturbance,
                                       const Channel& channel) const {
  return is_meant(nodes_[channel.from].name, disturbance.from) &&
         is_meant(nodes_[channel.to].name, disturbance.to);
}

void SimulatedNetwork::transmit(std::uint32_t index, const SharedMessage& message) {
  Channel& channel = channels_[index];
  SeededRandom random(mixed(channel.seed, channel.count++));
  const Nanoseconds now = queue_->now();
  Nanoseconds arrival = now + random.between(options_.least_delay, options_.most_delay);
  bool waits_its_turn = channel.rules.is_reliable();
  Nanoseconds second = 0;
  for (const Disturbance& disturbance : disturbances_) {
    if (!is_disturbed_by(disturbance, channel)) continue;
    if (random.chance(disturbance.withheld)) return;
    if (random.chance(disturbance.lost)) {
      if (!channel.rules.is_reliable()) return;
      arrival += random.between(kLeastRepair, kMostRepair);
    }
    if (random.chance(disturbance.repeated)) {
      second =
          now + options_.least_delay + random.below(options_.most_delay + disturbance.repeat_delay);
    }
    if (random.chance(disturbance.overtaken)) {
      waits_its_turn = false;
      arrival += random.below(disturbance.overtake_delay + 1);
    }
    if (disturbance.delay > 0) arrival += random.below(disturbance.delay);
    if (disturbance.flood_hz > 0.0) flood(index, message, disturbance.flood_hz);
  }
  channel.last_sent = now;
  if (waits_its_turn) {
    arrival = std::max(arrival, channel.last_arrival);
    channel.last_arrival = arrival;
  }
  queue_->add(arrival, {.what = EventKind::kArrival, .detail = index, .message = message});
  if (second != 0) {
    queue_->add(second, {.what = EventKind::kArrival, .detail = index, .message = message});
  }
}

/// Until the next message, if that is as far from this one as this one is from the last.
void SimulatedNetwork::flood(std::uint32_t index, const SharedMessage& message, double rate_hz) {
  const Nanoseconds now = queue_->now();
  const Nanoseconds lasts = std::min(now - channels_[index].last_sent, kLongestFlood);
  const auto copies = static_cast<Nanoseconds>(1e-9 * rate_hz * static_cast<double>(lasts));
  for (Nanoseconds i = 1; i <= copies; ++i) {
    queue_->add(now + options_.most_delay + i * lasts / copies,
                {.what = EventKind::kArrival, .detail = index, .message = message});
  }
}

std::optional<SimulatedNetwork::Arrival> SimulatedNetwork::arrive(Event event) {
  const Channel& channel = channels_[event.detail];
  if (nodes_[channel.to].is_gone) return std::nullopt;
  if (!sees(channel.to, channel.from, channel.rules.domain)) return std::nullopt;
  return Arrival{.node = channel.to, .topic = channel.inlet, .message = std::move(event.message)};
}

}  // namespace hlc::closed_loop
