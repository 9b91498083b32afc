// The page of a run under way in a browser. Skipped on a machine without Chromium.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "hlc_bridge/view/live_messages.hpp"
#include "tests/hlc_bridge/live/running_server.hpp"
#include "tests/hlc_bridge/view/sample_run.hpp"
#include "tests/support/browser.hpp"

namespace hlc::live {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr std::uint8_t kCars = 3;
constexpr std::size_t kSteps = 120;  // until a car is stuck

/// A run of three cars that the test lets go on.
class SlowRun {
 public:
  explicit SlowRun(const std::string& scenario = "sample")
      : run_(view::sample_run(kCars, kSteps)), messages_(begin_of(run_, scenario)) {}

  /// Portions with the next steps.
  [[nodiscard]] std::vector<std::string> go_on(std::size_t steps) {
    std::vector<std::string> portions;
    for (std::size_t i = 0; i < steps; ++i, ++step_) {
      for (std::size_t car = 0; car < kCars; ++car) {
        messages_.take(run_.rows[kCars * step_ + car].record);
        const result::Drive& drive = run_.drives.at(static_cast<std::uint8_t>(car + 1));
        for (std::size_t tick = 10 * step_; tick < 10 * (step_ + 1); ++tick) {
          messages_.take(VehicleState{.vehicle_id = static_cast<std::uint8_t>(car + 1),
                                      .create_stamp = drive[tick].t,
                                      .pose = drive[tick].pose,
                                      .speed_mps = drive[tick].speed_mps});
        }
      }
      portions.push_back(messages_.portion());
    }
    return portions;
  }
  [[nodiscard]] std::string end() { return messages_.last_portion("The run has ended."); }

 private:
  static view::FinishedRun begin_of(view::FinishedRun run, const std::string& scenario) {
    run.description.scenario = scenario;
    run.description.has_two_rounds = true;
    run.rows.clear();
    run.drives.clear();
    run.facts.first_step = {};
    return run;
  }

  view::FinishedRun run_;
  view::LiveMessages messages_;
  std::size_t step_{};
};

void append(const std::vector<std::string>& portions, RunningServer& server) {
  for (const std::string& portion : portions) server.append(portion);
}

class LiveInBrowser : public testing::Test {
 protected:
  void SetUp() override {
    if (render::path_of("chromium").empty()) GTEST_SKIP() << "no chromium on this machine";
    browser_.emplace();
  }
  static std::string url_of(const RunningServer& server) {
    return "http://127.0.0.1:" + std::to_string(server.port()) + "/";
  }

  [[nodiscard]] bool becomes_true(const std::string& expression) {
    return test::becomes_true(*browser_, expression);
  }

