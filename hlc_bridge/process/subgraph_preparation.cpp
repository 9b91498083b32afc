#include "hlc_bridge/process/subgraph_preparation.hpp"

#include <chrono>
#include <optional>
#include <utility>

#include "hlc_bridge/time/precedence.hpp"

namespace hlc {
namespace {

/// Only a bound for a wait that is woken.
constexpr std::chrono::hours kLong{1};

}  // namespace

SubgraphPreparation::SubgraphPreparation(RequestBase base, WeightDesign weights)
    : base_(std::move(base)), weights_(std::move(weights)), thread_([this] { run(); }) {}

SubgraphPreparation::~SubgraphPreparation() {
  stop_.request_stop();
  signal_.post([this] { ends_ = true; });
  thread_.join();
}

void SubgraphPreparation::ask(const AutomatonRequest& request) {
  signal_.post([&] {
    asked_.push_back(request);
    if (asked_.size() > kMaxWaiting) asked_.pop_front();
  });
}

std::vector<PreparedRequest> SubgraphPreparation::take() {
  return signal_.locked([this] { return std::exchange(done_, {}); });
}

void SubgraphPreparation::wait() const {
  static_cast<void>(signal_.wait_until(std::chrono::steady_clock::now() + kLongestWait,
                                       [this] { return asked_.empty() && !is_working_; }));
}

void SubgraphPreparation::run() {
  give_precedence();
  while (true) {
    static_cast<void>(signal_.wait_until(std::chrono::steady_clock::now() + kLong,
                                         [this] { return !asked_.empty() || ends_; }));
    const std::optional<AutomatonRequest> request =
        signal_.locked([this]() -> std::optional<AutomatonRequest> {
          if (ends_ || asked_.empty()) return std::nullopt;
          is_working_ = true;
          const AutomatonRequest first = std::move(asked_.front());
          asked_.pop_front();
          return first;
        });
    if (!request) {
      if (signal_.locked([this] { return ends_; })) return;
      continue;
    }
    PreparedRequest prepared = prepare(base_, *request, &weights_, stop_.get_token());
    signal_.post([&] {
      done_.push_back(std::move(prepared));
      is_working_ = false;
    });
  }
}

}  // namespace hlc
