#pragma once

#include <chrono>
#include <cstdlib>
#include <thread>

namespace hlc::time {

/// Ends the process with `exit_code` if it has not ended within `time`: for the end of main, since
/// a thread of the library can hang while participants are destroyed (Fast DDS 2.9.1 was seen in an
/// endless loop over sequence numbers, in StatefulWriter::add_gaps_for_holes_in_history_).
inline void end_within(std::chrono::seconds time, int exit_code) {
  std::thread([time, exit_code] {
    std::this_thread::sleep_for(time);
    std::_Exit(exit_code);
  }).detach();
}

/// Longer than any successful destruction (less than 1 s).
inline constexpr std::chrono::seconds kTakeDownTime{2};

}  // namespace hlc::time
