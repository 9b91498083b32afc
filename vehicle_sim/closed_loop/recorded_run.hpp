#pragma once

#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "planner/controller/prepared_subgraph.hpp"
#include "planner/coordination/messages.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::closed_loop {

/// What the controllers of a run in real time received.
struct RecordedMessages {
  template <class Message>
  struct Published {
    Nanoseconds time{};  ///< of the run, when it was published
    std::shared_ptr<const Message> message;
  };
  template <class Message>
  using BySteps = std::multimap<StepIndex, Published<Message>>;

  std::map<std::pair<VehicleId, StepIndex>, VehicleStateList> lists;  ///< of its middleware
  BySteps<coordination::Traffic> traffic;
  BySteps<coordination::Prediction> predictions;
  BySteps<coordination::Outcome> outcomes;
};

/// Drives the controller of one vehicle again through the steps of a run in real time, on the
/// lists and the others' messages as they were recorded.
///
/// When a message arrived is not recorded. Assumed: traffic arrived unless the report has its
/// sender as missing; a prediction or an outcome arrived if it was published before the deadline of
/// the phase that needs it (StepDeadlines).
///
/// @param recorded  reports of the vehicle, by step, one for each
/// @return the reports of the same steps, up to the first one whose list is not recorded; their
/// measured times are those recorded
[[nodiscard]] std::vector<ReportRecord> drive_recorded(const scenario::Scenario& scenario,
                                                       const controller::PreparedSubgraph& prepared,
                                                       VehicleId vehicle,
                                                       const RecordedMessages& messages,
                                                       std::span<const ReportRecord> recorded);

}  // namespace hlc::closed_loop
