// Preloaded into a process: its system clock can be set while it runs, by a number of nanoseconds
// in the file that HLC_TEST_CLOCK names, whatever the machine's clock shows.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <ctime>

namespace {

const std::atomic<std::int64_t>* offset() {
  static const std::atomic<std::int64_t>* const kOffset = []() -> const std::atomic<std::int64_t>* {
    const char* file = std::getenv("HLC_TEST_CLOCK");
    const int opened = file == nullptr ? -1 : ::open(file, O_RDONLY | O_CLOEXEC);
    if (opened < 0) return nullptr;
    void* memory = ::mmap(nullptr, sizeof(std::int64_t), PROT_READ, MAP_SHARED, opened, 0);
    ::close(opened);
    return memory == MAP_FAILED ? nullptr : static_cast<std::atomic<std::int64_t>*>(memory);
  }();
  return kOffset;
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) {
  using ClockGettime = int (*)(clockid_t, timespec*);
  static const auto kLibrarys = reinterpret_cast<ClockGettime>(::dlsym(RTLD_NEXT, "clock_gettime"));
  const int result = kLibrarys(clock, time);
  if (result != 0 || clock != CLOCK_REALTIME || offset() == nullptr) return result;
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t set = time->tv_sec * kSecond + time->tv_nsec + offset()->load();
  time->tv_sec = set / kSecond;
  time->tv_nsec = set % kSecond;
  return result;
}
