#pragma once

#include <chrono>

#include "hlc_bridge/dds/fast_dds.hpp"

/// Everything of Fast DDS that participants, writers and readers need. Only sources of this folder
/// include it.
namespace hlc::dds {

/// Once per process, before its first participant: registers the lab's types
/// (register_lab_types.hpp), turns off delivery within the process, and sends the library's own
/// errors to stderr.
///
/// Without delivery within the process a write never calls a reader's callback in the writing
/// thread, and two participants in one test communicate exactly as two processes do.
void set_up_library();

[[nodiscard]] LibraryDuration to_duration(std::chrono::nanoseconds time);

}  // namespace hlc::dds
