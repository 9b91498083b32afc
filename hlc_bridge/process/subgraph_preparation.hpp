#pragma once

#include <deque>
#include <functional>
#include <stop_token>
#include <thread>

#include "hlc_bridge/hlc/reconfiguration.hpp"
#include "hlc_bridge/time/signal.hpp"

namespace hlc::process {

/// Prepares requested subgraphs on a background thread while the controller drives. The thread has
/// a low priority, since designing maneuvers takes a core for some time.
class SubgraphPreparation {
 public:
  /// @param on_prepared  called on that thread, in the order of the requests; must not block
  SubgraphPreparation(high_level_controller::RequestBase base,
                      high_level_controller::WeightDesign weights,
                      std::function<void(high_level_controller::PreparedRequest)> on_prepared);
  /// Waits for the current preparation, of new weights for the current maneuver.
  ~SubgraphPreparation();
  SubgraphPreparation(const SubgraphPreparation&) = delete;
  SubgraphPreparation& operator=(const SubgraphPreparation&) = delete;

  /// From any thread. Requests are prepared in order.
  void ask(const AutomatonRequest& request);

 private:
  void run();

  const high_level_controller::RequestBase base_;
  high_level_controller::WeightDesign weights_;  ///< the thread's
  std::function<void(high_level_controller::PreparedRequest)> on_prepared_;
  std::stop_source stop_;

  time::Signal signal_;
  // Guarded by signal_:
  std::deque<AutomatonRequest> asked_;
  bool ends_{};

  std::thread thread_;  // last: it uses everything above
};

}  // namespace hlc::process
