#include "hlc_bridge/record/program.hpp"

#include <sys/utsname.h>

#include <thread>

#include "planner/common/processor_model.hpp"

namespace hlc::record {
namespace {

std::string kernel() {
  utsname name{};
  if (uname(&name) != 0) {
    return "unknown";
  }
  return std::string{static_cast<const char*>(name.sysname)} + " " +
         static_cast<const char*>(name.release);
}

}  // namespace

result::Host this_host() {
  return {processor_model(), std::thread::hardware_concurrency(), kernel()};
}

}  // namespace hlc::record
