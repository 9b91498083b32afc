#pragma once

#include <string>

#include "hlc_bridge/dds/library_version.hpp"
#include "hlc_bridge/record/program.hpp"

namespace hlc {

/// As every process tells the others (ParticipantOptions::version), for lab_doctor to compare.
[[nodiscard]] inline std::string program_version() {
  return "revision " + program_revision() + ", Fast DDS " + library_version();
}

}  // namespace hlc
