#include "hlc_bridge/messages/node_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hlc {
namespace {

using testing::ElementsAre;

TEST(NodeNames, ASharedNameStandsForTheProcessOfEachVehicle) {
  const std::vector<std::uint8_t> ids{1, 2, 30};
  EXPECT_THAT(process_names(middleware_name(ids)),
              ElementsAre(middleware_name(1), middleware_name(2), middleware_name(30)));
  EXPECT_THAT(process_names(vehicle_name(ids)),
              ElementsAre(vehicle_name(1), vehicle_name(2), vehicle_name(30)));
}

TEST(NodeNames, OtherNamesStandForThemselves) {
  const std::vector<std::uint8_t> one{7};
  EXPECT_EQ(middleware_name(one), middleware_name(7));
  for (const std::string name :
       {"middleware_7", "lab_control", "1,2", "a_1,", "a_1,b", "_", "1,2_", ""}) {
    EXPECT_THAT(process_names(name), ElementsAre(name));
  }
}

TEST(NodeNames, AReadyMiddlewareOfSeveralVehiclesIsReadyForEach) {
  const std::vector<std::uint8_t> ids{1, 12};
  EXPECT_EQ(middleware_ready_id(ids), "MW for muCars 1, 12 ready.");
  EXPECT_THAT(single_ready_ids(middleware_ready_id(ids)),
              ElementsAre(middleware_ready_id(1), middleware_ready_id(12)));
  EXPECT_THAT(single_ready_ids(middleware_ready_id(3)), ElementsAre(middleware_ready_id(3)));
  for (const std::string name : {"hlc_1", "MW for muCars 1,2 ready.", "MW for muCars  ready.",
                                 "MW for muCars ready.", "MW for muCars 1, 2 ready", ""}) {
    EXPECT_THAT(single_ready_ids(name), ElementsAre(name));
  }
}

}  // namespace
}  // namespace hlc
