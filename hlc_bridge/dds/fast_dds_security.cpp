// Functions of Fast DDS's DDS security that are replaced (README.md).
#include <dlfcn.h>

#include <mutex>
#include <stdexcept>

#include <fastdds/rtps/builtin/data/ParticipantProxyData.h>
#include <fastrtps/config.h>

#include "hlc_bridge/dds/fast_dds.hpp"

namespace eprosima::fastrtps::rtps::security {

/// As far as it is needed here: the library installs no header of it.
class SecurityManager {
 public:
  void match_builtin_endpoints(const ParticipantProxyData& participant);
  void match_builtin_key_exchange_endpoints(const ParticipantProxyData& participant);
};

namespace {

using Match = void (*)(SecurityManager*, const ParticipantProxyData&);

Match in_library(const char* symbol) {
  void* address = dlsym(RTLD_NEXT, symbol);
  if (address == nullptr)
    throw std::runtime_error(
        std::string("Fast DDS " FASTRTPS_VERSION_STR ": the library has no function ") + symbol);
  return reinterpret_cast<Match>(address);
}

struct LibraryFunctions {
  Match match_endpoints = in_library(
      "_ZN8eprosima8fastrtps4rtps8security15SecurityManager23match_builtin_endpointsERKNS1_"
      "20Partici"
      "pantProxyDataE");
  Match match_key_exchange = in_library(
      "_ZN8eprosima8fastrtps4rtps8security15SecurityManager36match_builtin_key_exchange_"
      "endpointsERK"
      "NS1_20ParticipantProxyDataE");
};

const LibraryFunctions& library() {
  static const LibraryFunctions kFunctions;
  return kFunctions;
}

// Of all participants of the process. Neither function calls the other, and a thread that waits for
// such a lock holds none that its owner could wait for.
std::mutex endpoints_mutex;
std::mutex key_exchange_mutex;

}  // namespace

// The library describes the other participant in members that all its threads share. Two of them
// that find a participant each, at the same time, matched one of the two only: this process never
// read the other's authentication, and they did not meet.
void SecurityManager::match_builtin_endpoints(const ParticipantProxyData& participant) {
  const std::lock_guard lock(endpoints_mutex);
  library().match_endpoints(this, participant);
}

void SecurityManager::match_builtin_key_exchange_endpoints(
    const ParticipantProxyData& participant) {
  const std::lock_guard lock(key_exchange_mutex);
  library().match_key_exchange(this, participant);
}

}  // namespace eprosima::fastrtps::rtps::security

namespace hlc::dds {

void find_security_functions() { static_cast<void>(eprosima::fastrtps::rtps::security::library()); }

}  // namespace hlc::dds