  std::optional<render::Browser> browser_;
};

TEST_F(LiveInBrowser, TheNewestMomentIsShownAndTheCarsMove) {
  SlowRun run;
  RunningServer server;
  append(run.go_on(10), server);
  browser_->open(url_of(server));
  ASSERT_TRUE(becomes_true("window.page && page.run.num_steps === 10"));
  EXPECT_TRUE(becomes_true("Math.abs(page.player.t - 1.8) < 0.01"));
  const std::string pose = "(page.run.driven_at(page.run.vehicles[0], page.player.t) || {x: 0}).x";
  const auto before = browser_->value_of(pose);
  append(run.go_on(10), server);
  EXPECT_TRUE(becomes_true("Math.abs(page.player.t - 3.8) < 0.01"));
  EXPECT_NE(browser_->value_of(pose), before);
  EXPECT_EQ(browser_->value_of("page.run.plan_points(page.run.vehicles[0], 0).path.length > 30"),
            true)
      << "the maneuvers are known";
  EXPECT_TRUE(becomes_true("document.getElementById('scrub').max > 3.9"));
  EXPECT_EQ(browser_->value_of("document.getElementById('fault').textContent"), "");
}

TEST_F(LiveInBrowser, WhoGoesBackStaysThereUntilLiveIsPressed) {
  SlowRun run;
  RunningServer server;
  append(run.go_on(10), server);
  browser_->open(url_of(server));
  ASSERT_TRUE(becomes_true("window.page && page.player.t > 1.5"));
  static_cast<void>(browser_->value_of("page.player.seek(0.4)"));
  append(run.go_on(10), server);
  ASSERT_TRUE(becomes_true("document.getElementById('scrub').max > 3"));
  EXPECT_EQ(browser_->value_of("page.player.t"), 0.4);
  EXPECT_EQ(browser_->value_of("document.getElementById('live').ariaPressed"), "false");
  static_cast<void>(browser_->value_of("document.getElementById('live').click()"));
  EXPECT_TRUE(becomes_true("Math.abs(page.player.t - 3.8) < 0.01"));
}

TEST_F(LiveInBrowser, WhyACarKeepsItsPlanOrWaitsIsNamedAsInAFinishedRun) {
  SlowRun run;
  RunningServer server;
  append(run.go_on(kSteps), server);
  browser_->open(url_of(server));
  ASSERT_TRUE(becomes_true("window.page && page.run.num_steps > 110"));
  const auto state_at = [this](const std::string& t) {
    return browser_
        ->value_of("page.player.seek(" + t +
                   "), page.draw(), document.getElementById('car_2').cells[2].textContent")
        .get<std::string>();
  };
  EXPECT_THAT(state_at("1.7"), StartsWith("keeps its plan: conflict with car 3"));
  EXPECT_THAT(state_at("2.5"), StartsWith("waits for car 1 since 1.0 s"));
  EXPECT_THAT(state_at("21.1"), StartsWith("stuck: waits for car 1 since 1.0 s"));
  EXPECT_THAT(browser_->value_of("document.getElementById('about').textContent").get<std::string>(),
              HasSubstr("two rounds of messages"));
}

TEST_F(LiveInBrowser, ABrokenConnectionIsNamedAndNothingIsLostOrTwiceThere) {
  SlowRun run;
  const std::vector<std::string> first = run.go_on(10);
  const std::vector<std::string> then = run.go_on(10);
  std::optional<RunningServer> server(std::in_place);
  const std::uint16_t port = server->port();
  append(first, *server);
  browser_->open(url_of(*server));
  ASSERT_TRUE(becomes_true("window.page && page.run.num_steps === 10"));
  server.reset();
  EXPECT_TRUE(becomes_true(
      "document.getElementById('fault').textContent.startsWith('The connection is broken')"));
  server.emplace(std::chrono::seconds{20}, port);
  append(first, *server);
  append(then, *server);
  ASSERT_TRUE(becomes_true("page.run.num_steps === 20"));
  EXPECT_EQ(browser_->value_of("document.getElementById('fault').textContent"), "");
  EXPECT_EQ(browser_->value_of(
                "page.run.vehicles.map((car) => car.drives.map(({states}) => states.length))"),
            nlohmann::json::parse("[[200], [200], [200]]"));
  EXPECT_EQ(browser_->value_of("page.run.maneuvers.length"), 2);
}

TEST_F(LiveInBrowser, AnotherRunAtTheSameAddressIsShownFromItsBegin) {
  std::optional<RunningServer> server(std::in_place);
  const std::uint16_t port = server->port();
  append(SlowRun("first").go_on(10), *server);
  browser_->open(url_of(*server));
  ASSERT_TRUE(becomes_true("window.page && document.title === 'Run of first'"));
  server.reset();
  server.emplace(std::chrono::seconds{20}, port, "2");
  append(SlowRun("second").go_on(5), *server);
  EXPECT_TRUE(becomes_true(
      "window.page && document.title === 'Run of second' && page.run.num_steps === 5"));
}

TEST_F(LiveInBrowser, TheEndIsShown) {
  SlowRun run;
  RunningServer server;
  append(run.go_on(5), server);
  browser_->open(url_of(server));
  ASSERT_TRUE(becomes_true("window.page && page.run.num_steps === 5"));
  server.append(run.end());
  server.end();
  EXPECT_TRUE(
      becomes_true("document.getElementById('fault').textContent === 'The run has ended.'"));
  EXPECT_EQ(browser_->value_of("page.run.num_steps"), 5);
}

}  // namespace
}  // namespace hlc::live
