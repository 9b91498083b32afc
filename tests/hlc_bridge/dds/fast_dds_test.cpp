#include "hlc_bridge/dds/fast_dds.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <fastdds/rtps/builtin/data/ParticipantProxyData.h>

namespace hlc::dds {
namespace {

const void* file_of(const void* address) {
  Dl_info info{};
  return dladdr(address, &info) != 0 ? info.dli_fbase : nullptr;
}

// The thread of the timers ended a process with an assertion when a participant left in the instant
// in which his lease was to be looked at.
TEST(ParticipantThatHasLeft, IsNotLookedAtForItsLease) {
  frtps::ParticipantProxyData proxy{frtps::RTPSParticipantAllocationAttributes{}};
  proxy.m_guid.entityId = frtps::c_EntityId_RTPSParticipant;
  proxy.m_guid.guidPrefix.value[0] = 1;
  proxy.should_check_lease_duration = true;
  proxy.clear();
  EXPECT_EQ(proxy.m_guid, frtps::GUID_t::unknown());
  EXPECT_FALSE(proxy.should_check_lease_duration);

  const void* called_by_library =
      dlsym(RTLD_DEFAULT, "_ZN8eprosima8fastrtps4rtps20ParticipantProxyData5clearEv");
  static const int here = 0;
  EXPECT_EQ(file_of(called_by_library), file_of(&here));
}

}  // namespace
}  // namespace hlc::dds
