#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/topics.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/hlc/step_mailbox.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/time/signal.hpp"
#include "planner/coordination/messages.hpp"

namespace hlc {

/// What controllers tell each other in a step (planner/coordination/messages.hpp), on their own
/// domain: says what this one tells, gathers by step and sender what the others do, waits for it.
///
/// Message: Traffic, Prediction or Outcome.
class StepExchange {
 public:
  /// @param own  the vehicle for which is spoken here
  /// @param controllers, signal  must outlive this object; `signal` guards what has come
  /// @param node_id  for the log
  /// @param is_over  asked under the signal's lock: whether waiting has no use any more
  StepExchange(VehicleId own, Participant& controllers, Signal& signal, bool logical_time,
               std::string node_id, std::function<bool()> is_over);
  StepExchange(const StepExchange&) = delete;  // its readers refer to it
  StepExchange& operator=(const StepExchange&) = delete;

  /// Those of them that do not hear yet what is said here.
  [[nodiscard]] std::set<std::string> deaf(const std::set<std::string>& participants) const;

  /// From now on it is about this step: what has come for earlier ones is dropped.
  void begin(StepIndex step);
  template <class Message>
  void say(const Message& message);
  /// Waits until the messages of all of `from` are in. Not for those that are gone from the domain.
  /// In real time at most until `deadline`, in logical time 10 s of silence: who is silent so long
  /// is not waited for any more until it sends its traffic again.
  template <class Message>
  void wait_for(const std::vector<VehicleId>& from, Nanoseconds deadline);
  /// Those of this step.
  template <class Message>
  [[nodiscard]] std::vector<Message> heard() const;

  /// Somebody else speaks for the own vehicle, or has since forget_twin. (What is said here is not
  /// heard here.)
  [[nodiscard]] bool has_heard_twin() const;
  void forget_twin();
  /// The step of the vehicle's newest traffic, whenever it came.
  [[nodiscard]] std::optional<StepIndex> newest_traffic(VehicleId vehicle) const;

 private:
  template <class Message>
  struct Channel {
    Channel(StepExchange& exchange, const Topic<Message>& topic);

    StepMailbox<Message> inbox;  ///< guarded by the signal
    Writer<Message> writer;
    Reader<Message> reader;  // last: it ends first
  };

  template <class Message>
  [[nodiscard]] const Channel<Message>& channel() const;
  template <class Message>
  [[nodiscard]] Channel<Message>& channel();
  template <class Message>
  void take(const Message& message);
  [[nodiscard]] bool is_awaited(VehicleId vehicle) const;

  VehicleId own_;
  Participant& controllers_;
  Signal& signal_;
  bool logical_time_;
  std::string node_id_;
  std::function<bool()> is_over_;
  // Guarded by the signal:
  std::map<VehicleId, StepIndex> newest_traffic_;
  std::set<VehicleId> given_up_;  ///< silent for 10 s in logical time: not waited for until heard

  Channel<Traffic> traffic_;
  Channel<Prediction> predictions_;
  Channel<Outcome> outcomes_;
};

}  // namespace hlc
