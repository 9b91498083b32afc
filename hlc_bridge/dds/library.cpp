#include "hlc_bridge/dds/library.hpp"

#include <memory>
#include <mutex>

#include <fastrtps/attributes/LibrarySettingsAttributes.h>
#include <fastrtps/types/DynamicDataFactory.h>
#include <fastrtps/types/DynamicTypeBuilderFactory.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>

#include "hlc_bridge/dds/register_lab_types.hpp"

#if defined(__SANITIZE_ADDRESS__)
// Fast DDS 2.9 frees the pool of every writer and reader through a base class without virtual
// destructor: harmless, but the address sanitizer would end each of our processes at its first
// endpoint. It asks this function for defaults.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "new_delete_type_mismatch=0"; }
#endif

namespace hlc {

void set_up_library() {
  static std::once_flag once;
  std::call_once(once, [] {
    namespace fdds = eprosima::fastdds::dds;
    namespace frtps = eprosima::fastrtps;
    fdds::Log::ClearConsumers();
    fdds::Log::RegisterConsumer(std::make_unique<fdds::StdoutErrConsumer>());
    frtps::LibrarySettingsAttributes settings;
    settings.intraprocess_delivery = frtps::INTRAPROCESS_OFF;
    frtps::xmlparser::XMLProfileManager::library_settings(settings);
    // Made here, by one thread: discovery threads of two participants would make them at the same
    // time, and one of each would be lost.
    static_cast<void>(frtps::types::DynamicTypeBuilderFactory::get_instance());
    static_cast<void>(frtps::types::DynamicDataFactory::get_instance());
    register_lab_types();
  });
}

eprosima::fastrtps::Duration_t to_duration(std::chrono::nanoseconds time) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
  return {static_cast<std::int32_t>(seconds.count()),
          static_cast<std::uint32_t>((time - seconds).count())};
}

}  // namespace hlc
