#include "hlc_bridge/doctor/listen.hpp"

#include <gtest/gtest.h>

#include <future>

#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/run_parameters.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc::doctor {
namespace {

using namespace std::chrono_literals;

class Listening : public testing::Test {
 protected:
  [[nodiscard]] ListenOptions options(std::chrono::milliseconds time) const {
    return {.transport = dds::Transport::kLoopback,
            .domains = {.lab = domains_.first(),
                        .local = domains_.first() + 1,
                        .controller = domains_.first() + 50},
            .discovery_server = std::nullopt,
            .time = time};
  }

  test::DomainReservation domains_{2};
};

TEST_F(Listening, HearsWhoIsThere) {
  const dds::Participant lab_control{
      dds::on_loopback(kLabControlName, domains_.first(), dds::DomainRole::kLab)};
  const dds::Participant controller{
      dds::on_loopback(controller_name(2), domains_.first() + 50, dds::DomainRole::kController)};
  dds::Participant vehicle{
      dds::on_loopback(vehicle_name(2), domains_.first(), dds::DomainRole::kLab)};
  dds::Participant middleware{
      dds::on_loopback(middleware_name(2), domains_.first() + 1, dds::DomainRole::kLocal)};
  dds::Participant answering{
      dds::on_loopback("answering", domains_.first(), dds::DomainRole::kLab)};
  dds::Writer<VehicleState> states{vehicle, dds::topics::vehicle_state(2)};
  dds::Writer<VehicleStateList> lists{middleware, dds::topics::vehicle_state_list()};
  dds::Writer<Parameter> parameters{answering, dds::topics::parameter()};
  const dds::Reader<ParameterRequest> requests{
      answering, dds::topics::parameter_request(), [&](const ParameterRequest& request) {
        parameters.write({.name = request.name, .value = std::uint64_t{250}});
      }};

  auto listening = std::async(std::launch::async, [&] {
    return listen(options(60s), [](const Received& received) {
      return received.lab_control_answers && received.lists == 1 && received.vehicles.contains(2) &&
             received.vehicles.at(2).states == 7 && !received.controllers.empty();
    });
  });
  ASSERT_TRUE(states.wait_for_matched(1, dds::soon()) && lists.wait_for_matched(1, dds::soon()));
  for (int i = 0; i < 7; ++i) {
    states.write({.vehicle_id = 2, .create_stamp = time::real_time_now()});
  }
  lists.write({.t_now = time::real_time_now(),
               .period_ms = 250,
               .states = {},
               .observations = {},
               .active_vehicle_ids = {2}});
  const Received result = listening.get();
  ASSERT_EQ(result.vehicles.count(2), 1U);
  EXPECT_EQ(result.vehicles.at(2).states, 7U);
  EXPECT_GE(result.vehicles.at(2).least_age_ns, 0);
  EXPECT_EQ(result.lists, 1U);
  EXPECT_TRUE(result.lab_control_answers);
  EXPECT_EQ(result.period_ms, 250U);
  EXPECT_EQ(result.controllers, std::set<std::string>{controller_name(2)});
}

TEST_F(Listening, EndsWhereNobodyIs) {
  const Nanoseconds begin = time::real_time_now();
  const Received result = listen(options(500ms), [](const Received&) { return false; });
  EXPECT_TRUE(result.vehicles.empty());
  EXPECT_FALSE(result.lab_control_answers);
  EXPECT_EQ(result.lists, 0U);
  EXPECT_TRUE(result.controllers.empty());
  EXPECT_GE(result.ended_at, begin + 500'000'000);
}

}  // namespace
}  // namespace hlc::doctor
