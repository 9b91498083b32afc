// What our processes announce on the wire with the lab's transport, against the tables of the
// lab's wire contract (3 and 4). History is not announced, and so not here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/messages/node_names.hpp"
#include "tests/integration/discovered_endpoints.hpp"
#include "tests/integration/lab_processes.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

enum class Qos { kBestEffort, kReliable, kReliableLate };  // late: TRANSIENT_LOCAL, else VOLATILE

/// One row of the contract: how writers and readers of a topic are to be announced.
struct Row {
  std::string topic;  ///< of vehicle 1 where the topic has a vehicle's number
  std::string type;
  Qos writer;
  Qos reader;
};

const std::vector<Row> kLocalTable{
    {"vehicleStateList", "VehicleStateList", Qos::kBestEffort, Qos::kBestEffort},
    {"vehicleCommandTrajectory", "VehicleCommandTrajectory", Qos::kBestEffort, Qos::kBestEffort},
    {"vehicleCommandPathTracking", "VehicleCommandPathTracking", Qos::kBestEffort,
     Qos::kBestEffort},
    {"vehicleCommandSpeedCurvature", "VehicleCommandSpeedCurvature", Qos::kBestEffort,
     Qos::kBestEffort},
    {"vehicleCommandDirect", "VehicleCommandDirect", Qos::kBestEffort, Qos::kBestEffort},
    {"readyStatus", "ReadyStatus", Qos::kReliable, Qos::kReliable},
    {"systemTrigger", "SystemTrigger", Qos::kReliable, Qos::kReliable},
    {"commonroad_dds_goal_states", "CommonroadDDSGoalState", Qos::kReliableLate,
     Qos::kReliableLate},
};

const std::vector<Row> kLabTable{
    {"vehicle/1/vehicleState", "VehicleState", Qos::kBestEffort, Qos::kBestEffort},
    {"vehicle/1/vehicleObservation", "VehicleObservation", Qos::kBestEffort, Qos::kBestEffort},
    {"vehicle/1/vehicleCommandTrajectory", "VehicleCommandTrajectory", Qos::kBestEffort,
     Qos::kBestEffort},
    {"vehicle/1/vehicleCommandPathTracking", "VehicleCommandPathTracking", Qos::kBestEffort,
     Qos::kBestEffort},
    {"vehicle/1/vehicleCommandSpeedCurvature", "VehicleCommandSpeedCurvature", Qos::kBestEffort,
     Qos::kBestEffort},
    {"vehicle/1/vehicleCommandDirect", "VehicleCommandDirect", Qos::kBestEffort, Qos::kBestEffort},
    {"readyStatus", "ReadyStatus", Qos::kReliable, Qos::kReliable},
    {"systemTrigger", "SystemTrigger", Qos::kReliable, Qos::kReliable},
    {"stopRequest", "StopRequest", Qos::kBestEffort, Qos::kBestEffort},
    {"parameterRequest", "ParameterRequest", Qos::kReliable, Qos::kBestEffort},
    {"parameter", "Parameter", Qos::kReliable, Qos::kReliable},
    {"log", "Log", Qos::kReliable, Qos::kReliable},
    {"logLevel", "LogLevel", Qos::kReliableLate, Qos::kReliableLate},
    {"visualization", "Visualization", Qos::kBestEffort, Qos::kBestEffort},
    {"hlc_hello", "HLCHello", Qos::kReliable, Qos::kReliable},
    {"round_trip_time", "RoundTripTime", Qos::kBestEffort, Qos::kBestEffort},
    {"commonroad_dds_goal_states", "CommonroadDDSGoalState", Qos::kReliableLate,
     Qos::kReliableLate},
    {"commonroadObstacle", "CommonroadObstacleList", Qos::kBestEffort, Qos::kBestEffort},
    {"vehiclePoseSimulated", "VehicleObservation", Qos::kBestEffort, Qos::kBestEffort},
    {"ipsLedPoints", "LedPoints", Qos::kBestEffort, Qos::kBestEffort},
};

/// Without which the lab's own programs would miss something: process, writer or reader, topic.
struct Part {
  std::string process;
  bool is_writer;
  std::string topic;
};

const std::vector<Part> kLocalParts{
    {middleware_name(1), true, "vehicleStateList"},
    {middleware_name(1), false, "vehicleCommandTrajectory"},
    {middleware_name(1), false, "readyStatus"},
    {middleware_name(1), true, "systemTrigger"},
    {controller_name(1), false, "vehicleStateList"},
    {controller_name(1), true, "vehicleCommandTrajectory"},
    {controller_name(1), true, "readyStatus"},
    {controller_name(1), false, "systemTrigger"},
};

