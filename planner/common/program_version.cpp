#include "planner/common/program_version.hpp"

#include "hlc_revision.hpp"  // written at build time

namespace hlc {

std::string program_release() { return HLC_RELEASE; }

std::string program_revision() { return HLC_REVISION; }

}  // namespace hlc
