#pragma once

#include <deque>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/time/signal.hpp"

namespace hlc {

/// The control centre's goals for the controllers (commonroad_dds_goal_states), held back until
/// somebody says that these are ready: one that asks for no earlier goals misses none either.
class GoalForwarder {
 public:
  /// @param lab, local  must outlive this object
  GoalForwarder(Participant& lab, Participant& local);

  /// Writes what has come since, in its order.
  void forward();

 private:
  Signal mail_;  // guards what follows, down to the next blank line
  std::deque<GoalState> waiting_;

  Writer<GoalState> writer_;
  Reader<GoalState> reader_;
};

}  // namespace hlc
