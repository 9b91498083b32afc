// A system clock that is set during a run in real time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "tests/integration/lab_processes.hpp"
#include "tests/integration/run_reports.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

/// Processes that are started meanwhile have a system clock that can be set.
class SystemClock {
 public:
  explicit SystemClock(const std::filesystem::path& file) : file_{file} {
    set_by(0ns);
    ::setenv("HLC_TEST_CLOCK", file_.c_str(), 1);
    ::setenv("LD_PRELOAD", HLC_SET_CLOCK, 1);
  }
  ~SystemClock() {
    ::unsetenv("LD_PRELOAD");
    ::unsetenv("HLC_TEST_CLOCK");
  }
  SystemClock(const SystemClock&) = delete;
  SystemClock& operator=(const SystemClock&) = delete;

  void set_by(std::chrono::nanoseconds offset) const {
    const std::int64_t value = offset.count();
    std::array<char, sizeof value> bytes{};
    std::memcpy(bytes.data(), &value, sizeof value);
    std::fstream file(file_, std::ios::binary | std::ios::in | std::ios::out);
    if (!file) file.open(file_, std::ios::binary | std::ios::out);
    file.write(bytes.data(), bytes.size());
  }

 private:
  std::filesystem::path file_;
};

struct ClockStep {
  std::chrono::milliseconds offset;
  const char* name;
};

class SystemClockThatIsSet : public testing::TestWithParam<ClockStep> {};

// Set back by an hour, cars stood for an hour without a line; set forth, the run ended at once.
TEST_P(SystemClockThatIsSet, ChangesNothingAndIsNamed) {
  constexpr std::size_t kSteps = 40;
  LabProcesses lab({.steps = kSteps, .simulated_time = false});
  const SystemClock clock(lab.folder() / "clock");
  lab.start_all();
  ASSERT_TRUE(eventually(60s, [&] { return reports_so_far(lab.folder()).size() > 30; }));
  clock.set_by(GetParam().offset);
  EXPECT_THAT(lab.still_running_after(60s), testing::IsEmpty());
  const std::string step = std::string("the system's clock was set ") +
                           (GetParam().offset < 0ms ? "back" : "forth") + " by ";
  for (const std::string& name : lab.names()) {
    EXPECT_EQ(lab[name].wait_for(1ms), 0) << name << ": " << lab.log(name);
    EXPECT_THAT(lab.log(name), testing::HasSubstr(step)) << name;
  }
  EXPECT_THAT(lab.log("lab_control"), testing::HasSubstr(std::to_string(kSteps) + " steps driven"));
  EXPECT_EQ(lab.summarize(), 0) << lab.log("summarize");
}

INSTANTIATE_TEST_SUITE_P(Clocks, SystemClockThatIsSet,
                         testing::Values(ClockStep{-3'600'000ms, "BackByAnHour"},
                                         ClockStep{3'600'000ms, "ForthByAnHour"},
                                         ClockStep{-10ms, "BackBy10Milliseconds"},
                                         ClockStep{10ms, "ForthBy10Milliseconds"}),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace hlc::test
