#pragma once

#include "hlc_bridge/record/run_folder.hpp"
#include "vehicle_sim/closed_loop/recorded_run.hpp"

namespace hlc::apps {

/// The messages that a run in real time was driven with, from its run.mcap.
/// @throws std::invalid_argument with one line: there is no run.mcap or it has no state lists (our
/// middleware did not record), or an operator's request changed a subgraph
/// @throws std::runtime_error with one line naming the file: it is broken or foreign, or a message
/// in it is
[[nodiscard]] closed_loop::RecordedMessages read_recorded_messages(const record::RunFolder& run);

}  // namespace hlc::apps
