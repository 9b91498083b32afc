#include "hlc_bridge/machine/start_up.hpp"

#include <algorithm>
#include <utility>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::machine {
namespace {

std::string in_seconds(Nanoseconds timeout) {
  return std::to_string(timeout / kNanosecondsPerSecond) + " s";
}

}  // namespace

void StartUp::fail(std::string text) {
  exit_code_ = kExitMissing;
  wake_up_.reset();
  line_ = error(std::move(text));
}

std::vector<std::string> StartUp::requests_at(Nanoseconds now) {
  if (!since_) {
    since_ = now;
    notice_ = WaitNotice(now);
  }
  if (parameters_.complete()) {
    wake_up_.reset();
    return {};
  }
  const std::vector<std::string> missing = parameters_.missing();
  if (is_too_late(now)) {
    fail(std::string(kLabControlName) + " did not send " + joined(missing) + " within " +
         in_seconds(timeout_));
    return {};
  }
  if (now < next_request_) return {};
  next_request_ = now + kRequestInterval;
  if (notice_.is_due(now)) {
    line_ = info("waiting for " + std::string(kLabControlName) + " to send " + joined(missing));
  }
  wake_up_ = std::min(next_request_, *since_ + timeout_);
  return missing;
}

void StartUp::wait_for(Nanoseconds now, const std::string& missing) {
  if (missing.empty()) {
    wake_up_.reset();
    return;
  }
  if (is_too_late(now)) return fail("missing after " + in_seconds(timeout_) + ": " + missing);
  if (notice_.is_due(now)) line_ = info("waiting for " + missing);
  wake_up_ = std::min(notice_.next(), *since_ + timeout_);
}

}  // namespace hlc::machine
