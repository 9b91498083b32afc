#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hlc::test {

/// A participant named "eavesdropper" on all domains of a run of LabProcesses that reads its
/// topics: states and commands of all vehicles, lists, triggers, parameters, ready statuses, stop
/// requests, log lines; traffic, predictions, outcomes, reports and the run state.
class Eavesdropper {
 public:
  Eavesdropper(int lab_domain, const std::vector<std::uint8_t>& vehicle_ids);
  ~Eavesdropper();
  Eavesdropper(const Eavesdropper&) = delete;
  Eavesdropper& operator=(const Eavesdropper&) = delete;

  /// Messages read of each kind.
  [[nodiscard]] std::map<std::string, std::uint64_t> num_read() const;

 private:
  class Readers;
  std::unique_ptr<Readers> readers_;
};

}  // namespace hlc::test
