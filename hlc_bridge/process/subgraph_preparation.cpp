#include "hlc_bridge/process/subgraph_preparation.hpp"

#include <chrono>
#include <optional>
#include <utility>

#include "hlc_bridge/time/precedence.hpp"

namespace hlc::process {
namespace {

/// Only a bound for an interruptible wait.
constexpr std::chrono::hours kLong{1};

}  // namespace

SubgraphPreparation::SubgraphPreparation(
    high_level_controller::RequestBase base, high_level_controller::WeightDesign weights,
    std::function<void(high_level_controller::PreparedRequest)> on_prepared)
    : base_(std::move(base)),
      weights_(std::move(weights)),
      on_prepared_(std::move(on_prepared)),
      thread_([this] { run(); }) {}

SubgraphPreparation::~SubgraphPreparation() {
  stop_.request_stop();
  signal_.post([this] { ends_ = true; });
  thread_.join();
}

void SubgraphPreparation::ask(const AutomatonRequest& request) {
  signal_.post([&] { asked_.push_back(request); });
}

void SubgraphPreparation::run() {
  time::give_precedence();
  while (true) {
    static_cast<void>(signal_.wait_until(std::chrono::steady_clock::now() + kLong,
                                         [this] { return !asked_.empty() || ends_; }));
    const std::optional<AutomatonRequest> request =
        signal_.locked([this]() -> std::optional<AutomatonRequest> {
          if (ends_ || asked_.empty()) return std::nullopt;
          const AutomatonRequest first = std::move(asked_.front());
          asked_.pop_front();
          return first;
        });
    if (request) {
      on_prepared_(high_level_controller::prepare(base_, *request, &weights_, stop_.get_token()));
    } else if (signal_.locked([this] { return ends_; })) {
      return;
    }
  }
}

}  // namespace hlc::process
