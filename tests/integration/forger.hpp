#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace hlc::test {

/// The name of its participants.
inline constexpr const char* kForger = "stranger";

/// A participant on all domains of a run of LabProcesses that publishes, 50 times a second and
/// until it is destroyed, messages in the name of all vehicles and of the lab control: traffic,
/// predictions, outcomes, reports, the demand for a minimal-risk stop, states, lists, commands,
/// parameters, triggers with the stop symbol and stop requests.
class Forger {
 public:
  Forger(int lab_domain, std::vector<std::uint8_t> vehicle_ids);
  ~Forger();
  Forger(const Forger&) = delete;
  Forger& operator=(const Forger&) = delete;

  /// Of all kinds and vehicles together.
  [[nodiscard]] std::uint64_t num_rounds() const { return num_rounds_; }

 private:
  void publish(int lab_domain, const std::vector<std::uint8_t>& vehicle_ids);

  std::atomic<bool> ends_{};
  std::atomic<std::uint64_t> num_rounds_{};
  std::thread thread_;
};

}  // namespace hlc::test
