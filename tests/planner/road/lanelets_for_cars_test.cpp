#include "planner/road/lanelets_for_cars.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace hlc::road::lanelets_for_cars_test {
namespace {

using testing::HasSubstr;

std::string file_with(const std::string& content) {
  return "<commonRoad benchmarkID=\"ZAM_A-1\" commonRoadVersion=\"2020a\">\n" + content +
         "\n</commonRoad>\n";
}

std::string lanelet(const std::string& more, const std::string& line = "", int id = 4) {
  return "<lanelet id=\"" + std::to_string(id) + "\"><leftBound>" + line +
         "</leftBound><rightBound/>" + more + "</lanelet>\n";
}

std::set<LaneletId> read(const std::string& content) {
  return parse_lanelets_for_cars(file_with(content), "file.xml");
}

std::string refusal(const std::string& content) {
  try {
    static_cast<void>(read(content));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(LaneletsForCars, AreThoseWithoutUsersOrWithCarsAmongThem) {
  EXPECT_EQ(read(lanelet("<laneletType>urban</laneletType>", "", 1) +
                 lanelet("<userOneWay>bus</userOneWay><userOneWay>car</userOneWay>", "", 2) +
                 lanelet("<userBidirectional>vehicle</userBidirectional>", "", 3)),
            (std::set<LaneletId>{1, 2, 3}));
}

TEST(LaneletsForCars, AreNoPavementsAndNoLanesOfOthers) {
  EXPECT_EQ(read(lanelet("<userOneWay>bus</userOneWay>", "", 1) +
                 lanelet("<laneletType>sidewalk</laneletType>", "", 2) +
                 lanelet("<userBidirectional>pedestrian</userBidirectional>", "", 3)),
            std::set<LaneletId>{});
}

TEST(LaneletsForCars, WithRulesThatNoCarRegardsAreRefusedByName) {
  for (const std::string name :
       {"stopLine", "speedLimit", "trafficSignRef", "trafficLightRef", "wall"}) {
    EXPECT_THAT(refusal(lanelet("<" + name + "/>")),
                HasSubstr("file.xml:2: lanelet 4: <" + name + "> is not regarded, must be absent"));
  }
}

TEST(LaneletsForCars, WithLinesThatCarsWouldCrossAreRefused) {
  const std::string beside = "<adjacentLeft ref=\"5\" drivingDir=\"same\"/>";
  const std::string oncoming = "<adjacentLeft ref=\"5\" drivingDir=\"opposite\"/>";
  for (const std::string line :
       {"solid", "broad_solid", "solid_dashed", "dashed_solid", "curb", "dahsed"}) {
    const std::string marking = "<lineMarking>" + line + "</lineMarking>";
    EXPECT_THAT(refusal(lanelet(beside, marking)),
                HasSubstr("lanelet 4: <lineMarking> of <leftBound> is \"" + line + "\", must be"));
    EXPECT_EQ(refusal(lanelet(oncoming, marking)), "");
    EXPECT_EQ(refusal(lanelet("", marking)), "");
  }
  EXPECT_EQ(refusal(lanelet(beside, "<lineMarking>dashed</lineMarking>")), "");
  EXPECT_EQ(refusal(lanelet(beside, "<lineMarking> dashed\n</lineMarking>")), "");
}

TEST(LaneletsForCars, OfATypeThatIsNotKnownAreRefused) {
  EXPECT_THAT(
      refusal(lanelet("<laneletType>urbn</laneletType>")),
      HasSubstr("file.xml:2: lanelet 4: <laneletType> is \"urbn\", must be one of urban, "));
  EXPECT_EQ(refusal(lanelet("<laneletType> urban </laneletType>")), "");
}

TEST(LaneletsForCars, InAFileWithOtherElementsAreRefusedByTheirNames) {
  EXPECT_EQ(refusal("<location/><scenarioTags/><intersection id=\"9\"/><planningProblem/>"), "");
  EXPECT_THAT(refusal("<weather/>"), HasSubstr("file.xml:2: <weather> is not regarded"));
}

}  // namespace
}  // namespace hlc::road::lanelets_for_cars_test
