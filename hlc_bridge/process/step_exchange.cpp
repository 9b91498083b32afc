#include "hlc_bridge/process/step_exchange.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <type_traits>
#include <utility>

#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/time/real_timer.hpp"

namespace hlc {
namespace {

constexpr std::chrono::nanoseconds kSilence{kMessageTimeout};

}  // namespace

template <class Message>
StepExchange::Channel<Message>::Channel(StepExchange& exchange, const Topic<Message>& topic)
    : writer(exchange.controllers_, topic, [&exchange] { exchange.signal_.notify(); }),
      reader(exchange.controllers_, topic,
             [&exchange](const Message& message) { exchange.take(message); }) {}

StepExchange::StepExchange(VehicleId own, Participant& controllers, Signal& signal,
                           bool logical_time, std::string node_id, std::function<bool()> is_over)
    : own_(own),
      controllers_(controllers),
      signal_(signal),
      logical_time_(logical_time),
      node_id_(std::move(node_id)),
      is_over_(std::move(is_over)),
      traffic_(*this, topics::traffic()),
      predictions_(*this, topics::prediction()),
      outcomes_(*this, topics::outcome()) {}

template <class Message>
const StepExchange::Channel<Message>& StepExchange::channel() const {
  if constexpr (std::is_same_v<Message, Traffic>) {
    return traffic_;
  } else if constexpr (std::is_same_v<Message, Prediction>) {
    return predictions_;
  } else {
    return outcomes_;
  }
}

template <class Message>
StepExchange::Channel<Message>& StepExchange::channel() {
  return const_cast<Channel<Message>&>(std::as_const(*this).template channel<Message>());
}

/// On a DDS thread.
template <class Message>
void StepExchange::take(const Message& message) {
  signal_.post([&] {
    channel<Message>().inbox.put(message);
    if constexpr (std::is_same_v<Message, Traffic>) {
      newest_traffic_[message.vehicle] = message.step;
      given_up_.erase(message.vehicle);
    }
  });
}

std::set<std::string> StepExchange::deaf(const std::set<std::string>& participants) const {
  std::set<std::string> result;
  const auto add = [&](const std::set<std::string>& hearers) {
    std::ranges::set_difference(participants, hearers, std::inserter(result, result.end()));
  };
  add(traffic_.writer.matched_names());
  add(predictions_.writer.matched_names());
  add(outcomes_.writer.matched_names());
  return result;
}

void StepExchange::begin(StepIndex step) {
  signal_.locked([&] {
    traffic_.inbox.begin(step);
    predictions_.inbox.begin(step);
    outcomes_.inbox.begin(step);
  });
}

template <class Message>
void StepExchange::say(const Message& message) {
  channel<Message>().writer.write(message);
}

bool StepExchange::is_awaited(VehicleId vehicle) const {
  return !given_up_.contains(vehicle) && controllers_.is_alive(controller_name(vehicle.value));
}

template <class Message>
void StepExchange::wait_for(const std::vector<VehicleId>& from, Nanoseconds deadline) {
  const StepMailbox<Message>& inbox = channel<Message>().inbox;
  const auto all_in = [&] {
    return is_over_() || std::ranges::all_of(from, [&](VehicleId vehicle) {
             return inbox.holds(vehicle) || !is_awaited(vehicle);
           });
  };
  if (!logical_time_) {
    static_cast<void>(signal_.wait_until(real_time_point(deadline), all_in));
    return;
  }
  if (signal_.wait_until(std::chrono::steady_clock::now() + kSilence, all_in)) return;
  for (const VehicleId vehicle : from) {
    if (signal_.locked([&] { return inbox.holds(vehicle); })) continue;
    spdlog::warn("{}: {} has said nothing for {} s and is not waited for any more", node_id_,
                 controller_name(vehicle.value), kMessageTimeout / kNanosecondsPerSecond);
    signal_.locked([&] { given_up_.insert(vehicle); });
  }
}

template <class Message>
std::vector<Message> StepExchange::heard() const {
  return signal_.locked([this] { return channel<Message>().inbox.all(); });
}

bool StepExchange::has_heard_twin() const { return newest_traffic(own_).has_value(); }

void StepExchange::forget_twin() {
  signal_.locked([this] { newest_traffic_.erase(own_); });
}

std::optional<StepIndex> StepExchange::newest_traffic(VehicleId vehicle) const {
  return signal_.locked([&]() -> std::optional<StepIndex> {
    const auto found = newest_traffic_.find(vehicle);
    if (found == newest_traffic_.end()) return std::nullopt;
    return found->second;
  });
}

template void StepExchange::say(const Traffic&);
template void StepExchange::say(const Prediction&);
template void StepExchange::say(const Outcome&);
template void StepExchange::wait_for<Traffic>(const std::vector<VehicleId>&, Nanoseconds);
template void StepExchange::wait_for<Prediction>(const std::vector<VehicleId>&, Nanoseconds);
template void StepExchange::wait_for<Outcome>(const std::vector<VehicleId>&, Nanoseconds);
template std::vector<Traffic> StepExchange::heard() const;
template std::vector<Prediction> StepExchange::heard() const;
template std::vector<Outcome> StepExchange::heard() const;

}  // namespace hlc
