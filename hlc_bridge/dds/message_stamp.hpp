#pragma once

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/messages/automaton_messages.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "planner/coordination/messages.hpp"

namespace hlc::dds {

template <class Message>
[[nodiscard]] MessageStamp stamp_of(const Message& message) {
  if constexpr (requires { message.create_stamp; }) return {.time = message.create_stamp};
  if constexpr (requires { message.t_now; }) return {.time = message.t_now};
  if constexpr (requires { message.step; }) return {.step = message.step};
  if constexpr (requires { message.report.step; }) return {.step = message.report.step};
  return {};
}

/// It begins the instant that it names, unless it ends the run.
[[nodiscard]] inline MessageStamp stamp_of(const SystemTrigger& message) {
  if (message.next_start == kStopSymbol) return {};
  return {.time = message.next_start};
}

}  // namespace hlc::dds