const std::vector<Part> kLabParts{
    {vehicle_name(1), true, "vehicle/1/vehicleState"},
    {vehicle_name(1), false, "vehicle/1/vehicleCommandTrajectory"},
    {vehicle_name(1), true, "readyStatus"},
    {vehicle_name(1), false, "systemTrigger"},
    {middleware_name(1), false, "vehicle/1/vehicleState"},
    {middleware_name(1), true, "vehicle/1/vehicleCommandTrajectory"},
    {middleware_name(1), true, "readyStatus"},
    {middleware_name(1), false, "systemTrigger"},
    {middleware_name(1), true, "parameterRequest"},
    {middleware_name(1), false, "parameter"},
    {controller_name(1), true, "stopRequest"},
    {controller_name(1), true, "visualization"},
    {controller_name(1), true, "log"},
    {controller_name(1), false, "logLevel"},
    {controller_name(1), false, "systemTrigger"},  // of ours alone: the stop without a middleware
    {kLabControlName, false, "readyStatus"},
    {kLabControlName, true, "systemTrigger"},
    {kLabControlName, false, "parameterRequest"},
    {kLabControlName, true, "parameter"},
    {kLabControlName, false, "stopRequest"},
    {kLabControlName, true, "log"},
};

const std::set<std::string> kOwnTopics{
    "hlc/traffic",   "hlc/prediction",        "hlc/outcome",         "hlc/report",
    "hlc/run_state", "hlc/automaton_request", "hlc/automaton_answer"};

bool holds(const std::vector<Endpoint>& endpoints, const Part& part) {
  return std::ranges::any_of(endpoints, [&](const Endpoint& endpoint) {
    return endpoint.process == part.process && endpoint.topic == part.topic &&
           endpoint.is_writer == part.is_writer;
  });
}

bool hold_all(const std::vector<Endpoint>& endpoints, const std::vector<Part>& parts) {
  return std::ranges::all_of(parts, [&](const Part& part) { return holds(endpoints, part); });
}

std::string text_of(const Endpoint& endpoint) {
  return endpoint.process + (endpoint.is_writer ? " writes " : " reads ") + endpoint.topic;
}

/// The lab's: bare names, no keys, type objects, nothing that is not in the table.
void expect_as_in(const std::vector<Row>& table, const std::vector<Part>& parts,
                  const std::vector<Endpoint>& endpoints) {
  for (const Part& part : parts) {
    EXPECT_TRUE(holds(endpoints, part))
        << part.process << (part.is_writer ? " does not write " : " does not read ") << part.topic;
  }
  for (const Endpoint& endpoint : endpoints) {
    SCOPED_TRACE(text_of(endpoint));
    const auto row = std::ranges::find(table, endpoint.topic, &Row::topic);
    ASSERT_NE(row, table.end()) << "is not in the contract";
    const Qos qos = endpoint.is_writer ? row->writer : row->reader;
    EXPECT_EQ(endpoint.type, row->type);
    EXPECT_EQ(endpoint.is_reliable, qos != Qos::kBestEffort);
    EXPECT_EQ(endpoint.is_transient_local, qos == Qos::kReliableLate);
    EXPECT_EQ(endpoint.entity_kind, endpoint.is_writer ? 0x03 : 0x04);
    EXPECT_TRUE(endpoint.has_type_object);
  }
}

TEST(Wire, EveryEndpointIsAnnouncedAsTheLabsContractSays) {
  LabProcesses lab(
      {.scenario = "paper_red_alone", .steps = 4000, .simulated_time = false, .transport = "lab"});
  lab.start_all();  // before our own participants, whose sockets they would inherit
  const auto listen = [&](int domain, dds::DomainRole role) {
    return DiscoveredEndpoints(
        {.name = "listener", .domain_id = domain, .role = role, .transport = dds::Transport::kLab});
  };
  const DiscoveredEndpoints on_lab = listen(lab.lab_domain(), dds::DomainRole::kLab);
  const DiscoveredEndpoints on_local = listen(lab.lab_domain() + 1, dds::DomainRole::kLocal);
  const DiscoveredEndpoints on_own =
      listen(dds::default_controller_domain(lab.lab_domain()), dds::DomainRole::kController);
  const auto own_topics = [&] {
    std::set<std::string> topics;
    for (const Endpoint& endpoint : on_own.so_far()) topics.insert(endpoint.topic);
    return topics;
  };
  // When a report is there, the car drives: whatever the processes make has been made. That we have
  // been notified is a separate question.
  const bool are_there = eventually(60s, [&] {
    return hold_all(on_lab.so_far(), kLabParts) && hold_all(on_local.so_far(), kLocalParts) &&
           std::ranges::includes(own_topics(), kOwnTopics) &&
           std::ranges::count(read_text(lab.folder() / "reports.csv"), '\n') > 20;
  });
  lab["lab_control"].send(SIGINT);
  EXPECT_THAT(lab.still_running_after(60s), testing::IsEmpty());
  EXPECT_TRUE(are_there) << lab.log("lab_control");

  expect_as_in(kLabTable, kLabParts, on_lab.so_far());
  expect_as_in(kLocalTable, kLocalParts, on_local.so_far());

  // Our own types would kill the lab's programs if they met their type objects.
  for (const Endpoint& endpoint : on_own.so_far()) {
    EXPECT_FALSE(endpoint.has_type_object) << text_of(endpoint);
    EXPECT_TRUE(endpoint.type.starts_with("hlc::")) << text_of(endpoint) << ": " << endpoint.type;
  }
  EXPECT_EQ(own_topics(), kOwnTopics);
}

}  // namespace
}  // namespace hlc::test
