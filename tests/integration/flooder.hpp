#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "hlc_bridge/dds/participant.hpp"

namespace hlc::test {

/// Writes to one topic.
struct FloodWriter {
  std::function<void()> write;
  std::function<std::size_t()> matched;
};

/// A topic that a process of a run reads, and who publishes on it.
struct Flood {
  std::string reader;  ///< process of LabProcesses
  std::string peer;    ///< name of a participant that may publish the messages
  std::string topic;   ///< for tables
  int domain{};
  dds::DomainRole role{};
  /// Messages are `bytes` long, if their type has texts or sequences. They ask no process to end.
  std::function<FloodWriter(dds::Participant& participant, std::size_t bytes)> writer;
};

/// All topics that the processes of vehicle 1 and the lab control read in a run in real time with
/// the vehicles 1 and 2, but that of the stop requests, the first of which ends the run.
[[nodiscard]] std::vector<Flood> floods(int lab_domain);

/// A participant that publishes 10 000 messages a second on one topic, from its match until it is
/// destroyed, or as many as the machine can.
class Flooder {
 public:
  Flooder(const Flood& flood, const std::string& name, std::size_t bytes);
  ~Flooder();
  Flooder(const Flooder&) = delete;
  Flooder& operator=(const Flooder&) = delete;

  [[nodiscard]] std::uint64_t num_published() const { return num_published_; }

 private:
  void publish(const Flood& flood, const std::string& name, std::size_t bytes);

  std::atomic<bool> ends_{};
  std::atomic<std::uint64_t> num_published_{};
  std::thread thread_;
};

}  // namespace hlc::test
