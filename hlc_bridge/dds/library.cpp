#include "hlc_bridge/dds/library.hpp"

#include <mutex>

#include "hlc_bridge/dds/register_lab_types.hpp"

namespace hlc::dds {

void set_up_library() {
  static std::once_flag once;
  std::call_once(once, [] {
    find_library_functions();
    log_library_errors();
    turn_off_delivery_within_process();
    make_type_factories();
    register_lab_types();
  });
}

LibraryDuration to_duration(std::chrono::nanoseconds time) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
  return {static_cast<std::int32_t>(seconds.count()),
          static_cast<std::uint32_t>((time - seconds).count())};
}

}  // namespace hlc::dds
