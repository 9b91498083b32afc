#include "hlc_bridge/view/run_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hlc_bridge/view/page_files.hpp"
#include "planner/common/text_file.hpp"
#include "tests/hlc_bridge/view/sample_run.hpp"

namespace hlc::view {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr std::size_t kMostOfPage = 60'000;  ///< bytes of all files of the page
constexpr std::size_t kMegabyte = 1'000'000;

/// The text of the element with the data.
std::string data_of(const std::string& page) {
  const std::string begin = R"(<script type="application/json" id="data">)";
  const std::size_t from = page.find(begin) + begin.size();
  return page.substr(from, page.find("</script>", from) - from);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

TEST(RunPage, HoldsTheRunAsOneJsonText) {
  const std::string page = run_page(sample_run(3, 20));
  const auto data = nlohmann::json::parse(data_of(page));
  EXPECT_EQ(data, nlohmann::json::parse(page_messages(sample_run(3, 20))));
}

TEST(RunPage, LoadsNothing) {
  const std::string page = run_page(sample_run(3, 20));
  EXPECT_THAT(page, Not(HasSubstr(" src=")));
  EXPECT_THAT(page, Not(HasSubstr("stylesheet")));
  EXPECT_EQ(count(page, "href="), 1U) << "the empty icon";
  for (const std::string& line : split(page, '\n')) {
    EXPECT_THAT(line, Not(StartsWith("import ")));
    EXPECT_THAT(line, Not(StartsWith("export ")));
  }
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, Not(HasSubstr("connect-src")));
  EXPECT_THAT(page, Not(HasSubstr("EventSource")));
}

TEST(RunPage, NoNameEndsTheDataOrBeginsAScript) {
  const std::string name = "</script><script>alert(1)</script><!--";
  FinishedRun run = sample_run(2, 20, name);
  run.description.scenario = name;
  run.log.push_back({.process = name, .stamp = {}, .level = name, .text = name, .run_s = {}});
  run.facts.reason = name;
  run.facts.died.push_back({.process = name, .sign = name});
  const std::string page = run_page(run);
  EXPECT_EQ(count(page, "<script"), count(run_page(sample_run(2, 20)), "<script"));
  EXPECT_EQ(count(page, "</script"), 2U);
  EXPECT_EQ(count(page, "<!--"), 0U);
  EXPECT_EQ(nlohmann::json::parse(data_of(page)).at(0).at("vehicles").at(0).at("name"), name);
}

// Targets: 1.5 MB for three cars of 30 s, 12 MB for twenty of 50 s. A run of the lab takes an
// eighth of them; a column that is not of differences would double it.
TEST(RunPage, TheSizeOfARunIsBounded) {
  EXPECT_LT(run_page(sample_run(3, 150)).size(), 0.15 * kMegabyte);
  EXPECT_LT(run_page(sample_run(20, 250)).size(), 1.0 * kMegabyte);
}

TEST(RunPage, NamesWhatWasWrongWithTheDrive) {
  FinishedRun run = sample_run(2, 20);
  run.fault = "collision of 1 and 2";
  EXPECT_EQ(nlohmann::json::parse(data_of(run_page(run))).at(0).at("fault"), run.fault);
}

TEST(RunPage, ARunWithoutStepsHasAPage) {
  EXPECT_THAT(run_page(sample_run(2, 0)), HasSubstr("</html>"));
}

TEST(PicturePage, LoadsNothingAndNoNameEndsItsData) {
  const std::string name = "</script><script>alert(1)</script><!--";
  const std::string page = picture_page(sample_run(2, 20, name));
  EXPECT_EQ(count(page, "</script"), 2U);
  EXPECT_EQ(nlohmann::json::parse(data_of(page)).at(0).at("vehicles").at(0).at("name"), name);
  EXPECT_THAT(page, Not(HasSubstr(" src=")));
  EXPECT_THAT(page, Not(HasSubstr("stylesheet")));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  for (const std::string& line : split(page, '\n')) {
    EXPECT_THAT(line, Not(StartsWith("import ")));
    EXPECT_THAT(line, Not(StartsWith("export ")));
  }
}

TEST(PageFiles, OfThePageAreSmallAndStandInItAsTheyAre) {
  std::size_t size = 0;
  for (const auto& [name, text] : page_files()) {
    size += text.size();
    EXPECT_FALSE(text.empty()) << name;
    EXPECT_LE(split(text, '\n').size(), 400U) << name;
    if (name.ends_with(".js")) {
      EXPECT_THAT(text, Not(HasSubstr("<script")));
      EXPECT_THAT(text, Not(HasSubstr("</script")));
      EXPECT_THAT(text, Not(HasSubstr("innerHTML"))) << name << ": names must stay text";
    }
    if (name == "run.html") continue;
    EXPECT_THAT(text, Not(HasSubstr("//www."))) << name;
    EXPECT_THAT(text, Not(HasSubstr("http"))) << name;
  }
  EXPECT_LE(size, kMostOfPage);
}

}  // namespace
}  // namespace hlc::view
