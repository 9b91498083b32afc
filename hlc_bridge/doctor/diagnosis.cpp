#include "hlc_bridge/doctor/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/settled_states.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::doctor {
namespace {

constexpr Nanoseconds kThisCentury = 946'684'800 * kNanosecondsPerSecond;  // since 1970 [ns]
constexpr double kFewestStates_hz = 25.0;  // of 50 Hz: half of them lost
constexpr double kShortest_s = 0.2;        // for a rate
constexpr std::int64_t kClockAhead_ns = 5'000'000;
constexpr std::int64_t kClockBehind_ns = 100'000'000;

std::string milliseconds(std::int64_t ns) {
  return fmt::format("{:.1f} ms", 1e-6 * static_cast<double>(ns));
}

/// Advice for stamps that do not fit this machine's clock; empty if they do.
std::string advice_on_clocks(std::int64_t least_age_ns) {
  if (least_age_ns < -kClockAhead_ns) {
    return "synchronise the clocks (chrony or NTP) before a run in real time";
  }
  if (least_age_ns > kClockBehind_ns) {
    return "synchronise the clocks (chrony or NTP), then look for a slow network";
  }
  return "";
}

Finding of_lab_control(const Received& received) {
  if (!received.lab_control_answers) {
    return {Verdict::kBad, "lab control: no answer to a parameter request",
            "start the lab control centre or lab_control, with the same --dds_domain and "
            "--transport"};
  }
  const std::string period =
      received.period_ms ? fmt::format(", period {} ms", *received.period_ms) : "";
  return {Verdict::kGood, "lab control: answers" + period, ""};
}

Finding of_vehicle(int id, const Received& received) {
  const std::string name = fmt::format("vehicle {}: ", id);
  const auto found = received.vehicles.find(static_cast<std::uint8_t>(id));
  if (found == received.vehicles.end()) {
    return {Verdict::kBad, name + "no state",
            "start it (vehicle_sim, or the car), with the same --dds_domain; between machines "
            "multicast must pass, or all must reach the same discovery server"};
  }
  const ReceivedVehicle& vehicle = found->second;
  const double since_first_s = 1e-9 * static_cast<double>(received.ended_at - vehicle.first_at);
  const double rate_hz = static_cast<double>(vehicle.states) / std::max(since_first_s, kShortest_s);
  const std::string states = fmt::format("{:.1f} states per second", rate_hz);
  if (!vehicle.is_located) {
    return {Verdict::kBad,
            name + "the cameras have not seen it for more than " +
                milliseconds(static_cast<std::int64_t>(kMaxPositionAge)),
            "put it where they see it, switch it on, and see that the positioning system runs"};
  }
  if (vehicle.has_logical_stamps) {
    return {Verdict::kGood, name + states + ", in logical time: clocks do not matter", ""};
  }
  if (vehicle.least_age_ns < -kClockAhead_ns) {
    return {Verdict::kBad,
            name + "its clock is ahead of this machine's by at least " +
                milliseconds(-vehicle.least_age_ns),
            advice_on_clocks(vehicle.least_age_ns)};
  }
  if (vehicle.least_age_ns > kClockBehind_ns) {
    return {Verdict::kBad,
            name + "its states are at least " + milliseconds(vehicle.least_age_ns) +
                " old when they arrive",
            advice_on_clocks(vehicle.least_age_ns)};
  }
  const std::string age = ", at least " + milliseconds(vehicle.least_age_ns) + " old";
  if (rate_hz < kFewestStates_hz) {
    return {Verdict::kBad, name + states + " instead of 50" + age,
            "the network loses them or the machine is overloaded"};
  }
  return {Verdict::kGood, name + states + age, ""};
}

Finding of_controller(int id, const Received& received) {
  const std::string name = controller_name(static_cast<std::uint8_t>(id));
  if (received.controllers.contains(name)) return {Verdict::kGood, name + ": there", ""};
  return {Verdict::kNote, name + ": not on the controllers' domain",
          "start it with the same --controller_domain, or with none and the same --dds_domain; one "
          "of other software is not seen here"};
}

Finding of_middleware(const Received& received) {
  if (received.lists > 0) {
    const std::string lists = fmt::format("middleware: {} state lists", received.lists);
    if (!received.least_list_age_ns) return {Verdict::kGood, lists, ""};
    const std::int64_t age_ns = *received.least_list_age_ns;
    if (age_ns < -kClockAhead_ns) {
      return {Verdict::kBad,
              lists + ", stamped at least " + milliseconds(-age_ns) + " ahead of this clock",
              "it runs on this machine: restart it, its clock was set while it ran"};
    }
    const bool is_old = age_ns > kClockBehind_ns;
    return {is_old ? Verdict::kBad : Verdict::kGood,
            lists + ", at least " + milliseconds(age_ns) + " old",
            is_old ? "the middleware or this machine is overloaded" : ""};
  }
  return {Verdict::kBad, "middleware: no state list",
          "start it on this machine with the same --middleware_domain (with --transport=lab both "
          "must share /dev/shm: no private container)"};
}

/// Machines with another version than this one's; those of the lab's own programs are unknown.
std::vector<Finding> of_versions(const Received& received, const std::string& version) {
  std::vector<Finding> findings;
  for (const auto& [name, other] : received.versions) {
    if (version.empty() || other == version) continue;
    findings.push_back({Verdict::kBad, name + ": " + other + ", this machine: " + version,
                        "build the same revision on all machines: messages may have changed"});
  }
  return findings;
}

}  // namespace

