#include "tests/integration/flooder.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <random>
#include <utility>

#include "hlc_bridge/dds/topics.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"

namespace hlc::test {
namespace {

using dds::DomainRole;
namespace topics = dds::topics;

constexpr std::uint8_t kVehicle = 1;
constexpr std::uint8_t kOther = 2;
constexpr std::size_t kMostEntries = 1000;

std::size_t entries(std::size_t bytes, std::size_t bytes_each) {
  return std::clamp<std::size_t>(bytes / bytes_each, 1, kMostEntries);
}

ConvexPolygon regular_polygon(std::size_t corners) {
  constexpr double kTurn_rad = 6.283185307179586;
  ConvexPolygon polygon;
  for (std::size_t i = 0; i < std::max<std::size_t>(corners, 3); ++i) {
    const double angle_rad = kTurn_rad * static_cast<double>(i) / static_cast<double>(corners);
    polygon.vertices_m.emplace_back(std::cos(angle_rad), std::sin(angle_rad));
  }
  return polygon;
}

std::vector<ConvexPolygon> areas(std::size_t bytes) {
  const std::size_t corners = std::clamp<std::size_t>(bytes / 16'000, 4, kMostEntries);
  return std::vector<ConvexPolygon>(entries(bytes, corners * 16 + 8), regular_polygon(corners));
}

std::string text(std::size_t bytes, char letter) {
  constexpr std::size_t kLongest = 60'000;
  return std::string(std::min(bytes, kLongest), letter);
}

/// Of another message in every call. The type has no message that asks a process to end.
template <class Message>
Message message_of(std::size_t bytes, std::mt19937_64& random) = delete;

template <>
coordination::Traffic message_of(std::size_t bytes, std::mt19937_64& random) {
  auto traffic = dds::sample<coordination::Traffic>(random);
  traffic.vehicle = {kOther};
  traffic.step = {static_cast<std::uint64_t>(time::real_time_now() / 200'000'000)};
  traffic.reference_areas_m = areas(bytes);
  return traffic;
}

template <>
coordination::Prediction message_of(std::size_t bytes, std::mt19937_64& random) {
  auto prediction = dds::sample<coordination::Prediction>(random);
  prediction.vehicle = {kOther};
  prediction.step = {static_cast<std::uint64_t>(time::real_time_now() / 200'000'000)};
  prediction.areas.areas_m = areas(bytes);
  return prediction;
}

template <>
coordination::Outcome message_of(std::size_t /*bytes*/, std::mt19937_64& /*random*/) {
  return {.vehicle = {kOther},
          .step = {static_cast<std::uint64_t>(time::real_time_now() / 200'000'000)}};
}

template <>
ReportRecord message_of(std::size_t bytes, std::mt19937_64& random) {
  auto record = dds::sample<ReportRecord>(random);
  record.report.vehicle = {kVehicle};
  constexpr std::size_t kManeuvers = 100;
  record.report.plan.assign(kManeuvers, {.to = {0}, .label = text(bytes / kManeuvers, 'l')});
  return record;
}

template <>
AutomatonRequest message_of(std::size_t bytes, std::mt19937_64& /*random*/) {
  AutomatonRequest request{.vehicle = {kVehicle}, .id = time::real_time_now()};
  request.subgraph.labels.assign(10, text(bytes / 10, 'l'));
  return request;
}

template <>
RunState message_of(std::size_t /*bytes*/, std::mt19937_64& /*random*/) {
  return {.phase = RunPhase::kRunning, .start = time::real_time_now()};
}

template <>
SystemTrigger message_of(std::size_t /*bytes*/, std::mt19937_64& /*random*/) {
  return {time::real_time_now()};
}

template <>
VehicleStateList message_of(std::size_t bytes, std::mt19937_64& random) {
  auto list = dds::sample<VehicleStateList>(random);
  list.t_now = time::real_time_now();
  list.period_ms = 200;
  list.states.assign(entries(bytes, 150), dds::sample<VehicleState>(random));
  return list;
}

template <>
Parameter message_of(std::size_t bytes, std::mt19937_64& /*random*/) {
  return {"flood", text(bytes, 'p')};
}

template <>
TrajectoryCommand message_of(std::size_t bytes, std::mt19937_64& random) {
  auto command = dds::sample<TrajectoryCommand>(random);
  command.vehicle_id = kVehicle;
  command.create_stamp = time::real_time_now();
  command.points.resize(entries(bytes, 40));
  return command;
}

template <>
ReadyStatus message_of(std::size_t bytes, std::mt19937_64& /*random*/) {
  return {text(bytes, 'r'), time::real_time_now()};
}

template <>
ParameterRequest message_of(std::size_t bytes, std::mt19937_64& /*random*/) {
  return {text(bytes, 'p')};
}

template <>
VehicleState message_of(std::size_t /*bytes*/, std::mt19937_64& random) {
  auto state = dds::sample<VehicleState>(random);
  state.vehicle_id = kVehicle;
  state.create_stamp = time::real_time_now();
  return state;
}

template <class Message>
auto writer_on(const dds::Topic<Message>& topic) {
  return [topic](dds::Participant& participant, std::size_t bytes) {
    const auto writer = std::make_shared<dds::Writer<Message>>(participant, topic);
    const auto random = std::make_shared<std::mt19937_64>(1);
    return FloodWriter{.write = [=] { writer->write(message_of<Message>(bytes, *random)); },
                       .matched = [=] { return writer->matched(); }};
  };
}

template <class Message>
Flood flood(const std::string& reader, const std::string& peer, int domain, DomainRole role,
            const dds::Topic<Message>& topic) {
  return {.reader = reader,
          .peer = peer,
          .topic = topic.name,
          .domain = domain,
          .role = role,
          .writer = writer_on(topic)};
}

}  // namespace

std::vector<Flood> floods(int lab_domain) {
  const std::string controller = controller_name(kVehicle);
  const std::string other = controller_name(kOther);
  const std::string middleware = middleware_name(kVehicle);
  const std::string vehicle = vehicle_name(kVehicle);
  const std::string simulated = "vehicle_" + std::to_string(kVehicle);  // in LabProcesses
  const std::string lab = kLabControlName;
  const int local = lab_domain + kVehicle;
  const int controllers = lab_domain + 50;
  using enum DomainRole;
  return {
      flood(controller, other, controllers, kController, topics::traffic()),
      flood(controller, other, controllers, kController, topics::prediction()),
      flood(controller, other, controllers, kController, topics::outcome()),
      flood(controller, lab, controllers, kController, topics::run_state()),
      flood(controller, "operator", controllers, kController, topics::automaton_request()),
      flood(controller, middleware, local, kLocal, topics::system_trigger()),
      flood(controller, middleware, local, kLocal, topics::vehicle_state_list()),
      flood(controller, lab, lab_domain, kLab, topics::parameter()),
      flood(controller, lab, lab_domain, kLab, topics::system_trigger()),
      flood(middleware, lab, lab_domain, kLab, topics::parameter()),
      flood(middleware, lab, lab_domain, kLab, topics::system_trigger()),
      flood(middleware, vehicle, lab_domain, kLab, topics::vehicle_state(kVehicle)),
      flood(middleware, controller, local, kLocal, topics::ready_status()),
      flood(middleware, controller, local, kLocal, topics::command()),
      flood(simulated, lab, lab_domain, kLab, topics::parameter()),
      flood(simulated, lab, lab_domain, kLab, topics::system_trigger()),
      flood(simulated, middleware, lab_domain, kLab, topics::vehicle_command(kVehicle)),
      flood(lab, middleware, lab_domain, kLab, topics::ready_status()),
      flood(lab, middleware, lab_domain, kLab, topics::parameter_request()),
      flood(lab, vehicle, lab_domain, kLab, topics::vehicle_state(kVehicle)),
      flood(lab, controller, controllers, kController, topics::report()),
  };
}

Flooder::Flooder(const Flood& flood, const std::string& name, std::size_t bytes)
    : thread_{[this, flood, name, bytes] { publish(flood, name, bytes); }} {}

Flooder::~Flooder() {
  ends_ = true;
  thread_.join();
}

void Flooder::publish(const Flood& flood, const std::string& name, std::size_t bytes) {
  constexpr int kEachTime = 20;
  constexpr std::chrono::milliseconds kPause{2};
  dds::Participant participant(dds::on_loopback(name, flood.domain, flood.role));
  const FloodWriter writer = flood.writer(participant, bytes);
  auto next = std::chrono::steady_clock::now();
  while (!ends_) {
    for (int i = 0; i < kEachTime && writer.matched() > 0; ++i) {
      writer.write();
      ++num_published_;
    }
    // A machine that is too slow publishes without a pause, but does not catch up.
    next = std::max(next + kPause, std::chrono::steady_clock::now());
    std::this_thread::sleep_until(next);
  }
}

}  // namespace hlc::test
