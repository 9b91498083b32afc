// How the page of a run reacts: time line, keys, mouse, touch, address.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hlc_bridge/view/page_in_browser.hpp"
#include "tests/hlc_bridge/view/sample_run.hpp"

namespace hlc::view {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(PageInBrowser, ASelectedCarScrollsItsListOnly) {
  const json result = result_of(sample_run(20, 20), R"(
    const list = by_id("list");
    list.style.marginTop = "3000px";
    const aside = document.querySelector("aside");
    result.scrolled = [];
    for (const id of [20, 1]) {
      page.select(id);
      page.draw();
      result.scrolled.push(list.scrollTop > by_id("car_1").offsetTop, aside.scrollTop + window.scrollY);
    }
  )");
  EXPECT_EQ(result.at("scrolled"), json({true, 0, false, 0}));
}

TEST_F(PageInBrowser, TwentyCarsAreDrawnTwentyTimesASecond) {
  const json result = result_of(sample_run(20, 250), R"(
    at(1);
    const begin_ms = performance.now();
    for (let i = 0; i < 40; ++i) {
      at(0.2 * i + 20);
      by_id("map").getContext("2d").getImageData(0, 0, 1, 1); // waits for the drawing
    }
    result.frame_ms = (performance.now() - begin_ms) / 40;
  )");
  EXPECT_LT(result.at("frame_ms"), 50);
  RecordProperty("frame_ms", result.at("frame_ms").dump());
}

TEST_F(PageInBrowser, TheTimeLineScrubsBothWays) {
  const json result = result_of(sample_run(3, 20), R"(
    const x = () => page.map.place(page.run.vehicles[0], page.player.t).x;
    result.places = [];
    const line = by_id("time_line");
    for (const part of [0.5, 0.25]) {
      click(line, page.time_line.x_of(part * page.run.end_s), 5);
      result.places.push([page.player.t, x(), text("step")]);
    }
    by_id("scrub").value = "3";
    by_id("scrub").dispatchEvent(new Event("input"));
    page.draw();
    result.places.push([page.player.t, x(), text("step")]);
    press("ArrowRight");
    result.right = page.player.t;
    press("ArrowLeft");
    press("ArrowLeft");
    result.left = page.player.t;
    at(3.05);
    press("ArrowLeft");
    result.left_of_step = page.player.t;
    at(3.05);
    press("ArrowRight");
    result.right_of_step = page.player.t;
    press("End");
    press("ArrowRight");
    result.end = page.player.t;
    press("Home");
    press("ArrowLeft");
    result.begin = page.player.t;
  )");
  const json& places = result.at("places");
  EXPECT_NEAR(places.at(0).at(0), 2.0, 0.02);
  EXPECT_NEAR(places.at(1).at(0), 1.0, 0.02);
  EXPECT_NEAR(places.at(2).at(0), 3.0, 1e-9);
  EXPECT_NE(places.at(0).at(1), places.at(1).at(1));
  EXPECT_NE(places.at(0).at(1), places.at(2).at(1));
  EXPECT_EQ(places.at(2).at(2), "step 15 (0 to 19)");
  EXPECT_NEAR(result.at("right"), 3.2, 1e-9);
  EXPECT_NEAR(result.at("left"), 2.8, 1e-9);
  EXPECT_NEAR(result.at("left_of_step"), 3.0, 1e-9);
  EXPECT_NEAR(result.at("right_of_step"), 3.2, 1e-9);
  EXPECT_NEAR(result.at("end"), 4.0, 1e-9);
  EXPECT_EQ(result.at("begin"), 0.0);
}

TEST_F(PageInBrowser, AClickOnACarOfAStepShowsItsReportAndThePartner) {
  const json result = result_of(sample_run(3, 20), R"(
    at(0.2 * 8 + 0.1);
    const { x, y } = page.map.place(page.run.vehicles[1], page.player.t);
    click(by_id("map"), ...page.map.to_canvas([x, y]));
    result.title = text("report_title");
    result.state = row("state");
    result.waits = row("waits for");
    result.coupled = row("coupled with");
    result.missing = row("missing");
    document.querySelector('[data-row="coupled with"] button').click();
    page.draw();
    result.partner = text("report_title");
  )");
  EXPECT_EQ(result.at("title"), "Car 2 (car 2) in step 8");
  EXPECT_THAT(result.at("state"), StartsWith("keeps its plan: conflict with car 3"));
  EXPECT_THAT(result.at("waits"), HasSubstr("car 1"));
  EXPECT_THAT(result.at("coupled"), HasSubstr("car 1"));
  EXPECT_EQ(result.at("missing"), "none");
  EXPECT_THAT(result.at("partner"), StartsWith("Car 1 (red)"));
}

TEST_F(PageInBrowser, PlaysForwardsAndBackwardsAtAnySpeed) {
  const json result = result_of(sample_run(3, 20), R"(
    const { player } = page;
    const play = (direction, speed) => {
      Object.assign(player, { speed });
      player.play(direction);
      for (const now_ms of [1000, 1100, 1300]) player.advance(now_ms);
      player.play(0);
      return player.t;
    };
    result.times = [play(1, 1), play(1, 10), play(-1, 2)];
  )");
  EXPECT_NEAR(result.at("times").at(0), 0.3, 1e-9);
  EXPECT_NEAR(result.at("times").at(1), 3.3, 1e-9);
  EXPECT_NEAR(result.at("times").at(2), 2.7, 1e-9);
}

TEST_F(PageInBrowser, TwoFingersZoomAndAFollowedCarStaysInTheMiddle) {
  const json result = result_of(sample_run(3, 20), R"(
    const map = by_id("map");
    const { left, top } = map.getBoundingClientRect();
    const touch = (type, pointerId, x) => map.dispatchEvent(new PointerEvent(
      type, { clientX: left + x, clientY: top + 100, pointerId, bubbles: true }));
    const scale = page.map.scale;
    touch("pointerdown", 1, 100);
    touch("pointerdown", 2, 200);
    touch("pointermove", 2, 300);
    for (const finger of [1, 2]) touch("pointerup", finger, 100);
    result.zoom = page.map.scale / scale;
    result.selected = page.selected;
    page.select(3);
    page.set_follow(true);
    at(2);
    const { x, y } = page.map.place(page.run.vehicles[2], 2);
    const [on_x, on_y] = page.map.to_canvas([x, y]);
    result.aside = Math.hypot(on_x - map.clientWidth / 2, on_y - map.clientHeight / 2);
  )");
  EXPECT_NEAR(result.at("zoom"), 2.0, 1e-6);
  EXPECT_EQ(result.at("selected"), nullptr) << "it was no click";
  EXPECT_NEAR(result.at("aside"), 0.0, 1e-6);
}

TEST_F(PageInBrowser, AnAddressLeadsToAMomentAndACar) {
  const json result = result_of(sample_run(3, 20), R"(
    page.draw();
    result.t = page.player.t;
    result.title = text("report_title");
    result.theme = document.documentElement.dataset.theme;
  )",
                                "#t=1.4&car=3&theme=dark");
  EXPECT_NEAR(result.at("t"), 1.4, 1e-9);
  EXPECT_THAT(result.at("title"), StartsWith("Car 3"));
  EXPECT_EQ(result.at("theme"), "dark");
}

TEST_F(PageInBrowser, TheAddressFollowsTheMoment) {
  const json result = result_of(sample_run(3, 20), R"(
    page.select(3);
    at(2.4);
    await new Promise((done) => setTimeout(done, 1000));
    result.address = location.hash;
  )");
  EXPECT_EQ(result.at("address"), "#t=2.40&car=3");
}

}  // namespace
}  // namespace hlc::view