void note(const VehicleState& state, Nanoseconds now, Received& received) {
  const auto age_ns = static_cast<std::int64_t>(now - state.create_stamp);
  const auto [found, is_first] = received.vehicles.try_emplace(state.vehicle_id);
  ReceivedVehicle& vehicle = found->second;
  if (is_first) vehicle.first_at = now;
  ++vehicle.states;
  vehicle.least_age_ns = is_first ? age_ns : std::min(vehicle.least_age_ns, age_ns);
  vehicle.is_located = is_located(state);
  vehicle.has_logical_stamps = state.create_stamp < kThisCentury;
}

void note(const VehicleStateList& list, Nanoseconds now, Received& received) {
  ++received.lists;
  if (list.t_now < kThisCentury) return;
  const auto age_ns = static_cast<std::int64_t>(now - list.t_now);
  received.least_list_age_ns = std::min(received.least_list_age_ns.value_or(age_ns), age_ns);
}

bool is_complete(const std::vector<int>& vehicle_ids, const Received& received, Nanoseconds now,
                 Nanoseconds span) {
  const auto is_known = [&](int id) {
    const auto vehicle = received.vehicles.find(static_cast<std::uint8_t>(id));
    return vehicle != received.vehicles.end() && now >= vehicle->second.first_at + span &&
           received.controllers.contains(controller_name(static_cast<std::uint8_t>(id)));
  };
  return received.lab_control_answers && (!received.listened_to_middleware || received.lists > 0) &&
         std::ranges::all_of(vehicle_ids, is_known);
}

std::vector<Finding> diagnose(const std::vector<int>& vehicle_ids, const Received& received,
                              const std::string& version) {
  std::vector<Finding> findings{of_lab_control(received)};
  for (const int id : vehicle_ids) findings.push_back(of_vehicle(id, received));
  for (const auto& [id, vehicle] : received.vehicles) {
    if (std::ranges::find(vehicle_ids, static_cast<int>(id)) != vehicle_ids.end()) continue;
    findings.push_back({Verdict::kNote, fmt::format("vehicle {}: also present", id),
                        "if it takes no part, the others do not keep clear of it"});
  }
  if (received.listened_to_middleware) findings.push_back(of_middleware(received));
  for (const int id : vehicle_ids) findings.push_back(of_controller(id, received));
  std::ranges::move(of_versions(received, version), std::back_inserter(findings));
  return findings;
}

}  // namespace hlc::doctor
