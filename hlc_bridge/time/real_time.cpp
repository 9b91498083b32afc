#include "hlc_bridge/time/real_time.hpp"

namespace hlc::time {

Nanoseconds real_time_now() {
  using namespace std::chrono;
  const auto since_epoch = system_clock::now().time_since_epoch();
  return static_cast<Nanoseconds>(duration_cast<nanoseconds>(since_epoch).count());
}

std::chrono::system_clock::time_point real_time_point(Nanoseconds time) {
  using namespace std::chrono;
  return system_clock::time_point{
      duration_cast<system_clock::duration>(nanoseconds{static_cast<std::int64_t>(time)})};
}

}  // namespace hlc::time
