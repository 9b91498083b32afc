#include "hlc_bridge/process/goal_forwarder.hpp"

#include <utility>

#include "hlc_bridge/dds/topics.hpp"

namespace hlc {

GoalForwarder::GoalForwarder(Participant& lab, Participant& local)
    : writer_(local, topics::goal_state()),
      reader_(lab, topics::goal_state(),
              [this](const GoalState& goal) { mail_.post([&] { waiting_.push_back(goal); }); }) {}

void GoalForwarder::forward() {
  for (const GoalState& goal : mail_.locked([this] { return std::exchange(waiting_, {}); })) {
    writer_.write(goal);
  }
}

}  // namespace hlc
