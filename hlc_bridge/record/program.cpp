#include "hlc_bridge/record/program.hpp"

#include <sys/utsname.h>

#include <fstream>
#include <thread>

namespace hlc::record {
namespace {

std::string cpu_model() {
  std::ifstream info{"/proc/cpuinfo"};
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

std::string kernel() {
  utsname name{};
  if (uname(&name) != 0) {
    return "unknown";
  }
  return std::string{static_cast<const char*>(name.sysname)} + " " +
         static_cast<const char*>(name.release);
}

}  // namespace

result::Host this_host() { return {cpu_model(), std::thread::hardware_concurrency(), kernel()}; }

}  // namespace hlc::record
