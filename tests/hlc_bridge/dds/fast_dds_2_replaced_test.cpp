#include "hlc_bridge/dds/fast_dds.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <string>

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
}

struct Replaced {
  const char* name;
  const char* symbol;
};
void PrintTo(const Replaced& one, std::ostream* out) { *out << one.name; }

// By name; that the library then calls them, datagram_test shows.
class ReplacedFunctions : public testing::TestWithParam<Replaced> {};

TEST_P(ReplacedFunctions, AreFoundBeforeThoseOfTheLibrary) {
  static const int here = 0;
  EXPECT_EQ(file_of(dlsym(RTLD_DEFAULT, GetParam().symbol)), file_of(&here));
  EXPECT_NE(dlsym(RTLD_NEXT, GetParam().symbol), nullptr) << "the library no longer has it";
}

constexpr std::array kReplaced{
    Replaced{
        "MatchForAuthentication",
        "_ZN8eprosima8fastrtps4rtps8security15SecurityManager23match_builtin_endpointsERKNS1_20"
        "ParticipantProxyDataE"},
    Replaced{
        "MatchForKeys",
        "_ZN8eprosima8fastrtps4rtps8security15SecurityManager36match_builtin_key_exchange_endpo"
        "intsERKNS1_20ParticipantProxyDataE"},
    Replaced{"Clear", "_ZN8eprosima8fastrtps4rtps20ParticipantProxyData5clearEv"},
    Replaced{"Statistics",
             "_ZNK8eprosima8fastrtps4rtps15MessageReceiver25notify_network_statisticsERKNS1_9"
             "Locator_tES5_PNS1_12CDRMessage_tE"},
    Replaced{"Heartbeat",
             "_ZN8eprosima8fastrtps4rtps14StatefulReader19processHeartbeatMsgERKNS1_6GUID_tEjRKNS1"
             "_16SequenceNumber_tES8_bb"},
    Replaced{"Gap",
             "_ZN8eprosima8fastrtps4rtps14StatefulReader13processGapMsgERKNS1_6GUID_tERKNS1_16"
             "SequenceNumber_tERKNS0_11BitmapRangeIS6_NS1_18SequenceNumberDiffELj256EEE"},
    Replaced{"Data",
             "_ZN8eprosima8fastrtps4rtps14StatefulReader14processDataMsgEPNS1_13CacheChange_tE"},
    Replaced{
        "Fragment",
        "_ZN8eprosima8fastrtps4rtps14StatefulReader18processDataFragMsgEPNS1_13CacheChange_tEjjt"},
    Replaced{"StatelessData",
             "_ZN8eprosima8fastrtps4rtps15StatelessReader14processDataMsgEPNS1_13CacheChange_tE"},
    Replaced{"StatelessFragment",
             "_ZN8eprosima8fastrtps4rtps15StatelessReader18processDataFragMsgEPNS1_13CacheChange_"
             "tEjjt"}};

INSTANTIATE_TEST_SUITE_P(FastDds, ReplacedFunctions, testing::ValuesIn(kReplaced),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace hlc::dds
