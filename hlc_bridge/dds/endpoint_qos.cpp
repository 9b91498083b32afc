#include "hlc_bridge/dds/endpoint_qos.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace hlc::dds {
namespace {

using std::chrono::milliseconds;

// How a lab endpoint behaves under Transport::kLab (cpm lab wire contract, 2 and 4).
enum class Lab : std::uint8_t {
  kBestEffort,       // BEST_EFFORT, KEEP_LAST 1, VOLATILE
  kBestEffortAll,    // BEST_EFFORT, KEEP_ALL, VOLATILE
  kReliable,         // RELIABLE, KEEP_LAST 1, VOLATILE
  kReliableAll,      // RELIABLE, KEEP_ALL, VOLATILE
  kReliableLate,     // RELIABLE, KEEP_LAST 1, TRANSIENT_LOCAL
  kReliableAllLate,  // RELIABLE, KEEP_ALL, TRANSIENT_LOCAL
};

struct LabRow {
  TopicId id;
  DomainRole role;
  Lab writer;
  Lab reader;
  // Transport::kLoopback: RELIABLE, KEEP_LAST with these depths, VOLATILE unless `late`.
  int writer_depth;
  int reader_depth;
  bool late;
};

// A depth covers what can arrive while the reader's process is delayed: vehicle ticks of more than
// a second; one ready status and some repetitions of every process; the triggers of ten logical
// seconds.
constexpr auto kLabTable = std::to_array<LabRow>({
    // clang-format off
    // topic                        domain              lab writer             lab reader            loopback: w, r, late
    {TopicId::kVehicleStateList,    DomainRole::kLocal, Lab::kBestEffort,      Lab::kBestEffort,        16,   16, false},
    {TopicId::kVehicleCommand,     DomainRole::kLocal, Lab::kBestEffort,      Lab::kBestEffortAll,     16,   16, false},
    {TopicId::kReadyStatus,         DomainRole::kLocal, Lab::kReliable,        Lab::kReliableAll,       16,   64, false},
    {TopicId::kSystemTrigger,       DomainRole::kLocal, Lab::kReliable,        Lab::kReliable,         512,  512, false},
    {TopicId::kGoalState,           DomainRole::kLocal, Lab::kReliableAllLate, Lab::kReliableAllLate,  256,  256, true},

    {TopicId::kVehicleState,        DomainRole::kLab,   Lab::kBestEffort,      Lab::kBestEffortAll,     64,   64, false},
    {TopicId::kVehicleObservation,  DomainRole::kLab,   Lab::kBestEffort,      Lab::kBestEffortAll,     64,   64, false},
    {TopicId::kVehicleCommand,     DomainRole::kLab,   Lab::kBestEffort,      Lab::kBestEffortAll,     16,   16, false},
    {TopicId::kReadyStatus,         DomainRole::kLab,   Lab::kReliable,        Lab::kReliableAll,       16, 1024, false},
    {TopicId::kSystemTrigger,       DomainRole::kLab,   Lab::kReliable,        Lab::kReliableAll,      512,  512, false},
    {TopicId::kStopRequest,         DomainRole::kLab,   Lab::kBestEffort,      Lab::kBestEffort,        16,   64, false},
    {TopicId::kParameterRequest,    DomainRole::kLab,   Lab::kReliable,        Lab::kBestEffort,        16,  256, false},
    {TopicId::kParameter,           DomainRole::kLab,   Lab::kReliable,        Lab::kReliable,         256,  256, false},
    {TopicId::kLog,                 DomainRole::kLab,   Lab::kReliable,        Lab::kReliable,         256, 1024, false},
    {TopicId::kLogLevel,            DomainRole::kLab,   Lab::kReliableAllLate, Lab::kReliableLate,       1,    1, true},
    {TopicId::kVisualization,       DomainRole::kLab,   Lab::kBestEffort,      Lab::kBestEffort,        16,  256, false},
    {TopicId::kGoalState,           DomainRole::kLab,   Lab::kReliableAllLate, Lab::kReliableAllLate,  256,  256, true},
    // clang-format on
});

// Our own topics: reliable on both transports; depth per vehicle.
struct OwnRow {
  TopicId id;
  bool keyed;
  int depth;
  Durability durability;
  bool of_a_step;  // worth a repair only within the step
};

constexpr auto kOwnTable = std::to_array<OwnRow>({
    {TopicId::kTraffic, true, 8, Durability::kVolatile, true},
    {TopicId::kPrediction, true, 8, Durability::kVolatile, true},
    {TopicId::kOutcome, true, 8, Durability::kVolatile, true},
    // A late joiner gets every report of a run of 10000 steps.
    {TopicId::kReport, true, 10'000, Durability::kTransientLocal, false},
    {TopicId::kRunState, false, 1, Durability::kTransientLocal, false},
    {TopicId::kAutomatonRequest, true, 1, Durability::kTransientLocal, false},
    {TopicId::kAutomatonAnswer, true, 16, Durability::kTransientLocal, false},
});

// In the lab's network, where samples do get lost: the tightest deadline of a step is 40 ms.
constexpr milliseconds kHeartbeatWithinStep{10};

constexpr int kKeepAllSamples = 5000;  // as in the library's defaults, which the lab uses

// Times do not affect matching. On loopback a sample is lost only when a buffer overflows; it is
// repaired within some 60 ms, against the library's 3 s. Acknowledgements and heartbeats slow down
// a run in logical time considerably, and so does the nack suppression of the library's default, 0
// s: its timer then ends and restarts with every sample, each time on another thread. In the lab's
// network heartbeats towards a participant that has died are to stay rare.
void set_times(EndpointQos& qos, Transport transport) {
  const bool loopback = transport == Transport::kLoopback;
  qos.max_blocking = loopback ? milliseconds{1000} : milliseconds{100};
  qos.heartbeat_period = milliseconds{50};
  qos.heartbeat_delay = milliseconds{1};
  qos.nack_response = milliseconds{0};
  qos.nack_suppression = loopback ? milliseconds{40} : milliseconds{0};
  qos.initial_acknack = milliseconds{1};
  qos.heartbeat_response = loopback ? milliseconds{10} : milliseconds{1};
}

EndpointQos with_history(int depth, int instances) {
  EndpointQos qos;
  qos.history_depth = depth;
  qos.max_instances = instances;
  qos.max_samples_per_instance = depth == 0 ? kKeepAllSamples : depth;
  qos.max_samples = qos.max_instances * qos.max_samples_per_instance;
  return qos;
}

EndpointQos lab_endpoint(Lab kind) {
  const bool keep_all =
      kind == Lab::kBestEffortAll || kind == Lab::kReliableAll || kind == Lab::kReliableAllLate;
  const bool best_effort = kind == Lab::kBestEffort || kind == Lab::kBestEffortAll;
  const bool late = kind == Lab::kReliableLate || kind == Lab::kReliableAllLate;
  EndpointQos qos = with_history(keep_all ? 0 : 1, 1);
  qos.reliability = best_effort ? Reliability::kBestEffort : Reliability::kReliable;
  qos.durability = late ? Durability::kTransientLocal : Durability::kVolatile;
  qos.preallocated = true;
  set_times(qos, Transport::kLab);
  return qos;
}

EndpointQos loopback_endpoint(int depth, bool late) {
  EndpointQos qos = with_history(depth, 1);
  qos.reliability = Reliability::kReliable;
  qos.durability = late ? Durability::kTransientLocal : Durability::kVolatile;
  qos.preallocated = true;
  set_times(qos, Transport::kLoopback);
  return qos;
}

EndpointQos own_endpoint(const OwnRow& row, Transport transport) {
  EndpointQos qos = with_history(row.depth, row.keyed ? kMaxInstances : 1);
  qos.reliability = Reliability::kReliable;
  qos.durability = row.durability;
  set_times(qos, transport);
  if (row.of_a_step && transport == Transport::kLab) {
    qos.heartbeat_period = kHeartbeatWithinStep;
  }
  return qos;
}

const char* name(DomainRole role) {
  switch (role) {
    case DomainRole::kLab:
      return "lab";
    case DomainRole::kLocal:
      return "local";
    case DomainRole::kController:
      return "controller";
  }
  return "?";
}

}  // namespace

TopicQos topic_qos(TopicId id, DomainRole role, Transport transport) {
  const auto lab = std::ranges::find_if(
      kLabTable, [&](const LabRow& row) { return row.id == id && row.role == role; });
  if (lab != kLabTable.end()) {
    if (transport == Transport::kLab) {
      return {lab_endpoint(lab->writer), lab_endpoint(lab->reader)};
    }
    return {loopback_endpoint(lab->writer_depth, lab->late),
            loopback_endpoint(lab->reader_depth, lab->late)};
  }
  const auto own = std::ranges::find_if(kOwnTable, [&](const OwnRow& row) { return row.id == id; });
  if (own != kOwnTable.end() && role == DomainRole::kController) {
    return {own_endpoint(*own, transport), own_endpoint(*own, transport)};
  }
  throw std::invalid_argument(
      fmt::format("topic {} does not belong on the {} domain", static_cast<int>(id), name(role)));
}

}  // namespace hlc::dds
