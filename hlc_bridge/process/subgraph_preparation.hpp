#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <stop_token>
#include <thread>
#include <vector>

#include "hlc_bridge/hlc/reconfiguration.hpp"
#include "hlc_bridge/time/signal.hpp"

namespace hlc {

/// Prepares requested subgraphs on a thread of its own while the controller drives. The thread
/// gives way to others, since making maneuvers takes a core for a good while.
class SubgraphPreparation {
 public:
  SubgraphPreparation(RequestBase base, WeightDesign weights);
  /// Waits for the one in work, of new weights for the maneuver in work.
  ~SubgraphPreparation();
  SubgraphPreparation(const SubgraphPreparation&) = delete;
  SubgraphPreparation& operator=(const SubgraphPreparation&) = delete;

  /// From any thread. They are prepared in order; of more than kMaxWaiting the first give way.
  void ask(const AutomatonRequest& request);

  /// What has been prepared since the last call, in order.
  [[nodiscard]] std::vector<PreparedRequest> take();

  /// Waits until nothing is asked or in work any more, kLongestWait at most: for logical time, in
  /// which the others wait for who waits, but for 10 s only. What takes longer is in force later.
  void wait() const;
  static constexpr std::chrono::seconds kLongestWait{8};

 private:
  static constexpr std::size_t kMaxWaiting = 16;

  void run();

  const RequestBase base_;
  WeightDesign weights_;  ///< the thread's
  std::stop_source stop_;

  Signal signal_;
  // Guarded by signal_:
  std::deque<AutomatonRequest> asked_;
  std::vector<PreparedRequest> done_;
  bool is_working_{};
  bool ends_{};

  std::thread thread_;  // last: it uses everything above
};

}  // namespace hlc
