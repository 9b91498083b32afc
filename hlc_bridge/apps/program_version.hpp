#pragma once

#include <string>

#include "hlc_bridge/dds/library_version.hpp"
#include "hlc_bridge/record/program.hpp"

namespace hlc::apps {

/// Published by every process (ParticipantOptions::version); lab_doctor compares it.
[[nodiscard]] inline std::string program_version() {
  return "revision " + program_revision() + ", Fast DDS " + dds::library_version();
}

}  // namespace hlc::apps
