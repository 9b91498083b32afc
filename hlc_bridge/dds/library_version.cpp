#include "hlc_bridge/dds/library_version.hpp"

#include <fastrtps/config.h>

namespace hlc {

std::string library_version() { return FASTRTPS_VERSION_STR; }

}  // namespace hlc
