#include "planner/road/lanelet_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/support/folders.hpp"

namespace hlc::road {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string kBounds =
    "<leftBound>\n"
    "<point><x>0</x><y>1</y></point>\n"
    "<point><x>2</x><y>1.5e0</y></point></leftBound>\n"
    "<rightBound><point><x>0</x><y>-1</y></point><point><x> 2.0 </x><y>-1</y></point></rightBound>";

std::string file_with(const std::string& content, const std::string& version = "2020a") {
  return "<?xml version=\"1.0\"?>\n<commonRoad benchmarkID=\"ZAM_A&amp;B-1\" commonRoadVersion=\"" +
         version + "\">\n" + content + "</commonRoad>\n";
}

std::string lanelet(const std::string& id, const std::string& rest, const std::string& bounds) {
  return "<lanelet id=\"" + id + "\">" + bounds + rest + "</lanelet>\n";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t place = text.find(what);
  EXPECT_NE(place, std::string::npos) << what;
  return text.replace(place, what.size(), by);
}

std::string error_of(const std::string& xml) {
  try {
    (void)parse_lanelet_map(xml, "map.xml");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(LaneletMap, IsReadFromBothVersionsOfTheFormat) {
  const std::string content = lanelet("7", "", kBounds);
  EXPECT_EQ(parse_lanelet_map(file_with(content, "2018b"), "map.xml"),
            parse_lanelet_map(file_with(content), "map.xml"));
}

TEST(LaneletMap, ReadsBoundsReferencesAndNeighbours) {
  const LaneletMap map = parse_lanelet_map(
      file_with(lanelet("7",
                        "<predecessor ref=\"7\"/><predecessor ref=\"8\"/><successor ref=\"8\"/>"
                        "<adjacentLeft drivingDir=\"opposite\" ref=\"8\"/>"
                        "<adjacentRight ref=\"8\" drivingDir=\"same\"/>",
                        kBounds) +
                lanelet("8", "", kBounds)),
      "map.xml");
  EXPECT_EQ(map.benchmark_id, "ZAM_A&B-1");
  ASSERT_EQ(map.lanelets.size(), 2U);
  const Lanelet& seven = map.lanelets.at(7);
  EXPECT_EQ(seven.id, 7);
  EXPECT_EQ(seven.left_m, (std::vector<Point>{{0.0, 1.0}, {2.0, 1.5}}));
  EXPECT_EQ(seven.right_m, (std::vector<Point>{{0.0, -1.0}, {2.0, -1.0}}));
  EXPECT_EQ(centre_line_m(seven), (std::vector<Point>{{0.0, 0.0}, {2.0, 0.25}}));
  EXPECT_EQ(seven.predecessors, (std::vector<LaneletId>{7, 8}));
  EXPECT_EQ(seven.successors, (std::vector<LaneletId>{8}));
  EXPECT_EQ(seven.adjacent_left, (Lanelet::Adjacent{.id = 8, .same_direction = false}));
  EXPECT_EQ(seven.adjacent_right, (Lanelet::Adjacent{.id = 8, .same_direction = true}));
  EXPECT_FALSE(map.lanelets.at(8).adjacent_left.has_value());
}

TEST(LaneletMap, IdsOfOtherElementsDoNotMatter) {
  const std::string intersection =
      "<intersection id=\"9\"><incoming id=\"7\"><incomingLanelet ref=\"7\"/></incoming>"
      "</intersection>\n";
  EXPECT_EQ(error_of(file_with(lanelet("7", "", kBounds) + intersection)), "no error");
}

TEST(LaneletMap, ErrorsNameFileLineValueAndWhatIsAllowed) {
  const std::string good = file_with(lanelet("7", "", kBounds));
  ASSERT_EQ(error_of(good), "no error");
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"", {"not well-formed XML"}},
      {"lanelets: []", {"not well-formed XML"}},
      {replaced(good, "</lanelet>", ""), {"not well-formed XML"}},
      {"<osm/>", {"map.xml:1: ", "<commonRoad>"}},
      {file_with(lanelet("7", "", kBounds), "2017a"), {"map.xml:2: ", "\"2017a\"", "\"2020a\""}},
      {replaced(good, " commonRoadVersion=\"2020a\"", ""), {"map.xml:2: ", "commonRoadVersion"}},
      {replaced(good, " benchmarkID=\"ZAM_A&amp;B-1\"", ""), {"map.xml:2: ", "benchmarkID"}},
      {file_with(""), {"map.xml:2: ", "at least one"}},
      {replaced(good, " id=\"7\"", ""), {"map.xml:3: ", "attribute id"}},
      {replaced(good, "id=\"7\"", "id=\"0\""), {"map.xml:3: ", "\"0\"", "from 1"}},
      {replaced(good, "id=\"7\"", "id=\"7x\""), {"map.xml:3: ", "\"7x\"", "whole number"}},
      {replaced(good, "id=\"7\"", "id=\"99999999999\""), {"map.xml:3: ", "2147483647"}},
      {file_with(lanelet("7", "", kBounds) + lanelet("7", "", kBounds)),
       {"map.xml:7: ", "7 is taken"}},
      {replaced(good, "leftBound", "leftbound"), {"not well-formed"}},
      {file_with(lanelet("7", "", "")), {"map.xml:3: ", "<leftBound>"}},
      {replaced(good, "<point><x>0</x><y>1</y></point>", ""), {"map.xml:3: ", "1 points", "2"}},
      {replaced(good, "<point><x>0</x><y>1</y></point>",
                "<point><x>0</x><y>1</y></point><point><x>0</x><y>1</y></point>"),
       {"map.xml:3: ", "lanelet 7", "has 3", "2", "must be equal"}},
      {replaced(good, "<y>1.5e0</y>", ""), {"map.xml:5: ", "<point>", "<y>"}},
      {replaced(good, "1.5e0", "1,5"), {"map.xml:5: ", "<y>", "\"1,5\"", "finite number"}},
      {replaced(good, "1.5e0", ""), {"map.xml:5: ", "<y>", "\"\"", "finite number"}},
      {replaced(good, "1.5e0", "nan"), {"map.xml:5: ", "\"nan\"", "finite number"}},
      {replaced(good, "1.5e0", "-inf"), {"map.xml:5: ", "\"-inf\"", "finite number"}},
      {replaced(good, "1.5e0", "1e999"), {"map.xml:5: ", "\"1e999\"", "finite number"}},
      {replaced(good, "1.5e0", "a\nb" + std::string(100, 'x')), {"map.xml:5: ", "\"a b", "..."}},
      {file_with(lanelet("7", "\n<successor ref=\"8\"/>", kBounds)),
       {"map.xml:7: ", "<successor>", "8", "id of a lanelet"}},
      {file_with(lanelet("7", "<predecessor/>", kBounds)), {"map.xml:6: ", "attribute ref"}},
      {file_with(lanelet("7", "<adjacentLeft ref=\"8\" drivingDir=\"same\"/>", kBounds)),
       {"map.xml:6: ", "<adjacentLeft>", "8"}},
      {file_with(lanelet("7", "<adjacentRight ref=\"7\" drivingDir=\"left\"/>", kBounds)),
       {"map.xml:6: ", "\"left\"", "\"same\" or \"opposite\""}},
  };
  for (const auto& [xml, parts] : cases) {
    const std::string error = error_of(xml);
    EXPECT_THAT(error, AllOf(StartsWith("map.xml:"), Not(HasSubstr("\n"))));
    for (const std::string& part : parts) {
      EXPECT_THAT(error, HasSubstr(part)) << xml;
    }
  }
}

TEST(LaneletMap, WrittenMapIsReadBackUpToTheLastDecimal) {
  LaneletMap map = parse_lanelet_map(
      file_with(
          lanelet("7", "<successor ref=\"8\"/><adjacentLeft drivingDir=\"opposite\" ref=\"8\"/>",
                  kBounds) +
          lanelet("8", "<predecessor ref=\"7\"/><adjacentRight drivingDir=\"same\" ref=\"7\"/>",
                  kBounds)),
      "map.xml");
  EXPECT_EQ(parse_lanelet_map(to_commonroad_xml(map), "written"), map);
  map.lanelets.at(7).left_m[0] = Point(1.0 / 3.0, -2.0 / 3.0);
  const LaneletMap back = parse_lanelet_map(to_commonroad_xml(map), "written");
  EXPECT_NEAR((back.lanelets.at(7).left_m[0] - map.lanelets.at(7).left_m[0]).norm(), 0.0, 1e-9);
}

TEST(LaneletMap, FileThatCannotBeReadOrWrittenIsNamed) {
  const auto directory = std::filesystem::temp_directory_path();
  for (const auto& file : {directory / "no_such_map.xml", directory}) {
    try {
      (void)read_lanelet_map(file);
      FAIL() << file;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), AllOf(StartsWith(file.string()), HasSubstr("cannot be read")));
    }
  }
  EXPECT_THROW(write_lanelet_map({}, directory / "no_such_folder" / "map.xml"), std::runtime_error);
}

TEST(LaneletMap, TheLabsFileIsRead) {
  const std::filesystem::path file =
      std::filesystem::path(test::source_folder()) / "../shared/data/LabMapCommonRoad.xml";
  if (!std::filesystem::exists(file)) {
    GTEST_SKIP() << "the lab's map is not here: " << file;
  }
  const LaneletMap map = read_lanelet_map(file);
  EXPECT_EQ(map.lanelets.size(), 104U);
  EXPECT_EQ(map.lanelets.at(57).successors, (std::vector<LaneletId>{55, 74}));
  EXPECT_EQ(map.lanelets.at(57).adjacent_left, (Lanelet::Adjacent{58, true}));
  EXPECT_EQ(map.lanelets.at(20).adjacent_left, (Lanelet::Adjacent{25, false}));
  EXPECT_EQ(map.lanelets.at(1).left_m.front(), Point(2.25, 3.82));
}

}  // namespace
}  // namespace hlc::road
