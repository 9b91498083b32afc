#include "hlc_bridge/dds/library_version.hpp"

#include "hlc_bridge/dds/fast_dds.hpp"

namespace hlc::dds {

std::string library_version() { return fast_dds_version(); }

}  // namespace hlc::dds
